#include "mesh/facts/ray_grid.h"

#include <string.h>

#include "base/sort.h"

enum {
    SLENDER = 8, /* the shorter side has at least this part of the rays of the longer one */
    SORTED_AT_ONCE = 1 << 12
};

/* Directions of rays: rot((0.3, 0.5, 0.8), 37.3 degrees) rot((1, 0.2, 0.1), 19.1 degrees) */
static const struct zr_world_place axes[ZR_RAY_DIRECTIONS] = {
    {0.77179749535245268, -0.33749036023969281, 0.53891454138199235},
    {0.56148016925650057, 0.75949794126626735, -0.32848576338099178},
    {-0.29844370608101645, 0.55611431734633843, 0.77567275338446939}};

/* ---- grids ---- */

/* Returns half the extent of the box along an axis, and a little more, so that no corner lies on the border. */
static double half_along(struct zr_world_place axis, const double half[3])
{
    return ((fabs(axis.x) * half[0] + fabs(axis.y) * half[1]) + fabs(axis.z) * half[2]) * (1.0 + 1e-9);
}

/* Turns the rays along an axis of the file, and the grid by 37.3 degrees. */
static void turn_along(struct zr_ray_grid *grid, int axis)
{
    static const double cosine = 0.7954734808548959, sine = 0.605988400265711;
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    grid->d = (struct zr_world_place){axis == 0, axis == 1, axis == 2};
    grid->u =
        (struct zr_world_place){(next == 0) * cosine + (last == 0) * sine, (next == 1) * cosine + (last == 1) * sine,
                                (next == 2) * cosine + (last == 2) * sine};
    grid->v = zr_world_place_cross(grid->d, grid->u);
}

void zr_ray_grid_turn(struct zr_ray_grid *grid, int direction, const double half[3])
{
    if (direction < ZR_RAY_DIRECTIONS) {
        grid->d = axes[direction];
        grid->u = axes[(direction + 1) % 3];
        grid->v = axes[(direction + 2) % 3];
    } else
        turn_along(grid, direction - ZR_RAY_ALONG_X);
    grid->half[0] = half_along(grid->u, half);
    grid->half[1] = half_along(grid->v, half);
    grid->half[2] = half_along(grid->d, half);
    grid->steps = ZR_RAY_HEIGHTS / (2.0 * grid->half[2]);
}

void zr_ray_grid_divide(struct zr_ray_grid *grid, uint32_t rays)
{
    const double longest = zr_most_of(grid->half[0], grid->half[1]);
    const uint32_t least = rays / SLENDER > 0 ? rays / SLENDER : 1;
    grid->columns = (uint32_t)((double)rays * grid->half[0] / longest + 0.5);
    grid->rows = (uint32_t)((double)rays * grid->half[1] / longest + 0.5);
    if (grid->columns < least) grid->columns = least;
    if (grid->rows < least) grid->rows = least;
    grid->width = 2.0 * grid->half[0] / (double)grid->columns;
    grid->height = 2.0 * grid->half[1] / (double)grid->rows;
    grid->rows_per_unit = (double)grid->rows / (2.0 * grid->half[1]);
}

/* ---- sorting ---- */

static void merge(const uint64_t *from, uint64_t begin, uint64_t middle, uint64_t end, uint64_t *to)
{
    for (uint64_t i = begin, left = begin, right = middle; i < end; i++)
        to[i] = left == middle || (right < end && from[right] < from[left]) ? from[right++] : from[left++];
}

void zr_ray_sort(uint64_t *at, uint32_t count, uint64_t *spare, const struct zr_cancel *cancel)
{
    for (uint64_t i = 0; i < count; i += SORTED_AT_ONCE) {
        if (i > 0 && zr_is_cancelled(cancel)) return;
        zr_sort_u64(at + i, (uint32_t)(count - i < SORTED_AT_ONCE ? count - i : SORTED_AT_ONCE));
    }
    for (uint64_t run = SORTED_AT_ONCE; run < count; run *= 2) {
        for (uint64_t begin = 0; begin < count; begin += 2 * run) {
            if (zr_is_cancelled(cancel)) return;
            const uint64_t middle = begin + run < count ? begin + run : count,
                           end = begin + 2 * run < count ? begin + 2 * run : count;
            merge(at, begin, middle, end, spare);
        }
        memcpy(at, spare, count * sizeof *at);
    }
}

double zr_ray_changes(const struct zr_ray_grid *grid, const double *lengths, size_t stride)
{
    const uint32_t columns = grid->columns, rows = grid->rows;
    double sum = 0.0;
    for (uint32_t i = 0; i < columns * rows; i++) {
        const uint32_t row = i / columns, column = i % columns;
        const uint32_t others[4] = {column > 0 ? i - 1 : i, column + 1 < columns ? i + 1 : i, row > 0 ? i - columns : i,
                                    row + 1 < rows ? i + columns : i};
        double most = 0.0;
        for (int k = 0; k < 4; k++)
            most = zr_most_of(most, fabs(lengths[i * stride] - lengths[others[k] * stride]));
        sum += most;
    }
    return sum;
}
