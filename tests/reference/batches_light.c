#include "reference/batches.h"

#include <math.h>

#include "shade/lights/light.h"

/* The factor and the term of KHR_lights_punctual. */
static void set_cone(struct reference_place *place, const struct zr_light *light)
{
    const double degree = acos(-1.0) / 180.0;
    const double inner = cos(light->inner_degrees * degree), outer = cos(light->outer_degrees * degree);
    const double scale = 1.0 / fmax(0.001, inner - outer);
    place->scale = (float)scale;
    place->offset = (float)(-outer * scale);
}

/* Of ours are only places and directions in eye space, and `scale`, how long a unit of the scene is there: as the root
 * of `gain` it would be rounded once more. */
static void set_place(struct reference_place *place, const struct zr_light *light, const struct zr_lamp_place *ours,
                      float scale)
{
    const double range = (double)light->range * (double)scale;
    if (!ours->is_placed) return;
    *place = (struct reference_place){
        .position = {ours->position.x, ours->position.y, ours->position.z, 1},
        .axis = {ours->axis.x, ours->axis.y, ours->axis.z, light->range > 0.0f ? (float)(1.0 / (range * range)) : 0.0f},
        .offset = 1.0f,
        .unit = ours->gain,
        .least = ours->least};
    if (light->type == ZR_LIGHT_SPOT) set_cone(place, light);
}

static bool set_places(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                       const struct batches_options *options, struct reference_lighting *lighting)
{
    struct zr_gl_lighting made = {.places = NULL};
    const zr_vec4 eye = zr_camera_eye(camera);
    bool is_fixed = scene->light_count <= REFERENCE_FIXED_MAX && eye.x == 0.0f && eye.y == 0.0f;
    zr_gl_lighting_place(arena, scene, camera, &made);
    if (!made.places) return zr_arena_ok(arena);
    struct reference_place *places = zr_arena_zero(arena, scene->light_count, sizeof *places);
    if (!places) return false;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        set_place(&places[i], light, &made.places[i], zr_eye_scale_of(camera));
        places[i].position[0] += options->more_to_x;
        is_fixed &= light->type == ZR_LIGHT_POINT && light->range == 0.0f;
    }
    lighting->places = places;
    lighting->is_fixed = is_fixed && (eye.w == 0.0f || eye.z == 0.0f);
    return true;
}

const struct reference_lighting *batches_light(struct zr_arena *arena, const struct zr_scene *scene,
                                               const struct zr_camera *camera, const struct batches_options *options)
{
    struct zr_gl_lighting made;
    const float more = options->more_ambient;
    struct reference_lighting *lighting = zr_arena_alloc(arena, 1, sizeof *lighting);
    zr_vec3 *to_light = zr_arena_alloc(arena, scene->light_count, sizeof *to_light);
    zr_gl_lighting_make(arena, scene, &camera->world_to_eye, &made);
    if (!zr_arena_ok(arena)) return NULL;
    for (uint32_t i = 0; i < made.count; i++) {
        to_light[i] = made.to_light[i];
        to_light[i].x += options->more_to_x;
    }
    *lighting = (struct reference_lighting){.ambient = zr_vec3_add(made.ambient, (zr_vec3){more, more, more}),
                                            .count = made.count,
                                            .to_light = to_light,
                                            .colors = made.colors};
    return set_places(arena, scene, camera, options, lighting) ? lighting : NULL;
}
