/* Makes a mesh of one primitive of glTF. Reads only the vertices from the smallest to the largest index, since many
 * primitives often share one accessor. */
#include "input/gltf/gltf_parts.h"

#include <string.h>

#include "base/cancel.h"
#include "base/srgb.h"
#include "input/codecs/draco.h"

/* Colours per encoding pass, on the stack. */
enum { AT_ONCE = 256 };

/* ---- attributes ---- */

static struct zr_gltf_attribute attribute_of(const struct zr_gltf_making *making, const char *name, uint32_t accessor,
                                             int shape)
{
    return (struct zr_gltf_attribute){making->attributes, name, accessor, shape, making->vertices};
}

static zr_vec4 *read_positions(struct zr_gltf *file, struct zr_gltf_values *values, const struct zr_gltf_making *making)
{
    const uint32_t count = making->range.count;
    zr_vec4 *positions = zr_gltf_allocate(file, count, sizeof *positions);
    const struct zr_limits *limits = file->json.limits;
    const bool is_bent = file->uses[file->use].skin != ZR_GLTF_NONE;
    const uint32_t holes = file->holes.count;
    values->limit = is_bent ? (double)limits->coordinate_max : zr_recenter_limit(limits);
    values->holes = true;
    if (!positions || !zr_gltf_read_floats(file, values, &making->range, &positions[0].x, 4)) return NULL;
    if (file->holes.count > holes && !zr_gltf_drop_holes(file, making, positions)) return NULL;
    const float near = limits->coordinate_max;
    bool is_far = false;
    for (uint32_t i = 0; i < count; i++) {
        is_far |= fabsf(positions[i].x) > near || fabsf(positions[i].y) > near || fabsf(positions[i].z) > near;
        positions[i].w = 1.0f;
    }
    if (!is_far) return positions;
    const struct zr_run run = zr_json_run(&file->json);
    return zr_recenter_move_floats(&run, limits, positions, count, &file->moves[making->number]) == ZR_OK ? positions
                                                                                                          : NULL;
}

static bool read_normals(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const struct zr_gltf_attribute of = attribute_of(making, "NORMAL", making->given->attributes.normal, ZR_GLTF_VEC3);
    zr_vec3 *normals = (zr_vec3 *)(void *)zr_gltf_read_vectors(file, &of, &making->range);
    if (!normals) return false;
    zr_scene_builder_note_normals(file->builder, making->number, normals, making->range.count);
    making->mesh->normals = normals;
    making->mesh->normal_count = making->range.count;
    return true;
}

static bool read_tangents(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const struct zr_gltf_attribute of =
        attribute_of(making, "TANGENT", making->given->attributes.tangent, ZR_GLTF_VEC4);
    zr_vec4 *tangents = (zr_vec4 *)(void *)zr_gltf_read_vectors(file, &of, &making->range);
    for (uint32_t i = 0; tangents && i < making->range.count; i++)
        tangents[i].w = tangents[i].w < 0.0f ? -1.0f : 1.0f;
    making->mesh->tangents = tangents;
    return tangents != NULL;
}

/* Some exporters write texture coordinates of volumes, of which the first two are read. */
static int shape_of_texcoords(const struct zr_gltf *file, uint32_t accessor)
{
    const bool is_wide = accessor < file->counts[ZR_GLTF_ACCESSORS] &&
                         file->accessors[accessor].shape == ZR_GLTF_VEC3 && file->accessors[accessor].sparse.count == 0;
    return is_wide ? ZR_GLTF_VEC3 : ZR_GLTF_VEC2;
}

/* Returns the accessor of the set that the material has at a place, 0 or 1. */
static uint32_t texcoords_at(const struct zr_gltf *file, const struct zr_gltf_making *making, uint32_t place)
{
    return making->given->attributes.texcoords[zr_gltf_set_of(file, making->given->material, place)];
}

/* Reads both sets of the material into one array: the first into x, y and the second into z, w. */
static bool read_texcoords(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    static const char *const names[ZR_GLTF_SETS] = {"TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2", "TEXCOORD_3",
                                                    "TEXCOORD_4", "TEXCOORD_5", "TEXCOORD_6", "TEXCOORD_7"};
    const uint32_t count = making->range.count;
    zr_vec4 *texcoords = zr_json_has_time(&file->json, count * sizeof *texcoords)
                             ? zr_arena_zero(file->json.arena, count, sizeof *texcoords)
                             : NULL;
    if (!texcoords) return false;
    for (uint32_t place = 0; place < 2; place++) {
        const uint32_t number = texcoords_at(file, making, place);
        const struct zr_gltf_attribute of =
            attribute_of(making, names[zr_gltf_set_of(file, making->given->material, place)], number,
                         shape_of_texcoords(file, number));
        struct zr_gltf_values values;
        if (number == ZR_GLTF_NONE) continue;
        if (!zr_gltf_open_attribute(file, &of, &values)) return false;
        values.mends = true;
        if (of.shape == ZR_GLTF_VEC3) zr_gltf_note(&file->wide_texcoords, ZR_JSON_KEY(of.path, of.name));
        values.width = 2;
        if (!zr_gltf_read_floats(file, &values, &making->range, &texcoords[0].x + 2 * (size_t)place, 4)) return false;
    }
    making->mesh->texcoords = texcoords;
    return true;
}

/* Clamps linear colours and encodes them as sRGB, the encoding of colours of a scene. */
static bool encode(struct zr_gltf *file, zr_vec4 *colors, uint32_t count)
{
    float linear[4 * AT_ONCE + ZR_SRGB_EXCESS] = {0}, encoded[4 * AT_ONCE + ZR_SRGB_EXCESS];
    zr_srgb_encode_fn *encode_all = zr_srgb_encode_of(zr_team_isa(file->json.team));
    for (uint32_t at = 0; at < count; at += AT_ONCE) {
        const uint32_t run = count - at < AT_ONCE ? count - at : AT_ONCE;
        if (zr_is_cancelled(file->json.cancel)) return false;
        memcpy(linear, colors + at, run * sizeof *colors);
        encode_all(linear, 4 * (size_t)run, encoded);
        for (uint32_t i = 0; i < run; i++) {
            const float alpha = linear[4 * i + 3];
            memcpy(&colors[at + i], &encoded[4 * i], sizeof *colors);
            colors[at + i].w = alpha < 0.0f ? 0.0f : alpha > 1.0f ? 1.0f : alpha;
        }
    }
    return true;
}

/* Reads colours with or without alpha. */
static bool read_colors(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const uint32_t number = making->given->attributes.color, count = making->range.count;
    const bool is_rgb = number < file->counts[ZR_GLTF_ACCESSORS] && file->accessors[number].shape == ZR_GLTF_VEC3;
    const struct zr_gltf_attribute of = attribute_of(making, "COLOR_0", number, is_rgb ? ZR_GLTF_VEC3 : ZR_GLTF_VEC4);
    struct zr_gltf_values values;
    if (!zr_gltf_open_attribute(file, &of, &values)) return false;
    zr_vec4 *colors = zr_gltf_allocate(file, count, sizeof *colors);
    if (!colors) return false;
    values.is_normalized = true; /* glTF requires this for integers */
    for (uint32_t i = 0; i < count; i++)
        colors[i].w = 1.0f;
    if (!zr_gltf_read_floats(file, &values, &making->range, &colors[0].x, 4) || !encode(file, colors, count))
        return false;
    making->mesh->colors = colors;
    return true;
}

static bool read_attributes(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const struct zr_gltf_attributes *of = &making->given->attributes;
    const uint32_t material = making->given->material;
    const bool has_texcoords =
        texcoords_at(file, making, 0) != ZR_GLTF_NONE || texcoords_at(file, making, 1) != ZR_GLTF_NONE;
    if (of->normal != ZR_GLTF_NONE && !read_normals(file, making)) return false;
    if (of->tangent != ZR_GLTF_NONE && !read_tangents(file, making)) return false;
    if (of->color != ZR_GLTF_NONE && !read_colors(file, making)) return false;
    const uint32_t needed = material == ZR_GLTF_NONE || making->mesh->face_count == 0
                                ? 0
                                : zr_gltf_texcoords_of(&file->made->materials[material]);
    for (uint32_t place = 0; place < 2; place++)
        if (needed >> place & 1u && texcoords_at(file, making, place) == ZR_GLTF_NONE)
            zr_gltf_note(&file->no_texcoords, making->path);
    return !(has_texcoords || needed) || read_texcoords(file, making);
}

/* ---- primitives ---- */

/* Reads the indices, finds their range of vertices, and makes them relative to its start. */
static bool read_indices(struct zr_gltf *file, struct zr_gltf_making *making)
{
    struct zr_gltf_values values;
    if (!zr_gltf_open(file, ZR_JSON_KEY(making->path, "indices"), making->given->indices, &values)) return false;
    uint32_t *corners = making->corners = zr_gltf_allocate(file, values.count, sizeof *corners);
    making->corner_count = values.count;
    if (!corners || !zr_gltf_read_indices(file, &values, making->vertices, corners, &making->range)) return false;
    const uint32_t low = making->range.first;
    for (uint32_t i = 0; low > 0 && i < values.count; i++)
        corners[i] -= low;
    return true;
}

/* Copies the faces of a decoded mesh, since other primitives may share it. */
static bool copy_faces(struct zr_gltf *file, struct zr_gltf_making *making)
{
    const struct zr_draco_mesh *of = making->given->draco;
    making->corner_count = 3 * of->face_count;
    making->corners = zr_gltf_allocate(file, making->corner_count, sizeof *making->corners);
    if (making->corners) memcpy(making->corners, of->corners, making->corner_count * sizeof *making->corners);
    return making->corners;
}

bool zr_gltf_make_primitive(struct zr_gltf *file, const struct zr_json_path *path,
                            const struct zr_gltf_primitive *given, struct zr_mesh *mesh, uint32_t number)
{
    const struct zr_json_path *attributes = ZR_JSON_KEY(path, "attributes");
    struct zr_gltf_making making = {
        .path = path, .attributes = attributes, .given = given, .number = number, .mesh = mesh};
    struct zr_gltf_values positions;
    if (given->mode > ZR_GLTF_TRIANGLE_FAN)
        return zr_json_fault(&file->json, ZR_JSON_KEY(path, "mode"), "%u; glTF has the modes 0 to 6", given->mode);
    if (given->attributes.position == ZR_GLTF_NONE) {
        zr_gltf_note(&file->no_positions, path);
        return false;
    }
    const struct zr_gltf_attribute of = attribute_of(&making, "POSITION", given->attributes.position, ZR_GLTF_VEC3);
    if (!zr_gltf_open_attribute(file, &of, &positions)) return false;
    making.vertices = making.range.count = making.corner_count = positions.count;
    if (given->draco && !copy_faces(file, &making)) return false;
    if (!given->draco && given->indices != ZR_GLTF_NONE && !read_indices(file, &making)) return false;
    if (!zr_gltf_make_topology(file, &making)) return false;
    if (!making.corners && given->mode == ZR_GLTF_TRIANGLES) making.range.count = 3 * mesh->face_count;
    mesh->positions = read_positions(file, &positions, &making);
    mesh->position_count = making.range.count;
    mesh->point_size = mesh->point_count > 0 ? 0.0f : 1.0f; /* 0: by the density of the points */
    return mesh->positions && read_attributes(file, &making) && zr_gltf_morph(file, &making) &&
           zr_gltf_bend(file, &making) && zr_arena_ok(file->json.arena);
}
