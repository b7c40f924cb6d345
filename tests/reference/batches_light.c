#include "reference/batches.h"

#include "shade/light.h"

const struct reference_lighting *batches_light(struct zr_arena *arena, const struct zr_scene *scene,
                                               const struct zr_camera *camera, const struct batches_options *options)
{
    struct zr_lighting made;
    const float more = options->more_ambient;
    struct reference_lighting *lighting = zr_arena_alloc(arena, 1, sizeof *lighting);
    zr_vec3 *to_light = zr_arena_alloc(arena, scene->light_count, sizeof *to_light);
    zr_lighting_make(arena, scene, &camera->world_to_eye, &made);
    if (!zr_arena_ok(arena)) return NULL;
    for (uint32_t i = 0; i < made.count; i++) {
        to_light[i] = made.to_light[i];
        to_light[i].x += options->more_to_x;
    }
    *lighting = (struct reference_lighting){.ambient = zr_vec3_add(made.ambient, (zr_vec3){more, more, more}),
                                            .count = made.count,
                                            .to_light = to_light,
                                            .colors = made.colors};
    return lighting;
}
