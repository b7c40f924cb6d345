/* Points of Draco meshes: corners of one vertex whose attributes all have one value share a point. */
#include "input/codecs/draco_mesh.h"

/* True if a seam parts two neighbouring corners of a vertex. */
static bool differs(const struct zr_draco *draco, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < draco->seam_count; i++)
        if (draco->seams[i].vertices[a] != draco->seams[i].vertices[b]) return true;
    return false;
}

/* Returns the first corner of the vertex to the right of `corner` whose value of attribute i differs, or NONE. */
static uint32_t find_seam(const struct zr_draco *draco, uint32_t i, uint32_t corner)
{
    const uint32_t *vertices = draco->seams[i].vertices;
    uint32_t at = zr_draco_right(&draco->base, corner);
    while (at != ZR_DRACO_NONE && at != corner && vertices[at] == vertices[corner])
        at = zr_draco_right(&draco->base, at);
    return at == corner ? ZR_DRACO_NONE : at;
}

/* Returns the corner at which the points of a vertex begin: at a boundary, else at a seam, else anywhere. */
static uint32_t find_start(const struct zr_draco *draco, uint32_t vertex)
{
    const uint32_t first = draco->base.first[vertex];
    uint32_t found = ZR_DRACO_NONE;
    for (uint32_t i = 0; i < draco->seam_count && draco->is_inner[vertex] && found == ZR_DRACO_NONE; i++)
        found = find_seam(draco, i, first);
    return found == ZR_DRACO_NONE ? first : found;
}

/* Gives the corners of a vertex their points. Returns the number of corners; 0: broken or cancelled. */
static uint32_t make_points(struct zr_draco *draco, uint32_t vertex)
{
    const uint32_t start = find_start(draco, vertex);
    uint32_t count = 0, at = start, before = start, *points = draco->points;
    do {
        if (points[at] != ZR_DRACO_NONE || draco->base.vertices[at] != vertex || zr_draco_stops(draco)) return 0;
        if (count++ == 0 || differs(draco, at, before)) draco->mesh->point_count++;
        points[at] = draco->mesh->point_count - 1;
        before = at;
        at = zr_draco_right(&draco->base, at);
    } while (at != ZR_DRACO_NONE && at != start);
    return count;
}

bool zr_draco_make_points(struct zr_draco *draco)
{
    const struct zr_draco_corners *base = &draco->base;
    uint32_t corners = 0;
    draco->mesh->point_count = 0;
    if (!zr_draco_clear(draco, draco->points, base->corner_count)) return false;
    for (uint32_t v = 0; v < base->vertex_count; v++) {
        if (zr_draco_stops(draco)) return false;
        if (base->first[v] == ZR_DRACO_NONE) continue;
        const uint32_t count = make_points(draco, v);
        if (count == 0) return false;
        corners += count;
    }
    return corners == base->corner_count;
}
