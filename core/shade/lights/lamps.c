#include "shade/lights/lamps.h"

#include "base/trig.h"
#include "shade/lights/environment.h"

zr_vec3 zr_look_up(const struct zr_scene *scene)
{
    return scene->picture.z_is_up ? (zr_vec3){0, 0, 1} : (zr_vec3){0, 1, 0};
}

/* Of a direction of the world, of any length. */
static zr_vec3 to_eye_space(const zr_mat4 *world_to_eye, zr_vec3 d)
{
    return zr_vec3_normalize(zr_mat4_direction(world_to_eye, d));
}

/* ---- environment ---- */

/* What of v is not along a unit vector. */
static zr_vec3 level(zr_vec3 v, zr_vec3 up)
{
    return zr_vec3_sub(v, zr_vec3_scale(up, zr_vec3_dot(v, up)));
}

/* Its axes in eye space: y is up, z leads towards the camera, or, seen from straight above, down the picture. */
static void environment_axes(const struct zr_scene *scene, const zr_mat4 *world_to_eye, zr_vec3 axes[3])
{
    const zr_vec3 back = {0, 0, 1}, down = {0, -1, 0};
    axes[0] = (zr_vec3){1, 0, 0};
    axes[1] = (zr_vec3){0, 1, 0};
    axes[2] = back;
    if (scene->picture.environment.camera_frame) return;
    axes[1] = to_eye_space(world_to_eye, zr_look_up(scene));
    const zr_vec3 towards = level(back, axes[1]);
    axes[2] = zr_vec3_normalize(zr_vec3_dot(towards, towards) > 1e-6f ? towards : level(down, axes[1]));
    axes[0] = zr_vec3_cross(axes[1], axes[2]);
}

/* Turned by an angle, it is asked for what lies so far back. */
static void turn_environment(const struct zr_scene *scene, const zr_mat4 *world_to_eye, zr_vec3 rows[3])
{
    zr_vec3 axes[3];
    double sine, cosine;
    environment_axes(scene, world_to_eye, axes);
    zr_sine_cosine(scene->picture.environment.rotation_degrees, &sine, &cosine);
    const float s = (float)sine, c = (float)cosine;
    rows[0] = zr_vec3_sub(zr_vec3_scale(axes[0], c), zr_vec3_scale(axes[2], s));
    rows[1] = axes[1];
    rows[2] = zr_vec3_add(zr_vec3_scale(axes[0], s), zr_vec3_scale(axes[2], c));
}

/* ---- lamps ---- */

/* The way that a light travels, or to a hemisphere's sky, in eye space. */
static zr_vec3 direction_of(const struct zr_light *light, const zr_mat4 *world_to_eye, const zr_vec3 environment[3])
{
    const zr_vec3 d = light->direction;
    if (!light->environment_frame) return light->camera_frame ? zr_vec3_normalize(d) : to_eye_space(world_to_eye, d);
    return zr_vec3_normalize(
        zr_vec3_add(zr_vec3_add(zr_vec3_scale(environment[0], d.x), zr_vec3_scale(environment[1], d.y)),
                    zr_vec3_scale(environment[2], d.z)));
}

zr_vec3 zr_look_light_direction(const struct zr_scene *scene, const struct zr_light *light, const zr_mat4 *world_to_eye)
{
    zr_vec3 environment[3];
    turn_environment(scene, world_to_eye, environment);
    return direction_of(light, world_to_eye, environment);
}

static struct zr_lamp lamp_of(const struct zr_light *light, zr_vec3 direction)
{
    const bool is_hemisphere = light->type == ZR_LIGHT_HEMISPHERE;
    return (struct zr_lamp){.to_light = is_hemisphere ? direction : zr_vec3_scale(direction, -1.0f),
                            .color = light->color,
                            .ground = light->ground,
                            .is_hemisphere = is_hemisphere,
                            .lights_pbr = light->lit != ZR_LIT_CLASSIC,
                            .lights_classic = light->lit != ZR_LIT_PBR};
}

static struct zr_placed_lamp placed_lamp_of(const struct zr_light *light, const struct zr_camera *camera)
{
    return (struct zr_placed_lamp){.place = zr_lamp_place_of(light, camera),
                                   .color = light->color,
                                   .lights_pbr = light->lit != ZR_LIT_CLASSIC,
                                   .lights_classic = light->lit != ZR_LIT_PBR};
}

/* ---- all ---- */

void zr_linear_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                             const struct zr_shadow_map *shadows, struct zr_linear_lighting *lighting)
{
    const struct zr_picture *picture = &scene->picture;
    const zr_vec4 eye = zr_camera_eye(camera);
    struct zr_lamp *lamps = zr_arena_alloc(arena, scene->light_count, sizeof *lamps);
    struct zr_placed_lamp *placed = zr_arena_alloc(arena, scene->light_count, sizeof *placed);
    *lighting = (struct zr_linear_lighting){.materials = scene->materials,
                                            .ambient = scene->ambient,
                                            .lamps = lamps,
                                            .placed = placed,
                                            .environment_intensity = picture->environment.intensity,
                                            .is_parallel = eye.w == 0.0f,
                                            .to_eye = {eye.x, eye.y, eye.z},
                                            .tone = picture->tone,
                                            .exposure = picture->exposure};
    lighting->has_environment = zr_environment_make(picture->environment.name, &lighting->environment);
    if (!lamps || !placed) return;
    turn_environment(scene, &camera->world_to_eye, lighting->eye_to_environment);
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        const struct zr_shadow_map *shadow = shadows && shadows[i].depths ? &shadows[i] : NULL;
        if (zr_light_has_place(light)) {
            struct zr_placed_lamp *lamp = &placed[lighting->placed_count++];
            *lamp = placed_lamp_of(light, camera);
            lamp->shadow = shadow;
        } else {
            struct zr_lamp *lamp = &lamps[lighting->lamp_count++];
            *lamp = lamp_of(light, direction_of(light, &camera->world_to_eye, lighting->eye_to_environment));
            lamp->shadow = shadow;
        }
    }
}
