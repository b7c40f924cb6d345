/* Turns a bare mesh upright, and views it face on if it is flat. */
#include <math.h>
#include <string.h>

#include "input/formats/formats.h"
#include "input/query/cloud.h"
#include "input/query/parameters.h"
#include "input/scene/kept.h"
#include "input/text/names.h"
#include "input/text/number.h"
#include "input/text/recenter.h"
#include "render_request.h"
#include "scene/camera/face_on.h"
#include "scene/camera/mesh_up.h"
#include "scene/picture.h"

static enum zr_mesh_up usual_up(const struct zr_query *query)
{
    return zr_format_rows[query->request->format].z_is_up ? ZR_MESH_UP_Z : ZR_MESH_UP_Y;
}

/* The axis of a file with nodes is known. */
static bool gives_up(const struct zr_query *query)
{
    return query->up != ZR_UNSET && !(query->up == ZR_MESH_UP_AUTO && query->given.builder->file);
}

enum zr_mesh_up zr_query_up(const struct zr_query *query)
{
    return gives_up(query) ? (enum zr_mesh_up)query->up : usual_up(query);
}

/* Moves a place of the file, "X,Y,Z", as the mesh is: in double precision, since floats may lose digits of a far one. */
static zr_vec3 place_of(const struct zr_scene *scene, const zr_mat4 *upright, const char *text)
{
    const char *const end = text + strlen(text);
    double given[3] = {0, 0, 0};
    for (int i = 0; i < 3 && text; i++) {
        text = zr_number_read(text, end, &given[i]);
        if (text && text < end) text++; /* the comma */
    }
    const zr_vec4 moved = zr_recenter_position(given, scene->origin);
    return zr_mat4_direction(upright, (zr_vec3){moved.x, moved.y, moved.z});
}

/* Looking straight down or up, the presets top and bottom say what is up in the picture. */
static void choose_up(struct zr_view *view)
{
    const zr_vec3 to = {view->target.x - view->eye.x, view->target.y - view->eye.y, view->target.z - view->eye.z};
    const float least = 1e-6f * fabsf(to.y);
    if (fabsf(to.x) <= least && fabsf(to.z) <= least) view->up = (zr_vec3){0.0f, 0.0f, to.y < 0.0f ? -1.0f : 1.0f};
}

/* Eye and target are in coordinates of the file. An eye without a target looks at the middle. */
static void place_view(const struct zr_query *query, const zr_mat4 *upright)
{
    const struct zr_request *request = query->request;
    struct zr_scene *scene = query->given.builder->scene;
    struct zr_view *view = &scene->views[0];
    if (request->eye) view->eye = place_of(scene, upright, request->eye);
    if (request->target) view->target = place_of(scene, upright, request->target);
    if (!request->eye) return;
    const struct zr_bounds bounds = zr_bounds_of(scene, query->given.builder->team, request->cancel);
    if (!request->target && bounds.valid)
        view->target = (zr_vec3){0.5f * (bounds.min.x + bounds.max.x), 0.5f * (bounds.min.y + bounds.max.y),
                                 0.5f * (bounds.min.z + bounds.max.z)};
    choose_up(view);
}

static void turn(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    struct zr_scene *scene = builder->scene;
    enum zr_mesh_up up = zr_query_up(query);
    scene->file.up_source = up == ZR_MESH_UP_AUTO ? "auto" : gives_up(query) ? "parameter" : "format";
    if (up == ZR_MESH_UP_AUTO) up = zr_mesh_up_find(scene, usual_up(query), builder->team, query->request->cancel);
    scene->file.up = zr_mesh_up_names.words[up];
    const zr_mat4 upright = zr_mesh_up_turn(up);
    for (uint32_t i = 0; up != ZR_MESH_UP_Y && i < scene->instance_count; i++)
        query->instances[i].object_to_world = zr_mat4_mul(&upright, &query->instances[i].object_to_world);
    place_view(query, &upright);
}

static void show_face_on(const struct zr_query *query)
{
    const struct zr_scene_builder *builder = query->given.builder;
    const struct zr_request *request = query->request;
    struct zr_scene *scene = builder->scene;
    struct zr_view *view = &scene->views[0];
    const bool has_view = request->eye || request->target || request->preset || request->azimuth ||
                          request->elevation || query->camera || (builder->keeping && builder->keeping->has_view);
    if (has_view || scene->picture->z_is_up) return;
    const struct zr_bounds bounds = zr_bounds_of(scene, builder->team, request->cancel);
    scene->has_box = bounds.valid;
    scene->box_min = bounds.min;
    scene->box_max = bounds.max;
    if (zr_face_on_find(scene, &bounds, builder->team, request->cancel, &view->preset)) view->pose = ZR_POSE_PRESET;
}

void zr_query_orient(const struct zr_query *query)
{
    if (zr_format_rows[query->request->format].has_view) return; /* a scene in JSON */
    zr_cloud_size_points(query);
    turn(query);
    show_face_on(query);
}
