/* Generators of scenes that are lit. */
#include "reference/generate.h"

static zr_vec3 random_vector(struct random *r, double reach)
{
    double v[3];
    for (int k = 0; k < 3; k++)
        v[k] = random_range(r, -reach, reach);
    return (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

static zr_vec3 random_light_color(struct random *r, double most)
{
    const zr_vec3 v = random_vector(r, most);
    return (zr_vec3){v.x < 0 ? -v.x : v.x, v.y < 0 ? -v.y : v.y, v.z < 0 ? -v.z : v.z};
}

/* A soup behind matrices, whose normals are given in half of the pictures; in some, light is brighter than 1. */
void fill_lit(struct drawing *drawing, struct random *r)
{
    if (random_below(r, 2))
        fill_matrix_perspective(drawing, r);
    else
        fill_matrix_orthographic(drawing, r);
    drawing->lit = true;
    drawing->given_normals = random_below(r, 2);
    for (uint32_t i = 0; i < drawing->position_count; i++)
        drawing->normals[i] = random_vector(r, random_power(r, -8, 8));
    drawing->ambient = random_light_color(r, 0.5);
    drawing->light_count = random_below(r, DRAWING_LIGHTS_MAX + 1);
    for (uint32_t i = 0; i < drawing->light_count; i++) {
        struct zr_light *light = &drawing->lights[i];
        light->direction = zr_vec3_normalize(random_vector(r, 1));
        light->color = random_light_color(r, 1);
        light->camera_frame = random_below(r, 2);
    }
}
