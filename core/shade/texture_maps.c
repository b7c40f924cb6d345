#include "shade/texture_maps.h"

#include <string.h>

#include "base/run.h"
#include "base/srgb.h"
#include "scene/image.h"

/* Texels per range: some hundred microseconds. */
enum { TEXELS_PER_RANGE = 1 << 14 };

/* Levels of an image, averaged either as they are or in linear light. */
struct chain {
    uint32_t level_count;
    struct zr_texture_level levels[ZR_TEXTURE_LEVELS_MAX];
};

/* Steps of the table from light, 0..1, to codes. A step is narrower than the least distance of 8-bit thresholds,
 * 1/3294, and therefore contains at most one. */
enum { CODE_STEPS = 4096 };

/* Tables for colours of 8 or 16 bits. */
struct decoding {
    const float *values;     /* light of each code */
    const float *thresholds; /* light midway between a code and the next, in encoded values */
    const uint8_t *codes;    /* 8 bits: number of thresholds at or below n / CODE_STEPS; else NULL */
};

struct making {
    const struct zr_run *run;
    const struct zr_scene *scene;
    bool decode;
    struct decoding decodings[2]; /* of 8 and of 16 bits; values NULL: not needed so far */
    uint8_t codes[CODE_STEPS + 1];
    struct chain *chains; /* two per image: not decoded, decoded */
};

/* ---- tables ---- */

enum { ROOM_BEHIND = 16 };

static const uint8_t *make_codes(const float *thresholds, uint8_t *codes)
{
    uint8_t code = 0; /* the last threshold exceeds every light */
    for (int n = 0; n <= CODE_STEPS; n++) {
        while (thresholds[code] * (float)CODE_STEPS <= (float)n)
            code++;
        codes[n] = code;
    }
    return codes;
}

static bool make_decoding(struct making *m, uint32_t bits, struct decoding *out)
{
    const size_t count = (size_t)1 << bits, last = 2 * (count - 1);
    float *ramp = zr_arena_alloc(m->run->arena, last + ROOM_BEHIND, sizeof *ramp);
    float *values = zr_arena_alloc(m->run->arena, count, sizeof *values);
    float *thresholds = zr_arena_alloc(m->run->arena, count, sizeof *thresholds);
    if (!zr_arena_ok(m->run->arena)) return false;
    zr_srgb_ramp_of(zr_team_isa(m->run->team))(last, ramp);
    for (size_t i = 0; i < count; i++) {
        values[i] = ramp[2 * i];
        thresholds[i] = i + 1 < count ? ramp[2 * i + 1] : 2.0f;
    }
    *out = (struct decoding){values, thresholds, bits == 8 ? make_codes(thresholds, m->codes) : NULL};
    return true;
}

/* Returns the tables, or NULL if out of memory. */
static const struct decoding *find_decoding(struct making *m, uint32_t bits)
{
    struct decoding *decoding = &m->decodings[bits == 16];
    return decoding->values || make_decoding(m, bits, decoding) ? decoding : NULL;
}

/* Returns the code of a light: the number of thresholds at or below it. */
static uint32_t encode(const struct decoding *decoding, uint32_t bits, double light)
{
    uint32_t code = 0;
    for (uint32_t step = 1u << (bits - 1); step > 0; step >>= 1)
        if ((double)decoding->thresholds[code + step - 1] <= light) code += step;
    return code;
}

/* ---- levels ---- */

/* Texels of one axis that texel i of the next level covers, and their shares. */
struct span {
    uint32_t first, count, shares[3], all;
};

static struct span span_of(uint32_t side, uint32_t i)
{
    const uint32_t half = side / 2;
    if (side == 1) return (struct span){0, 1, {1}, 1};
    if (side % 2 == 0) return (struct span){2 * i, 2, {1, 1}, 2};
    return (struct span){2 * i, 3, {half - i, half, i + 1}, side};
}

struct halving {
    const struct zr_texture_level *from, *to;
    void *texels; /* those of `to` */
    uint32_t bits;
    const struct decoding *decoding; /* NULL: values are averaged as they are */
    const struct zr_cancel *cancel;
};

static uint32_t value_of(const void *texels, uint32_t bits, size_t number)
{
    return bits == 8 ? ((const uint8_t *)texels)[number] : ((const uint16_t *)texels)[number];
}

static uint32_t mean_of(const struct halving *h, const struct span *x, const struct span *y, uint32_t channel)
{
    uint64_t sum = 0, all = (uint64_t)x->all * y->all;
    double light = 0.0;
    const bool decodes = h->decoding && channel < 3;
    for (uint32_t j = 0; j < y->count; j++)
        for (uint32_t i = 0; i < x->count; i++) {
            const size_t texel = (size_t)(y->first + j) * h->from->width + x->first + i;
            const uint32_t value = value_of(h->from->texels, h->bits, 4 * texel + channel);
            const uint64_t share = (uint64_t)x->shares[i] * y->shares[j];
            if (decodes)
                light += (double)share * (double)h->decoding->values[value];
            else
                sum += share * value;
        }
    if (decodes) return encode(h->decoding, h->bits, light / (double)all);
    return (uint32_t)((2 * sum + all) / (2 * all));
}

/* ---- 8 bits, both sides even: the frequent case, with the same result ---- */

static uint8_t encode_quick(const struct decoding *decoding, double light)
{
    const uint8_t code = decoding->codes[(size_t)(light * CODE_STEPS)];
    return (uint8_t)(code + ((double)decoding->thresholds[code] <= light));
}

static uint32_t load_word(const uint8_t *texel)
{
    uint32_t word;
    memcpy(&word, texel, sizeof word);
    return word;
}

/* Returns the mean of each byte, rounded half up. Sums of bytes 0 and 2, and of 1 and 3, fit in 16 bits. */
static uint32_t mean_of_words(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t every_other = 0x00ff00ff, half = 0x00020002;
    const uint32_t even = (a & every_other) + (b & every_other) + (c & every_other) + (d & every_other) + half;
    const uint32_t odd =
        (a >> 8 & every_other) + (b >> 8 & every_other) + (c >> 8 & every_other) + (d >> 8 & every_other) + half;
    return (even >> 2 & every_other) | (odd >> 2 & every_other) << 8;
}

static void halve_row_quick(const struct halving *h, size_t row)
{
    const uint8_t *above = (const uint8_t *)h->from->texels + row * 8 * h->from->width;
    const uint8_t *below = above + (size_t)4 * h->from->width;
    uint8_t *to = (uint8_t *)h->texels + row * 4 * h->to->width;
    for (size_t i = 0; i < h->to->width; i++) {
        const uint32_t mean = mean_of_words(load_word(above + 8 * i), load_word(above + 8 * i + 4),
                                            load_word(below + 8 * i), load_word(below + 8 * i + 4));
        memcpy(to + 4 * i, &mean, sizeof mean);
    }
    if (!h->decoding) return;
    const float *values = h->decoding->values;
    for (size_t i = 0; i < h->to->width; i++, above += 8, below += 8, to += 4)
        for (int k = 0; k < 3; k++) {
            const double light = (double)values[above[k]] + (double)values[above[4 + k]] + (double)values[below[k]] +
                                 (double)values[below[4 + k]];
            to[k] = encode_quick(h->decoding, light / 4.0);
        }
}

/* ---- levels, one after the other ---- */

static bool is_quick(const struct halving *h)
{
    return h->bits == 8 && h->from->width % 2 == 0 && h->from->height % 2 == 0;
}

/* Computes rows of the smaller level. */
static void halve_rows(void *context, size_t begin, size_t end)
{
    const struct halving *h = context;
    if (zr_is_cancelled(h->cancel)) return;
    for (size_t row = begin; row < end; row++) {
        const struct span y = span_of(h->from->height, (uint32_t)row);
        if (is_quick(h)) {
            halve_row_quick(h, row);
            continue;
        }
        for (uint32_t column = 0; column < h->to->width; column++) {
            const struct span x = span_of(h->from->width, column);
            const size_t at = 4 * (row * h->to->width + column);
            for (uint32_t channel = 0; channel < 4; channel++) {
                const uint32_t mean = mean_of(h, &x, &y, channel);
                if (h->bits == 8)
                    ((uint8_t *)h->texels)[at + channel] = (uint8_t)mean;
                else
                    ((uint16_t *)h->texels)[at + channel] = (uint16_t)mean;
            }
        }
    }
}

static bool make_levels(struct making *m, uint32_t bits, const struct decoding *decoding, struct chain *chain)
{
    while (chain->level_count < ZR_TEXTURE_LEVELS_MAX) {
        const struct zr_texture_level *from = &chain->levels[chain->level_count - 1];
        struct zr_texture_level *to = &chain->levels[chain->level_count];
        if (from->width == 1 && from->height == 1) return true;
        *to = (struct zr_texture_level){.width = zr_image_half(from->width), .height = zr_image_half(from->height)};
        void *texels = zr_arena_alloc(m->run->arena, (size_t)to->width * to->height, bits / 2);
        if (!texels) return false;
        to->texels = texels;
        struct halving halving = {from, to, texels, bits, decoding, m->run->cancel};
        zr_team_ranges(m->run->team, to->height, TEXELS_PER_RANGE / to->width + 1, halve_rows, &halving);
        chain->level_count++;
    }
    return true;
}

/* ---- kept levels ---- */

static enum zr_levels_state state_of(const struct decoding *decoding)
{
    return decoding ? ZR_LEVELS_LINEAR : ZR_LEVELS_PLAIN;
}

/* Takes the levels of a kept image. The arena counts them as if they were made. False if they are not there, or
 * without memory. */
static bool take_levels(struct making *m, const struct zr_image *image, const struct decoding *decoding,
                        struct chain *chain)
{
    struct zr_image_levels *kept = image->levels;
    if (!kept || atomic_load_explicit(&kept->state, memory_order_acquire) != (int)state_of(decoding)) return false;
    const unsigned char *at = kept->texels;
    for (struct zr_image level = *image; level.width > 1 || level.height > 1; at += zr_image_bytes(&level)) {
        level.width = zr_image_half(level.width);
        level.height = zr_image_half(level.height);
        zr_arena_alloc(m->run->arena, zr_image_bytes(&level), 1);
        chain->levels[chain->level_count++] = (struct zr_texture_level){level.width, level.height, at};
    }
    return zr_arena_ok(m->run->arena);
}

/* Copies the levels into the room of a kept image, unless another thread has filled it. */
static void keep_levels(const struct making *m, const struct zr_image *image, const struct decoding *decoding,
                        const struct chain *chain)
{
    struct zr_image_levels *kept = image->levels;
    int empty = ZR_LEVELS_EMPTY;
    if (!kept || zr_is_cancelled(m->run->cancel)) return; /* cancelled: not all rows are made */
    if (!atomic_compare_exchange_strong(&kept->state, &empty, ZR_LEVELS_WRITTEN)) return;
    unsigned char *at = kept->texels;
    for (uint32_t i = 1; i < chain->level_count; i++) {
        const size_t bytes = (size_t)chain->levels[i].width * chain->levels[i].height * (image->bits / 2);
        memcpy(at, chain->levels[i].texels, bytes);
        at += bytes;
    }
    atomic_store_explicit(&kept->state, (int)state_of(decoding), memory_order_release);
}

static bool find_levels(struct making *m, const struct zr_image *image, const struct decoding *decoding,
                        struct chain *chain)
{
    if (take_levels(m, image, decoding, chain)) return true;
    if (!zr_arena_ok(m->run->arena)) return false;
    if (!make_levels(m, image->bits, decoding, chain)) return false;
    keep_levels(m, image, decoding, chain);
    return true;
}

/* ---- all ---- */

/* Returns a flag at 1 + the number of each texture: true if a material has it. NULL without memory. */
static const bool *find_used(struct zr_arena *arena, const struct zr_scene *scene)
{
    bool *used = zr_arena_zero(arena, 1 + (size_t)scene->texture_count, sizeof *used);
    for (uint32_t i = 0; used && i < scene->material_count; i++)
        for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
            used[scene->materials[i].textures[slot]] = true;
    return used;
}

static bool has_finish_textures(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].shading == ZR_SHADING_PBR && scene->materials[i].finish.anisotropy > 0.0f) return true;
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int slot = ZR_TEXTURE_COAT; slot < ZR_TEXTURE_SLOTS; slot++)
            if (scene->materials[i].textures[slot]) return true;
    return false;
}

static bool is_see_through(const struct zr_scene *scene, uint32_t texture)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const struct zr_material *material = &scene->materials[i];
        if (material->alpha_mode != ZR_ALPHA_OPAQUE && material->textures[ZR_TEXTURE_BASE_COLOR] == 1 + texture)
            return true;
    }
    return false;
}

/* Returns texels whose four components are the image's alpha. */
static const void *spread_alpha(struct zr_arena *arena, const struct zr_image *image)
{
    const size_t texels = (size_t)image->width * image->height;
    uint8_t *bytes = zr_arena_alloc(arena, texels, image->bits / 2);
    for (size_t i = 0; bytes && i < 4 * texels; i++) {
        const uint32_t alpha = value_of(image->texels, image->bits, i / 4 * 4 + 3);
        if (image->bits == 8)
            bytes[i] = (uint8_t)alpha;
        else
            ((uint16_t *)(void *)bytes)[i] = (uint16_t)alpha;
    }
    return bytes;
}

static bool make_opacity(struct making *m, const struct zr_texture *texture, struct zr_texture_map *map)
{
    const struct zr_image *image = &m->scene->images[texture->image];
    struct chain chain = {.level_count = 1};
    chain.levels[0] = (struct zr_texture_level){image->width, image->height, spread_alpha(m->run->arena, image)};
    if (!chain.levels[0].texels) return false;
    if (zr_filter_has_levels(texture->minify) && !make_levels(m, image->bits, NULL, &chain)) return false;
    *map = (struct zr_texture_map){.texture = texture, .bits = image->bits, .level_count = chain.level_count};
    memcpy(map->levels, chain.levels, sizeof map->levels);
    return true;
}

static bool make_map(struct making *m, const struct zr_texture *texture, struct zr_texture_map *map)
{
    const struct zr_image *image = &m->scene->images[texture->image];
    const bool decodes = m->decode && texture->is_color;
    const struct decoding *decoding = decodes ? find_decoding(m, image->bits) : NULL;
    struct chain *chain = &m->chains[2 * (size_t)texture->image + decodes];
    if (decodes && !decoding) return false;
    if (chain->level_count == 0) {
        chain->levels[0] = (struct zr_texture_level){image->width, image->height, image->texels};
        chain->level_count = 1;
    }
    const bool wants_levels = zr_filter_has_levels(texture->minify);
    if (wants_levels && chain->level_count == 1 && !find_levels(m, image, decoding, chain)) return false;
    *map = (struct zr_texture_map){.texture = texture,
                                   .bits = image->bits,
                                   .decoded = decoding ? decoding->values : NULL,
                                   .level_count = wants_levels ? chain->level_count : 1};
    for (uint32_t i = 0; i < map->level_count; i++)
        map->levels[i] = chain->levels[i];
    return true;
}

/* ---- places ---- */

/* Number of places that textures may share. */
enum { PLACES = 16 };

static bool are_alike(const struct zr_texture_map *a, const struct zr_texture_map *b)
{
    const struct zr_texture *s = a->texture, *t = b->texture;
    return s->texcoord == t->texcoord && s->wrap_s == t->wrap_s && s->wrap_t == t->wrap_t && s->magnify == t->magnify &&
           s->minify == t->minify && memcmp(s->rows, t->rows, sizeof s->rows) == 0 &&
           a->levels[0].width == b->levels[0].width && a->levels[0].height == b->levels[0].height;
}

/* Numbers the places of maps. Maps beyond the first PLACES places share none. */
static void find_places(struct zr_texture_map *maps, uint32_t count)
{
    uint32_t places[PLACES], found = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!maps[i].texture) continue;
        uint32_t k = 0;
        while (k < found && !are_alike(&maps[places[k]], &maps[i]))
            k++;
        maps[i].place = k < found ? places[k] : i;
        if (k == found && found < PLACES) places[found++] = i;
    }
}

enum zr_status zr_texture_maps_make(const struct zr_run *run, const struct zr_scene *scene, bool decode,
                                    struct zr_texture_maps *maps)
{
    struct making m = {.run = run, .scene = scene, .decode = decode};
    *maps = (struct zr_texture_maps){NULL, NULL, false};
    const bool of_finishes = has_finish_textures(scene);
    if (scene->texture_count == 0 && !of_finishes) return ZR_OK;
    if (scene->texture_count == 0) {
        *maps = (struct zr_texture_maps){zr_arena_zero(run->arena, 1, sizeof *maps->of), NULL, true};
        return maps->of ? ZR_OK : ZR_NO_MEMORY;
    }
    struct zr_texture_map *of = zr_arena_zero(run->arena, scene->texture_count, sizeof *of);
    struct zr_texture_map *opacity = zr_arena_zero(run->arena, scene->texture_count, sizeof *opacity);
    m.chains = zr_arena_zero(run->arena, 2 * (size_t)scene->image_count, sizeof *m.chains);
    const bool *used = find_used(run->arena, scene);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        if (!used[1 + i]) continue;
        if (!make_map(&m, &scene->textures[i], &of[i])) return ZR_NO_MEMORY;
        if (is_see_through(scene, i) && !make_opacity(&m, &scene->textures[i], &opacity[i])) return ZR_NO_MEMORY;
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    }
    find_places(of, scene->texture_count);
    *maps = (struct zr_texture_maps){of, opacity, of_finishes};
    return ZR_OK;
}

struct zr_texture_maps_size zr_texture_maps_measure(const struct zr_scene *scene, bool decode)
{
    struct zr_texture_maps_size sum = {0.0, 0.0};
    bool has_tables[2] = {false, false};
    if (scene->texture_count > 0)
        sum.bytes +=
            2.0 * (double)scene->image_count * (double)sizeof(struct chain) + (double)scene->texture_count + 1.0;
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        const struct zr_texture *texture = &scene->textures[i];
        const struct zr_image *image = &scene->images[texture->image];
        sum.bytes += 2.0 * (double)sizeof(struct zr_texture_map);
        if (is_see_through(scene, i)) {
            const double spread = (double)image->width * (double)image->height * 4.0 / 3.0;
            sum.texels += spread;
            sum.bytes += spread * (double)image->bits / 2.0;
        }
        if (decode && texture->is_color && !has_tables[image->bits == 16]) {
            has_tables[image->bits == 16] = true;
            sum.bytes += 4.0 * sizeof(float) * (double)((size_t)1 << image->bits);
        }
        if (!zr_filter_has_levels(texture->minify)) continue;
        bool is_made = false; /* for an earlier texture */
        for (uint32_t k = 0; k < i && !is_made; k++) {
            const struct zr_texture *other = &scene->textures[k];
            is_made = other->image == texture->image && zr_filter_has_levels(other->minify) &&
                      (!decode || other->is_color == texture->is_color);
        }
        /* A level has at most half the texels of the one before, and usually a quarter. */
        const double texels = (double)image->width * (double)image->height;
        const double made = image->width == 1 || image->height == 1 ? texels : texels / 3.0;
        if (is_made) continue;
        sum.texels += made;
        sum.bytes += made * (double)image->bits / 2.0;
    }
    return sum;
}
