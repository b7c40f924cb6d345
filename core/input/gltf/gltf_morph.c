/* Adds morph targets of glTF to a mesh. Source: glTF 2.0, section 3.7.2.2. */
#include "input/gltf/gltf_extensions.h"
#include "input/gltf/gltf_parts.h"

#include <float.h>
#include <math.h>

/* One target: accessor numbers of its differences, or NONE. */
struct target {
    uint32_t position, normal, tangent;
};
#define AT(member) offsetof(struct target, member)
static const struct zr_json_field fields[] = {{.key = "POSITION", .read = zr_gltf_index, .offset = AT(position)},
                                              {.key = "NORMAL", .read = zr_gltf_index, .offset = AT(normal)},
                                              {.key = "TANGENT", .read = zr_gltf_index, .offset = AT(tangent)}};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("target", fields);

#define WEIGHT_MAX 1e6

/* Adds `weight` times the differences to the first three floats of vectors that are `step` floats apart. */
static bool add(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number, double weight,
                const struct zr_gltf_range *range, float *vectors, size_t step)
{
    struct zr_gltf_values values;
    if (!zr_gltf_open_attribute(file, path, name, number, ZR_GLTF_VEC3, ZR_GLTF_VEC3, range->all, &values))
        return false;
    zr_vec3 *moves = zr_gltf_note_bytes(file, range->count * sizeof *moves)
                         ? zr_arena_alloc(file->json.arena, range->count, sizeof *moves)
                         : NULL;
    if (!moves || !zr_gltf_read_floats(file, &values, range->first, range->count, (double)FLT_MAX, &moves[0].x, 3))
        return false;
    for (uint32_t i = 0; i < range->count; i++, vectors += step) {
        vectors[0] += (float)weight * moves[i].x;
        vectors[1] += (float)weight * moves[i].y;
        vectors[2] += (float)weight * moves[i].z;
    }
    zr_arena_trim(file->json.arena, moves, range->count, 0, sizeof *moves);
    return true;
}

static bool add_target(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, double weight,
                       const struct zr_gltf_range *range, struct zr_mesh *mesh)
{
    struct target target = {ZR_GLTF_NONE, ZR_GLTF_NONE, ZR_GLTF_NONE};
    uint64_t keys;
    if (!zr_gltf_extensions(file, json, path, &object, &target, &keys)) return false;
    if (weight == 0.0) return true;
    if (target.position != ZR_GLTF_NONE &&
        !add(file, path, "POSITION", target.position, weight, range, (float *)mesh->positions, 4))
        return false;
    if (mesh->normals && target.normal != ZR_GLTF_NONE &&
        !add(file, path, "NORMAL", target.normal, weight, range, (float *)mesh->normals, 3))
        return false;
    return !mesh->tangents || target.tangent == ZR_GLTF_NONE ||
           add(file, path, "TANGENT", target.tangent, weight, range, (float *)mesh->tangents, 4);
}

bool zr_gltf_morph(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_primitive *given,
                   const struct zr_gltf_range *range, struct zr_mesh *mesh)
{
    const struct zr_json_path *targets = ZR_JSON_KEY(path, "targets"), *weights = ZR_JSON_KEY(path->parent, "weights");
    const struct zr_gltf_pose *pose = file->uses[file->use].pose;
    if (!given->targets || (!file->weights && !pose)) return true;
    struct zr_json target = zr_json_at(&file->json, given->targets), weight = target;
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
        if (!add_target(file, &target, ZR_JSON_ITEM(targets, i), factor, range, mesh)) return false;
    }
    return zr_gltf_check_moved(file, path, mesh, "a morph target");
}
