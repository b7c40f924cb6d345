/* Adds morph targets of glTF to a mesh. Source: glTF 2.0, section 3.7.2.2. */
#include "input/gltf/gltf_extensions.h"
#include "input/gltf/gltf_parts.h"

/* Parts of a target: accessor numbers of differences, or NONE. */
enum { POSITION, NORMAL, TANGENT, PARTS };
#define PART(name, at)                                                                                                 \
    {                                                                                                                  \
        .key = (name), .read = zr_gltf_index, .offset = (at) * sizeof(uint32_t)                                        \
    }
static const struct zr_json_field fields[] = {
    [POSITION] = PART("POSITION", POSITION), [NORMAL] = PART("NORMAL", NORMAL), [TANGENT] = PART("TANGENT", TANGENT)};
#undef PART
static const struct zr_json_object object = {ZR_JSON_FIELDS("target", fields), .is_open = true};

#define WEIGHT_MAX 1e6

/* Adds `weight` times the differences to the first three floats of vectors that are `step` floats apart. */
static void add(const zr_vec3 *differences, uint32_t count, float weight, float *vectors, size_t step)
{
    for (uint32_t i = 0; i < count; i++, vectors += step) {
        vectors[0] += weight * differences[i].x;
        vectors[1] += weight * differences[i].y;
        vectors[2] += weight * differences[i].z;
    }
}

static bool add_target(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, double weight,
                       const struct zr_gltf_making *making)
{
    static const size_t steps[PARTS] = {4, 3, 4};
    const struct zr_mesh *mesh = making->mesh;
    float *vectors[PARTS] = {(float *)mesh->positions, (float *)mesh->normals, (float *)mesh->tangents};
    uint32_t target[PARTS] = {ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE};
    if (!zr_gltf_fields(file, json, path, &object, target)) return false;
    for (int k = 0; weight != 0.0 && k < PARTS; k++) {
        const struct zr_gltf_attribute of = {path, fields[k].key, target[k], ZR_GLTF_VEC3, making->vertices};
        const uint32_t count = making->range.count;
        if (target[k] == ZR_GLTF_NONE || !vectors[k]) continue;
        zr_vec3 *differences = (zr_vec3 *)(void *)zr_gltf_read_vectors(file, &of, &making->range);
        if (!differences) return false;
        add(differences, count, (float)weight, vectors[k], steps[k]);
        zr_arena_trim(file->json.arena, differences, count, 0, sizeof *differences);
    }
    return true;
}

bool zr_gltf_morph(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const struct zr_json_path *path = making->path, *targets = ZR_JSON_KEY(path, "targets"),
                              *weights = ZR_JSON_KEY(path->parent, "weights");
    const char *places = making->given->targets;
    const struct zr_gltf_pose *pose = file->uses[file->use].pose;
    if (!places || (!file->weights && !pose)) return true;
    struct zr_json target = zr_json_at(&file->json, places), weight = target;
    if (!pose) weight = zr_json_at(&file->json, file->weights);
    if (!zr_json_list(&target, targets) || (!pose && !zr_json_list(&weight, weights))) return false;
    if (!pose) zr_json_enter(&weight, '[');
    zr_json_enter(&target, '[');
    for (size_t i = 0; zr_json_any_item(&target); i++) {
        double factor = 0;
        if (pose ? i == pose->weight_count : !zr_json_any_item(&weight)) break; /* missing weights are 0 */
        if (pose)
            factor = (double)pose->weights[i];
        else if (!zr_json_number_in(&weight, ZR_JSON_ITEM(weights, i), -WEIGHT_MAX, WEIGHT_MAX, &factor))
            return false;
        if (!add_target(file, &target, ZR_JSON_ITEM(targets, i), factor, making)) return false;
    }
    return zr_gltf_check_moved(file, path, making->mesh, "a morph target");
}
