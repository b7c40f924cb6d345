#include "mesh/features/planes.h"

static const double SHARE = 0.01; /* of the area */
static const double SAME = 1e-5;  /* of the size, and between unit normals */

/* Returns the mean height of a facet along its normal, weighted by the areas of its triangles. */
static double offset_of(const struct zr_facets *facets, uint32_t facet)
{
    const struct zr_surface *surface = facets->surface;
    double sum = 0.0, weights = 0.0;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++) {
        const uint32_t *corners = surface->corners[facets->triangles[i]];
        const zr_dvec3 a = surface->places[corners[0]], b = surface->places[corners[1]],
                       c = surface->places[corners[2]];
        const zr_dvec3 cross = zr_dvec3_cross(zr_dvec3_sub(b, a), zr_dvec3_sub(c, a));
        const double weight = sqrt(zr_dvec3_dot(cross, cross));
        const zr_dvec3 normal = facets->normals[facet];
        sum += weight * (zr_dvec3_dot(normal, a) + zr_dvec3_dot(normal, b) + zr_dvec3_dot(normal, c)) / 3.0;
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

static bool are_same(const struct zr_plane *a, const struct zr_plane *b, double size)
{
    const zr_dvec3 turn = zr_dvec3_sub(a->normal, b->normal);
    return zr_dvec3_dot(turn, turn) <= SAME * SAME && fabs(a->offset - b->offset) <= SAME * size;
}

static void sort(struct zr_plane *planes, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const struct zr_plane own = planes[i];
        uint32_t k = i;
        for (; k > 0 && planes[k - 1].area < own.area; k--)
            planes[k] = planes[k - 1];
        planes[k] = own;
    }
}

bool zr_planes_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                    struct zr_planes *out)
{
    struct zr_plane *planes = zr_arena_alloc(arena, ZR_PLANES_MAX, sizeof *planes);
    double area = 0.0;
    *out = (struct zr_planes){.at = planes};
    if (!planes) return false;
    for (uint32_t f = 0; f < facets->count && zr_feature_has_steps(work, 1); f++)
        area += facets->areas[f];
    for (uint32_t f = 0; f < facets->count && area > 0.0; f++) {
        if (!zr_feature_has_steps(work, 1)) return false;
        if (facets->areas[f] < SHARE * area || out->count == ZR_PLANES_MAX) continue;
        if (!zr_feature_has_steps(work, facets->begins[f + 1] - facets->begins[f] + out->count)) return false;
        const struct zr_plane own = {facets->normals[f], offset_of(facets, f), facets->areas[f]};
        uint32_t to = 0;
        while (to < out->count && !are_same(&planes[to], &own, facets->surface->size))
            to++;
        if (to < out->count)
            planes[to].area += own.area;
        else
            planes[out->count++] = own;
    }
    sort(planes, out->count);
    return !work->is_stopped;
}
