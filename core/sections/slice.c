#include "sections/slices.h"

#include "base/run.h"
#include "mesh/facts/closed_parts.h"
#include "mesh/weld.h"

enum { FACES_PER_CANCEL_CHECK = 1 << 13, VERTICES_PER_CANCEL_CHECK = 1 << 16 };

/* Edges that cross the plane, by their vertices; a hash table with linear probing, at most half full. */
struct crossing {
    uint32_t low, high, vertex;
    double t; /* 0 at low, 1 at high */
};

struct splitting {
    struct zr_slices *slices;
    const struct zr_slice_faces *from;
    double *distances; /* per vertex */
    bool *stays;       /* per vertex */
    bool saves;
    struct crossing *table;
    uint32_t table_bits;
    struct zr_slice_segment *segments;
    uint32_t segment_count;
    struct zr_slice_faces *out;
};

/* ---- beginning ---- */

static bool make_faces(struct zr_arena *arena, uint64_t faces, uint64_t rings, uint64_t corners,
                       struct zr_slice_faces *out)
{
    *out = (struct zr_slice_faces){.numbers = zr_arena_alloc(arena, faces, sizeof *out->numbers),
                                   .is_saved = zr_arena_alloc(arena, faces, sizeof *out->is_saved),
                                   .face_ends = zr_arena_alloc(arena, faces, sizeof *out->face_ends),
                                   .ring_ends = zr_arena_alloc(arena, rings, sizeof *out->ring_ends),
                                   .corners = zr_arena_alloc(arena, corners, sizeof *out->corners)};
    return zr_arena_ok(arena) && corners < ZR_SLICE_NONE;
}

static void end_ring(struct zr_slice_faces *faces)
{
    faces->ring_ends[faces->ring_count++] = faces->corner_count;
}

static void end_face(struct zr_slice_faces *faces, uint32_t number, bool is_saved)
{
    faces->is_saved[faces->face_count] = is_saved;
    faces->numbers[faces->face_count] = number;
    faces->face_ends[faces->face_count++] = faces->ring_count;
}

/* Lists a ring. */
static void list_ring(const struct zr_rings *rings, uint32_t ring, bool is_reversed, struct zr_slice_faces *faces)
{
    const uint32_t begin = rings->offsets[ring], end = rings->offsets[ring + 1];
    for (uint32_t i = begin; i < end; i++)
        faces->corners[faces->corner_count++] = is_reversed ? begin + end - 1 - i : i;
    end_ring(faces);
}

static void list_face(const struct zr_mesh *mesh, uint32_t face, struct zr_slice_faces *faces)
{
    const struct zr_rings rings = zr_mesh_rings(mesh, face);
    for (uint32_t r = 0; r < rings.count; r++)
        list_ring(&rings, r, r > 0 && zr_ring_turns_as_first(mesh, &rings, r), faces);
    end_face(faces, face, false);
}

/* Lists the fan of a face, each triangle as a face. */
static void list_fan(const struct zr_mesh *mesh, uint32_t face, struct zr_slice_faces *faces)
{
    const uint32_t begin = mesh->face_offsets[face], end = mesh->face_offsets[face + 1];
    for (uint32_t i = begin + 2; i < end; i++) {
        const uint32_t fan[3] = {end - begin == 3 ? begin : i - 1, end - begin == 3 ? begin + 1 : i,
                                 end - begin == 3 ? begin + 2 : begin};
        memcpy(faces->corners + faces->corner_count, fan, sizeof fan);
        faces->corner_count += 3;
        end_ring(faces);
        end_face(faces, face, false);
    }
}

static uint32_t part_of(const struct zr_mesh *mesh, uint32_t face)
{
    return mesh->face_parts ? mesh->face_parts[face] : 0;
}

/* Lists the faces of parts that are cut, or those of parts that are not. */
static enum zr_status list_faces(struct zr_arena *arena, const struct zr_slices *slices, bool uncut,
                                 struct zr_slice_faces *out)
{
    const struct zr_mesh *mesh = slices->mesh;
    const bool fans = mesh->faces_are_fans;
    uint64_t faces = 0, rings = 0, corners = 0;
    for (uint32_t face = 0; face < mesh->face_count; face++) {
        const uint32_t count = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
        if (face % VERTICES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(slices->cancel)) return ZR_CANCELLED;
        if ((slices->parts[part_of(mesh, face)] == ZR_SLICE_UNCUT) != uncut) continue;
        faces += fans ? count - 2 : 1;
        rings += fans ? count - 2 : zr_mesh_rings(mesh, face).count;
        corners += fans ? 3 * (count - 2) : count;
    }
    if (!make_faces(arena, faces, rings, corners, out)) return ZR_NO_MEMORY;
    for (uint32_t face = 0; face < mesh->face_count && corners > 0; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(slices->cancel)) return ZR_CANCELLED;
        if ((slices->parts[part_of(mesh, face)] == ZR_SLICE_UNCUT) != uncut) continue;
        if (fans)
            list_fan(mesh, face, out);
        else
            list_face(mesh, face, out);
    }
    return ZR_OK;
}

/* Sets points[v] to the first position of each vertex. */
static void list_points(const struct zr_mesh *mesh, const struct zr_cancel *cancel, const uint32_t *vertices,
                        zr_vec3 *points)
{
    for (uint32_t p = mesh->position_count; p-- > 0;) {
        if (p % VERTICES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        points[vertices[p]] = zr_vec4_over_w(mesh->positions[p]);
    }
}

enum zr_status zr_slices_begin(const struct zr_run *run, const struct zr_mesh *mesh, const uint8_t *parts,
                               struct zr_slices *slices, struct zr_slice_faces *faces, struct zr_slice_faces *uncut)
{
    const struct zr_mesh_extent extent = zr_mesh_extent_of(run->team, mesh);
    uint32_t *vertices = zr_arena_alloc(run->arena, mesh->position_count, sizeof *vertices);
    zr_vec3 *points = zr_arena_alloc(run->arena, mesh->position_count, sizeof *points);
    uint64_t *room = zr_arena_alloc(run->arena, zr_weld_room(mesh->position_count), sizeof *room);
    zr_vec4 *copy = zr_arena_alloc(run->arena, extent.needs_copy ? mesh->position_count : 0, sizeof *copy);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    const struct zr_weld_input input = zr_weld_input_make(run->team, mesh, &extent, copy);
    *slices = (struct zr_slices){.mesh = mesh,
                                 .cancel = run->cancel,
                                 .parts = parts,
                                 .slot_count = mesh->face_offsets[mesh->face_count],
                                 .vertices = vertices,
                                 .points = points};
    slices->corner_count = slices->slot_count;
    slices->vertex_count = zr_weld_make(run->team, run->cancel, &input, room, vertices);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    list_points(mesh, run->cancel, vertices, points);
    const enum zr_status status = list_faces(run->arena, slices, true, uncut);
    return status == ZR_OK ? list_faces(run->arena, slices, false, faces) : status;
}

/* ---- sides ---- */

static bool find_sides(struct splitting *s, const struct zr_slice_plane *plane)
{
    const struct zr_slices *slices = s->slices;
    for (uint32_t v = 0; v < slices->vertex_count; v++) {
        const zr_vec3 p = slices->points[v];
        if (v % VERTICES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(slices->cancel)) return false;
        s->distances[v] = zr_slice_distance(plane, (zr_vec4){p.x, p.y, p.z, 1.0f});
        s->stays[v] = (s->distances[v] > 0.0) != s->saves;
    }
    return true;
}

static bool corner_stays(const struct splitting *s, uint32_t corner)
{
    return s->stays[zr_slice_vertex(s->slices, corner)];
}

/* Upper bounds of what the step makes. */
struct sizes {
    uint64_t crossings, faces, rings, corners;
};

/* Both sides of a face count, also if one of them is dropped. */
static bool measure(const struct splitting *s, struct sizes *sizes)
{
    const struct zr_slice_faces *from = s->from;
    uint64_t crossings = 0, crossed = 0;
    for (uint32_t ring = 0, at = 0; ring < from->ring_count; ring++) {
        const uint32_t end = from->ring_ends[ring];
        const uint64_t before = crossings;
        bool last = corner_stays(s, from->corners[end - 1]);
        if (ring % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(s->slices->cancel)) return false;
        for (; at < end; at++) {
            const bool stays = corner_stays(s, from->corners[at]);
            crossings += stays != last;
            last = stays;
        }
        crossed += crossings > before;
    }
    /* A face on both sides has a crossed ring, or rings on either side. */
    *sizes = (struct sizes){crossings, from->face_count + crossed, from->ring_count + crossed,
                            from->corner_count + 2 * crossings};
    if (s->slices->mesh->face_rings) sizes->faces = from->face_count + from->ring_count;
    return true;
}

/* ---- vertices on edges ---- */

static float between(float a, float b, double t)
{
    return (float)((double)a + t * ((double)b - (double)a));
}

static void make_vertex(struct splitting *s, struct crossing *c)
{
    struct zr_slices *slices = s->slices;
    const double low = s->distances[c->low], high = s->distances[c->high];
    const zr_vec3 a = slices->points[c->low], b = slices->points[c->high];
    c->t = low / (low - high);
    c->vertex = slices->vertex_count++;
    slices->points[c->vertex] =
        c->t == 1.0 ? b : (zr_vec3){between(a.x, b.x, c->t), between(a.y, b.y, c->t), between(a.z, b.z, c->t)};
}

/* Returns the crossing of an edge, in either direction. */
static const struct crossing *crossing_of(struct splitting *s, uint32_t from, uint32_t to)
{
    const uint32_t low = from < to ? from : to, high = from < to ? to : from, mask = (1u << s->table_bits) - 1;
    uint32_t slot = (uint32_t)(((uint64_t)low << 32 | high) * UINT64_C(0x9e3779b97f4a7c15) >> (64 - s->table_bits));
    while (s->table[slot].vertex != ZR_SLICE_NONE && (s->table[slot].low != low || s->table[slot].high != high))
        slot = (slot + 1) & mask;
    struct crossing *c = &s->table[slot];
    if (c->vertex != ZR_SLICE_NONE) return c;
    c->low = low;
    c->high = high;
    make_vertex(s, c);
    return c;
}

/* Makes the corner on the edge between two corners of a ring. */
static uint32_t cross(struct splitting *s, uint32_t a, uint32_t b)
{
    struct zr_slices *slices = s->slices;
    const uint32_t from = zr_slice_vertex(slices, a), to = zr_slice_vertex(slices, b);
    const struct crossing *c = crossing_of(s, from, to);
    slices->made[slices->corner_count - slices->slot_count] =
        (struct zr_slice_corner){a, b, from < to ? c->t : 1.0 - c->t, c->vertex};
    return slices->corner_count++;
}

/* ---- clipping ---- */

/* Chords of one face. */
struct chords {
    uint32_t part, face; /* of the mesh; part ZR_SLICE_NONE: no caps */
    uint32_t left;       /* vertex at which the ring left the side last; ZR_SLICE_NONE: not yet */
    uint32_t first_back; /* vertex at which it came back without having left */
};

static void add_segment(struct splitting *s, const struct chords *chords, uint32_t left, uint32_t back)
{
    if (chords->part == ZR_SLICE_NONE || left == back) return;
    s->segments[s->segment_count++] = (struct zr_slice_segment){chords->part, back, left, chords->face};
}

static void meet(struct splitting *s, struct chords *chords, uint32_t vertex, bool leaves)
{
    if (leaves)
        chords->left = vertex;
    else if (chords->left == ZR_SLICE_NONE)
        chords->first_back = vertex;
    else
        add_segment(s, chords, chords->left, vertex);
}

/* Clips a ring to the side that stays, or to the other one. */
static void clip_ring(struct splitting *s, const uint32_t *corners, uint32_t count, bool side, struct chords *chords)
{
    struct zr_slice_faces *out = s->out;
    const uint32_t begin = out->corner_count;
    uint32_t last = corners[count - 1];
    bool last_in = corner_stays(s, last) == side;
    chords->left = chords->first_back = ZR_SLICE_NONE;
    for (uint32_t i = 0; i < count; i++) {
        const bool in = corner_stays(s, corners[i]) == side;
        if (in != last_in) {
            const uint32_t corner = cross(s, last, corners[i]);
            out->corners[out->corner_count++] = corner;
            meet(s, chords, zr_slice_vertex(s->slices, corner), last_in);
        }
        if (in) out->corners[out->corner_count++] = corners[i];
        last = corners[i];
        last_in = in;
    }
    if (chords->first_back != ZR_SLICE_NONE) add_segment(s, chords, chords->left, chords->first_back);
    if (out->corner_count > begin) end_ring(out);
}

/* Emits the part of a face on one side. */
static void clip_face(struct splitting *s, uint32_t face, bool side, bool is_saved, struct chords *chords)
{
    const struct zr_slice_faces *from = s->from;
    const uint32_t rings = s->out->ring_count;
    for (uint32_t r = face > 0 ? from->face_ends[face - 1] : 0; r < from->face_ends[face]; r++) {
        const uint32_t begin = r > 0 ? from->ring_ends[r - 1] : 0;
        clip_ring(s, from->corners + begin, from->ring_ends[r] - begin, side, chords);
    }
    if (s->out->ring_count > rings) end_face(s->out, from->numbers[face], is_saved);
}

static void split_face(struct splitting *s, uint32_t face)
{
    const struct zr_slices *slices = s->slices;
    const struct zr_mesh *mesh = slices->mesh;
    const uint32_t number = s->from->numbers[face];
    const struct zr_slice_cap *cap = number >= mesh->face_count ? &slices->caps[number - mesh->face_count] : NULL;
    const uint32_t own = cap ? cap->face : number, part = part_of(mesh, own);
    const bool is_saved = s->from->is_saved[face], has_caps = slices->parts[part] == ZR_SLICE_CLOSED && !is_saved;
    struct chords chords = {.part = has_caps ? part : ZR_SLICE_NONE, .face = own}, none = {.part = ZR_SLICE_NONE};
    clip_face(s, face, true, is_saved, &chords);
    if (s->saves && !cap) clip_face(s, face, false, true, &none);
}

/* ---- the step ---- */

/* Makes all arrays that later steps fill. Each side makes corners of its own. */
static bool make_rooms(struct zr_arena *arena, struct splitting *s, const struct sizes *sizes)
{
    struct zr_slices *slices = s->slices;
    const uint64_t chords = sizes->crossings / 2, made = slices->corner_count - slices->slot_count;
    const uint64_t more = (s->saves ? 2 : 1) * sizes->crossings + chords;
    const uint64_t vertices = slices->vertex_count + sizes->crossings;
    if (slices->corner_count + more >= ZR_SLICE_NONE || vertices >= ZR_SLICE_NONE) return false;
    while ((UINT64_C(1) << s->table_bits) < 2 * sizes->crossings + 2)
        s->table_bits++;
    s->table = zr_arena_alloc(arena, (size_t)1 << s->table_bits, sizeof *s->table);
    s->segments = zr_arena_alloc(arena, chords, sizeof *s->segments);
    struct zr_slice_corner *corners = zr_arena_grow(arena, slices->made, made, made + more, sizeof *corners);
    zr_vec3 *points = zr_arena_grow(arena, slices->points, slices->vertex_count, vertices, sizeof *points);
    if (!zr_arena_ok(arena)) return false;
    slices->made = corners;
    slices->points = points;
    for (size_t i = 0; i < (size_t)1 << s->table_bits; i++)
        s->table[i].vertex = ZR_SLICE_NONE;
    return make_faces(arena, sizes->faces + chords, sizes->rings + chords, sizes->corners + chords, s->out);
}

enum zr_status zr_slices_split(struct zr_arena *arena, struct zr_slices *slices, const struct zr_slice_plane *plane,
                               enum zr_slice_mode mode, const struct zr_slice_faces *faces, struct zr_slice_faces *out)
{
    struct splitting s = {
        .slices = slices, .from = faces, .out = out, .saves = mode == ZR_SLICE_SAVES, .table_bits = 1};
    struct sizes sizes;
    s.distances = zr_arena_alloc(arena, slices->vertex_count, sizeof *s.distances);
    s.stays = zr_arena_alloc(arena, slices->vertex_count, sizeof *s.stays);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (!find_sides(&s, plane) || !measure(&s, &sizes)) return ZR_CANCELLED;
    if (!make_rooms(arena, &s, &sizes)) return ZR_NO_MEMORY;
    for (uint32_t face = 0; face < faces->face_count; face++) {
        if (face % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(slices->cancel)) return ZR_CANCELLED;
        split_face(&s, face);
    }
    const enum zr_status status = zr_slice_caps_add(arena, slices, s.segments, s.segment_count, out);
    slices->plane_count++;
    return status;
}
