/* Moves vertices by the joints of a skin of glTF, in the pose of the nodes. Source: glTF 2.0, section 3.7.3. */
#include "input/gltf/gltf_parts.h"

#include <math.h>

#include "base/cancel.h"

/* Vertices between checks for cancellation. */
enum { AT_ONCE = 1024, INFLUENCES = 4 };

struct zr_gltf_skin {
    const char *joints; /* place of the list */
    uint32_t inverse;   /* accessor of matrices, or NONE */
    uint32_t count;
    zr_mat4 *matrices; /* one per joint, from mesh to world space; NULL before its first use */
    bool is_refused;
};

enum { JOINTS, INVERSE };
#define AT(member) offsetof(struct zr_gltf_skin, member)
static const struct zr_json_field fields[] = {
    [JOINTS] =
        {.key = "joints", .read = zr_json_value_start, .offset = AT(joints), .required = true, .text = "its nodes"},
    [INVERSE] = {.key = "inverseBindMatrices", .read = zr_gltf_index, .offset = AT(inverse)},
    {.key = "skeleton", .read = zr_gltf_ignore},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("skin", fields);

static void read_skin(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf_skin *skin = &file->skins[number];
    *skin = (struct zr_gltf_skin){.inverse = ZR_GLTF_NONE};
    zr_gltf_fields(file, json, path, &object, skin);
}

bool zr_gltf_read_skins(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    file->skins = zr_arena_zero(arena, file->counts[ZR_GLTF_SKINS], sizeof *file->skins);
    return zr_arena_ok(arena) && zr_gltf_read_list(file, ZR_GLTF_SKINS, read_skin);
}

/* ---- joints ---- */

/* Reads the matrices from mesh to joint space. Without an accessor, they are identities. */
static bool read_inverses(struct zr_gltf *file, const struct zr_json_path *path, struct zr_gltf_skin *skin)
{
    struct zr_gltf_values values;
    for (uint32_t i = 0; i < skin->count; i++)
        skin->matrices[i] = zr_mat4_identity();
    if (skin->inverse == ZR_GLTF_NONE) return true;
    const struct zr_json_path *at = ZR_JSON_KEY(path, fields[INVERSE].key);
    const struct zr_gltf_attribute of = {path, fields[INVERSE].key, skin->inverse, ZR_GLTF_MAT4, skin->count};
    if (!zr_gltf_open_attribute(file, &of, &values)) return false;
    if (values.accessor->type != ZR_GLTF_FLOAT32) return zr_json_fault(&file->json, at, "floats are needed");
    values.limit = (double)ZR_MATRIX_MAX;
    return zr_gltf_read_floats(file, &values, &(struct zr_gltf_range){0, skin->count}, skin->matrices[0].m, 16);
}

static bool make_matrices(struct zr_gltf *file, uint32_t number, struct zr_gltf_skin *skin)
{
    const struct zr_json_path *path = ZR_GLTF_ITEM(ZR_GLTF_SKINS, number),
                              *list = ZR_JSON_KEY(path, fields[JOINTS].key);
    struct zr_json there = zr_json_at(&file->json, skin->joints), *json = &there;
    size_t count;
    if (!zr_json_count(json, list, &count)) return false;
    skin->count = (uint32_t)count;
    skin->matrices = zr_arena_alloc(json->arena, count, sizeof *skin->matrices);
    if (!skin->matrices || !read_inverses(file, path, skin)) return false;
    zr_json_enter(json, '[');
    for (uint32_t i = 0; zr_json_any_item(json); i++) {
        uint32_t node;
        if (!zr_json_index(json, ZR_JSON_ITEM(list, i), file->counts[ZR_GLTF_NODES], "nodes", &node)) return false;
        skin->matrices[i] = zr_mat4_mul(&file->nodes->worlds[node], &skin->matrices[i]);
    }
    return true;
}

/* ---- vertices ---- */

/* Joints and weights: four of each per vertex. */
struct influences {
    float *joints, *weights;
};

static bool read_influences(struct zr_gltf *file, const struct zr_gltf_making *making, int set, struct influences *out)
{
    static const char *const joint_names[] = {"JOINTS_0", "JOINTS_1"}, *const weight_names[] = {"WEIGHTS_0",
                                                                                                "WEIGHTS_1"};
    const struct zr_gltf_attributes *numbers = &making->given->attributes;
    const struct zr_gltf_attribute joints = {making->attributes, joint_names[set], numbers->joints[set], ZR_GLTF_VEC4,
                                             making->vertices},
                                   weights = {making->attributes, weight_names[set], numbers->weights[set],
                                              ZR_GLTF_VEC4, making->vertices};
    const struct zr_gltf_range *range = &making->range;
    struct zr_gltf_values of_joints, of_weights;
    if (!zr_gltf_open_attribute(file, &joints, &of_joints) || !zr_gltf_open_attribute(file, &weights, &of_weights))
        return false;
    of_joints.is_normalized = false;
    of_weights.is_normalized = true;
    if (!zr_json_has_time(&file->json, 2 * range->count * sizeof(zr_vec4))) return false;
    out->joints = zr_arena_alloc(file->json.arena, range->count, sizeof(zr_vec4));
    out->weights = zr_arena_alloc(file->json.arena, range->count, sizeof(zr_vec4));
    return out->joints && out->weights && zr_gltf_read_floats(file, &of_joints, range, out->joints, 4) &&
           zr_gltf_read_floats(file, &of_weights, range, out->weights, 4);
}

/* Adds the vertex's weighted matrices to *sum, and its weights to *weight. False if the skin has no such joint. */
static bool add_matrices(const struct zr_gltf_skin *skin, const struct influences *of, uint32_t vertex, zr_mat4 *sum,
                         float *weight)
{
    for (uint32_t k = INFLUENCES * vertex; k < INFLUENCES * (vertex + 1); k++) {
        const float joint = of->joints[k], share = of->weights[k];
        if (share == 0.0f) continue;
        if (!(joint >= 0.0f && joint < (float)skin->count)) return false;
        const zr_mat4 *matrix = &skin->matrices[(uint32_t)joint];
        for (int i = 0; i < 16; i++)
            sum->m[i] += share * matrix->m[i];
        *weight += share;
    }
    return true;
}

static void turn(const float *m, float scale, float *v)
{
    const float x = v[0], y = v[1], z = v[2];
    for (int row = 0; row < 3; row++)
        v[row] = scale * ((m[row] * x + m[4 + row] * y) + m[8 + row] * z);
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Turns a normal by the inverse transpose of the matrix, up to a factor, and keeps its length. A matrix that flattens
 * the normal away leaves it. */
static void turn_normal(const float *m, float *normal)
{
    double columns[3][3], turned[3] = {0, 0, 0}, cofactors[3][3], before = 0.0, after = 0.0, det = 0.0;
    for (int k = 0; k < 9; k++)
        columns[k / 3][k % 3] = (double)m[4 * (k / 3) + k % 3];
    for (int k = 0; k < 3; k++)
        cross(columns[(k + 1) % 3], columns[(k + 2) % 3], cofactors[k]);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            turned[i] += (double)normal[k] * cofactors[k][i];
        det += columns[0][i] * cofactors[0][i];
        before += (double)normal[i] * (double)normal[i];
        after += turned[i] * turned[i];
    }
    if (!(after > 0.0 && isfinite(after))) return;
    const double scale = (det < 0.0 ? -1.0 : 1.0) * sqrt(before / after);
    for (int i = 0; i < 3; i++)
        normal[i] = (float)(scale * turned[i]);
}

/* Moves vertex `i`. Scales its weights to the sum 1. If their sum is 0, the vertex stays. */
static bool move(const struct zr_gltf_skin *skin, const struct influences of[2], int sets, uint32_t i,
                 struct zr_mesh *mesh)
{
    zr_mat4 sum = {{0}};
    float weight = 0.0f;
    for (int set = 0; set < sets; set++)
        if (!add_matrices(skin, &of[set], i, &sum, &weight)) return false;
    if (!(weight > 0.0f)) return true;
    zr_vec4 *position = (zr_vec4 *)mesh->positions + i;
    const float scale = 1.0f / weight;
    turn(sum.m, scale, &position->x);
    position->x += scale * sum.m[12];
    position->y += scale * sum.m[13];
    position->z += scale * sum.m[14];
    if (mesh->normals) turn_normal(sum.m, (float *)(mesh->normals + i));
    if (mesh->tangents) turn(sum.m, scale, (float *)(mesh->tangents + i));
    return true;
}

bool zr_gltf_bend(struct zr_gltf *file, const struct zr_gltf_making *making)
{
    const struct zr_gltf_range *range = &making->range;
    const uint32_t number = file->uses[file->use].skin;
    struct influences of[2];
    int sets = 0;
    if (number == ZR_GLTF_NONE) return true;
    struct zr_gltf_skin *skin = &file->skins[number];
    if (!skin->matrices && !skin->is_refused) skin->is_refused = !make_matrices(file, number, skin);
    if (skin->is_refused) return false;
    for (; sets < 2 && making->given->attributes.joints[sets] != ZR_GLTF_NONE; sets++)
        if (!read_influences(file, making, sets, &of[sets])) return false;
    for (uint32_t i = 0; i < range->count; i++) {
        if (i % AT_ONCE == 0 && zr_is_cancelled(file->json.cancel)) return false;
        if (!move(skin, of, sets, i, making->mesh))
            return zr_json_fault(&file->json, ZR_JSON_KEY(making->attributes, "JOINTS_0"),
                                 "vertex %u has a joint beyond the %u joints of skin %u", range->first + i, skin->count,
                                 number);
    }
    return zr_gltf_check_moved(file, making->path, making->mesh, "a skin");
}

bool zr_gltf_check_moved(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_mesh *mesh,
                         const char *by)
{
    const float limit = file->json.limits->coordinate_max;
    for (uint32_t i = 0; i < mesh->position_count; i++) {
        const zr_vec4 p = mesh->positions[i];
        if (!(fabsf(p.x) <= limit && fabsf(p.y) <= limit && fabsf(p.z) <= limit))
            return zr_json_fault(&file->json, path, "%s moves a vertex beyond the limit of %.9g", by, (double)limit);
    }
    for (uint32_t i = 0; i < mesh->normal_count; i++)
        if (!isfinite(mesh->normals[i].x + mesh->normals[i].y + mesh->normals[i].z))
            return zr_json_fault(&file->json, path, "%s makes a normal that is not finite", by);
    for (uint32_t i = 0; mesh->tangents && i < mesh->position_count; i++)
        if (!isfinite(mesh->tangents[i].x + mesh->tangents[i].y + mesh->tangents[i].z))
            return zr_json_fault(&file->json, path, "%s makes a tangent that is not finite", by);
    return true;
}
