/* Makes a mesh of one primitive of glTF. Reads only the vertices from the smallest to the largest index, since many
 * primitives often share one accessor. */
#include "input/gltf/gltf_parts.h"

#include <float.h>
#include <string.h>

#include "base/cancel.h"
#include "base/srgb.h"
#include "input/codecs/draco.h"
#include "scene/texture.h"

/* Colours per encoding pass, on the stack. */
enum { AT_ONCE = 256 };

static void *allocate(struct zr_gltf *file, size_t count, size_t size)
{
    return zr_gltf_note_bytes(file, count * size) ? zr_arena_alloc(file->json.arena, count, size) : NULL;
}

/* ---- attributes ---- */

static zr_vec4 *read_positions(struct zr_gltf *file, const struct zr_gltf_values *values,
                               const struct zr_gltf_range *range, uint32_t mesh)
{
    zr_vec4 *positions = allocate(file, range->count, sizeof *positions);
    struct zr_json *json = &file->json;
    const bool is_bent = file->uses[file->use].skin != ZR_GLTF_NONE;
    const double limit = is_bent ? (double)json->limits->coordinate_max : zr_recenter_limit(json->limits);
    if (!positions || !zr_gltf_read_floats(file, values, range->first, range->count, limit, &positions[0].x, 4))
        return NULL;
    const float near = json->limits->coordinate_max;
    bool is_far = false;
    for (uint32_t i = 0; i < range->count; i++) {
        is_far |= fabsf(positions[i].x) > near || fabsf(positions[i].y) > near || fabsf(positions[i].z) > near;
        positions[i].w = 1.0f;
    }
    if (!is_far) return positions;
    return zr_recenter_move_floats(json->arena, json->cancel, json->limits, positions, range->count, &file->moves[mesh],
                                   json->error) == ZR_OK
               ? positions
               : NULL;
}

/* Reads an attribute of vectors of any length, `width` numbers per vertex. Returns NULL after a fault. */
static float *read_vectors(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number,
                           size_t width, uint32_t vertices, const struct zr_gltf_range *range)
{
    struct zr_gltf_values values;
    const int shape = width == 3 ? ZR_GLTF_VEC3 : ZR_GLTF_VEC4;
    if (!zr_gltf_open_attribute(file, path, name, number, shape, shape, vertices, &values)) return NULL;
    float *out = allocate(file, range->count, width * sizeof *out);
    const bool is_read =
        out && zr_gltf_read_floats(file, &values, range->first, range->count, (double)FLT_MAX, out, width);
    return is_read ? out : NULL;
}

static bool read_normals(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, uint32_t vertices,
                         const struct zr_gltf_range *range, struct zr_mesh *mesh, uint32_t mesh_number)
{
    zr_vec3 *normals = (zr_vec3 *)(void *)read_vectors(file, path, "NORMAL", number, 3, vertices, range);
    if (!normals) return false;
    zr_scene_builder_note_normals(file->builder, mesh_number, normals, range->count);
    mesh->normals = normals;
    mesh->normal_count = range->count;
    return true;
}

static bool read_tangents(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, uint32_t vertices,
                          const struct zr_gltf_range *range, struct zr_mesh *mesh)
{
    zr_vec4 *tangents = (zr_vec4 *)(void *)read_vectors(file, path, "TANGENT", number, 4, vertices, range);
    for (uint32_t i = 0; tangents && i < range->count; i++)
        tangents[i].w = tangents[i].w < 0.0f ? -1.0f : 1.0f;
    mesh->tangents = tangents;
    return tangents != NULL;
}

/* Reads both sets into one array: set 0 into x, y and set 1 into z, w. */
static bool read_texcoords(struct zr_gltf *file, const struct zr_json_path *path, const uint32_t numbers[2],
                           uint32_t vertices, const struct zr_gltf_range *range, struct zr_mesh *mesh)
{
    static const char *const names[2] = {"TEXCOORD_0", "TEXCOORD_1"};
    zr_vec4 *texcoords = zr_gltf_note_bytes(file, range->count * sizeof *texcoords)
                             ? zr_arena_zero(file->json.arena, range->count, sizeof *texcoords)
                             : NULL;
    if (!texcoords) return false;
    for (int set = 0; set < 2; set++) {
        struct zr_gltf_values values;
        if (numbers[set] == ZR_GLTF_NONE) continue;
        if (!zr_gltf_open_attribute(file, path, names[set], numbers[set], ZR_GLTF_VEC2, ZR_GLTF_VEC2, vertices,
                                    &values) ||
            !zr_gltf_read_floats(file, &values, range->first, range->count, (double)ZR_TEXCOORD_MAX,
                                 &texcoords[0].x + 2 * set, 4))
            return false;
    }
    mesh->texcoords = texcoords;
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

static bool read_colors(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, uint32_t vertices,
                        const struct zr_gltf_range *range, struct zr_mesh *mesh)
{
    struct zr_gltf_values values;
    if (!zr_gltf_open_attribute(file, path, "COLOR_0", number, ZR_GLTF_VEC4, ZR_GLTF_VEC3, vertices, &values))
        return false;
    zr_vec4 *colors = allocate(file, range->count, sizeof *colors);
    if (!colors) return false;
    values.is_normalized = true; /* glTF requires this for integers */
    for (uint32_t i = 0; i < range->count; i++)
        colors[i].w = 1.0f;
    if (!zr_gltf_read_floats(file, &values, range->first, range->count, (double)FLT_MAX, &colors[0].x, 4) ||
        !encode(file, colors, range->count))
        return false;
    mesh->colors = colors;
    return true;
}

static bool read_attributes(struct zr_gltf *file, const struct zr_json_path *path,
                            const struct zr_gltf_primitive *given, uint32_t vertices, const struct zr_gltf_range *range,
                            struct zr_mesh *mesh, uint32_t number)
{
    const struct zr_gltf_attributes *of = &given->attributes;
    const bool has_texcoords = of->texcoords[0] != ZR_GLTF_NONE || of->texcoords[1] != ZR_GLTF_NONE;
    if (of->normal != ZR_GLTF_NONE && !read_normals(file, path, of->normal, vertices, range, mesh, number))
        return false;
    if (of->tangent != ZR_GLTF_NONE && !read_tangents(file, path, of->tangent, vertices, range, mesh)) return false;
    if (of->color != ZR_GLTF_NONE && !read_colors(file, path, of->color, vertices, range, mesh)) return false;
    const uint32_t needed = given->material == ZR_GLTF_NONE || mesh->face_count == 0
                                ? 0
                                : zr_gltf_texcoords_of(&file->made->materials[given->material]);
    for (uint32_t set = 0; set < 2; set++)
        if (needed >> set & 1u && of->texcoords[set] == ZR_GLTF_NONE) zr_gltf_note(&file->no_texcoords, path->parent);
    return !(has_texcoords || needed) || read_texcoords(file, path, of->texcoords, vertices, range, mesh);
}

/* ---- primitives ---- */

/* Reads the indices, finds their range of vertices, and makes them relative to its start. */
static bool read_indices(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, uint32_t vertices,
                         struct zr_gltf_range *range, uint32_t **corners, uint32_t *count)
{
    struct zr_gltf_values values;
    uint32_t low, high;
    if (!zr_gltf_open(file, ZR_JSON_KEY(path, "indices"), number, &values)) return false;
    *count = values.count;
    *corners = allocate(file, values.count, sizeof **corners);
    if (!*corners || !zr_gltf_read_indices(file, &values, vertices, *corners, &low, &high)) return false;
    *range = values.count == 0 ? (struct zr_gltf_range){0, 0, vertices}
                               : (struct zr_gltf_range){low, high - low + 1, vertices};
    for (uint32_t i = 0; low > 0 && i < values.count; i++)
        (*corners)[i] -= low;
    return true;
}

/* Copies the faces of a decoded mesh, since other primitives may share it. */
static bool copy_faces(struct zr_gltf *file, const struct zr_draco_mesh *of, uint32_t **corners, uint32_t *count)
{
    *count = 3 * of->face_count;
    *corners = allocate(file, *count, sizeof **corners);
    if (*corners) memcpy(*corners, of->corners, *count * sizeof **corners);
    return *corners;
}

bool zr_gltf_make_primitive(struct zr_gltf *file, const struct zr_json_path *path,
                            const struct zr_gltf_primitive *given, struct zr_mesh *mesh, uint32_t number)
{
    struct zr_gltf_values positions;
    struct zr_gltf_range range;
    uint32_t *corners = NULL, count;
    if (given->mode > ZR_GLTF_TRIANGLE_FAN)
        return zr_json_fault(&file->json, ZR_JSON_KEY(path, "mode"), "%u; glTF has the modes 0 to 6", given->mode);
    if (given->attributes.position == ZR_GLTF_NONE) {
        zr_gltf_note(&file->no_positions, path);
        return false;
    }
    const struct zr_json_path *attributes = ZR_JSON_KEY(path, "attributes");
    if (!zr_gltf_open_attribute(file, attributes, "POSITION", given->attributes.position, ZR_GLTF_VEC3, ZR_GLTF_VEC3, 0,
                                &positions))
        return false;
    range = (struct zr_gltf_range){0, count = positions.count, positions.count};
    if (given->draco && !copy_faces(file, given->draco, &corners, &count)) return false;
    if (!given->draco && given->indices != ZR_GLTF_NONE &&
        !read_indices(file, path, given->indices, positions.count, &range, &corners, &count))
        return false;
    if (!zr_gltf_make_topology(file, path, given->mode, corners, count, mesh)) return false;
    if (!corners && given->mode == ZR_GLTF_TRIANGLES) range.count = 3 * mesh->face_count;
    mesh->positions = read_positions(file, &positions, &range, number);
    mesh->position_count = range.count;
    mesh->point_size = mesh->point_count > 0 ? 0.0f : 1.0f; /* 0: by the density of the points */
    return mesh->positions && read_attributes(file, attributes, given, positions.count, &range, mesh, number) &&
           zr_gltf_morph(file, path, given, &range, mesh) && zr_gltf_bend(file, attributes, given, &range, mesh) &&
           zr_arena_ok(file->json.arena);
}
