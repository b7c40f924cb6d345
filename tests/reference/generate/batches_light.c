#include "reference/generate/batches.h"

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
static void set_place(struct reference_place *place, const struct zr_light *light, const struct zr_lamp *lamp,
                      float scale)
{
    const double range = (double)light->range * (double)scale;
    const struct zr_lamp_place *ours = &lamp->place;
    if (!lamp->is_placed) return;
    *place = (struct reference_place){
        .position = {ours->position.x, ours->position.y, ours->position.z, 1},
        .axis = {ours->axis.x, ours->axis.y, ours->axis.z, light->range > 0.0f ? (float)(1.0 / (range * range)) : 0.0f},
        .offset = 1.0f,
        .unit = ours->gain,
        .least = ours->least};
    if (light->type == ZR_LIGHT_SPOT) set_cone(place, light);
}

static bool set_places(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                       const struct batches_options *options, const struct zr_lights *made,
                       struct reference_lighting *lighting)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    bool is_fixed = scene->light_count <= REFERENCE_FIXED_MAX && eye.x == 0.0f && eye.y == 0.0f;
    if (made->placed_count == 0) return true;
    struct reference_place *places = zr_arena_zero(arena, scene->light_count, sizeof *places);
    if (!places) return false;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        set_place(&places[i], light, &made->lamps[i], zr_eye_scale_of(camera));
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
    const struct zr_lights made = zr_lights_make(arena, scene, camera);
    const float more = options->more_ambient;
    struct reference_lighting *lighting = zr_arena_alloc(arena, 1, sizeof *lighting);
    zr_vec3 *to_light = zr_arena_alloc(arena, scene->light_count, sizeof *to_light);
    zr_vec3 *colors = zr_arena_alloc(arena, scene->light_count, sizeof *colors);
    if (!zr_arena_ok(arena)) return NULL;
    for (uint32_t i = 0; i < made.count; i++) {
        colors[i] = made.lamps[i].color;
        to_light[i] = made.lamps[i].to_light;
        to_light[i].x += options->more_to_x;
    }
    *lighting = (struct reference_lighting){.ambient = zr_vec3_add(made.ambient, (zr_vec3){more, more, more}),
                                            .count = made.count,
                                            .to_light = to_light,
                                            .colors = colors};
    return set_places(arena, scene, camera, options, &made, lighting) ? lighting : NULL;
}
