#include "shade/lights/light.h"

static zr_vec3 upper_row(const zr_mat4 *m, int row)
{
    return (zr_vec3){m->m[row], m->m[4 + row], m->m[8 + row]};
}

/* Returns the unit vector towards a light, summed in Mesa's order. */
static zr_vec3 to_light_of(const struct zr_light *light, const zr_mat4 *world_to_eye)
{
    zr_vec3 d = light->direction;
    if (!light->camera_frame)
        d = (zr_vec3){zr_vec3_dot(upper_row(world_to_eye, 0), d), zr_vec3_dot(upper_row(world_to_eye, 1), d),
                      zr_vec3_dot(upper_row(world_to_eye, 2), d)};
    return zr_vec3_normalize(zr_vec3_scale(d, -1.0f));
}

struct zr_lights zr_lights_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera)
{
    struct zr_lamp *lamps = zr_arena_zero(arena, scene->light_count, sizeof *lamps);
    struct zr_lights lights = {.ambient = scene->ambient, .lamps = lamps};
    const zr_vec4 eye = zr_camera_eye(camera);
    if (!lamps) return lights;
    lights.count = scene->light_count;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        lamps[i] = (struct zr_lamp){.is_placed = zr_light_has_place(light), .color = light->color};
        if (lamps[i].is_placed)
            lamps[i].place = zr_lamp_place_of(light, camera);
        else
            lamps[i].to_light = to_light_of(light, &camera->world_to_eye);
        lights.placed_count += lamps[i].is_placed;
    }
    if (lights.placed_count > 0 && eye.w != 0.0f) lights.start = (zr_vec3){eye.x, eye.y, eye.z};
    return lights;
}

/* Cofactors are the inverse transpose times the determinant. Only its sign matters, since normals are normalized
 * later. */
struct zr_normal_matrix zr_normal_matrix_make(const zr_mat4 *object_to_eye)
{
    zr_vec3 r0 = upper_row(object_to_eye, 0), r1 = upper_row(object_to_eye, 1), r2 = upper_row(object_to_eye, 2);
    struct zr_normal_matrix n = {{zr_vec3_cross(r1, r2), zr_vec3_cross(r2, r0), zr_vec3_cross(r0, r1)}};
    if (zr_vec3_dot(r0, n.rows[0]) < 0.0f)
        for (int i = 0; i < 3; i++)
            n.rows[i] = zr_vec3_scale(n.rows[i], -1.0f);
    return n;
}
