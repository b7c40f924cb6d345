#include "shade/lights/environment.h"

#include <string.h>

#define GREY(v)                                                                                                        \
    {                                                                                                                  \
        v, v, v                                                                                                        \
    }
#define TINT(v, r, g, b)                                                                                               \
    {                                                                                                                  \
        (v) * (r), (v) * (g), (v) * (b)                                                                                \
    }

/* A studio: a large soft key light at the upper left, a strip that shows whether metal is round or flat, and a rim
 * light behind. Light from the floor gives the sides of a metal cube different greys. */
static const struct zr_environment_light STUDIO = {
    .sky = TINT(0.30f, 0.98f, 1.0f, 1.03f),
    .ground = TINT(0.115f, 1.03f, 1.0f, 0.97f),
    .half_width = 0.012f,
    .nearness = 0.4f,
    .box_count = 4,
    .boxes = {{.middle = {-0.60f, 0.66f, 0.46f},
               .a = 0.48f,
               .h = 0.36f,
               .w0 = 0.010f,
               .color = TINT(5.5f, 1.02f, 1.0f, 0.97f)},
              {.middle = {0.95f, 0.10f, 0.25f},
               .a = 0.07f,
               .h = 0.62f,
               .w0 = 0.008f,
               .color = TINT(0.55f, 0.95f, 0.99f, 1.05f)},
              {.middle = {0.35f, 0.45f, -0.85f}, .a = 0.55f, .h = 0.13f, .w0 = 0.010f, .color = GREY(1.7f)},
              {.middle = {-0.85f, -0.42f, 0.25f},
               .a = 0.50f,
               .h = 0.30f,
               .w0 = 0.05f,
               .color = TINT(0.42f, 1.04f, 1.0f, 0.96f)}},
    .lobe_count = 2,
    .lobes = {{.middle = {0.85f, -0.25f, 0.45f}, .w0 = 0.52f, .color = TINT(0.194f, 0.96f, 1.0f, 1.04f)},
              {.middle = {0.10f, -0.97f, 0.22f}, .w0 = 0.66f, .color = TINT(0.305f, 1.04f, 1.0f, 0.96f)}},
    .harmonics = {{0.6508f, 0.6444f, 0.6363f},
                  {-0.3456f, -0.3359f, -0.3224f},
                  {0.4674f, 0.4663f, 0.4627f},
                  {0.2497f, 0.2438f, 0.2353f},
                  {-0.3651f, -0.3581f, -0.3471f},
                  {0.2404f, 0.2349f, 0.2264f},
                  {-0.2916f, -0.2854f, -0.2765f},
                  {-0.0271f, -0.0264f, -0.0254f},
                  {-0.0070f, -0.0063f, -0.0054f}}};

/* Soft boxes where the planes of a part look, without the studio's bright window. */
static const struct zr_environment_light METAL = {
    .sky = TINT(0.34f, 0.98f, 1.0f, 1.03f),
    .ground = TINT(0.10f, 1.03f, 1.0f, 0.97f),
    .half_width = 0.012f,
    .nearness = 0.5f,
    .box_count = 6,
    .boxes = {{.middle = {-0.55f, 0.70f, 0.46f},
               .a = 0.55f,
               .h = 0.42f,
               .w0 = 0.010f,
               .color = TINT(2.3f, 1.02f, 1.0f, 0.97f)},
              {.middle = {0.95f, 0.10f, 0.25f},
               .a = 0.07f,
               .h = 0.62f,
               .w0 = 0.008f,
               .color = TINT(0.9f, 0.95f, 0.99f, 1.05f)},
              {.middle = {-0.15f, 0.80f, -0.58f}, .a = 0.55f, .h = 0.22f, .w0 = 0.010f, .color = GREY(0.95f)},
              {.middle = {0.35f, 0.35f, -0.87f}, .a = 0.50f, .h = 0.10f, .w0 = 0.010f, .color = GREY(1.4f)},
              {.middle = {0.85f, -0.15f, -0.50f}, .a = 0.30f, .h = 0.40f, .w0 = 0.03f, .color = GREY(0.28f)},
              {.middle = {-0.85f, -0.42f, 0.25f},
               .a = 0.50f,
               .h = 0.30f,
               .w0 = 0.03f,
               .color = TINT(1.0f, 1.04f, 1.0f, 0.96f)}},
    .harmonics = {{0.5474f, 0.5441f, 0.5408f},
                  {-0.2297f, -0.2217f, -0.2114f},
                  {0.3870f, 0.3889f, 0.3902f},
                  {0.0977f, 0.0938f, 0.0886f},
                  {-0.1540f, -0.1522f, -0.1482f},
                  {0.0779f, 0.0752f, 0.0708f},
                  {-0.1754f, -0.1712f, -0.1657f},
                  {-0.0212f, -0.0207f, -0.0201f},
                  {0.0010f, 0.0008f, 0.0011f}}};

/* A clear day: blue sky, haze at the horizon in front and behind, and a glow around the sun, which is itself a lamp.
 * The sun is at a place where it lights top and front of a cube differently. */
static const struct zr_environment_light OUTDOOR = {
    .sky = {0.46f, 0.54f, 0.70f},
    .ground = {0.30f, 0.27f, 0.22f},
    .half_width = 0.04f,
    .box_count = 2,
    .boxes = {{.middle = {0, 0.18f, -1}, .a = 1.2f, .h = 0.18f, .w0 = 0.15f, .color = {0.55f, 0.50f, 0.42f}},
              {.middle = {0, 0.18f, 1}, .a = 1.2f, .h = 0.18f, .w0 = 0.15f, .color = {0.55f, 0.50f, 0.42f}}},
    .lobe_count = 1,
    .lobes = {{.middle = {-0.42f, 0.80f, 0.43f}, .w0 = 0.7f, .color = TINT(0.45f, 1.0f, 0.95f, 0.85f)}},
    .harmonics = {{0.5236f, 0.5376f, 0.5739f},
                  {-0.0262f, -0.0249f, -0.0223f},
                  {0.1502f, 0.2003f, 0.2963f},
                  {0.0268f, 0.0255f, 0.0228f},
                  {-0.0232f, -0.0220f, -0.0197f},
                  {0.0237f, 0.0225f, 0.0201f},
                  {-0.0124f, -0.0118f, -0.0106f},
                  {0.0097f, 0.0087f, 0.0072f},
                  {0.0280f, 0.0251f, 0.0207f}}};

bool zr_environment_make(enum zr_environment_name name, struct zr_environment_light *out)
{
    static const struct zr_environment_light *const rows[ZR_ENVIRONMENT_IMAGE + 1] = {
        [ZR_ENVIRONMENT_STUDIO] = &STUDIO, [ZR_ENVIRONMENT_METAL] = &METAL, [ZR_ENVIRONMENT_OUTDOOR] = &OUTDOOR};
    const zr_vec3 up = {0, 1, 0};
    if (!rows[name]) return false;
    *out = *rows[name];
    for (uint32_t i = 0; i < out->box_count; i++) {
        struct zr_environment_box *box = &out->boxes[i];
        box->middle = zr_vec3_normalize(box->middle);
        box->across = zr_vec3_normalize(zr_vec3_cross(up, box->middle));
        box->along = zr_vec3_cross(box->middle, box->across);
    }
    for (uint32_t i = 0; i < out->lobe_count; i++)
        out->lobes[i].middle = zr_vec3_normalize(out->lobes[i].middle);
    return true;
}

_Static_assert((int)ZR_HARMONICS == (int)ZR_MAP_HARMONICS, "the same functions");

struct zr_environment_light zr_environment_of_map(const struct zr_environment_map *map)
{
    struct zr_environment_light light = {.map = map->texels};
    memcpy(light.harmonics, map->harmonics, sizeof light.harmonics);
    return light;
}
