#include "shade/lights/light.h"

static zr_vec3 upper_row(const zr_mat4 *m, int row)
{
    return (zr_vec3){m->m[row], m->m[4 + row], m->m[8 + row]};
}

void zr_gl_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const zr_mat4 *world_to_eye,
                         struct zr_gl_lighting *lighting)
{
    zr_vec3 *to_light = zr_arena_alloc(arena, scene->light_count, sizeof *to_light);
    zr_vec3 *colors = zr_arena_alloc(arena, scene->light_count, sizeof *colors);
    *lighting = (struct zr_gl_lighting){.ambient = scene->ambient, .to_light = to_light, .colors = colors};
    if (!zr_arena_ok(arena)) return;
    lighting->count = scene->light_count;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        zr_vec3 d = light->direction;
        if (!light->camera_frame)
            d = (zr_vec3){zr_vec3_dot(upper_row(world_to_eye, 0), d), zr_vec3_dot(upper_row(world_to_eye, 1), d),
                          zr_vec3_dot(upper_row(world_to_eye, 2), d)};
        to_light[i] = zr_vec3_normalize(zr_vec3_scale(d, -1.0f));
        colors[i] = light->color;
    }
}

void zr_gl_lighting_place(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                          struct zr_gl_lighting *lighting)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    bool any = false;
    for (uint32_t i = 0; i < scene->light_count; i++)
        any |= zr_light_has_place(&scene->lights[i]);
    if (!any) return;
    struct zr_lamp_place *places = zr_arena_zero(arena, scene->light_count, sizeof *places);
    if (!places) return;
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (zr_light_has_place(&scene->lights[i])) places[i] = zr_lamp_place_of(&scene->lights[i], camera);
    lighting->places = places;
    if (eye.w != 0.0f) lighting->start = (zr_vec3){eye.x, eye.y, eye.z};
}

/* Cofactors are the inverse transpose times the determinant: of it only the sign
 * matters, since normals are normalised afterwards. */
struct zr_normal_matrix zr_normal_matrix_make(const zr_mat4 *object_to_eye)
{
    zr_vec3 r0 = upper_row(object_to_eye, 0), r1 = upper_row(object_to_eye, 1), r2 = upper_row(object_to_eye, 2);
    struct zr_normal_matrix n = {{zr_vec3_cross(r1, r2), zr_vec3_cross(r2, r0), zr_vec3_cross(r0, r1)}};
    if (zr_vec3_dot(r0, n.rows[0]) < 0.0f)
        for (int i = 0; i < 3; i++)
            n.rows[i] = zr_vec3_scale(n.rows[i], -1.0f);
    return n;
}

zr_light_fn *zr_light_of(enum zr_isa isa)
{
    static zr_light_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_light);
    return table[isa];
}

zr_light_placed_fn *zr_light_placed_of(enum zr_isa isa)
{
    static zr_light_placed_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_light_placed);
    return table[isa];
}

zr_to_eye_fn *zr_to_eye_of(enum zr_isa isa)
{
    static zr_to_eye_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_to_eye);
    return table[isa];
}
