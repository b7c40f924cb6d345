#include "render/finish.h"

#include "base/mutant.h"
#include "scene/picture.h"

enum { ROWS_PER_RANGE = 8 };

/* ((b + 1/2) / 16 - 1/2) / 255 for b of the ordered 4 x 4 pattern of Bayer, repeated. */
#define MOVED(b)            (((b) + 0.5f) / 16.0f - 0.5f) / 255.0f
#define FOUR(a, b, c, d)    MOVED(a), MOVED(b), MOVED(c), MOVED(d)
#define SIXTEEN(a, b, c, d) FOUR(a, b, c, d), FOUR(a, b, c, d), FOUR(a, b, c, d), FOUR(a, b, c, d)
const float zr_finish_dither[ZR_DITHER_SIDE][ZR_DITHER_ROOM] = {
    {SIXTEEN(0, 8, 2, 10)}, {SIXTEEN(12, 4, 14, 6)}, {SIXTEEN(3, 11, 1, 9)}, {SIXTEEN(15, 7, 13, 5)}};

struct rows {
    const struct zr_post_desc *of;
    enum zr_isa isa;
    float top[3], bottom[3], ink_color[3];
    const struct zr_cancel *cancel;
    float (*composed)[4];
};

/* Computes the background of row y above the lowest: linear from the centre of the lowest row to that of the
 * highest. */
static void background_of(const struct rows *rows, uint32_t y, float out[4])
{
    const struct zr_scene *scene = rows->of->scene;
    const uint32_t height = rows->of->light->height;
    const float rise = height > 1 ? (float)y / (float)(height - 1) : 1.0f;
    const float up = ZR_MUTANT(gradient_turned, rise, 1.0f - rise);
    for (int k = 0; k < 3; k++)
        out[k] = rows->bottom[k] + (rows->top[k] - rows->bottom[k]) * up;
    out[3] = scene->picture->has_gradient ? 1.0f : scene->background.w;
}

enum { SHARES_AT_ONCE = 16384 + 16 };

/* Returns row y over its background, without ink. shares: room for the ground's T. */
static struct zr_finish_row row_of(const struct rows *rows, size_t y, float *shares)
{
    const struct zr_post_desc *of = rows->of;
    const struct zr_linear_frame *light = of->light;
    struct zr_finish_row row = {.cover = light->cover + y * light->stride, .count = light->width};
    for (int k = 0; k < 3; k++) {
        row.color[k] = light->color[k] + y * light->stride;
        row.ink_color[k] = rows->ink_color[k];
    }
    background_of(rows, (uint32_t)y, row.background);
    if (!of->ground || !of->ground->light) return row;
    zr_ground_row_of(rows->isa)(of->ground, &of->ground_frame, &of->rays, (int32_t)y, (int32_t)light->width, shares);
    if (of->sun.map)
        zr_ground_sun_row_of(rows->isa)(&of->sun, &of->ground_frame, &of->rays, (int32_t)y, (int32_t)light->width,
                                        shares);
    row.share = shares;
    return row;
}

static void finish_range(void *context, size_t begin, size_t end)
{
    const struct rows *rows = context;
    const struct zr_post_desc *of = rows->of;
    const struct zr_linear_frame *light = of->light;
    float shares[SHARES_AT_ONCE];
    for (size_t y = begin; y < end && !zr_is_cancelled(rows->cancel); y++) {
        struct zr_finish_row row = row_of(rows, y, shares);
        if (of->scene->picture->has_gradient)
            row.dither = zr_finish_dither[ZR_MUTANT(dither_from_above, y, light->height - 1 - y) % ZR_DITHER_SIDE];
        if (of->ink) row.ink = of->ink + y * light->width;
        zr_finish_row_of(rows->isa)(&row, (uint32_t *)(void *)of->out + (size_t)(light->height - 1 - y) * light->width);
    }
}

static void compose_range(void *context, size_t begin, size_t end)
{
    const struct rows *rows = context;
    const uint32_t width = rows->of->light->width;
    float shares[SHARES_AT_ONCE];
    for (size_t y = begin; y < end && !zr_is_cancelled(rows->cancel); y++) {
        const struct zr_finish_row row = row_of(rows, y, shares);
        for (uint32_t x = 0; x < width; x++) {
            float *out = rows->composed[y * width + x];
            const float rest = (1.0f - row.cover[x]) * (row.share ? row.share[x] : 1.0f);
            for (int k = 0; k < 3; k++)
                out[k] = row.color[k][x] + row.background[k] * rest;
            out[3] = 1.0f;
        }
    }
}

static struct rows rows_of(struct zr_team *team, const struct zr_post_desc *desc, const struct zr_cancel *cancel)
{
    const struct zr_scene *scene = desc->scene;
    const struct zr_picture *picture = scene->picture;
    struct rows rows = {.of = desc, .isa = zr_team_isa(team), .cancel = cancel};
    const zr_vec3 plain = {scene->background.x, scene->background.y, scene->background.z};
    const zr_vec3 top = picture->has_gradient ? picture->top : plain;
    const zr_vec3 bottom = picture->has_gradient ? picture->bottom : plain;
    const zr_vec3 ink = picture->edges.color;
    zr_decode_of(rows.isa)((const float[3]){top.x, top.y, top.z}, rows.top);
    zr_decode_of(rows.isa)((const float[3]){bottom.x, bottom.y, bottom.z}, rows.bottom);
    zr_decode_of(rows.isa)((const float[3]){ink.x, ink.y, ink.z}, rows.ink_color);
    return rows;
}

bool zr_background_is_opaque(const struct zr_scene *scene)
{
    return scene->picture->has_gradient || scene->background.w >= 1.0f;
}

void zr_finish_compose(struct zr_team *team, const struct zr_post_desc *desc, const struct zr_cancel *cancel,
                       float (*out)[4])
{
    struct rows rows = rows_of(team, desc, cancel);
    rows.composed = out;
    zr_team_ranges(team, desc->light->height, ROWS_PER_RANGE, compose_range, &rows);
}

void zr_finish_picture(struct zr_team *team, const struct zr_post_desc *desc, const struct zr_cancel *cancel)
{
    struct rows rows = rows_of(team, desc, cancel);
    zr_team_ranges(team, desc->light->height, ROWS_PER_RANGE, finish_range, &rows);
}
