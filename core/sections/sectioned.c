#include "sections/sectioned.h"

#include "base/run.h"
#include "sections/sectioned_attributes.h"

/* ---- sides ---- */

enum zr_section_side zr_section_side_of(const struct zr_section_cut *cut, const struct zr_mesh *mesh,
                                        const struct zr_cancel *cancel)
{
    bool all_kept_by_all = true, any_gone = false, any_whole = false, all_gone_by_all = true;
    for (uint32_t k = 0; k < cut->plane_count; k++) {
        const struct zr_slice_plane *plane = &cut->planes[k];
        bool any_kept = false, any_cut = false;
        for (uint32_t p = 0; p < mesh->position_count && !(any_kept && any_cut); p++) {
            if (p % ZR_SECTIONING_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_SECTION_WHOLE;
            const bool is_kept = zr_slice_distance(plane, mesh->positions[p]) > 0.0;
            any_kept = any_kept || is_kept;
            any_cut = any_cut || !is_kept;
        }
        all_kept_by_all = all_kept_by_all && !any_cut;
        all_gone_by_all = all_gone_by_all && !any_kept;
        any_gone = any_gone || !any_kept;
        any_whole = any_whole || !any_cut;
    }
    if (cut->is_corner) return any_whole ? ZR_SECTION_WHOLE : all_gone_by_all ? ZR_SECTION_GONE : ZR_SECTION_CUT;
    return all_kept_by_all ? ZR_SECTION_WHOLE : any_gone ? ZR_SECTION_GONE : ZR_SECTION_CUT;
}

/* ---- splitting ---- */

/* Drops faces of the mesh that are not saved: those of what all planes cut away. Its caps close the saved faces. */
static void drop_rest(const struct zr_mesh *mesh, struct zr_slice_faces *faces)
{
    uint32_t face_count = 0, ring_count = 0, corner_count = 0;
    for (uint32_t face = 0, ring = 0, at = 0; face < faces->face_count; face++) {
        const uint32_t end = faces->face_ends[face];
        const bool stays = faces->numbers[face] >= mesh->face_count || faces->is_saved[face];
        for (; ring < end; ring++) {
            for (const uint32_t ring_end = faces->ring_ends[ring]; at < ring_end; at++)
                if (stays) faces->corners[corner_count++] = faces->corners[at];
            if (stays) faces->ring_ends[ring_count++] = corner_count;
        }
        if (!stays) continue;
        faces->numbers[face_count] = faces->numbers[face];
        faces->face_ends[face_count++] = ring_count;
    }
    faces->face_count = face_count;
    faces->ring_count = ring_count;
    faces->corner_count = corner_count;
}

/* Splits by all planes. A corner is what they cut away together: each plane saves what it keeps of the rest. Saved
 * faces are split, too, so that neighbours share all vertices. */
static enum zr_status split(struct zr_sectioning *m, struct zr_slice_faces faces)
{
    const bool is_corner = m->cut->is_corner;
    for (uint32_t k = 0; k < m->cut->plane_count; k++) {
        const enum zr_status status =
            zr_slices_split(m->arena, &m->slices, &m->cut->planes[k], is_corner ? ZR_SLICE_SAVES : ZR_SLICE_KEEPS,
                            &faces, &m->lists[ZR_LIST_KEPT]);
        if (status != ZR_OK) return status;
        faces = m->lists[ZR_LIST_KEPT];
    }
    if (is_corner) drop_rest(m->mesh, &m->lists[ZR_LIST_KEPT]);
    return ZR_OK;
}

/* ---- faces ---- */

static zr_vec3 point_of(const struct zr_sectioning *m, uint32_t corner)
{
    return m->slices.points[zr_slice_vertex(&m->slices, corner)];
}

static bool is_at(zr_vec3 a, zr_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Returns true for a piece without three distinct points: a face that a plane touches in a corner or an edge. */
static bool is_rest(const struct zr_sectioning *m, const struct zr_slice_faces *list, uint32_t face)
{
    const uint32_t first = face > 0 ? list->face_ends[face - 1] : 0;
    const uint32_t begin = first > 0 ? list->ring_ends[first - 1] : 0, end = list->ring_ends[list->face_ends[face] - 1];
    const zr_vec3 a = point_of(m, list->corners[begin]);
    zr_vec3 b = a;
    bool is_made = false;
    for (uint32_t i = begin; i < end; i++) {
        const zr_vec3 c = point_of(m, list->corners[i]);
        is_made = is_made || list->corners[i] >= m->slices.slot_count;
        if (is_at(b, a))
            b = c;
        else if (!is_at(c, a) && !is_at(c, b))
            return false;
    }
    return is_made;
}

/* Appends a face of a list. */
static void add_face(struct zr_sectioning *m, const struct zr_slice_faces *list, uint32_t face)
{
    const uint32_t number = list->numbers[face], first_made = m->slices.slot_count;
    if (number >= m->mesh->face_count) m->cap_numbers[m->face_count] = number - m->mesh->face_count;
    m->numbers[m->face_count] = number;
    for (uint32_t r = face > 0 ? list->face_ends[face - 1] : 0; r < list->face_ends[face]; r++) {
        for (uint32_t at = r > 0 ? list->ring_ends[r - 1] : 0; at < list->ring_ends[r]; at++) {
            const uint32_t corner = list->corners[at];
            m->corners[m->corner_count] = corner;
            m->indices[m->corner_count++] =
                corner < first_made ? m->mesh->indices[corner] : m->mesh->position_count + (corner - first_made);
        }
        m->ring_offsets[++m->ring_count] = m->corner_count;
    }
    m->offsets[++m->face_count] = m->corner_count;
    m->face_rings[m->face_count] = m->ring_count;
}

static bool make_rooms(struct zr_sectioning *m)
{
    uint64_t faces = 0, rings = 0, corners = 0;
    for (uint32_t i = 0; i < ZR_LISTS; i++) {
        faces += m->lists[i].face_count;
        rings += m->lists[i].ring_count;
        corners += m->lists[i].corner_count;
    }
    const uint64_t wires = (uint64_t)m->wires.line_count + m->wires.point_count;
    if (corners >= ZR_SLICE_NONE || faces + wires >= ZR_SLICE_NONE) return false;
    m->offsets = zr_arena_zero(m->arena, faces + 1, sizeof *m->offsets);
    m->face_rings = zr_arena_zero(m->arena, faces + 1, sizeof *m->face_rings);
    m->ring_offsets = zr_arena_zero(m->arena, rings + 1, sizeof *m->ring_offsets);
    m->indices = zr_arena_alloc(m->arena, corners, sizeof *m->indices);
    m->corners = zr_arena_alloc(m->arena, corners, sizeof *m->corners);
    m->numbers = zr_arena_alloc(m->arena, faces + wires, sizeof *m->numbers);
    m->cap_numbers = zr_arena_alloc(m->arena, faces, sizeof *m->cap_numbers);
    m->cap_planes = zr_arena_alloc(m->arena, m->slices.cap_count, sizeof *m->cap_planes);
    return zr_arena_ok(m->arena);
}

/* Merges the lists in the order of faces. Returns the number of caps. */
static uint32_t list_faces(struct zr_sectioning *m)
{
    uint32_t at[ZR_LISTS] = {0}, caps = 0;
    for (uint32_t face = 0; face < m->mesh->face_count && !zr_sectioning_stops(m, face); face++)
        for (uint32_t i = 0; i < ZR_LISTS; i++)
            for (; at[i] < m->lists[i].face_count && m->lists[i].numbers[at[i]] == face; at[i]++)
                if (!is_rest(m, &m->lists[i], at[i])) add_face(m, &m->lists[i], at[i]);
    const struct zr_slice_faces *last = &m->lists[ZR_LIST_KEPT];
    for (uint32_t i = at[ZR_LIST_KEPT]; i < last->face_count; i++) {
        if (is_rest(m, last, i)) continue;
        add_face(m, last, i);
        caps++;
    }
    return caps;
}

/* ---- caps ---- */

/* Twice the area of a ring of made corners, along a normal. */
static double area_of(const struct zr_sectioning *m, uint32_t begin, uint32_t end, const double normal[3])
{
    double sum = 0.0;
    const zr_vec3 *points = m->slices.points;
    const zr_vec3 first = points[zr_slice_vertex(&m->slices, m->corners[begin])];
    for (uint32_t i = begin + 1; i + 1 < end; i++) {
        const zr_vec3 p = points[zr_slice_vertex(&m->slices, m->corners[i])],
                      q = points[zr_slice_vertex(&m->slices, m->corners[i + 1])];
        const double a[3] = {(double)p.x - (double)first.x, (double)p.y - (double)first.y,
                             (double)p.z - (double)first.z};
        const double b[3] = {(double)q.x - (double)first.x, (double)q.y - (double)first.y,
                             (double)q.z - (double)first.z};
        sum += (normal[0] * (a[1] * b[2] - a[2] * b[1]) + normal[1] * (a[2] * b[0] - a[0] * b[2])) +
               normal[2] * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
}

static void reverse(uint32_t *values, uint32_t begin, uint32_t end)
{
    for (; begin + 1 < end; begin++, end--) {
        const uint32_t value = values[begin];
        values[begin] = values[end - 1];
        values[end - 1] = value;
    }
}

/* Puts the largest ring of a cap first, and turns all rings so that this one is counter-clockwise seen from the side
 * that is cut away: ring 0 decides which side is the front. */
static bool turn_cap(struct zr_sectioning *m, uint32_t face)
{
    const struct zr_slice_plane *plane = &m->cut->planes[m->slices.caps[m->cap_numbers[face]].plane];
    const uint32_t first = m->face_rings[face], end = m->face_rings[face + 1], begin = m->offsets[face];
    uint32_t largest = first;
    double area = 0.0, most = 0.0; /* not fabs(area): see outside_of in lines/line_pieces.c */
    for (uint32_t r = first; r < end; r++) {
        const double own = area_of(m, m->ring_offsets[r], m->ring_offsets[r + 1], plane->normal);
        if (!(fabs(own) > most)) continue;
        most = fabs(own);
        area = own;
        largest = r;
    }
    const uint32_t moved = m->ring_offsets[largest + 1] - m->ring_offsets[largest];
    uint32_t *ring = zr_arena_alloc(m->arena, moved, sizeof *ring);
    if (!ring) return false;
    memcpy(ring, m->corners + m->ring_offsets[largest], moved * sizeof *ring);
    memmove(m->corners + begin + moved, m->corners + begin, (m->ring_offsets[largest] - begin) * sizeof *ring);
    memcpy(m->corners + begin, ring, moved * sizeof *ring);
    for (uint32_t r = largest; r > first; r--)
        m->ring_offsets[r] = m->ring_offsets[r - 1] + moved;
    for (uint32_t r = first; r < end && area > 0.0; r++)
        reverse(m->corners, m->ring_offsets[r], m->ring_offsets[r + 1]);
    for (uint32_t i = begin; i < m->offsets[face + 1]; i++)
        m->indices[i] = zr_sectioning_position(m, m->corners[i]);
    return true;
}

/* ---- the mesh ---- */

static enum zr_status build(struct zr_sectioning *m, struct zr_sectioned *out)
{
    if (!make_rooms(m)) return ZR_NO_MEMORY;
    const uint32_t caps = list_faces(m);
    if (zr_is_cancelled(m->cancel)) return ZR_CANCELLED;
    struct zr_mesh *mesh = &out->mesh;
    *mesh = *m->mesh;
    mesh->face_count = m->face_count;
    mesh->cap_count = caps;
    mesh->position_count =
        m->mesh->position_count + (m->slices.corner_count - m->slices.slot_count) + m->wires.end_count;
    for (uint32_t face = m->face_count - caps; face < m->face_count; face++)
        if (!turn_cap(m, face)) return ZR_NO_MEMORY;
    if (!zr_sectioned_attributes_make(m, mesh)) return ZR_NO_MEMORY;
    zr_wires_put(&m->wires, m->mesh, m->mesh->position_count + (m->slices.corner_count - m->slices.slot_count),
                 m->numbers + m->face_count, mesh);
    out->numbers = m->numbers;
    out->caps = m->slices.caps;
    out->cap_numbers = m->cap_numbers + (m->face_count - caps);
    for (uint32_t i = 0; i < caps; i++) {
        m->numbers[m->face_count - caps + i] = (uint32_t)zr_mesh_ids(m->mesh) + i;
        m->cap_planes[i] = m->slices.caps[out->cap_numbers[i]].plane;
    }
    mesh->cap_planes = m->cap_planes;
    if (zr_is_cancelled(m->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(m->arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_sectioned_make(const struct zr_run *run, const struct zr_mesh *mesh, const uint8_t *parts,
                                 const struct zr_section_cut *cut, struct zr_sectioned *out)
{
    struct zr_sectioning m = {.arena = run->arena, .cancel = run->cancel, .mesh = mesh, .cut = cut};
    struct zr_slice_faces faces;
    enum zr_status status = zr_slices_begin(run, mesh, parts, &m.slices, &faces, &m.lists[ZR_LIST_UNCUT]);
    if (status == ZR_OK) status = split(&m, faces);
    if (status == ZR_OK) status = zr_wires_cut(run, mesh, cut->planes, cut->plane_count, cut->is_corner, &m.wires);
    return status == ZR_OK ? build(&m, out) : status;
}
