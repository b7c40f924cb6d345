#include "shade/lights/lamps.h"

#include "base/trig.h"
#include "scene/picture.h"
#include "shade/lights/environment.h"

zr_vec3 zr_scene_up(const struct zr_scene *scene)
{
    return scene->picture->z_is_up ? (zr_vec3){0, 0, 1} : (zr_vec3){0, 1, 0};
}

/* Converts a world direction of any length to a unit vector in eye space. */
static zr_vec3 to_eye_space(const zr_mat4 *world_to_eye, zr_vec3 d)
{
    return zr_vec3_normalize(zr_mat4_direction(world_to_eye, d));
}

/* ---- environment ---- */

/* Returns the part of v that is perpendicular to a unit vector. */
static zr_vec3 level(zr_vec3 v, zr_vec3 up)
{
    return zr_vec3_sub(v, zr_vec3_scale(up, zr_vec3_dot(v, up)));
}

/* Computes the environment's axes in eye space: y is up, z points towards the camera. Seen from straight above, z
 * points down the picture. The axes of an image are the scene's. */
static void environment_axes(const struct zr_scene *scene, const zr_mat4 *world_to_eye, zr_vec3 axes[3])
{
    const zr_vec3 back = {0, 0, 1}, down = {0, -1, 0};
    axes[0] = (zr_vec3){1, 0, 0};
    axes[1] = (zr_vec3){0, 1, 0};
    axes[2] = back;
    if (scene->picture->environment.camera_frame) return;
    if (scene->picture->environment.map) {
        const bool z_is_up = scene->picture->z_is_up;
        axes[0] = to_eye_space(world_to_eye, (zr_vec3){1, 0, 0});
        axes[1] = to_eye_space(world_to_eye, zr_scene_up(scene));
        axes[2] = to_eye_space(world_to_eye, z_is_up ? (zr_vec3){0, -1, 0} : (zr_vec3){0, 0, 1});
        return;
    }
    axes[1] = to_eye_space(world_to_eye, zr_scene_up(scene));
    const zr_vec3 towards = level(back, axes[1]);
    axes[2] = zr_vec3_normalize(zr_vec3_dot(towards, towards) > 1e-6f ? towards : level(down, axes[1]));
    axes[0] = zr_vec3_cross(axes[1], axes[2]);
}

/* Computes the rows from eye space to the environment's. A rotation of the environment turns directions backwards. */
static void turn_environment(const struct zr_scene *scene, const zr_mat4 *world_to_eye, zr_vec3 rows[3])
{
    zr_vec3 axes[3];
    double sine, cosine;
    environment_axes(scene, world_to_eye, axes);
    zr_sine_cosine(scene->picture->environment.rotation_degrees, &sine, &cosine);
    const float s = (float)sine, c = (float)cosine;
    rows[0] = zr_vec3_sub(zr_vec3_scale(axes[0], c), zr_vec3_scale(axes[2], s));
    rows[1] = axes[1];
    rows[2] = zr_vec3_add(zr_vec3_scale(axes[0], s), zr_vec3_scale(axes[2], c));
}

/* Sets how near the environment is: bounds that are empty or a point have no gradient. */
static void set_nearness(const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_linear_lighting *lighting)
{
    const float diagonal = zr_diagonal_of(bounds) * zr_eye_scale_of(camera);
    const float nearness = 2.0f * lighting->environment.nearness / diagonal;
    if (!lighting->has_environment || !(diagonal > 0.0f) || !isfinite(nearness)) return;
    const zr_vec3 middle = zr_vec3_scale(zr_vec3_add(bounds->min, bounds->max), 0.5f);
    const zr_vec4 in_eye = zr_mat4_apply(&camera->world_to_eye, (zr_vec4){middle.x, middle.y, middle.z, 1.0f});
    const zr_vec4 eye = zr_camera_eye(camera);
    lighting->nearness = nearness;
    lighting->middle = (zr_vec3){in_eye.x, in_eye.y, in_eye.z};
    if (eye.w != 0.0f) lighting->middle = zr_vec3_sub(lighting->middle, (zr_vec3){eye.x, eye.y, eye.z});
}

/* ---- lamps ---- */

/* Returns the direction in which a light travels, or that to a hemisphere's sky, in eye space. */
static zr_vec3 direction_of(const struct zr_light *light, const zr_mat4 *world_to_eye, const zr_vec3 environment[3])
{
    const zr_vec3 d = light->direction;
    if (!light->environment_frame) return light->camera_frame ? zr_vec3_normalize(d) : to_eye_space(world_to_eye, d);
    return zr_vec3_normalize(
        zr_vec3_add(zr_vec3_add(zr_vec3_scale(environment[0], d.x), zr_vec3_scale(environment[1], d.y)),
                    zr_vec3_scale(environment[2], d.z)));
}

zr_vec3 zr_light_direction(const struct zr_scene *scene, const struct zr_light *light, const zr_mat4 *world_to_eye)
{
    zr_vec3 environment[3];
    turn_environment(scene, world_to_eye, environment);
    return direction_of(light, world_to_eye, environment);
}

static struct zr_lamp lamp_of(const struct zr_light *light, const struct zr_camera *camera,
                              const zr_vec3 environment[3])
{
    struct zr_lamp lamp = {.is_placed = zr_light_has_place(light),
                           .is_hemisphere = light->type == ZR_LIGHT_HEMISPHERE,
                           .lights_pbr = light->lit != ZR_LIT_CLASSIC,
                           .lights_classic = light->lit != ZR_LIT_PBR,
                           .color = light->color,
                           .ground = light->ground};
    if (lamp.is_placed) {
        lamp.place = zr_lamp_place_of(light, camera);
    } else {
        const zr_vec3 along = direction_of(light, &camera->world_to_eye, environment);
        lamp.to_light = lamp.is_hemisphere ? along : zr_vec3_scale(along, -1.0f);
    }
    return lamp;
}

/* Adds the lamps that are or are not placed, in scene order. */
static void add_lamps(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_shadow_map *shadows,
                      bool placed, struct zr_lamp *lamps, struct zr_linear_lighting *lighting)
{
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        if (zr_light_has_place(light) != placed) continue;
        struct zr_lamp *lamp = &lamps[lighting->lights.count++];
        *lamp = lamp_of(light, camera, lighting->eye_to_environment);
        lamp->shadow = shadows && shadows[i].depths ? &shadows[i] : NULL;
        lighting->lights.placed_count += placed;
    }
}

/* ---- all ---- */

void zr_linear_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                             const struct zr_bounds *bounds, const struct zr_shadow_map *shadows,
                             struct zr_linear_lighting *lighting)
{
    const struct zr_picture *picture = scene->picture;
    const zr_vec4 eye = zr_camera_eye(camera);
    struct zr_lamp *lamps = zr_arena_alloc(arena, scene->light_count, sizeof *lamps);
    *lighting = (struct zr_linear_lighting){.materials = scene->materials,
                                            .lights = {.ambient = scene->ambient, .lamps = lamps},
                                            .environment_intensity = picture->environment.intensity,
                                            .is_parallel = eye.w == 0.0f,
                                            .to_eye = {eye.x, eye.y, eye.z},
                                            .tone = picture->tone,
                                            .exposure = picture->exposure,
                                            .gooch = picture->gooch};
    if (picture->environment.map) lighting->environment = zr_environment_of_map(picture->environment.map);
    lighting->has_environment =
        picture->environment.map || zr_environment_make(picture->environment.name, &lighting->environment);
    set_nearness(camera, bounds, lighting);
    if (!lamps) return;
    turn_environment(scene, &camera->world_to_eye, lighting->eye_to_environment);
    add_lamps(scene, camera, shadows, false, lamps, lighting);
    add_lamps(scene, camera, shadows, true, lamps, lighting);
}
