/* Tables of attributes with seams: the faces of the positions, parted along the seams. */
#include "input/codecs/draco_mesh.h"

/* Parts the faces along seams. Marks the vertices at seams and boundaries. */
static bool part(struct zr_draco *draco, const bool *is_seam, bool *at_seam, struct zr_draco_corners *out)
{
    const struct zr_draco_corners *base = &draco->base;
    for (uint32_t c = 0; c < base->corner_count; c++) {
        const uint32_t opposite = base->opposites[c];
        const bool is_parted = opposite == ZR_DRACO_NONE || is_seam[c] || is_seam[opposite];
        out->opposites[c] = is_parted ? ZR_DRACO_NONE : opposite;
        if (is_parted) at_seam[base->vertices[zr_draco_next(c)]] = at_seam[base->vertices[zr_draco_previous(c)]] = true;
        if (zr_draco_stops(draco)) return false;
    }
    return true;
}

/* Returns the corner of a vertex at the right of a seam or a boundary; NONE if there is none. */
static uint32_t find_start(const struct zr_draco_corners *of, uint32_t corner)
{
    uint32_t at = corner;
    for (uint32_t left = zr_draco_left(of, at); left != ZR_DRACO_NONE; left = zr_draco_left(of, at)) {
        if (left == corner) return ZR_DRACO_NONE;
        at = left;
    }
    return at;
}

/* Makes the vertices of `out` around a vertex of the base. Returns the number of its corners; 0: broken
 * or cancelled. */
static uint32_t make_vertices(struct zr_draco *draco, uint32_t vertex, bool at_seam, struct zr_draco_corners *out)
{
    const struct zr_draco_corners *base = &draco->base;
    const uint32_t start = at_seam ? find_start(out, base->first[vertex]) : base->first[vertex];
    uint32_t count = 0, at = start;
    if (start == ZR_DRACO_NONE) return 0;
    do {
        if (out->vertices[at] != ZR_DRACO_NONE || base->vertices[at] != vertex || zr_draco_stops(draco)) return 0;
        if (count++ == 0 || out->opposites[zr_draco_next(at)] == ZR_DRACO_NONE) out->first[out->vertex_count++] = at;
        out->vertices[at] = out->vertex_count - 1;
        at = zr_draco_right(base, at);
    } while (at != ZR_DRACO_NONE && at != start);
    return count;
}

bool zr_draco_make_seams(struct zr_draco *draco, const bool *is_seam, struct zr_draco_corners *out)
{
    const struct zr_draco_corners *base = &draco->base;
    bool *at_seam = zr_arena_zero(&draco->scratch, base->vertex_count, sizeof *at_seam);
    uint32_t corners = 0;
    *out = (struct zr_draco_corners){.corner_count = base->corner_count,
                                     .vertices = zr_draco_nones(draco, base->corner_count),
                                     .opposites = zr_draco_numbers(draco, base->corner_count),
                                     .first = zr_draco_numbers(draco, base->corner_count)};
    if (!at_seam || !out->vertices || !zr_arena_ok(&draco->scratch) || !part(draco, is_seam, at_seam, out))
        return false;
    for (uint32_t v = 0; v < base->vertex_count; v++) {
        if (zr_draco_stops(draco)) return false;
        if (base->first[v] == ZR_DRACO_NONE) continue;
        const uint32_t count = make_vertices(draco, v, at_seam[v], out);
        if (count == 0) return false;
        corners += count;
    }
    return corners == base->corner_count;
}
