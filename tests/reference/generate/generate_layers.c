/* Generators of scenes with see-through faces: up to 64, most of them large, that cut one another. */
#include "reference/generate/generate.h"

enum { FACES_MOST = 64 };

/* Some are so alike that equal depths decide. */
static void fill_sheets(struct drawing *drawing, struct random *r)
{
    for (uint32_t i = 0; i < FACES_MOST; i++) {
        uint32_t v[3];
        const bool level = random_below(r, 4) == 0;
        const double z = (double)random_below(r, 4) / 4.0;
        for (int k = 0; k < 3; k++) {
            const double x = random_range(r, -1.5, 1.5), y = random_range(r, -1.5, 1.5), own = random_range(r, -1, 1);
            v[k] = random_vertex(drawing, r, x, y, level ? z : own, level ? 1.0 : random_power(r, -2, 2));
        }
        drawing_triangle(drawing, v[0], v[1], v[2]);
    }
}

static enum zr_alpha_mode random_mode(struct random *r, enum zr_alpha_mode usual)
{
    const uint32_t number = random_below(r, 8);
    return number == 0 ? ZR_ALPHA_OPAQUE : number == 1 ? ZR_ALPHA_MASK : usual;
}

static void fill_layers_of(struct drawing *drawing, struct random *r, enum zr_alpha_mode usual)
{
    if (random_below(r, 2))
        fill_sheets(drawing, r);
    else
        fill_lit(drawing, r);
    if (drawing->face_count > FACES_MOST) drawing->face_count = FACES_MOST;
    drawing->see_through = true;
    drawing->alpha_cutoff = (float)random_range(r, 0.1, 0.9);
    for (uint32_t i = 0; i < drawing->position_count; i++)
        drawing->colors[i].w = (float)random_range(r, 0.05, 1.0);
    for (uint32_t f = 0; f < drawing->face_count; f++) {
        drawing->face_colors[f].w = (float)random_range(r, 0.05, 1.0);
        drawing->face_materials[f] = f == 0 ? ZR_ALPHA_OPAQUE : random_mode(r, usual);
    }
}

void fill_blended(struct drawing *drawing, struct random *r)
{
    fill_layers_of(drawing, r, ZR_ALPHA_BLEND);
}

void fill_masked(struct drawing *drawing, struct random *r)
{
    fill_layers_of(drawing, r, ZR_ALPHA_MASK);
}
