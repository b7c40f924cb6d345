#include "mesh/features/tunnels.h"

/* Finds the triangles that are connected with the first one of `stack`. False if an edge there has not two triangles, or
 * no step is left. */
static bool flood(struct zr_feature_work *work, const struct zr_facets *facets, bool *is_found, uint32_t *stack)
{
    for (uint32_t count = 1; count > 0;) {
        if (!zr_feature_has_steps(work, 1)) return false;
        const uint32_t *neighbours = facets->neighbours[stack[--count]];
        for (int k = 0; k < 3; k++) {
            if (neighbours[k] == ZR_NO_FACET) return false;
            if (is_found[neighbours[k]]) continue;
            is_found[neighbours[k]] = true;
            stack[count++] = neighbours[k];
        }
    }
    return true;
}

/* Returns the corner of a triangle at a place. */
static uint32_t corner_at(const struct zr_surface *surface, uint32_t triangle, uint32_t place)
{
    const uint32_t *corners = surface->corners[triangle];
    return 3 * triangle + (corners[0] == place ? 0 : corners[1] == place ? 1 : 2);
}

/* Counts the fans of triangles around all places: shells that touch at a place have one each. The surface is closed. */
static uint32_t count_fans(struct zr_feature_work *work, const struct zr_facets *facets, bool *is_found)
{
    const struct zr_surface *surface = facets->surface;
    uint32_t fans = 0;
    for (uint32_t first = 0; first < 3 * surface->triangle_count; first++) {
        if (!zr_feature_has_steps(work, 1)) return 0;
        if (is_found[first]) continue;
        fans++;
        for (uint32_t corner = first; !is_found[corner];) {
            const uint32_t triangle = corner / 3, place = surface->corners[triangle][corner % 3];
            is_found[corner] = true;
            corner = corner_at(surface, facets->neighbours[triangle][corner % 3], place);
        }
    }
    return fans;
}

struct zr_tunnels zr_tunnels_count(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets)
{
    const uint32_t triangles = facets->surface->triangle_count;
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    uint32_t *stack = zr_arena_alloc(&scratch, triangles, sizeof *stack), pieces = 0, fans = 0;
    bool *is_found = zr_arena_zero(&scratch, triangles, sizeof *is_found),
         *is_in_fan = zr_arena_zero(&scratch, triangles, 3 * sizeof *is_in_fan);
    bool is_closed = zr_arena_ok(&scratch) && triangles > 0;
    for (uint32_t t = 0; t < triangles && is_closed; t++) {
        if (is_found[t]) continue;
        is_found[t] = true;
        stack[0] = t;
        pieces++;
        is_closed = flood(work, facets, is_found, stack);
    }
    if (is_closed) fans = count_fans(work, facets, is_in_fan);
    zr_arena_close_scratch(&scratch, arena);
    const int64_t euler = (int64_t)fans - triangles / 2, twice = 2 * (int64_t)pieces - euler;
    const bool is_known = fans > 0 && twice >= 0 && twice % 2 == 0;
    return (struct zr_tunnels){is_known, is_known ? (uint32_t)(twice / 2) : 0};
}
