#include "effects/shadow_maps.h"

#include "base/trig.h"
#include "shade/lights/lamps.h"

/* ---- cameras along the light ---- */

/* Finds two unit axes perpendicular to a unit vector. */
static void axes_across(zr_vec3 back, zr_vec3 *right, zr_vec3 *up)
{
    const zr_vec3 helper = fabsf(back.y) < 0.9f ? (zr_vec3){0, 1, 0} : (zr_vec3){1, 0, 0};
    *right = zr_vec3_normalize(zr_vec3_cross(helper, back));
    *up = zr_vec3_cross(back, *right);
}

/* Returns the unit vector against the light's direction, in world space. */
static zr_vec3 back_of(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                       const zr_mat4 *eye_to_world)
{
    const zr_vec3 along = zr_light_direction(scene, light, &camera->world_to_eye);
    return zr_vec3_normalize(zr_vec3_scale(zr_mat4_direction(eye_to_world, along), -1.0f));
}

/* Returns half the side of a directional light's map, scene units. */
static float radius_of(const struct zr_bounds *bounds)
{
    return 0.51f * zr_diagonal_of(bounds);
}

static struct zr_camera directional_camera(zr_vec3 back, const struct zr_bounds *bounds)
{
    const float radius = radius_of(bounds);
    const zr_vec3 middle = zr_vec3_scale(zr_vec3_add(bounds->min, bounds->max), 0.5f);
    zr_vec3 right, up;
    axes_across(back, &right, &up);
    return zr_camera_orthographic(right, up, back, middle, radius, -radius, radius);
}

/* Returns half the side of a spot's map at depth 1: the cone's, plus the texels filtered at its border. */
static float half_width_of(const struct zr_light *light)
{
    double sine, cosine;
    zr_sine_cosine(light->outer_degrees, &sine, &cosine);
    return (float)(sine / cosine * (1.0 + 8.0 / ZR_SHADOW_SIDE));
}

/* Finds the least and the largest depth of the bounds' corners along an axis. */
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

/* Makes the camera of a spot at `at`. Surfaces nearer than the bias of directional lights cast no shadow, since they
 * may enclose the light. */
static bool find_spot_camera(const struct zr_light *light, zr_vec3 at, zr_vec3 back, const struct zr_bounds *bounds,
                             struct zr_camera *out)
{
    const float margin = ZR_SHADOW_BIAS * zr_diagonal_of(bounds), half_width = half_width_of(light);
    float least = 0.0f, most = 0.0f;
    zr_vec3 right, up;
    depths_of(bounds, at, zr_vec3_scale(back, -1.0f), &least, &most);
    const float far = most + margin, near = least - margin > margin ? least - margin : margin;
    if (!(far > near) || !isfinite(far)) return false;
    axes_across(back, &right, &up);
    *out = zr_camera_orthographic(right, up, back, at, half_width, near, far);
    out->projection = (zr_mat4){{1.0f / half_width, 0, 0, 0, 0, 1.0f / half_width, 0, 0, 0, 0,
                                 (far + near) / (near - far), -1, 0, 0, 2.0f * far * near / (near - far), 0}};
    return true;
}

bool zr_light_camera(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                     const struct zr_bounds *bounds, struct zr_camera *out)
{
    zr_mat4 eye_to_world;
    zr_vec3 at = light->position;
    if (!zr_mat4_invert(&camera->world_to_eye, &eye_to_world)) return false;
    const zr_vec3 back = back_of(scene, light, camera, &eye_to_world);
    if (light->type != ZR_LIGHT_SPOT) {
        *out = directional_camera(back, bounds);
        return true;
    }
    if (light->camera_frame) at = zr_vec4_over_w(zr_mat4_apply(&eye_to_world, (zr_vec4){at.x, at.y, at.z, 1.0f}));
    return find_spot_camera(light, at, back, bounds, out);
}

/* ---- maps from depths ---- */

/* Converts `row`, an affine function of world space, to one of eye-space points relative to `eye`: returns its slope,
 * and sets *offset. */
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

/* Copies depths into a map with an uncovered border. Row 0 of the depths is on top, row 0 of the map is the lowest. */
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

/* Affine functions of world space: u and v in texels, and the depth along the light. For spots, u and v are multiplied
 * by the depth. */
struct map_rows {
    float u[4], v[4], depth[4];
};

static struct map_rows directional_rows(const float *m, const struct zr_bounds *bounds)
{
    const float radius = radius_of(bounds), to_texels = 0.5f * ZR_SHADOW_SIDE / radius;
    return (struct map_rows){.u = {m[0] * to_texels, m[4] * to_texels, m[8] * to_texels, (m[12] + radius) * to_texels},
                             .v = {m[1] * to_texels, m[5] * to_texels, m[9] * to_texels, (m[13] + radius) * to_texels},
                             .depth = {-m[2], -m[6], -m[10], -m[14]}};
}

static struct map_rows spot_rows(const float *m, float to_texels)
{
    const float middle = 0.5f * ZR_SHADOW_SIDE;
    struct map_rows rows;
    for (int k = 0; k < 4; k++) {
        rows.depth[k] = -m[4 * k + 2];
        rows.u[k] = m[4 * k] * to_texels + rows.depth[k] * middle;
        rows.v[k] = m[4 * k + 1] * to_texels + rows.depth[k] * middle;
    }
    return rows;
}

struct zr_shadow_map zr_shadow_map_make(struct zr_arena *arena, const struct zr_light *light,
                                        const struct zr_camera *camera, const struct zr_bounds *bounds,
                                        const struct zr_camera *along, const float *depths)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    const zr_vec3 start = eye.w != 0.0f ? (zr_vec3){eye.x, eye.y, eye.z} : (zr_vec3){0, 0, 0};
    const bool is_spot = light->type == ZR_LIGHT_SPOT;
    const float spot_texels = is_spot ? 0.5f * ZR_SHADOW_SIDE / half_width_of(light) : 1.0f;
    const struct map_rows rows =
        is_spot ? spot_rows(along->world_to_eye.m, spot_texels) : directional_rows(along->world_to_eye.m, bounds);
    struct zr_shadow_map map = {.stride = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER, .eye_scale = zr_eye_scale_of(camera)};
    zr_mat4 eye_to_world;
    if (!zr_mat4_invert(&camera->world_to_eye, &eye_to_world)) return map;
    map.bias = is_spot ? ZR_SHADOW_BIAS_TEXELS / spot_texels : ZR_SHADOW_BIAS * zr_diagonal_of(bounds);
    map.u_axis = row_of_eye(&eye_to_world, start, rows.u, &map.u_offset);
    map.v_axis = row_of_eye(&eye_to_world, start, rows.v, &map.v_offset);
    map.depth_axis = row_of_eye(&eye_to_world, start, rows.depth, &map.depth_offset);
    map.depths = bordered(arena, depths, map.stride);
    return map;
}
