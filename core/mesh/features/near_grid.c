#include "mesh/features/near_grid.h"

#include <string.h>

enum { SIDE_MOST = 48, ENTRIES_OF_TRIANGLE = 12, ENTRIES_LEAST = 1 << 13 };

/* Cells that a triangle comes near to. */
struct range {
    uint32_t low[3], high[3];
};

static uint32_t cell_of(const struct zr_near_grid *grid, int axis, double at)
{
    const double cell = (at - grid->low[axis]) / grid->cell;
    return cell > 0.0 ? (uint32_t)zr_least_of(cell, (double)(grid->sides[axis] - 1)) : 0;
}

static struct range range_of(const struct zr_near_grid *grid, uint32_t triangle)
{
    struct range range;
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int c = 0; c < 3; c++) {
        const zr_dvec3 p = grid->surface->places[grid->surface->corners[triangle][c]];
        const double at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            low[k] = zr_least_of(low[k], at[k]);
            high[k] = zr_most_of(high[k], at[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        range.low[k] = cell_of(grid, k, low[k] - grid->reach);
        range.high[k] = cell_of(grid, k, high[k] + grid->reach);
    }
    return range;
}

static uint64_t cells_in(const struct range *range)
{
    return (uint64_t)(range->high[0] - range->low[0] + 1) * (range->high[1] - range->low[1] + 1) *
           (range->high[2] - range->low[2] + 1);
}

/* Divides the longest side of the box by `side`. */
static void divide(struct zr_near_grid *grid, const double size[3], uint32_t side)
{
    const double longest = zr_most_of(size[0], zr_most_of(size[1], size[2]));
    grid->cell = longest > 0.0 ? longest / side : 1.0;
    for (int k = 0; k < 3; k++)
        grid->sides[k] = (uint32_t)(size[k] / grid->cell) + 1;
}

/* Chooses the number of cells. Returns the number of entries; 0 without steps. */
static uint64_t choose(struct zr_feature_work *work, struct zr_near_grid *grid, const double size[3])
{
    const uint32_t count = grid->surface->triangle_count;
    uint32_t side = 4;
    while (side < SIDE_MOST && (uint64_t)side * side * side < 2 * (uint64_t)count)
        side += side / 2;
    for (;; side = side / 2 > 0 ? side / 2 : 1) {
        uint64_t entries = 0;
        divide(grid, size, side);
        for (uint32_t t = 0; t < count; t++) {
            const struct range range = range_of(grid, t);
            if (!zr_feature_has_steps(work, 1)) return 0;
            entries += cells_in(&range);
        }
        if (side == 1 || entries <= ENTRIES_OF_TRIANGLE * (uint64_t)count + ENTRIES_LEAST) return entries;
    }
}

static bool fill(struct zr_feature_work *work, struct zr_near_grid *grid, uint32_t *begins, uint32_t *triangles)
{
    const uint32_t cells = grid->sides[0] * grid->sides[1] * grid->sides[2];
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t t = grid->surface->triangle_count; t-- > 0;) {
            const struct range range = range_of(grid, t);
            if (!zr_feature_has_steps(work, 1 + cells_in(&range) / 4)) return false;
            for (uint32_t z = range.low[2]; z <= range.high[2]; z++)
                for (uint32_t y = range.low[1]; y <= range.high[1]; y++)
                    for (uint32_t x = range.low[0]; x <= range.high[0]; x++) {
                        uint32_t *begin = &begins[(z * grid->sides[1] + y) * grid->sides[0] + x];
                        if (pass == 0)
                            (*begin)++;
                        else
                            triangles[--*begin] = t;
                    }
        }
        for (uint32_t c = 0, sum = 0; c <= cells && pass == 0; c++)
            begins[c] = sum += begins[c];
    }
    return true;
}

bool zr_near_grid_make(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                       double reach, struct zr_near_grid *out)
{
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, size[3];
    *out = (struct zr_near_grid){.surface = surface, .reach = reach, .low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    for (uint32_t i = 0; i < surface->place_count; i++) {
        const double at[3] = {surface->places[i].x, surface->places[i].y, surface->places[i].z};
        if (!zr_feature_has_steps(work, 1)) return false;
        for (int k = 0; k < 3; k++) {
            out->low[k] = zr_least_of(out->low[k], at[k]);
            high[k] = zr_most_of(high[k], at[k]);
        }
    }
    if (surface->triangle_count == 0) return false;
    for (int k = 0; k < 3; k++)
        size[k] = high[k] - out->low[k];
    const uint64_t entries = choose(work, out, size);
    if (entries == 0) return false;
    const size_t cells = (size_t)out->sides[0] * out->sides[1] * out->sides[2];
    uint32_t *begins = zr_arena_zero(arena, cells + 1, sizeof *begins);
    uint32_t *triangles = zr_arena_alloc(arena, entries, sizeof *triangles);
    out->begins = begins;
    out->triangles = triangles;
    return begins && triangles && fill(work, out, begins, triangles);
}

/* ---- distances ---- */

static double squared(zr_dvec3 v)
{
    return zr_dvec3_dot(v, v);
}

/* Returns the squared distance of a place from the line between two corners. */
static double from_side(zr_dvec3 p, zr_dvec3 a, zr_dvec3 b)
{
    const zr_dvec3 side = zr_dvec3_sub(b, a), to = zr_dvec3_sub(p, a);
    const double length = zr_dvec3_dot(side, side);
    double t = length > 0.0 ? zr_dvec3_dot(to, side) / length : 0.0;
    t = zr_most_of(0.0, zr_least_of(t, 1.0));
    return squared(zr_dvec3_add_scaled(to, side, 0.0 - t));
}

static double from_triangle(zr_dvec3 p, zr_dvec3 a, zr_dvec3 b, zr_dvec3 c)
{
    const zr_dvec3 ab = zr_dvec3_sub(b, a), bc = zr_dvec3_sub(c, b), ca = zr_dvec3_sub(a, c);
    const zr_dvec3 normal = zr_dvec3_cross(ab, bc);
    const double length = squared(normal), height = zr_dvec3_dot(zr_dvec3_sub(p, a), normal);
    const bool is_over = zr_dvec3_dot(zr_dvec3_cross(ab, zr_dvec3_sub(p, a)), normal) >= 0.0 &&
                         zr_dvec3_dot(zr_dvec3_cross(bc, zr_dvec3_sub(p, b)), normal) >= 0.0 &&
                         zr_dvec3_dot(zr_dvec3_cross(ca, zr_dvec3_sub(p, c)), normal) >= 0.0;
    if (is_over && length > 0.0) return height * height / length;
    return zr_least_of(from_side(p, a, b), zr_least_of(from_side(p, b, c), from_side(p, c, a)));
}

bool zr_near_grid_has(struct zr_feature_work *work, const struct zr_near_grid *grid, zr_dvec3 place)
{
    const double at[3] = {place.x, place.y, place.z}, most = grid->reach * grid->reach;
    uint32_t cell = 0;
    for (int k = 2; k >= 0; k--) {
        if (at[k] < grid->low[k] - grid->reach || at[k] > grid->low[k] + grid->cell * grid->sides[k] + grid->reach)
            return false;
        cell = cell * grid->sides[k] + cell_of(grid, k, at[k]);
    }
    for (uint32_t i = grid->begins[cell]; i < grid->begins[cell + 1]; i++) {
        const uint32_t *corners = grid->surface->corners[grid->triangles[i]];
        const zr_dvec3 *places = grid->surface->places;
        if (!zr_feature_has_steps(work, 1)) return false;
        if (from_triangle(place, places[corners[0]], places[corners[1]], places[corners[2]]) <= most) return true;
    }
    return false;
}
