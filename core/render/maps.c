#include "render/maps.h"

#include "base/matrix.h"
#include "base/trig.h"
#include "render/pass.h"
#include "scene/scene_edit.h"
#include "shade/lights/lamps.h"

float zr_diagonal_of(const struct zr_bounds *bounds)
{
    if (!bounds->valid) return 0.0f;
    const zr_vec3 size = zr_vec3_sub(bounds->max, bounds->min);
    return sqrtf(zr_vec3_dot(size, size));
}

/* Points of the G-buffer are counted from the eye. */
struct zr_pixel_scale zr_pixel_scale_of(const struct zr_camera *camera, uint32_t height)
{
    const float *p = camera->projection.m;
    const zr_vec4 eye = zr_camera_eye(camera);
    const zr_vec3 slope = {p[3], p[7], p[11]};
    float offset = p[15];
    if (eye.w != 0.0f) offset = p[15] + zr_vec3_dot(slope, (zr_vec3){eye.x, eye.y, eye.z});
    return (struct zr_pixel_scale){
        .scale = 0.5f * (float)height * fabsf(p[5]), .slope = {slope.x, slope.y, slope.z}, .offset = offset};
}

/* ---- drawing ---- */

/* An orthographic camera at `eye` that looks along -back, half a size wide each way. */
static struct zr_camera map_camera(zr_vec3 right, zr_vec3 up, zr_vec3 back, zr_vec3 eye, float half_size, float near,
                                   float far)
{
    struct zr_camera camera = {.znear = near, .zfar = far};
    camera.world_to_eye = (zr_mat4){{right.x, up.x, back.x, 0, right.y, up.y, back.y, 0, right.z, up.z, back.z, 0,
                                     -zr_vec3_dot(right, eye), -zr_vec3_dot(up, eye), -zr_vec3_dot(back, eye), 1}};
    camera.projection = (zr_mat4){{1.0f / half_size, 0, 0, 0, 0, 1.0f / half_size, 0, 0, 0, 0, 2.0f / (near - far), 0,
                                   0, 0, (far + near) / (near - far), 1}};
    return camera;
}

/* Maps show both sides of faces, and no outlines. */
static void edit_material(struct zr_material *material)
{
    material->double_sided = true;
    material->outline = ZR_OUTLINE_NONE;
}

/* Depths along the camera's axis, INFINITY where nothing is; row 0 on top. */
static enum zr_status draw_map(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                               const struct zr_camera *camera, uint32_t side, const struct zr_cancel *cancel,
                               const float **depths)
{
    struct zr_pass *pass = zr_arena_zero(arena, 1, sizeof *pass);
    struct zr_frame *frame = zr_arena_zero(arena, 1, sizeof *frame);
    struct zr_scene of_maps;
    if (!pass || !frame || !zr_scene_edit_materials(arena, scene, edit_material, &of_maps)) return ZR_NO_MEMORY;
    of_maps.algorithm = ZR_ALGORITHM_HALFSPACE;
    of_maps.base = NULL;
    struct zr_pass_desc of = {.scene = &of_maps, .camera = camera, .window = {side, side, 1, 0.0f}};
    frame->width = frame->height = side;
    frame->camera = *camera;
    frame->depth = zr_arena_alloc(arena, (size_t)side * side, sizeof *frame->depth);
    frame->reaches = zr_arena_alloc(arena, side, sizeof *frame->reaches);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    *depths = frame->depth;
    enum zr_status status = ZR_OK;
    if (zr_any_is_masked(scene->materials, scene->material_count))
        status = zr_texture_maps_make(arena, team, scene, false, cancel, &of.wants.textures);
    if (status != ZR_OK) return status;
    status = zr_pass_make(arena, team, &of, cancel, pass);
    return status == ZR_OK ? zr_tiles_draw(arena, team, &pass->tiles, cancel, frame) : status;
}

/* ---- ground ---- */

/* The plane through the lowest point of the bounds: where its middle is, and its axes, x, y and up, in the world. */
struct plane {
    zr_vec3 middle, x, y, up;
    float half_size, height; /* of the map, and of the scene over the plane */
};

static struct plane plane_under(const struct zr_scene *scene, const struct zr_bounds *bounds)
{
    const zr_vec3 min = bounds->min, max = bounds->max, size = zr_vec3_sub(max, min);
    const bool z_is_up = scene->picture.z_is_up;
    struct plane plane = {.middle = zr_vec3_scale(zr_vec3_add(min, max), 0.5f),
                          .x = {1, 0, 0},
                          .y = z_is_up ? (zr_vec3){0, 1, 0} : (zr_vec3){0, 0, -1},
                          .up = zr_look_up(scene),
                          .height = z_is_up ? size.z : size.y};
    const float depth = z_is_up ? size.y : size.z, widest = size.x > depth ? size.x : depth;
    if (z_is_up)
        plane.middle.z = min.z;
    else
        plane.middle.y = min.y;
    plane.half_size = 0.5f * widest + 0.3f * zr_diagonal_of(bounds);
    return plane;
}

static zr_vec3 direction_in(const zr_mat4 *m, zr_vec3 d)
{
    const zr_vec4 out = zr_mat4_apply(m, (zr_vec4){d.x, d.y, d.z, 0.0f});
    return (zr_vec3){out.x, out.y, out.z};
}

/* An axis by which what is that long in the world has the coordinate 1. */
static zr_vec3 axis_in(const zr_mat4 *m, zr_vec3 axis, float scale)
{
    const zr_vec3 v = direction_in(m, axis);
    return scale == 1.0f ? v : zr_vec3_scale(v, 1.0f / (scale * scale));
}

static struct zr_ground_frame frame_of(const struct plane *plane, const struct zr_camera *camera)
{
    const zr_mat4 *m = &camera->world_to_eye;
    const float scale = zr_eye_scale_of(camera);
    const zr_vec4 middle = zr_mat4_apply(m, (zr_vec4){plane->middle.x, plane->middle.y, plane->middle.z, 1.0f});
    return (struct zr_ground_frame){.origin = {middle.x, middle.y, middle.z},
                                    .x_axis = axis_in(m, plane->x, scale),
                                    .y_axis = axis_in(m, plane->y, scale),
                                    .z_axis = direction_in(m, plane->up)};
}

static bool is_above(const struct zr_camera *camera, const struct zr_ground_frame *frame)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    zr_vec3 place = {eye.x, eye.y, eye.z};
    if (eye.w != 0.0f) place = zr_vec3_sub(place, frame->origin);
    return zr_vec3_dot(place, frame->z_axis) > 0.0f;
}

/* Seen from below, the map's rows from the top on go along the plane's y. */
enum zr_status zr_ground_map_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  const struct zr_cancel *cancel, struct zr_ground *ground,
                                  struct zr_ground_frame *frame)
{
    const float diagonal = zr_diagonal_of(bounds), *heights = NULL;
    *ground = (struct zr_ground){.light = NULL};
    if (!(diagonal > 0.0f)) return ZR_OK;
    const struct plane plane = plane_under(scene, bounds);
    *frame = frame_of(&plane, camera);
    if (!is_above(camera, frame)) return ZR_OK;
    const float margin = 0.01f * diagonal;
    const struct zr_camera below = map_camera(plane.x, zr_vec3_scale(plane.y, -1.0f), zr_vec3_scale(plane.up, -1.0f),
                                              plane.middle, plane.half_size, -margin, plane.height + margin);
    const enum zr_status status = draw_map(arena, team, scene, &below, ZR_GROUND_SIDE, cancel, &heights);
    if (status != ZR_OK) return status;
    *ground = zr_ground_make(arena, team, heights, plane.half_size, diagonal);
    return ground->light ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- rays ---- */

struct homogeneous {
    double v[4];
};

static struct homogeneous eye_point(const struct zr_matrix *clip_to_eye, double x, double y, double z)
{
    const double clip[4] = {x, y, z, 1.0};
    struct homogeneous out;
    zr_matrix_apply(clip_to_eye, clip, out.v);
    return out;
}

static zr_vec3 vec3_of(const double v[3])
{
    return (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

/* Where an affine function of the window is at its lower left, and how it changes from pixel to pixel. */
static void spread(const double at[3], const double right[3], const double top[3], double width, double height,
                   zr_vec3 *value, zr_vec3 *along_x, zr_vec3 *along_y)
{
    double x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (right[k] - at[k]) / width;
        y[k] = (top[k] - at[k]) / height;
    }
    *value = vec3_of(at);
    *along_x = vec3_of(x);
    *along_y = vec3_of(y);
}

/* The way from the eye, times w: that is linear over the window. Parallel rays: a point of the near plane. */
static void corner_of(const struct zr_matrix *clip_to_eye, zr_vec4 eye, double x, double y, double out[3])
{
    const struct homogeneous p = eye_point(clip_to_eye, x, y, eye.w != 0.0f ? 1.0 : -1.0);
    const double from[3] = {(double)eye.x, (double)eye.y, (double)eye.z};
    for (int k = 0; k < 3; k++)
        out[k] = eye.w != 0.0f ? p.v[k] - from[k] * p.v[3] : p.v[k] / p.v[3];
}

bool zr_rays_of(const struct zr_camera *camera, uint32_t width, uint32_t height, struct zr_rays *rays)
{
    const struct zr_matrix projection = zr_matrix_of(&camera->projection);
    const zr_vec4 eye = zr_camera_eye(camera);
    struct zr_matrix back;
    double at[3], right[3], top[3];
    if (!zr_matrix_invert(&projection, &back)) return false;
    corner_of(&back, eye, -1.0, -1.0, at);
    corner_of(&back, eye, 1.0, -1.0, right);
    corner_of(&back, eye, -1.0, 1.0, top);
    *rays = (struct zr_rays){.origin = {eye.x, eye.y, eye.z}};
    if (eye.w != 0.0f) {
        spread(at, right, top, (double)width, (double)height, &rays->direction, &rays->direction_x, &rays->direction_y);
    } else {
        rays->direction = (zr_vec3){-eye.x, -eye.y, -eye.z};
        spread(at, right, top, (double)width, (double)height, &rays->origin, &rays->origin_x, &rays->origin_y);
    }
    return true;
}

/* ---- shadows ---- */

/* Two axes across a unit vector. */
static void axes_across(zr_vec3 back, zr_vec3 *right, zr_vec3 *up)
{
    const zr_vec3 helper = fabsf(back.y) < 0.9f ? (zr_vec3){0, 1, 0} : (zr_vec3){1, 0, 0};
    *right = zr_vec3_normalize(zr_vec3_cross(helper, back));
    *up = zr_vec3_cross(back, *right);
}

/* The row of an affine function of world space, as one of points counted from the eye in eye space. */
static zr_vec3 row_of_eye(const zr_mat4 *eye_to_world, zr_vec3 eye, const float row[4], float *offset)
{
    const zr_vec3 in_world = {row[0], row[1], row[2]};
    zr_vec3 out;
    float *components[3] = {&out.x, &out.y, &out.z};
    for (int k = 0; k < 3; k++)
        *components[k] = zr_vec3_dot(
            in_world, (zr_vec3){eye_to_world->m[4 * k], eye_to_world->m[4 * k + 1], eye_to_world->m[4 * k + 2]});
    const zr_vec3 origin = {eye_to_world->m[12], eye_to_world->m[13], eye_to_world->m[14]};
    *offset = zr_vec3_dot(in_world, origin) + row[3] + zr_vec3_dot(out, eye);
    return out;
}

/* With a border in which nothing is. The frame's row 0 is on top, the map's the lowest. */
static const float *bordered(struct zr_arena *arena, const float *depths, int32_t stride)
{
    float *out = zr_arena_alloc(arena, (size_t)stride * (size_t)stride, sizeof *out);
    if (!out) return NULL;
    for (int32_t y = 0; y < stride; y++)
        for (int32_t x = 0; x < stride; x++) {
            const int32_t u = x - ZR_SHADOW_BORDER, v = y - ZR_SHADOW_BORDER;
            const bool within = u >= 0 && u < ZR_SHADOW_SIDE && v >= 0 && v < ZR_SHADOW_SIDE;
            out[y * stride + x] = within ? depths[(ZR_SHADOW_SIDE - 1 - v) * ZR_SHADOW_SIDE + u] : INFINITY;
        }
    return out;
}

static enum zr_status make_shadow(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  const struct zr_light *light, const struct zr_cancel *cancel,
                                  struct zr_shadow_map *map)
{
    const float radius = 0.51f * zr_diagonal_of(bounds), to_texels = 0.5f * ZR_SHADOW_SIDE / radius;
    const zr_vec3 middle = zr_vec3_scale(zr_vec3_add(bounds->min, bounds->max), 0.5f);
    const zr_vec4 eye = zr_camera_eye(camera);
    const zr_vec3 start = eye.w != 0.0f ? (zr_vec3){eye.x, eye.y, eye.z} : (zr_vec3){0, 0, 0};
    zr_mat4 eye_to_world;
    zr_vec3 right, up, back = zr_look_light_direction(scene, light, &camera->world_to_eye);
    if (!zr_mat4_invert(&camera->world_to_eye, &eye_to_world)) return ZR_OK;
    back = zr_vec3_normalize(zr_vec3_scale(direction_in(&eye_to_world, back), -1.0f));
    axes_across(back, &right, &up);
    const struct zr_camera along = map_camera(right, up, back, middle, radius, -radius, radius);
    const float *m = along.world_to_eye.m, *depths;
    const enum zr_status status = draw_map(arena, team, scene, &along, ZR_SHADOW_SIDE, cancel, &depths);
    if (status != ZR_OK) return status;
    const float u_row[4] = {m[0] * to_texels, m[4] * to_texels, m[8] * to_texels, (m[12] + radius) * to_texels};
    const float v_row[4] = {m[1] * to_texels, m[5] * to_texels, m[9] * to_texels, (m[13] + radius) * to_texels};
    const float depth_row[4] = {-m[2], -m[6], -m[10], -m[14]};
    map->stride = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER;
    map->bias = ZR_SHADOW_BIAS * zr_diagonal_of(bounds);
    map->eye_scale = zr_eye_scale_of(camera);
    map->u_axis = row_of_eye(&eye_to_world, start, u_row, &map->u_offset);
    map->v_axis = row_of_eye(&eye_to_world, start, v_row, &map->v_offset);
    map->depth_axis = row_of_eye(&eye_to_world, start, depth_row, &map->depth_offset);
    map->depths = bordered(arena, depths, map->stride);
    return map->depths ? ZR_OK : ZR_NO_MEMORY;
}

/* The half width of a spot's map at a depth of 1: its cone, and the texels around places at the cone's border. */
static float half_width_of(const struct zr_light *light)
{
    double sine, cosine;
    zr_sine_cosine(light->outer_degrees, &sine, &cosine);
    return (float)(sine / cosine * (1.0 + 8.0 / ZR_SHADOW_SIDE));
}

/* How deep the bounds' corners lie along an axis from a place. */
static void depths_of(const struct zr_bounds *bounds, zr_vec3 from, zr_vec3 axis, float *least, float *most)
{
    for (int i = 0; i < 8; i++) {
        const zr_vec3 corner = {i & 1 ? bounds->max.x : bounds->min.x, i & 2 ? bounds->max.y : bounds->min.y,
                                i & 4 ? bounds->max.z : bounds->min.z};
        const float depth = zr_vec3_dot(zr_vec3_sub(corner, from), axis);
        if (i == 0 || depth < *least) *least = depth;
        if (i == 0 || depth > *most) *most = depth;
    }
}

/* What is nearer to the lamp than a directional lamp's bias casts no shadow: it may be what the lamp is in. */
bool zr_spot_camera(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                    const struct zr_bounds *bounds, struct zr_camera *out)
{
    const float margin = ZR_SHADOW_BIAS * zr_diagonal_of(bounds), half_width = half_width_of(light);
    zr_vec3 right, up, at = light->position, back = zr_look_light_direction(scene, light, &camera->world_to_eye);
    float least = 0.0f, most = 0.0f;
    zr_mat4 eye_to_world;
    if (!zr_mat4_invert(&camera->world_to_eye, &eye_to_world)) return false;
    back = zr_vec3_normalize(zr_vec3_scale(direction_in(&eye_to_world, back), -1.0f));
    if (light->camera_frame) at = zr_vec4_over_w(zr_mat4_apply(&eye_to_world, (zr_vec4){at.x, at.y, at.z, 1.0f}));
    depths_of(bounds, at, zr_vec3_scale(back, -1.0f), &least, &most);
    const float far = most + margin, near = least - margin > margin ? least - margin : margin;
    if (!(far > near) || !isfinite(far)) return false;
    axes_across(back, &right, &up);
    *out = map_camera(right, up, back, at, half_width, near, far);
    out->projection = (zr_mat4){{1.0f / half_width, 0, 0, 0, 0, 1.0f / half_width, 0, 0, 0, 0,
                                 (far + near) / (near - far), -1, 0, 0, 2.0f * far * near / (near - far), 0}};
    return true;
}

static enum zr_status make_spot_shadow(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                       const struct zr_camera *camera, const struct zr_bounds *bounds,
                                       const struct zr_light *light, const struct zr_cancel *cancel,
                                       struct zr_shadow_map *map)
{
    const float half_width = half_width_of(light), middle = 0.5f * ZR_SHADOW_SIDE, to_texels = middle / half_width;
    const zr_vec4 eye = zr_camera_eye(camera);
    const zr_vec3 start = eye.w != 0.0f ? (zr_vec3){eye.x, eye.y, eye.z} : (zr_vec3){0, 0, 0};
    struct zr_camera along;
    zr_mat4 eye_to_world;
    const float *depths;
    if (!zr_spot_camera(scene, light, camera, bounds, &along)) return ZR_OK;
    if (!zr_mat4_invert(&camera->world_to_eye, &eye_to_world)) return ZR_OK;
    const enum zr_status status = draw_map(arena, team, scene, &along, ZR_SHADOW_SIDE, cancel, &depths);
    if (status != ZR_OK) return status;
    const float *m = along.world_to_eye.m;
    float u_row[4], v_row[4], depth_row[4];
    for (int k = 0; k < 4; k++) {
        depth_row[k] = -m[4 * k + 2];
        u_row[k] = m[4 * k] * to_texels + depth_row[k] * middle;
        v_row[k] = m[4 * k + 1] * to_texels + depth_row[k] * middle;
    }
    map->stride = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER;
    map->bias = ZR_SHADOW_BIAS_TEXELS / to_texels;
    map->eye_scale = zr_eye_scale_of(camera);
    map->u_axis = row_of_eye(&eye_to_world, start, u_row, &map->u_offset);
    map->v_axis = row_of_eye(&eye_to_world, start, v_row, &map->v_offset);
    map->depth_axis = row_of_eye(&eye_to_world, start, depth_row, &map->depth_offset);
    map->depths = bordered(arena, depths, map->stride);
    return map->depths ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_shadow_maps_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                   const struct zr_camera *camera, const struct zr_bounds *bounds,
                                   const struct zr_cancel *cancel, const struct zr_shadow_map **maps)
{
    bool any = false;
    *maps = NULL;
    for (uint32_t i = 0; i < scene->light_count; i++)
        any |= zr_light_casts_shadows(&scene->lights[i]);
    if (!any || !(zr_diagonal_of(bounds) > 0.0f)) return ZR_OK;
    struct zr_shadow_map *out = zr_arena_zero(arena, scene->light_count, sizeof *out);
    if (!out) return ZR_NO_MEMORY;
    *maps = out;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        if (!zr_light_casts_shadows(light)) continue;
        const enum zr_status status = light->type == ZR_LIGHT_SPOT
                                          ? make_spot_shadow(arena, team, scene, camera, bounds, light, cancel, &out[i])
                                          : make_shadow(arena, team, scene, camera, bounds, light, cancel, &out[i]);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}
