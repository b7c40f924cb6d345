/* ray_grid.h - mesh: a grid of parallel rays along an oblique direction, and the crossings of triangles with them.
 *
 * Space:      a grid has the axes u, v and d; rays run along d. Places are relative to the middle of a box.
 * Directions: three at right angles, along which no faces of usual models line up.
 * Edges:      a ray crosses either both triangles of an edge or none: rows and columns are decided from the edge alone,
 *             from its lower to its upper end.
 * Exact:      doubles, in a fixed order, without libm but for sqrt.
 */
#ifndef ZR_RAY_GRID_H
#define ZR_RAY_GRID_H

#include "base/cancel.h"
#include "mesh/world_place.h"

enum { ZR_RAY_DIRECTIONS = 3 };

/* Directions behind the oblique ones: along the axes x, y and z, with the grid turned in its plane. */
enum { ZR_RAY_ALONG_X = ZR_RAY_DIRECTIONS };

/* Steps of a height along a ray: 2^47 from one end of the box to the other. */
#define ZR_RAY_HEIGHTS 0x1p47

struct zr_ray_grid {
    struct zr_world_place middle; /* of the box */
    struct zr_world_place u, v, d;
    double half[3]; /* of the extents along u, v and d */
    double steps;   /* of heights, per unit */
    uint32_t columns, rows;
    double width, height; /* of a cell */
    double rows_per_unit;
};

/* A triangle in the frame of a grid. Its plane has the height at[0].d + du u + dv v at (u, v) from at[0]. */
struct zr_ray_facet {
    struct {
        double u, v, d;
    } at[3];
    double cosine, du, dv, low, high; /* lowest and highest corner, from at[0] */
};

/* Sets the direction, 0 to 2 or ZR_RAY_ALONG_X to ZR_RAY_ALONG_X + 2. `half`: half of the box's sides, not all 0. */
void zr_ray_grid_turn(struct zr_ray_grid *grid, int direction, const double half[3]);

/* Sets rows and columns: `rays` along the longer side, and at least an eighth along the other one. */
void zr_ray_grid_divide(struct zr_ray_grid *grid, uint32_t rays);

/* Sorts the crossings of a ray, in pieces, so that a cancelled request need not wait for many of them. `spare` has room
 * for as many. Returns early if cancelled. */
void zr_ray_sort(uint64_t *at, uint32_t count, uint64_t *spare, const struct zr_cancel *cancel);

/* Returns the sum over all rays of the largest difference between the length of a ray and those of its neighbours.
 * lengths[i * stride] belongs to ray i, row by row. */
double zr_ray_changes(const struct zr_ray_grid *grid, const double *lengths, size_t stride);

static inline void zr_ray_facet_put(const struct zr_ray_grid *grid, struct zr_world_place at, struct zr_ray_facet *f,
                                    int corner)
{
    f->at[corner].u = zr_world_place_dot(grid->u, at);
    f->at[corner].v = zr_world_place_dot(grid->v, at);
    f->at[corner].d = zr_world_place_dot(grid->d, at);
}

/* Finds the plane, when all corners are put. */
static inline void zr_ray_facet_plane(struct zr_ray_facet *f)
{
    const struct zr_world_place a = {f->at[1].u - f->at[0].u, f->at[1].v - f->at[0].v, f->at[1].d - f->at[0].d},
                                b = {f->at[2].u - f->at[0].u, f->at[2].v - f->at[0].v, f->at[2].d - f->at[0].d},
                                n = zr_world_place_cross(a, b);
    const double length = sqrt(zr_world_place_dot(n, n));
    f->cosine = length > 0.0 ? fabs(n.z) / length : 0.0;
    f->low = zr_least_of(0.0, zr_least_of(a.z, b.z));
    f->high = zr_most_of(0.0, zr_most_of(a.z, b.z));
    f->du = n.z != 0.0 ? -n.x / n.z : 0.0;
    f->dv = n.z != 0.0 ? -n.y / n.z : 0.0;
}

/* Returns the number of cells of `size` whose middles lie before `at`, at most `count`. */
static inline uint32_t zr_ray_cells_before(double at, double half, double size, uint32_t count)
{
    const double cells = (at + half) / size + 0.5;
    return cells <= 0.0 ? 0 : cells >= (double)count ? count : (uint32_t)cells;
}

/* Returns the place of a row's rays along v. */
static inline double zr_ray_row_place(const struct zr_ray_grid *grid, uint32_t row)
{
    return ((double)row + 0.5) * grid->height - grid->half[1];
}

/* Returns the first row that does not lie below `v`. */
static inline uint32_t zr_ray_row_from(const struct zr_ray_grid *grid, double v)
{
    const double near = (v + grid->half[1]) * grid->rows_per_unit;
    uint32_t row = near <= 0.0 ? 0 : near >= (double)grid->rows ? grid->rows : (uint32_t)near;
    while (row > 0 && zr_ray_row_place(grid, row - 1) >= v)
        row--;
    while (row < grid->rows && zr_ray_row_place(grid, row) < v)
        row++;
    return row;
}

/* Finds the rows that a triangle meets. */
static inline void zr_ray_rows(const struct zr_ray_grid *grid, const struct zr_ray_facet *f, uint32_t *begin,
                               uint32_t *end)
{
    double low = f->at[0].v, high = f->at[0].v;
    for (int k = 1; k < 3; k++) {
        low = zr_least_of(low, f->at[k].v);
        high = zr_most_of(high, f->at[k].v);
    }
    *begin = zr_ray_row_from(grid, low);
    *end = zr_ray_row_from(grid, high);
}

/* Finds the columns at which the border of a triangle rises and falls on a row. False: it does not meet the row. */
static inline bool zr_ray_columns(const struct zr_ray_grid *grid, const struct zr_ray_facet *f, uint32_t row,
                                  uint32_t *rise, uint32_t *fall)
{
    const double v = zr_ray_row_place(grid, row);
    int found = 0;
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        if ((f->at[k].v <= v) == (f->at[next].v <= v)) continue;
        const bool rises = f->at[k].v <= v;
        const int low = rises ? k : next, high = rises ? next : k;
        const double u =
            f->at[low].u + (v - f->at[low].v) * (f->at[high].u - f->at[low].u) / (f->at[high].v - f->at[low].v);
        *(rises ? rise : fall) = zr_ray_cells_before(u, grid->half[0], grid->width, grid->columns);
        found++;
    }
    return found == 2;
}

/* Returns the height of a triangle on a ray, in steps, within those of its corners. */
static inline uint64_t zr_ray_height(const struct zr_ray_grid *grid, const struct zr_ray_facet *f, uint32_t row,
                                     uint32_t column)
{
    const double u = ((double)column + 0.5) * grid->width - grid->half[0] - f->at[0].u,
                 v = ((double)row + 0.5) * grid->height - grid->half[1] - f->at[0].v, d = f->du * u + f->dv * v;
    const double height =
        (f->at[0].d + (d > f->low ? d < f->high ? d : f->high : f->low) + grid->half[2]) * grid->steps;
    return (uint64_t)(height > 0.0 ? height < ZR_RAY_HEIGHTS ? height : ZR_RAY_HEIGHTS : 0.0);
}

#endif
