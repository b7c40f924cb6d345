#include "input/root/json_far.h"

#include "base/matrix.h"
#include "base/vec.h"
#include "input/mesh/parsed_mesh.h"

/* Positions or instances between two checks for cancellation. */
enum { AT_ONCE = 1 << 14 };

/* Positions at infinity are no places. */
static void include(struct zr_box *box, zr_vec4 at)
{
    const double w = (double)at.w;
    if (w > 0.0) zr_box_include(box, (const double[]){(double)at.x / w, (double)at.y / w, (double)at.z / w});
}

static bool is_remote(const struct zr_box *box)
{
    return box->low[0] <= box->high[0] && zr_box_is_remote(box, ZR_FAR_SIZES);
}

static double middle_of(const struct zr_box *box, int axis)
{
    return zr_rounded(box->low[axis] / 2.0 + box->high[axis] / 2.0);
}

/* Sets `out` to the middle of a remote box, rounded to floats; else to zeros. */
static void find_middle(const struct zr_box *box, double out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = is_remote(box) ? middle_of(box, axis) : 0.0;
}

static bool is_list(const struct zr_parsed_scene *root, uint32_t mesh)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    return mesh >= root->meshes.count || !given[mesh].model;
}

static struct zr_box box_of(const struct zr_parsed_scene *root, const struct zr_mesh *mesh)
{
    struct zr_box box = zr_box_empty();
    for (uint32_t k = 0; k < mesh->position_count; k++) {
        if (k % AT_ONCE == 0 && zr_is_cancelled(root->json.cancel)) return box;
        include(&box, mesh->positions[k]);
    }
    return box;
}

/* Returns how many meshes may be lists: they come first. */
static uint32_t lists_of(const struct zr_parsed_scene *root)
{
    const uint32_t most = (uint32_t)root->meshes.count + zr_parsed_has_polygons(root);
    return most < root->scene->mesh_count ? most : root->scene->mesh_count;
}

/* Sets the offsets of lists. Returns true if the lists are remote together, and share one. */
static bool find_moves(const struct zr_parsed_scene *root, struct zr_box *boxes, double (*moves)[3])
{
    struct zr_box all = zr_box_empty();
    for (uint32_t i = 0; i < lists_of(root); i++) {
        boxes[i] = is_list(root, i) ? box_of(root, &root->scene->meshes[i]) : zr_box_empty();
        zr_box_join(&all, &boxes[i]);
    }
    const bool is_together = is_remote(&all);
    for (uint32_t i = 0; i <= root->meshes.count; i++)
        find_middle(is_together || i >= lists_of(root) ? &all : &boxes[i], moves[i]);
    return is_together;
}

/* Finds the bounds of the placed positions, or of three positions per instance. */
static struct zr_box placed_of(const struct zr_parsed_scene *root, bool is_sample)
{
    const struct zr_scene *scene = root->scene;
    struct zr_box box = zr_box_empty();
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
        const uint32_t step = is_sample && mesh->position_count > 2 ? (mesh->position_count - 1) / 2 : 1;
        for (uint32_t k = 0; k < mesh->position_count; k += step) {
            if (k % AT_ONCE == 0 && zr_is_cancelled(root->json.cancel)) return box;
            include(&box, zr_mat4_apply(&instance->object_to_world, mesh->positions[k]));
        }
    }
    return box;
}

static bool has_far_model(const struct zr_parsed_scene *root)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    for (size_t i = 0; i < root->meshes.count; i++)
        if (given[i].model && zr_model_origin(given[i].model)) return true;
    return false;
}

/* True if samples are nearly remote: those of a remote scene always are. */
static bool may_be_far(const struct zr_parsed_scene *root)
{
    const struct zr_box box = placed_of(root, true);
    return box.low[0] <= box.high[0] && zr_box_is_remote(&box, ZR_FAR_SIZES / 2.0);
}

/* True if a list of several positions is remote. */
static bool has_far_list(const struct zr_parsed_scene *root)
{
    const struct zr_scene *scene = root->scene;
    for (uint32_t i = 0; i < lists_of(root); i++) {
        if (i % AT_ONCE == 0 && zr_is_cancelled(root->json.cancel)) return false;
        if (is_list(root, i) && scene->meshes[i].position_count > 1 &&
            zr_recenter_is_remote(scene->meshes[i].positions, scene->meshes[i].position_count))
            return true;
    }
    return false;
}

/* ---- lists that nodes bring back ---- */

/* Parts of a scene that was read. */
struct parts {
    const struct zr_parsed_scene *root;
    struct zr_box *boxes; /* per mesh, in object space; `found` tells which are known */
    bool *found;
};

static bool open_parts(const struct zr_parsed_scene *root, struct parts *parts)
{
    const uint32_t meshes = root->scene->mesh_count;
    *parts = (struct parts){root, zr_arena_alloc(root->json.arena, meshes, sizeof *parts->boxes),
                            zr_arena_zero(root->json.arena, meshes, sizeof *parts->found)};
    return parts->boxes && parts->found;
}

/* Returns the bounds of an instance, or of three of its positions. */
static struct zr_box sample_of(const struct parts *parts, const struct zr_instance *instance)
{
    const struct zr_mesh *mesh = &parts->root->scene->meshes[instance->mesh];
    const uint32_t step = mesh->position_count > 2 ? (mesh->position_count - 1) / 2 : 1;
    struct zr_box box = zr_box_empty();
    for (uint32_t k = 0; k < mesh->position_count; k += step)
        include(&box, zr_mat4_apply(&instance->object_to_world, mesh->positions[k]));
    return box;
}

static struct zr_box bounds_of(const struct parts *parts, const struct zr_instance *instance)
{
    const struct zr_matrix matrix = zr_matrix_of(&instance->object_to_world);
    const uint32_t mesh = instance->mesh;
    struct zr_box box = zr_box_empty();
    if (!parts->found[mesh]) parts->boxes[mesh] = box_of(parts->root, &parts->root->scene->meshes[mesh]);
    parts->found[mesh] = true;
    zr_box_include_placed(&box, &parts->boxes[mesh], &matrix);
    return box;
}

/* True if the instance is remote; *box: its bounds. A single position has no size, and is not. */
static bool is_far_part(const struct parts *parts, const struct zr_instance *instance, struct zr_box *box)
{
    *box = sample_of(parts, instance);
    if (!(box->low[0] <= box->high[0] && zr_box_is_remote(box, ZR_FAR_SIZES / 2.0))) return false;
    *box = bounds_of(parts, instance);
    return is_remote(box);
}

/* True if a list is moved whose instance is not far. */
static bool undoes_move(const struct zr_parsed_scene *root, const struct zr_far *far)
{
    const struct zr_scene *scene = root->scene;
    struct parts parts;
    struct zr_box box;
    if (!open_parts(root, &parts)) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        if (i % AT_ONCE == 0 && zr_is_cancelled(root->json.cancel)) return false;
        if (instance->mesh < lists_of(root) && zr_far_moves(zr_far_move(far, instance->mesh)) &&
            !is_far_part(&parts, instance, &box))
            return true;
    }
    return false;
}

bool zr_far_find(const struct zr_parsed_scene *root, struct zr_far *far)
{
    const bool is_far = may_be_far(root), has_list = is_far || has_far_list(root);
    const size_t lists = root->meshes.count + 1;
    double(*moves)[3] = zr_arena_zero(root->json.arena, lists, sizeof *moves);
    struct zr_box *boxes = zr_arena_alloc(root->json.arena, lists, sizeof *boxes);
    if (!moves || !boxes) return false;
    *far = (struct zr_far){.mesh_count = (uint32_t)root->meshes.count, .moves = (const double(*)[3])moves};
    const bool is_together = has_list && find_moves(root, boxes, moves);
    const struct zr_box placed = is_far ? placed_of(root, false) : zr_box_empty();
    find_middle(&placed, far->origin);
    return is_together || zr_far_moves(far->origin) || has_far_model(root) || (has_list && undoes_move(root, far));
}
