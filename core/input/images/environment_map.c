#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "base/trig.h"
#include "input/formats/sniff.h"
#include "input/images/environment_image.h"

/* BASE: side of the sharpest map. SAMPLES: least number of samples along the equator; half as many from pole to pole. A
 * texel of the sharpest map then has several. */
enum { BASE = 512, SAMPLES = 4096, PYRAMID = 5, BLOCK = 8 };

/* Light of texels: sums over samples, of radiance times solid angle (r, g, b) and of solid angle (w). */
struct sums {
    uint32_t side;
    float (*at)[4];
};

struct making {
    const struct zr_cancel *cancel;
    struct zr_image image;
    float (*texels)[4]; /* of the map */
    const uint8_t *rgbe;
    float bright; /* luminance above which light belongs to the sun; INFINITY: there is none */
    struct sums pyramid[PYRAMID];
    struct zr_environment_map *map;
};

/* ---- directions ---- */

static float fold(float of, float other)
{
    const float folded = 1.0f - fabsf(other);
    return of < 0.0f ? -folded : folded;
}

/* Returns the direction of the middle of texel i, j. */
static zr_vec3 texel_direction(uint32_t side, uint32_t i, uint32_t j)
{
    const float p = (2.0f * (float)i + 1.0f) / (float)side - 1.0f, q = (2.0f * (float)j + 1.0f) / (float)side - 1.0f;
    const float y = 1.0f - fabsf(p) - fabsf(q);
    return zr_vec3_normalize(y < 0.0f ? (zr_vec3){fold(p, q), y, fold(q, p)} : (zr_vec3){p, y, q});
}

static uint32_t texel_at(float place)
{
    const float at = (place + 1.0f) * (0.5f * (float)BASE);
    return at >= (float)(BASE - 1) ? BASE - 1 : at > 0.0f ? (uint32_t)at : 0;
}

static size_t texel_of(zr_vec3 d)
{
    const float all = fabsf(d.x) + fabsf(d.y) + fabsf(d.z), p = d.x / all, q = d.z / all;
    const bool is_below = d.y < 0.0f;
    return (size_t)texel_at(is_below ? fold(q, p) : q) * BASE + texel_at(is_below ? fold(p, q) : p);
}

/* ---- samples of the image ---- */

static zr_vec3 radiance_of(const struct making *m, uint32_t x, uint32_t y)
{
    const uint8_t *texel = m->rgbe + 4 * ((size_t)m->image.width * y + x);
    const float unit = fminf(zr_radiance_unit(texel[3]), 1e6f);
    return (zr_vec3){(float)texel[0] * unit, (float)texel[1] * unit, (float)texel[2] * unit};
}

static float luminance(zr_vec3 color)
{
    return (0.2126f * color.x + 0.7152f * color.y) + 0.0722f * color.z;
}

/* Returns the samples per texel of a side. */
static uint32_t samples_per(uint32_t side, uint32_t least)
{
    return least > side ? (least + side - 1) / side : 1;
}

/* Sine and cosine of the angles of `count` samples from `first` degrees on, `step` apart. NULL without memory. */
static float (*angles(struct zr_arena *arena, uint32_t count, double first, double step))[2]
{
    float(*out)[2] = zr_arena_alloc(arena, count, sizeof *out);
    for (uint32_t i = 0; out && i < count; i++) {
        double sine, cosine;
        zr_sine_cosine(first + ((double)i + 0.5) * step, &sine, &cosine);
        out[i][0] = (float)sine;
        out[i][1] = (float)cosine;
    }
    return out;
}

/* The image's texels as directions. `per`: samples per texel, across and down. */
struct grid {
    uint32_t per[2];
    float (*columns)[2], (*rows)[2]; /* sine and cosine of each sample's angle */
    float cell;                      /* solid angle of a sample, over the cosine of its elevation */
};

static bool make_grid(struct zr_arena *arena, const struct zr_image *image, uint32_t across, struct grid *grid)
{
    grid->per[0] = samples_per(image->width, across);
    grid->per[1] = samples_per(image->height, across / 2);
    const uint32_t columns = grid->per[0] * image->width, rows = grid->per[1] * image->height;
    grid->columns = angles(arena, columns, -180.0, 360.0 / (double)columns);
    grid->rows = angles(arena, rows, 90.0, -180.0 / (double)rows);
    grid->cell = (float)(2.0 * 9.869604401089358 / ((double)columns * (double)rows));
    return grid->columns && grid->rows;
}

static zr_vec3 sample_direction(const struct grid *grid, uint32_t column, uint32_t row)
{
    const float *across = grid->columns[column], *up = grid->rows[row];
    return (zr_vec3){across[1] * up[1], up[0], across[0] * up[1]};
}

/* ---- the sun ---- */

/* Sums over texels, in doubles. */
struct light {
    double color[3], all; /* of radiance times solid angle; of its luminance */
    double way[3];        /* of directions times that luminance */
};

static void add_light(struct light *light, zr_vec3 color, zr_vec3 d, float share)
{
    const double amount = (double)(luminance(color) * share);
    light->color[0] += (double)(color.x * share);
    light->color[1] += (double)(color.y * share);
    light->color[2] += (double)(color.z * share);
    light->all += amount;
    light->way[0] += amount * (double)d.x;
    light->way[1] += amount * (double)d.y;
    light->way[2] += amount * (double)d.z;
}

/* Returns the part of a radiance that belongs to the sun. */
static zr_vec3 excess(zr_vec3 color, float bright)
{
    const float l = luminance(color);
    return l > bright ? zr_vec3_scale(color, 1.0f - bright / l) : (zr_vec3){0, 0, 0};
}

/* Sums over the image of the light above `bright`. False if cancelled. */
static bool sum_light(const struct making *m, const struct grid *grid, float bright, struct light *out)
{
    *out = (struct light){.all = 0.0};
    for (uint32_t y = 0; y < m->image.height; y++) {
        struct light row = {.all = 0.0};
        if (zr_is_cancelled(m->cancel)) return false;
        for (uint32_t x = 0; x < m->image.width; x++)
            add_light(&row, excess(radiance_of(m, x, y), bright), sample_direction(grid, x, y),
                      grid->cell * grid->rows[y][1]);
        for (int k = 0; k < 3; k++) {
            out->color[k] += row.color[k];
            out->way[k] += row.way[k];
        }
        out->all += row.all;
    }
    return true;
}

#define PI 3.141592653589793

/* Finds a sun: brighter than 50 times the mean, and nearly all of it in one place. False if cancelled. */
static bool find_sun(struct making *m, const struct grid *grid)
{
    struct light all, sun;
    if (!sum_light(m, grid, 0.0f, &all)) return false;
    const float bright = (float)(50.0 * all.all / (4.0 * PI));
    if (!sum_light(m, grid, bright, &sun)) return false;
    const double length = sqrt((sun.way[0] * sun.way[0] + sun.way[1] * sun.way[1]) + sun.way[2] * sun.way[2]);
    m->bright = INFINITY;
    if (!(sun.all > 0.0) || length < 0.99 * sun.all) return true;
    m->bright = bright;
    m->map->has_sun = true;
    m->map->sun_direction =
        (zr_vec3){(float)(-sun.way[0] / length), (float)(-sun.way[1] / length), (float)(-sun.way[2] / length)};
    m->map->sun_color = (zr_vec3){(float)(sun.color[0] / PI), (float)(sun.color[1] / PI), (float)(sun.color[2] / PI)};
    return true;
}

/* ---- the pyramid ---- */

static void add_sample(float sum[4], zr_vec3 color, float share)
{
    sum[0] += color.x * share;
    sum[1] += color.y * share;
    sum[2] += color.z * share;
    sum[3] += share;
}

/* Adds the samples of the image to the largest map. False if cancelled. */
static bool spread_image(struct making *m, const struct grid *grid)
{
    float(*base)[4] = m->pyramid[0].at;
    for (uint32_t row = 0; row < grid->per[1] * m->image.height; row++) {
        const float share = grid->cell * grid->rows[row][1];
        if (zr_is_cancelled(m->cancel)) return false;
        for (uint32_t x = 0, column = 0; x < m->image.width; x++) {
            const zr_vec3 given = radiance_of(m, x, row / grid->per[1]);
            const zr_vec3 color = zr_vec3_sub(given, excess(given, m->bright));
            for (uint32_t i = 0; i < grid->per[0]; i++, column++)
                add_sample(base[texel_of(sample_direction(grid, column, row))], color, share);
        }
    }
    return true;
}

static void halve(const struct sums *from, const struct sums *to)
{
    for (uint32_t j = 0; j < to->side; j++)
        for (uint32_t i = 0; i < to->side; i++) {
            const float(*a)[4] = (const float(*)[4])from->at + (size_t)(2 * j) * from->side + 2 * i,
                  (*b)[4] = a + from->side;
            for (int k = 0; k < 4; k++)
                to->at[(size_t)j * to->side + i][k] = (a[0][k] + a[1][k]) + (b[0][k] + b[1][k]);
        }
}

/* Fills in the harmonics. The solid angles of all texels add up to 4 pi. */
static void find_harmonics(struct making *m)
{
    static const double factors[ZR_MAP_HARMONICS] = {1.0 / (4.0 * PI),   1.0 / (2.0 * PI),   1.0 / (2.0 * PI),
                                                     1.0 / (2.0 * PI),   15.0 / (16.0 * PI), 15.0 / (16.0 * PI),
                                                     15.0 / (16.0 * PI), 5.0 / (64.0 * PI),  15.0 / (64.0 * PI)};
    const struct sums *from = &m->pyramid[1];
    double sums[ZR_MAP_HARMONICS][3] = {{0}}, all = 0.0;
    for (uint32_t at = 0; at < from->side * from->side; at++) {
        const zr_vec3 d = texel_direction(from->side, at % from->side, at / from->side);
        const float f[ZR_MAP_HARMONICS] = {
            1.0f, d.x, d.y, d.z, d.x * d.y, d.y * d.z, d.z * d.x, 3.0f * d.z * d.z - 1.0f, d.x * d.x - d.y * d.y};
        for (int h = 0; h < ZR_MAP_HARMONICS; h++)
            for (int k = 0; k < 3; k++)
                sums[h][k] += (double)(f[h] * from->at[at][k]);
        all += (double)from->at[at][3];
    }
    for (int h = 0; h < ZR_MAP_HARMONICS; h++) {
        const double factor = factors[h] * (4.0 * PI / all);
        m->map->harmonics[h] =
            (zr_vec3){(float)(factor * sums[h][0]), (float)(factor * sums[h][1]), (float)(factor * sums[h][2])};
    }
}

/* ---- levels ---- */

/* A pyramid's map as it is gathered: directions of its texels, and of the middle of each block with its cosine. */
struct gathered {
    struct sums sums;
    zr_vec3 *directions;
    struct block {
        zr_vec3 middle;
        float cosine, sine; /* of the angle from the middle to the farthest texel */
    } * blocks;
};

static bool make_gathered(struct zr_arena *scratch, const struct sums *sums, struct gathered *out)
{
    const uint32_t side = sums->side, blocks = side / BLOCK;
    out->sums = *sums;
    out->directions = zr_arena_alloc(scratch, (size_t)side * side, sizeof *out->directions);
    out->blocks = zr_arena_alloc(scratch, (size_t)blocks * blocks, sizeof *out->blocks);
    if (!out->directions || !out->blocks) return false;
    for (uint32_t at = 0; at < side * side; at++)
        out->directions[at] = texel_direction(side, at % side, at / side);
    for (uint32_t b = 0; b < blocks * blocks; b++) {
        const zr_vec3 *first = out->directions + (size_t)(b / blocks) * BLOCK * side + b % blocks * BLOCK;
        struct block *block = &out->blocks[b];
        const uint32_t last = BLOCK - 1;
        block->middle = zr_vec3_normalize(zr_vec3_add(zr_vec3_add(first[0], first[last]),
                                                      zr_vec3_add(first[last * side], first[last * side + last])));
        block->cosine = 1.0f;
        for (uint32_t i = 0; i < BLOCK * BLOCK; i++)
            block->cosine = fminf(block->cosine, zr_vec3_dot(block->middle, first[i / BLOCK * side + i % BLOCK]));
        block->sine = sqrtf(fmaxf(1.0f - block->cosine * block->cosine, 0.0f));
    }
    return true;
}

/* GGX at N = V = R. A direction L has the weight D(N.H) N.L with N.H^2 = (1 + N.L) / 2, left out below 1/625 of the
 * largest D. */
struct lobe {
    float squared;      /* alpha^2 */
    float cosine, sine; /* of the largest angle of L */
};

static struct lobe lobe_of(float roughness)
{
    const float alpha = roughness * roughness, squared = alpha * alpha;
    const float half = fmaxf((1.0f - 25.0f * squared) / (1.0f - fminf(squared, 0.5f)), 0.0f);
    const float cosine = fmaxf(2.0f * half - 1.0f, 0.0f);
    return (struct lobe){squared, cosine, sqrtf(1.0f - cosine * cosine)};
}

static void gather_block(const struct gathered *from, const struct lobe *lobe, zr_vec3 n, size_t first, float sum[4])
{
    for (uint32_t i = 0; i < BLOCK * BLOCK; i++) {
        const size_t at = first + (size_t)(i / BLOCK) * from->sums.side + i % BLOCK;
        const float cosine = zr_vec3_dot(n, from->directions[at]);
        if (cosine <= lobe->cosine) continue;
        const float below = (0.5f + 0.5f * cosine) * (lobe->squared - 1.0f) + 1.0f;
        const float weight = cosine / (below * below);
        for (int k = 0; k < 4; k++)
            sum[k] += weight * from->sums.at[at][k];
    }
}

/* Gathers the light around n. Blocks outside the lobe are left out: the cosine of the sum of both angles. */
static void gather(const struct gathered *from, const struct lobe *lobe, zr_vec3 n, float sum[4])
{
    const uint32_t blocks = from->sums.side / BLOCK;
    for (uint32_t b = 0; b < blocks * blocks; b++) {
        const struct block *block = &from->blocks[b];
        const float least = lobe->cosine * block->cosine - lobe->sine * block->sine;
        if (zr_vec3_dot(n, block->middle) < least - 1e-5f) continue;
        gather_block(from, lobe, n, (size_t)(b / blocks) * BLOCK * from->sums.side + b % blocks * BLOCK, sum);
    }
}

/* Writes a texel: the mean radiance of the sums. */
static void put(const float sum[4], float out[4])
{
    const float over = sum[3] > 0.0f ? 1.0f / sum[3] : 0.0f;
    for (int k = 0; k < 3; k++)
        out[k] = sum[k] * over;
    out[3] = 0.0f;
}

/* Continues the map into its border: beyond an edge is the same edge, turned around its middle. */
static void put_border(float (*texels)[4], uint32_t side)
{
    const uint32_t stride = side + 2;
    for (uint32_t at = 0; at < stride * stride; at++) {
        uint32_t i = at % stride, j = at / stride;
        if (i > 0 && i <= side && j > 0 && j <= side) continue;
        if (i == 0 || i > side) {
            i = i == 0 ? 1 : side;
            j = side + 1 - j;
        }
        if (j == 0 || j > side) {
            j = j == 0 ? 1 : side;
            i = side + 1 - i;
        }
        memcpy(texels[at], texels[j * stride + i], sizeof texels[at]);
    }
}

/* Makes a level of the map from a map of the pyramid. False if cancelled or out of memory. */
static bool make_level(struct making *m, struct zr_arena *scratch, float roughness, uint32_t side,
                       const struct sums *from, float (*texels)[4])
{
    struct gathered gathered = {0};
    const struct lobe lobe = lobe_of(roughness);
    if (roughness > 0.0f && !make_gathered(scratch, from, &gathered)) return false;
    for (uint32_t j = 0; j < side; j++) {
        for (uint32_t i = 0; i < side; i++) {
            float sum[4] = {0}, *to = texels[(j + 1) * (side + 2) + i + 1];
            if (i % 4 == 0 && zr_is_cancelled(m->cancel)) return false;
            if (roughness > 0.0f) {
                gather(&gathered, &lobe, texel_direction(side, i, j), sum);
                put(sum, to);
            } else {
                put(from->at[(size_t)j * side + i], to);
            }
        }
    }
    put_border(texels, side);
    return true;
}

static bool make_levels(struct making *m, struct zr_arena *scratch)
{
#define LEVEL(roughness, side, from) {roughness, side, from},
    static const struct {
        float roughness;
        uint32_t side, from;
    } levels[ZR_MAP_LEVELS] = {ZR_MAP_LEVEL_ROWS(LEVEL)};
#undef LEVEL
    float(*at)[4] = m->texels;
    for (int i = 0; i < ZR_MAP_LEVELS; at += (size_t)(levels[i].side + 2) * (levels[i].side + 2), i++) {
        int from = 0;
        while (m->pyramid[from].side != levels[i].from)
            from++;
        if (!make_level(m, scratch, levels[i].roughness, levels[i].side, &m->pyramid[from], at)) return false;
    }
    return true;
}

/* ---- all ---- */

static bool open_pyramid(struct zr_arena *scratch, struct sums pyramid[PYRAMID])
{
    for (int i = 0; i < PYRAMID; i++) {
        const uint32_t side = (uint32_t)BASE >> i;
        pyramid[i] = (struct sums){side, zr_arena_zero(scratch, (size_t)side * side, sizeof *pyramid[i].at)};
        if (!pyramid[i].at) return false;
    }
    return true;
}

/* False if cancelled or out of memory. */
static bool make(struct making *m, struct zr_arena *scratch)
{
    struct grid texels, samples;
    if (!make_grid(scratch, &m->image, 0, &texels) || !make_grid(scratch, &m->image, SAMPLES, &samples) ||
        !open_pyramid(scratch, m->pyramid) || !find_sun(m, &texels) || !spread_image(m, &samples))
        return false;
    for (int i = 1; i < PYRAMID; i++)
        halve(&m->pyramid[i - 1], &m->pyramid[i]);
    find_harmonics(m);
    return make_levels(m, scratch);
}

static enum zr_status read_map(struct making *m, struct zr_arena *scratch, const struct zr_encoded_image *file,
                               struct zr_reason *reason)
{
    size_t rows;
    if (!zr_radiance_head_read(file, &m->image.width, &m->image.height, &rows, reason) ||
        !zr_image_fits(m->image.width, m->image.height, file->texels_max, reason))
        return ZR_BAD_SCENE;
    uint8_t *rgbe = zr_arena_alloc(scratch, (size_t)m->image.width * m->image.height, 4);
    if (!rgbe) return ZR_NO_MEMORY;
    const enum zr_status status = zr_radiance_read(file, rows, &m->image, rgbe, m->cancel, reason);
    m->rgbe = rgbe;
    m->map->image_texels = (uint64_t)m->image.width * m->image.height;
    if (status != ZR_OK || make(m, scratch)) return status;
    return zr_arena_ok(scratch) ? ZR_CANCELLED : ZR_NO_MEMORY;
}

enum zr_status zr_environment_map_read(struct zr_arena *arena, const struct zr_encoded_image *file,
                                       struct zr_environment_map **out, struct zr_reason *reason)
{
    if (!zr_radiance_looks_so(file->bytes, file->size)) {
        const char *words = zr_bytes_in_words(file->bytes, file->size);
        zr_reason_give(reason, "it is %s; a Radiance picture (.hdr) is needed", words ? words : "no known picture");
        return ZR_BAD_SCENE;
    }
    struct zr_environment_map *map = *out = zr_arena_zero(arena, 1, sizeof *map);
    struct making m = {.cancel = arena->cancel, .map = map};
    m.texels = zr_arena_alloc(arena, ZR_MAP_TEXELS, sizeof *m.texels);
    if (!map || !m.texels) return ZR_NO_MEMORY;
    map->texels = m.texels[0];
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    const enum zr_status status = read_map(&m, &scratch, file, reason);
    zr_arena_close_scratch(&scratch, arena);
    return status;
}
