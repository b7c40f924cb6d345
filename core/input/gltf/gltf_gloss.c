/* Converts KHR_materials_pbrSpecularGlossiness to metallic-roughness. Textures are converted texel by texel to two
 * images of 8 bits per channel. */
#include <math.h>
#include <string.h>

#include "base/srgb.h"
#include "input/gltf/gltf_extensions.h"
#include "input/images/image_read.h"

enum { MADE_MAX = 64, ROWS_AT_ONCE = 4, TEXELS_AT_ONCE = 256, LAST = 255 };

/* ---- the conversion ---- */

static double within(double value)
{
    return value > 0.0 ? value < 1.0 ? value : 1.0 : 0.0;
}

static double brightness(const double *color)
{
    return sqrt(0.299 * color[0] * color[0] + 0.587 * color[1] * color[1] + 0.114 * color[2] * color[2]);
}

/* Returns the metalness that gives the same reflection: the root of a quadratic equation. `diffuse` and `specular` are
 * brightnesses; `rest` is 1 minus the largest component of the specular colour. */
static double find_metallic(double diffuse, double specular, double rest)
{
    if (specular < ZR_GLTF_PLASTIC) return 0.0;
    const double a = ZR_GLTF_PLASTIC, b = diffuse * rest / (1.0 - ZR_GLTF_PLASTIC) + specular - 2.0 * ZR_GLTF_PLASTIC,
                 c = ZR_GLTF_PLASTIC - specular;
    const double d = b * b - 4.0 * a * c;
    return within((-b + sqrt(d > 0.0 ? d : 0.0)) / (2.0 * a));
}

void zr_gltf_convert_glossiness(const double diffuse[3], const double specular[3], struct zr_gltf_glossiness *out)
{
    const double least = 1e-6, most = fmax(specular[0], fmax(specular[1], specular[2])), rest = 1.0 - most,
                 metallic = find_metallic(brightness(diffuse), brightness(specular), rest),
                 plastic = fmax(1.0 - metallic, least), metal = fmax(metallic, least);
    for (int k = 0; k < 3; k++) {
        const double of_diffuse = diffuse[k] * rest / (1.0 - ZR_GLTF_PLASTIC) / plastic,
                     of_specular = (specular[k] - ZR_GLTF_PLASTIC * (1.0 - metallic)) / metal;
        out->color[k] = (float)within(of_diffuse + (of_specular - of_diffuse) * metallic * metallic);
    }
    out->metallic = (float)metallic;
}

/* ---- images ---- */

struct baking {
    const struct zr_gltf_gloss *factors;
    const struct zr_image *diffuse, *specular; /* diffuse may be NULL, which is white */
    const struct zr_cancel *cancel;
    enum zr_isa isa;
    uint32_t width, height;
    uint8_t *color, *rough;    /* RGBA */
    float ramp[LAST + 1 + 16]; /* linear light of sRGB bytes */
};

/* Scales a coordinate from one size to another. */
static size_t scale(uint32_t at, uint32_t from, uint32_t to)
{
    return from == to ? at : (size_t)((uint64_t)at * to / from);
}

/* Reads the texel of `from` at texel (x, y) of the result, with linear RGB. Texels of a smaller image are repeated.
 * NULL is white. */
static void read_texel(const struct baking *b, const struct zr_image *from, uint32_t x, uint32_t y, double out[4])
{
    const size_t column = from ? scale(x, b->width, from->width) : 0,
                 row = from ? scale(y, b->height, from->height) : 0;
    for (uint32_t k = 0; k < 4; k++) {
        const uint32_t value = from ? zr_image_texel(from, column, row, k) >> 8 : LAST;
        out[k] = k < 3 ? (double)b->ramp[value] : value / (double)LAST;
    }
}

static uint8_t byte_of(double value)
{
    return (uint8_t)(value * LAST + 0.5);
}

static void bake_texels(const struct baking *b, uint32_t y, uint32_t first, uint32_t count)
{
    float linear[3 * TEXELS_AT_ONCE + ZR_SRGB_EXCESS] = {0}, encoded[3 * TEXELS_AT_ONCE + ZR_SRGB_EXCESS];
    uint8_t *color = b->color + 4 * ((size_t)y * b->width + first),
            *rough = b->rough + 4 * ((size_t)y * b->width + first);
    for (uint32_t i = 0; i < count; i++) {
        struct zr_gltf_glossiness found;
        double diffuse[4], specular[4];
        read_texel(b, b->diffuse, first + i, y, diffuse);
        read_texel(b, b->specular, first + i, y, specular);
        for (int k = 0; k < 3; k++) {
            diffuse[k] *= b->factors->diffuse[k];
            specular[k] *= b->factors->specular[k];
        }
        zr_gltf_convert_glossiness(diffuse, specular, &found);
        memcpy(linear + 3 * (size_t)i, found.color, 3 * sizeof *linear);
        color[4 * i + 3] = byte_of(diffuse[3]);
        rough[4 * i] = 0;
        rough[4 * i + 1] = byte_of(1.0 - specular[3] * b->factors->glossiness);
        rough[4 * i + 2] = byte_of((double)found.metallic);
        rough[4 * i + 3] = LAST;
    }
    zr_srgb_encode_of(b->isa)(linear, 3 * (size_t)count, encoded);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++)
            color[4 * i + k] = byte_of((double)encoded[3 * i + k]);
}

static void bake_rows(void *context, size_t begin, size_t end)
{
    const struct baking *b = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < b->width; x += TEXELS_AT_ONCE) {
            const uint32_t left = b->width - x;
            if (zr_is_cancelled(b->cancel)) return;
            bake_texels(b, (uint32_t)y, x, left < TEXELS_AT_ONCE ? left : TEXELS_AT_ONCE);
        }
}

static uint32_t add_image(struct zr_gltf *file, const struct baking *b, const uint8_t *texels)
{
    const struct zr_image image = {b->width, b->height, 8, texels, NULL};
    return zr_scene_builder_image(file->builder, &image);
}

/* Makes both images. False beyond the limit of texels, without memory, or if cancelled. */
static bool make(struct zr_gltf *file, struct zr_gltf_baked *made)
{
    const struct zr_json *json = &file->json;
    const struct zr_image *images = file->builder->scene->images;
    struct baking b = {.factors = &made->factors,
                       .diffuse = made->has_diffuse ? &images[made->diffuse] : NULL,
                       .specular = &images[made->specular],
                       .cancel = json->cancel,
                       .isa = zr_team_isa(json->team)};
    const struct zr_image *size = b.specular;
    if (b.diffuse && (uint64_t)b.diffuse->width * b.diffuse->height > (uint64_t)size->width * size->height)
        size = b.diffuse;
    b.width = size->width;
    b.height = size->height;
    const uint64_t pixels = (uint64_t)b.width * b.height;
    const enum zr_status status = zr_image_list_count(&file->decoded, 2 * pixels);
    if (status == ZR_CANCELLED) zr_error_add(json->error, ZR_CANCELLED, NULL, "reading was stopped");
    if (status != ZR_OK) return false;
    b.color = zr_arena_alloc(json->arena, (size_t)pixels, 4);
    b.rough = zr_arena_alloc(json->arena, (size_t)pixels, 4);
    if (!zr_arena_ok(json->arena)) return false;
    zr_srgb_ramp_of(b.isa)(LAST, b.ramp);
    zr_team_ranges(json->team, b.height, ROWS_AT_ONCE, bake_rows, &b);
    made->color = add_image(file, &b, b.color);
    made->rough = add_image(file, &b, b.rough);
    return zr_arena_ok(json->arena) && !zr_is_cancelled(json->cancel);
}

static bool is_same(const struct zr_gltf_baked *a, const struct zr_gltf_baked *b)
{
    return a->specular == b->specular && a->has_diffuse == b->has_diffuse && a->diffuse == b->diffuse &&
           memcmp(&a->factors, &b->factors, sizeof a->factors) == 0;
}

const struct zr_gltf_baked *zr_gltf_bake_glossiness(struct zr_gltf *file, const struct zr_gltf_gloss *factors,
                                                    const uint32_t *diffuse, uint32_t specular)
{
    struct zr_gltf_baked made = {
        .factors = *factors, .has_diffuse = diffuse != NULL, .diffuse = diffuse ? *diffuse : 0, .specular = specular};
    if (!file->baked) file->baked = zr_arena_alloc(file->json.arena, MADE_MAX, sizeof *file->baked);
    if (!file->baked) return NULL;
    for (uint32_t i = 0; i < file->baked_count; i++)
        if (is_same(&file->baked[i], &made)) return &file->baked[i];
    if (file->baked_count == MADE_MAX || !make(file, &made)) return NULL;
    file->baked[file->baked_count] = made;
    return &file->baked[file->baked_count++];
}
