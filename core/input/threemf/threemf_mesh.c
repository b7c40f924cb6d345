/* Reads the mesh of an object of 3MF: vertices, triangles and their colours. */
#include <math.h>
#include <string.h>

#include "input/threemf/threemf_file.h"

enum { COUNTED_AT_ONCE = 1 << 18, EXPANDED_AT_ONCE = 1 << 14 };

struct mesh {
    struct zr_threemf *file;
    uint32_t vertex_count, vertex_room, triangle_count, triangle_room;
    zr_vec4 *positions;
    uint32_t *corners;
    struct zr_threemf_corners properties;
    bool has_holes;       /* a vertex is not finite */
    bool is_far;          /* a coordinate is beyond the limit (recenter.h) */
    struct zr_xml *again; /* if is_far: state at the begin of the vertices */
    bool finds_box;       /* vertices are read to find the bounds of used ones */
    const uint8_t *used;  /* one per vertex */
    const double *origin; /* subtracted from positions; NULL: none */
    struct zr_recenter_move *move;
    uint32_t pid, pindex; /* of the object */
};

/* ---- capacity ---- */

/* Estimates the number of elements up to the next end tag with this name. Too low only if a comment has that tag. */
static uint32_t count_children(const struct zr_threemf *file, const char *name)
{
    const char *at = file->xml.at, *const end = file->xml.end;
    const size_t length = strlen(name);
    uint32_t count = 0;
    while (at < end && !zr_is_cancelled(file->cancel)) {
        const size_t left = (size_t)(end - at);
        const char *const stop = at + (left < COUNTED_AT_ONCE ? left : COUNTED_AT_ONCE);
        while (at < stop && (at = memchr(at, '<', (size_t)(stop - at))) != NULL) {
            const char *word = ++at;
            if (word == end) return count;
            if (*word != '/') {
                if (*word != '!' && *word != '?' && count < ZR_THREEMF_NONE - 1) count++;
                continue;
            }
            while (word < end && *word != '>' && (size_t)(end - word) > length)
                if (memcmp(++word, name, length) == 0 && (word[length] == '>' || word[length] <= ' ')) return count;
        }
        at = at ? at : stop;
    }
    return count;
}

/* Returns a larger room, for a list that an end tag in a comment made too small. */
static uint32_t larger(uint32_t room)
{
    return room < ZR_THREEMF_NONE / 2 ? room * 2 + 16 : ZR_THREEMF_NONE;
}

static bool has_vertex_room(struct mesh *mesh)
{
    if (mesh->vertex_count < mesh->vertex_room) return mesh->positions != NULL;
    mesh->vertex_room = larger(mesh->vertex_room);
    mesh->positions = zr_arena_grow(mesh->file->arena, mesh->positions, mesh->vertex_count, mesh->vertex_room,
                                    sizeof *mesh->positions);
    return mesh->positions != NULL;
}

static bool has_triangle_room(struct mesh *mesh)
{
    const size_t size = 3 * sizeof *mesh->corners;
    struct zr_arena *arena = mesh->file->arena;
    if (mesh->triangle_count < mesh->triangle_room) return mesh->corners != NULL;
    mesh->triangle_room = larger(mesh->triangle_room);
    mesh->corners = zr_arena_grow(arena, mesh->corners, mesh->triangle_count, mesh->triangle_room, size);
    zr_threemf_corners_grow(&mesh->properties, mesh->triangle_count, mesh->triangle_room);
    return zr_arena_ok(arena);
}

/* ---- vertices ---- */

/* Reads a coordinate. Returns false if it is not finite. */
static bool read_coordinate(struct mesh *mesh, const struct zr_xml_attribute *attribute, double *out)
{
    struct zr_threemf *file = mesh->file;
    const struct zr_xml_text text = attribute->value;
    const double limit = zr_recenter_limit(file->limits);
    if (!zr_threemf_number(&file->xml, text, out)) {
        if (zr_is_not_finite(text.at, text.length)) return false;
        zr_threemf_fault(file, file->tag.at, "vertex %u: %c is %s, which is no number", mesh->vertex_count,
                         *attribute->name.at, zr_quote(text.at, text.length).text);
    } else if (!(*out >= -limit && *out <= limit)) {
        zr_threemf_fault(file, file->tag.at, "vertex %u: %c is beyond the limit of %.9g", mesh->vertex_count,
                         *attribute->name.at, limit);
    }
    return true;
}

/* Stores a vertex; x of a hole, one that is not finite, is NaN. */
static void put_vertex(struct mesh *mesh, const double v[3], bool is_hole)
{
    struct zr_threemf *file = mesh->file;
    if (is_hole && !mesh->move) zr_threemf_note(file, ZR_THREEMF_NOTE_HOLE, file->tag.at, file->tag.name);
    mesh->has_holes |= is_hole;
    if (mesh->finds_box && mesh->used[mesh->vertex_count]) zr_box_include(&mesh->move->box, v);
    if (!has_vertex_room(mesh)) return;
    mesh->positions[mesh->vertex_count++] =
        is_hole ? (zr_vec4){NAN, NAN, NAN, 1} : zr_recenter_position(v, mesh->origin);
}

static void read_vertex(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    const struct zr_xml_tag *tag = &file->tag;
    const double near = (double)file->limits->coordinate_max;
    double v[3] = {0};
    unsigned given = 0;
    bool is_hole = false;
    for (size_t i = 0; i < tag->count; i++) {
        const struct zr_xml_attribute *attribute = &tag->attributes[i];
        const unsigned axis = (unsigned)((unsigned char)*attribute->name.at - 'x');
        if (attribute->name.length != 1 || axis > 2 || attribute->prefix.length != 0) continue;
        given |= 1u << axis;
        if (read_coordinate(mesh, attribute, &v[axis]))
            mesh->is_far |= !(v[axis] >= -near && v[axis] <= near);
        else
            is_hole = true;
    }
    if (given != 7)
        zr_threemf_fault(file, tag->at, "vertex %u: %c is missing", mesh->vertex_count, "xyz"[__builtin_ctz(~given)]);
    put_vertex(mesh, v, is_hole);
}

static void read_vertices(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    const size_t depth = file->xml.depth, bindings = file->xml.binding_count;
    const char *at = file->xml.at;
    const bool is_first = !mesh->positions && !file->xml.ends_next;
    if (is_first) {
        mesh->vertex_room = count_children(file, "vertices");
        mesh->positions = zr_arena_alloc(file->arena, mesh->vertex_room, sizeof *mesh->positions);
    }
    while (zr_threemf_child(file, depth))
        if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "vertex")) read_vertex(mesh);
    const bool is_whole = is_first && !mesh->again;
    mesh->is_far = mesh->is_far || (is_whole && zr_recenter_is_remote(mesh->positions, mesh->vertex_count));
    if (!mesh->is_far || zr_threemf_stops(file)) return;
    if (!is_whole) {
        zr_threemf_fault(file, file->xml.at, "a mesh with coordinates beyond %.9g has one list of vertices",
                         (double)file->limits->coordinate_max);
        return;
    }
    mesh->again = zr_arena_alloc(file->arena, 1, sizeof *mesh->again);
    if (!mesh->again) return;
    *mesh->again = file->xml;
    mesh->again->at = at;
    mesh->again->depth = depth;
    mesh->again->binding_count = bindings;
}

static void read_again(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    file->xml = *mesh->again;
    mesh->vertex_count = 0;
    while (zr_threemf_child(file, mesh->again->depth))
        if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "vertex")) read_vertex(mesh);
}

/* Finds the middle of the vertices that triangles use, and reads all again to subtract it. */
static void move_to_middle(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    struct zr_xml *after = zr_arena_alloc(file->arena, 1, sizeof *after);
    uint8_t *used = zr_arena_zero(file->arena, mesh->vertex_count, sizeof *used);
    mesh->move = zr_arena_zero(file->arena, 1, sizeof *mesh->move);
    if (!zr_arena_ok(file->arena)) return;
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        if (i % EXPANDED_AT_ONCE == 0 && zr_is_cancelled(file->cancel)) return;
        used[mesh->corners[i]] = 1;
    }
    *after = file->xml;
    mesh->used = used;
    mesh->move->box = zr_box_empty();
    mesh->finds_box = true;
    read_again(mesh);
    mesh->finds_box = false;
    if (!zr_threemf_stops(file) &&
        zr_recenter_origin(file->arena, &mesh->move->box, file->limits, &mesh->origin, file->error) == ZR_OK)
        read_again(mesh);
    mesh->move->by = mesh->origin;
    if (!mesh->origin) mesh->move = NULL; /* only unused vertices are far */
    file->xml = *after;
}

/* ---- triangles ---- */

struct triangle {
    uint32_t v[3], p[3], pid;
    struct zr_xml_text paint;
    unsigned given; /* bit i: v[i] */
};

/* Reads the attributes. False after a fault. */
static bool read_attributes(struct mesh *mesh, struct triangle *t)
{
    struct zr_threemf *file = mesh->file;
    const struct zr_xml_tag *tag = &file->tag;
    for (size_t i = 0; i < tag->count; i++) {
        const struct zr_xml_attribute *attribute = &tag->attributes[i];
        const char *name = attribute->name.at;
        const size_t length = attribute->name.length;
        const bool is_bare = attribute->prefix.length == 0;
        uint32_t *out = NULL;
        const unsigned corner = length == 2 ? (unsigned)((unsigned char)name[1] - '1') : 3;
        if (is_bare && corner < 3 && *name == 'v') {
            out = &t->v[corner];
            t->given |= 1u << corner;
        } else if (is_bare && corner < 3 && *name == 'p') {
            out = &t->p[corner];
        } else if (is_bare && zr_xml_text_is(attribute->name, "pid")) {
            out = &t->pid;
        } else if (zr_xml_text_is(attribute->name, "paint_color") ||
                   zr_xml_text_is(attribute->name, "mmu_segmentation")) {
            t->paint = attribute->value;
            if (file->filament_count == 0) zr_threemf_note(file, ZR_THREEMF_NOTE_PAINTED, tag->at, attribute->name);
        }
        if (!out || zr_threemf_digits(attribute->value, out)) continue;
        return zr_threemf_fault(file, tag->at, "triangle %u: %.*s is %s, which is no whole number",
                                mesh->triangle_count, (int)length, name,
                                zr_quote(attribute->value.at, attribute->value.length).text);
    }
    if (t->given == 7) return true;
    const char missing = t->given & 1 ? t->given & 2 ? '3' : '2' : '1';
    return zr_threemf_fault(file, tag->at, "triangle %u: v%c is missing", mesh->triangle_count, missing);
}

static bool is_at_hole(const struct mesh *mesh, const uint32_t corners[3])
{
    return isnan(mesh->positions[corners[0]].x) || isnan(mesh->positions[corners[1]].x) ||
           isnan(mesh->positions[corners[2]].x);
}

/* The caller ensures room. Leaves out triangles at holes. */
static void read_triangle(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    struct triangle t = {.p = {ZR_THREEMF_NONE, ZR_THREEMF_NONE, ZR_THREEMF_NONE}, .pid = ZR_THREEMF_NONE};
    if (!read_attributes(mesh, &t)) return;
    uint32_t *corners = mesh->corners + (size_t)mesh->triangle_count * 3;
    for (int i = 0; i < 3; i++) {
        corners[i] = t.v[i];
        if (t.v[i] < mesh->vertex_count) continue;
        zr_threemf_fault(file, file->tag.at, "triangle %u names vertex %u, but there are %u", mesh->triangle_count,
                         t.v[i], mesh->vertex_count);
        return;
    }
    if (mesh->has_holes && is_at_hole(mesh, corners)) {
        mesh->properties.dropped++;
        return;
    }
    if (t.p[0] == ZR_THREEMF_NONE) {
        const uint32_t p[3] = {mesh->pindex, mesh->pindex, mesh->pindex};
        zr_threemf_corners_set(&mesh->properties, mesh->triangle_count, mesh->pid, p);
    } else {
        zr_threemf_corners_set(&mesh->properties, mesh->triangle_count, t.pid == ZR_THREEMF_NONE ? mesh->pid : t.pid,
                               t.p);
    }
    zr_threemf_corners_paint(&mesh->properties, mesh->triangle_count, t.paint);
    mesh->triangle_count++;
}

static void read_triangles(struct mesh *mesh)
{
    struct zr_threemf *file = mesh->file;
    const size_t depth = file->xml.depth;
    if (mesh->corners || file->xml.ends_next) {
        if (mesh->corners) zr_threemf_fault(file, file->tag.at, "a mesh has one list of triangles");
        return;
    }
    mesh->triangle_room = count_children(file, "triangles");
    mesh->corners = zr_arena_alloc(file->arena, mesh->triangle_room, 3 * sizeof *mesh->corners);
    mesh->properties.room = mesh->triangle_room;
    while (zr_threemf_child(file, depth))
        if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "triangle") && has_triangle_room(mesh)) read_triangle(mesh);
}

/* ---- the mesh ---- */

/* Places holes, which no triangle uses, at a vertex that is finite: they would enlarge bounds. */
static void fill_holes(const struct mesh *mesh)
{
    uint32_t good = 0;
    while (good < mesh->vertex_count && isnan(mesh->positions[good].x))
        good++;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (i % EXPANDED_AT_ONCE == 0 && zr_is_cancelled(mesh->file->cancel)) return;
        if (isnan(mesh->positions[i].x))
            mesh->positions[i] = good < mesh->vertex_count ? mesh->positions[good] : (zr_vec4){0, 0, 0, 1};
    }
}

uint32_t zr_threemf_read_mesh(struct zr_threemf *file, uint32_t object, uint32_t pid, uint32_t pindex)
{
    struct mesh mesh = {.file = file, .pid = pid, .pindex = pindex, .properties = {.file = file}};
    const size_t depth = file->xml.depth;
    if (file->part == 0)
        mesh.properties.volumes =
            zr_threemf_find_settings(file, object, ZR_THREEMF_NONE, &mesh.properties.volume_count);
    while (zr_threemf_child(file, depth)) {
        if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "vertices"))
            read_vertices(&mesh);
        else if (zr_threemf_is(file, ZR_THREEMF_SPACE_CORE, "triangles"))
            read_triangles(&mesh);
        else if (file->tag.space >= ZR_THREEMF_SPACE_SLICE)
            zr_threemf_note(file, ZR_THREEMF_NOTE_SPACES + file->tag.space, file->tag.at, file->tag.name);
    }
    if (mesh.again && !zr_threemf_stops(file)) move_to_middle(&mesh);
    if (mesh.has_holes && !zr_threemf_stops(file)) fill_holes(&mesh);
    struct zr_mesh *out = zr_threemf_list_add(file->arena, &file->meshes, sizeof *out);
    const struct zr_recenter_move **move = zr_threemf_list_add(file->arena, &file->moves, sizeof *move);
    if (!out || !move) return ZR_THREEMF_NONE;
    *move = mesh.move;
    *out = (struct zr_mesh){.name = "",
                            .position_count = mesh.vertex_count,
                            .positions = mesh.positions,
                            .face_count = mesh.triangle_count,
                            .indices = mesh.corners};
    if (!zr_threemf_corners_finish(&mesh.properties, out)) return ZR_THREEMF_NONE;
    return file->meshes.count - 1;
}
