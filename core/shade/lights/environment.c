#include "shade/lights/environment.h"

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
    .sky = TINT(0.40f, 0.98f, 1.0f, 1.03f),
    .ground = TINT(0.15f, 1.03f, 1.0f, 0.97f),
    .half_width = 0.10f,
    .box_count = 4,
    .boxes = {{.middle = {-0.55f, 0.70f, 0.46f},
               .a = 0.42f,
               .h = 0.32f,
               .w0 = 0.06f,
               .color = TINT(6.4f, 1.02f, 1.0f, 0.97f)},
              {.middle = {0.95f, 0.10f, 0.25f},
               .a = 0.07f,
               .h = 0.62f,
               .w0 = 0.05f,
               .color = TINT(0.6f, 0.95f, 0.99f, 1.05f)},
              {.middle = {0.35f, 0.45f, -0.85f}, .a = 0.55f, .h = 0.13f, .w0 = 0.06f, .color = GREY(1.8f)},
              {.middle = {-0.85f, -0.42f, 0.25f},
               .a = 0.50f,
               .h = 0.30f,
               .w0 = 0.25f,
               .color = TINT(0.6f, 1.04f, 1.0f, 0.96f)}},
    .harmonics = {{0.6571f, 0.6521f, 0.6463f},
                  {-0.3070f, -0.2986f, -0.2870f},
                  {0.5184f, 0.5178f, 0.5154f},
                  {0.2044f, 0.1991f, 0.1913f},
                  {-0.3063f, -0.3002f, -0.2906f},
                  {0.2398f, 0.2342f, 0.2258f},
                  {-0.2616f, -0.2564f, -0.2490f},
                  {-0.0210f, -0.0204f, -0.0196f},
                  {-0.0239f, -0.0233f, -0.0222f}}};

/* A clear day: blue sky, haze at the horizon in front and behind, and a glow around the sun, which is itself a lamp. */
static const struct zr_environment_light OUTDOOR = {
    .sky = {0.34f, 0.52f, 0.84f},
    .ground = {0.30f, 0.27f, 0.22f},
    .half_width = 0.04f,
    .box_count = 2,
    .boxes = {{.middle = {0, 0.18f, -1}, .a = 1.2f, .h = 0.18f, .w0 = 0.15f, .color = {0.55f, 0.50f, 0.42f}},
              {.middle = {0, 0.18f, 1}, .a = 1.2f, .h = 0.18f, .w0 = 0.15f, .color = {0.55f, 0.50f, 0.42f}}},
    .lobe = {-0.48f, 0.67f, 0.57f},
    .lobe_width = 0.7f,
    .lobe_color = TINT(0.45f, 1.0f, 0.95f, 0.85f),
    .harmonics = {{0.4636f, 0.5276f, 0.6439f},
                  {-0.0299f, -0.0284f, -0.0254f},
                  {0.0820f, 0.1825f, 0.3594f},
                  {0.0355f, 0.0337f, 0.0302f},
                  {-0.0221f, -0.0210f, -0.0188f},
                  {0.0262f, 0.0249f, 0.0223f},
                  {-0.0188f, -0.0179f, -0.0160f},
                  {0.0121f, 0.0110f, 0.0092f},
                  {0.0322f, 0.0292f, 0.0243f}}};

bool zr_environment_make(enum zr_environment_name name, struct zr_environment_light *out)
{
    static const struct zr_environment_light *const rows[ZR_ENVIRONMENT_COUNT] = {
        [ZR_ENVIRONMENT_STUDIO] = &STUDIO, [ZR_ENVIRONMENT_OUTDOOR] = &OUTDOOR};
    const zr_vec3 up = {0, 1, 0};
    if (!rows[name]) return false;
    *out = *rows[name];
    for (uint32_t i = 0; i < out->box_count; i++) {
        struct zr_environment_box *box = &out->boxes[i];
        box->middle = zr_vec3_normalize(box->middle);
        box->across = zr_vec3_normalize(zr_vec3_cross(up, box->middle));
        box->along = zr_vec3_cross(box->middle, box->across);
    }
    out->lobe = zr_vec3_normalize(out->lobe);
    return true;
}
