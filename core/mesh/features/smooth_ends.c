#include "mesh/features/smooth_ends.h"

enum { TRIANGLES_MOST = 32 }; /* of a facet that may belong to a free form */

static const double COS_SMOOTH = 0.883; /* 28 degrees */
static const double BOTH = 1.0 / 3.0, ONE = 0.6;

/* Arcs of one end: all, and those that go on in facets as long as BOTH or ONE say. */
struct end {
    double all, both, one;
};

static zr_dvec3 place_of(const struct zr_facets *facets, uint32_t triangle, int corner)
{
    return facets->surface->places[facets->surface->corners[triangle][corner]];
}

/* Returns how far a small facet reaches from one of its edges; 0 for others. */
static double reach_of(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t facet, zr_dvec3 from,
                       zr_dvec3 edge)
{
    const uint32_t begin = facets->begins[facet], end = facets->begins[facet + 1];
    const double square = zr_dvec3_dot(edge, edge);
    double most = 0.0;
    if (end - begin > TRIANGLES_MOST) return 0.0;
    for (uint32_t i = begin; i < end && zr_feature_has_steps(work, 1); i++)
        for (int k = 0; k < 3; k++) {
            const zr_dvec3 cross = zr_dvec3_cross(zr_dvec3_sub(place_of(facets, facets->triangles[i], k), from), edge);
            most = zr_most_of(most, zr_dvec3_dot(cross, cross) / square);
        }
    return sqrt(most);
}

/* Adds a side of the patch to its end. */
static void add_side(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                     uint32_t triangle, int k, struct end ends[2])
{
    const zr_dvec3 from = place_of(facets, triangle, k), to = place_of(facets, triangle, (k + 1) % 3),
                   edge = zr_dvec3_sub(to, from);
    const double along = zr_dvec3_dot(edge, patch->frame.axis), square = zr_dvec3_dot(edge, edge);
    const uint32_t next = facets->neighbours[triangle][k];
    if (along * along > 0.5 * square) return;
    const double arc = sqrt(square - along * along);
    const double middle = 0.5 * (zr_dvec3_dot(zr_dvec3_sub(from, patch->frame.center), patch->frame.axis) +
                                 zr_dvec3_dot(zr_dvec3_sub(to, patch->frame.center), patch->frame.axis));
    struct end *end = &ends[middle > 0.5 * (patch->low + patch->high)];
    end->all += arc;
    if (next == ZR_NO_FACET) return;
    const uint32_t other = facets->of_triangle[next];
    if (zr_dvec3_dot(facets->normals[facets->of_triangle[triangle]], facets->normals[other]) < COS_SMOOTH) return;
    const double reach = reach_of(work, facets, other, from, edge), length = patch->high - patch->low;
    if (reach > BOTH * length) end->both += arc;
    if (reach > ONE * length) end->one += arc;
}

bool zr_patch_is_free(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                      const uint32_t *list, const uint32_t *owners, uint32_t own)
{
    struct end ends[2] = {{0, 0, 0}, {0, 0, 0}};
    for (uint32_t i = patch->begin; i < patch->end; i++)
        for (uint32_t j = facets->begins[list[i]]; j < facets->begins[list[i] + 1]; j++) {
            if (!zr_feature_has_steps(work, 1)) return true;
            for (int k = 0; k < 3; k++) {
                const uint32_t next = facets->neighbours[facets->triangles[j]][k];
                if (next == ZR_NO_FACET || owners[facets->of_triangle[next]] != own)
                    add_side(work, facets, patch, facets->triangles[j], k, ends);
            }
        }
    return (ends[0].both > 0.5 * ends[0].all && ends[1].both > 0.5 * ends[1].all) || ends[0].one > 0.5 * ends[0].all ||
           ends[1].one > 0.5 * ends[1].all;
}
