#include "input/root/json_far.h"

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

/* Sets `out` to the middle of a remote box, rounded to floats; else to zeros. */
static void find_middle(const struct zr_box *box, double out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = is_remote(box) ? zr_rounded(box->low[axis] / 2.0 + box->high[axis] / 2.0) : 0.0;
}

static bool is_list(const struct zr_parsed_scene *root, uint32_t mesh)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    return mesh >= root->meshes.count || !given[mesh].model;
}

/* Finds the bounds of the positions in lists: their meshes come first. */
static struct zr_box lists_of(const struct zr_parsed_scene *root)
{
    const uint32_t end = (uint32_t)root->meshes.count + zr_parsed_has_polygons(root);
    struct zr_box box = zr_box_empty();
    for (uint32_t i = 0; i < end && i < root->scene->mesh_count; i++) {
        const struct zr_mesh *mesh = &root->scene->meshes[i];
        for (uint32_t k = 0; is_list(root, i) && k < mesh->position_count; k++) {
            if (k % AT_ONCE == 0 && zr_is_cancelled(root->json.cancel)) return box;
            include(&box, mesh->positions[k]);
        }
    }
    return box;
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

/* True if the first list with faces is remote by its first positions. */
static bool has_far_list(const struct zr_parsed_scene *root)
{
    const struct zr_scene *scene = root->scene;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        if (is_list(root, i) && scene->meshes[i].position_count > 1)
            return zr_recenter_is_remote(scene->meshes[i].positions, scene->meshes[i].position_count);
    return false;
}

bool zr_far_find(const struct zr_parsed_scene *root, struct zr_far *far)
{
    const bool is_far = may_be_far(root), has_list = is_far || has_far_list(root);
    const struct zr_box none = zr_box_empty(), lists = has_list ? lists_of(root) : none,
                        placed = is_far ? placed_of(root, false) : none;
    find_middle(&lists, far->move);
    find_middle(&placed, far->origin);
    return has_far_model(root) || zr_far_moves(far->move) || zr_far_moves(far->origin);
}
