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

/* Parts of the poses: accessor numbers, or NONE. */
enum { TRANSLATION, ROTATION, SCALE, PARTS };
#define PART(name, at)                                                                                                 \
    {                                                                                                                  \
        .key = (name), .read = zr_gltf_index, .offset = (at) * sizeof(uint32_t)                                        \
    }
static const struct zr_json_field attribute_fields[] = {[TRANSLATION] = PART("TRANSLATION", TRANSLATION),
                                                        [ROTATION] = PART("ROTATION", ROTATION),
                                                        [SCALE] = PART("SCALE", SCALE)};
#undef PART
static const struct zr_json_object attribute_object = {ZR_JSON_FIELDS("attributes", attribute_fields), .is_open = true};

/* Reads a part of all instances, four floats each. A part without an accessor changes nothing. Sets *count if it is
 * 0. */
static zr_vec4 *read_part(struct zr_gltf *file, const struct zr_json_path *path, int part, uint32_t number,
                          uint32_t *count)
{
    static const int shapes[PARTS] = {ZR_GLTF_VEC3, ZR_GLTF_VEC4, ZR_GLTF_VEC3};
    static const zr_vec4 otherwise[PARTS] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 1}};
    const struct zr_gltf_attribute of = {path, attribute_fields[part].key, number, shapes[part], *count};
    const struct zr_limits *limits = file->json.limits;
    struct zr_gltf_values values = {.count = *count};
    if (number != ZR_GLTF_NONE && !zr_gltf_open_attribute(file, &of, &values)) return NULL;
    if (values.count > limits->instances_max) {
        zr_json_fault(&file->json, ZR_JSON_KEY(path, of.name), "%u instances; %u are allowed", values.count,
                      limits->instances_max);
        return NULL;
    }
    if (*count == 0) *count = values.count;
    zr_vec4 *out = zr_arena_alloc(file->json.arena, *count, sizeof *out);
    for (uint32_t i = 0; out && i < *count; i++)
        out[i] = otherwise[part];
    if (!out || number == ZR_GLTF_NONE) return out;
    values.limit = (double)limits->coordinate_max;
    return zr_gltf_read_floats(file, &values, &(struct zr_gltf_range){0, *count}, &out[0].x, 4) ? out : NULL;
}

static zr_vec3 xyz(zr_vec4 v)
{
    return (zr_vec3){v.x, v.y, v.z};
}

static bool make_poses(struct zr_gltf *file, const struct zr_json_path *path, const uint32_t numbers[PARTS],
                       struct zr_gltf_use *use)
{
    const zr_vec4 *parts[PARTS];
    uint32_t count = 0;
    for (int pass = 0; pass == 0 || (pass == 1 && numbers[TRANSLATION] == ZR_GLTF_NONE); pass++)
        for (int k = 0; k < PARTS; k++) /* the first pass counts the instances */
            if (!(parts[k] = read_part(file, path, k, numbers[k], &count))) return false;
    zr_mat4 *poses = zr_arena_alloc(file->json.arena, count, sizeof *poses);
    if (!poses) return false;
    for (uint32_t i = 0; i < count; i++) {
        const zr_vec4 q = parts[ROTATION][i];
        if (q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 0.0f)
            return zr_json_fault(&file->json, ZR_JSON_KEY(path, attribute_fields[ROTATION].key),
                                 "instance %u: the quaternion has the length 0", i);
        poses[i] = zr_mat4_of_pose(xyz(parts[TRANSLATION][i]), q, xyz(parts[SCALE][i]));
    }
    use->poses = poses;
    use->pose_count = count;
    return true;
}

bool zr_gltf_read_poses(struct zr_gltf *file, struct zr_gltf_use *use)
{
    const struct zr_json_path *node = ZR_GLTF_ITEM(ZR_GLTF_NODES, use->node),
                              *extensions = ZR_JSON_KEY(node, "extensions"),
                              *path = ZR_JSON_KEY(extensions, ZR_GLTF_INSTANCING),
                              *at = ZR_JSON_KEY(path, fields[0].key);
    uint32_t numbers[PARTS] = {ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE};
    struct given_instancing given = {NULL};
    zr_gltf_fields_at(file, use->instancing, path, &object, &given);
    if (!given.attributes) return false;
    return zr_gltf_fields_at(file, given.attributes, at, &attribute_object, numbers) &&
           make_poses(file, at, numbers, use);
}
