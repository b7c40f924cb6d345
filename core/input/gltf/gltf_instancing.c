/* Reads EXT_mesh_gpu_instancing: a node that places its mesh in many poses. */
#include "input/gltf/gltf_extensions.h"
#include "input/gltf/gltf_parts.h"

#include "input/json/json_matrix.h"

struct given_instancing {
    const char *attributes;
};
static const struct zr_json_field fields[] = {{.key = "attributes",
                                               .read = zr_json_value_start,
                                               .offset = offsetof(struct given_instancing, attributes),
                                               .required = true,
                                               .text = "accessors of the poses"},
                                              ZR_GLTF_COMMON};
static const struct zr_json_object object = ZR_JSON_OBJECT_OF(ZR_GLTF_INSTANCING, fields);

/* Accessor numbers, or NONE. */
struct attributes {
    uint32_t translation, rotation, scale;
};
#define AT(member) offsetof(struct attributes, member)
static const struct zr_json_field attribute_fields[] = {
    {.key = "TRANSLATION", .read = zr_gltf_index, .offset = AT(translation)},
    {.key = "ROTATION", .read = zr_gltf_index, .offset = AT(rotation)},
    {.key = "SCALE", .read = zr_gltf_index, .offset = AT(scale)}};
#undef AT
static const struct zr_json_object attribute_object = ZR_JSON_OBJECT_OF("attributes", attribute_fields);

/* Reads an attribute of all instances, four floats each. Without the attribute, each instance gets `otherwise`.
 * Sets *count if it is 0. */
static zr_vec4 *read_attribute(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number,
                               int shape, zr_vec4 otherwise, uint32_t *count)
{
    struct zr_arena *arena = file->json.arena;
    struct zr_gltf_values values = {.count = *count};
    if (number != ZR_GLTF_NONE && !zr_gltf_open_attribute(file, path, name, number, shape, shape, *count, &values))
        return NULL;
    if (values.count > file->json.limits->instances_max) {
        zr_json_fault(&file->json, ZR_JSON_KEY(path, name), "%u instances; %u are allowed", values.count,
                      file->json.limits->instances_max);
        return NULL;
    }
    if (*count == 0) *count = values.count;
    zr_vec4 *out = zr_arena_alloc(arena, *count, sizeof *out);
    for (uint32_t i = 0; out && i < *count; i++)
        out[i] = otherwise;
    if (!out || number == ZR_GLTF_NONE) return out;
    return zr_gltf_read_floats(file, &values, 0, *count, (double)file->json.limits->coordinate_max, &out[0].x, 4)
               ? out
               : NULL;
}

static zr_vec3 xyz(zr_vec4 v)
{
    return (zr_vec3){v.x, v.y, v.z};
}

static bool make_poses(struct zr_gltf *file, const struct zr_json_path *path, const struct attributes *of,
                       struct zr_gltf_use *use)
{
    const zr_vec4 zero = {0, 0, 0, 0}, one = {1, 1, 1, 1}, straight = {0, 0, 0, 1};
    uint32_t count = 0;
    for (int pass = 0; pass < 2; pass++) { /* the first pass counts the instances */
        const zr_vec4 *t = read_attribute(file, path, "TRANSLATION", of->translation, ZR_GLTF_VEC3, zero, &count);
        const zr_vec4 *q =
            t ? read_attribute(file, path, "ROTATION", of->rotation, ZR_GLTF_VEC4, straight, &count) : NULL;
        const zr_vec4 *s = q ? read_attribute(file, path, "SCALE", of->scale, ZR_GLTF_VEC3, one, &count) : NULL;
        if (!s) return false;
        if (pass == 0 && of->translation == ZR_GLTF_NONE) continue;
        zr_mat4 *poses = zr_arena_alloc(file->json.arena, count, sizeof *poses);
        if (!poses) return false;
        for (uint32_t i = 0; i < count; i++) {
            if (q[i].x == 0.0f && q[i].y == 0.0f && q[i].z == 0.0f && q[i].w == 0.0f)
                return zr_json_fault(&file->json, ZR_JSON_KEY(path, "ROTATION"),
                                     "instance %u: the quaternion has the length 0", i);
            poses[i] = zr_mat4_of_pose(xyz(t[i]), q[i], xyz(s[i]));
        }
        use->poses = poses;
        use->pose_count = count;
        return true;
    }
    return false;
}

bool zr_gltf_read_poses(struct zr_gltf *file, struct zr_gltf_use *use)
{
    const struct zr_json_path *node = ZR_GLTF_ITEM(ZR_GLTF_NODES, use->node),
                              *extensions = ZR_JSON_KEY(node, "extensions"),
                              *path = ZR_JSON_KEY(extensions, ZR_GLTF_INSTANCING),
                              *at = ZR_JSON_KEY(path, fields[0].key);
    struct attributes attributes = {ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE};
    struct given_instancing given = {NULL};
    struct zr_json there = zr_json_at(&file->json, use->instancing);
    uint64_t keys;
    zr_gltf_fields(file, &there, path, &object, &given, &keys);
    if (!given.attributes) return false;
    there = zr_json_at(&file->json, given.attributes);
    return zr_gltf_extensions(file, &there, at, &attribute_object, &attributes, &keys) &&
           make_poses(file, at, &attributes, use);
}
