/* Generators of scenes that are lit. */
#include "reference/generate/generate.h"

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

/* A lamp near some vertex, as bright there as light is elsewhere. */
static struct zr_light random_lamp(const struct drawing *drawing, struct random *r)
{
    const zr_vec4 near = drawing->positions[random_below(r, drawing->position_count)];
    const double distance = random_power(r, -6, 2);
    struct zr_light light = {.type = ZR_LIGHT_POINT,
                             .position = zr_vec3_add((zr_vec3){near.x, near.y, near.z}, random_vector(r, distance))};
    light.color = random_light_color(r, 0.5 * distance * distance);
    return light;
}

/* Eye space is object space, so that the fixed functions light where lamps are point lamps without a range. */
static void fill_in_eye_space(struct drawing *drawing, struct random *r)
{
    fill_lit(drawing, r);
    for (uint32_t i = 0; i < drawing->position_count; i++) {
        const zr_vec3 at = zr_vec4_over_w(zr_mat4_apply(&drawing->modelview, drawing->positions[i]));
        drawing->positions[i] = (zr_vec4){at.x, at.y, at.z, 1};
    }
    drawing->modelview = zr_mat4_identity();
}

/* As the fixed functions have them. */
void fill_lamps(struct drawing *drawing, struct random *r)
{
    fill_in_eye_space(drawing, r);
    drawing->light_count = 1 + random_below(r, DRAWING_LIGHTS_MAX);
    for (uint32_t i = 0; i < drawing->light_count; i++)
        drawing->lights[i] = random_lamp(drawing, r);
}

/* Spots, ranges, and directional lights among them; behind any matrix. */
void fill_spots(struct drawing *drawing, struct random *r)
{
    fill_lit(drawing, r);
    for (uint32_t i = 0; i < drawing->position_count; i++)
        drawing->positions[i].w = 1;
    drawing->light_count = 1 + random_below(r, DRAWING_LIGHTS_MAX);
    for (uint32_t i = 0; i < drawing->light_count; i++) {
        if (i > 0 && random_below(r, 4) == 0) continue;
        struct zr_light light = random_lamp(drawing, r);
        const zr_vec4 at = drawing->positions[random_below(r, drawing->position_count)];
        const zr_vec3 way = zr_vec3_sub((zr_vec3){at.x, at.y, at.z}, light.position);
        if (random_below(r, 2)) light.range = sqrtf(zr_vec3_dot(way, way)) * (float)random_range(r, 0.5, 3);
        if (random_below(r, 2)) {
            light.type = ZR_LIGHT_SPOT;
            light.direction = zr_vec3_normalize(way);
            light.outer_degrees = random_range(r, 1, 90);
            light.inner_degrees = random_range(r, 0, light.outer_degrees);
        }
        drawing->lights[i] = light;
    }
}
