#include "output/palette.h"

#include <stdlib.h>
#include <string.h>

enum { SLOT_BITS = 11, SLOTS = 1 << SLOT_BITS, SAMPLES = 4096 };

/* Colours as they are in memory; open addressing, an eighth full at most. */
struct set {
    uint32_t colors[SLOTS];
    uint16_t numbers[SLOTS]; /* from 1 on; 0: free */
    uint16_t count;
    uint32_t kept; /* bits of a pixel that count */
    uint32_t made; /* bits that are set in any case */
};

static inline uint32_t color_at(const struct set *set, const uint8_t *pixel)
{
    uint32_t color;
    memcpy(&color, pixel, sizeof color);
    return (color & set->kept) | set->made;
}

static inline uint32_t slot_of(const struct set *set, uint32_t color)
{
    uint32_t slot = color * 2654435761u >> (32 - SLOT_BITS);
    while (set->numbers[slot] && set->colors[slot] != color)
        slot = (slot + 1) % SLOTS;
    return slot;
}

/* False where it is one too many. */
static inline bool add(struct set *set, uint32_t color)
{
    uint32_t slot = slot_of(set, color);
    if (set->numbers[slot]) return true;
    if (set->count == ZR_PALETTE_MAX) return false;
    set->colors[slot] = color;
    set->numbers[slot] = ++set->count;
    return true;
}

static void set_init(struct set *set, bool opaque)
{
    static const uint8_t alpha[4] = {0, 0, 0, 255};
    memset(set, 0, sizeof *set);
    memcpy(&set->made, alpha, sizeof alpha);
    set->kept = opaque ? ~set->made : UINT32_MAX;
    set->made = opaque ? set->made : 0;
}

/* A few pixels from everywhere: a shaded picture is known by them, and costs 0.02 ms. */
static bool sample(struct set *set, const uint8_t *pixels, size_t count)
{
    size_t step = count / SAMPLES | 1;
    for (size_t i = 0; i < count; i += step)
        if (!add(set, color_at(set, pixels + 4 * i))) return false;
    return true;
}

static bool collect(struct set *set, const uint8_t *pixels, uint32_t width, uint32_t height)
{
    const size_t stride = (size_t)width * 4;
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t *row = pixels + y * stride;
        if (y > 0 && memcmp(row, row - stride, stride) == 0) continue;
        uint32_t last = ~color_at(set, row);
        for (uint32_t x = 0; x < width; x++) {
            uint32_t color = color_at(set, row + 4 * (size_t)x);
            if (color != last && !add(set, color)) return false;
            last = color;
        }
    }
    return true;
}

static int by_alpha_and_light(const void *left, const void *right)
{
    const uint8_t *a = left, *b = right;
    if ((a[3] < 255) != (b[3] < 255)) return a[3] < 255 ? -1 : 1;
    int light = 2 * a[0] + 5 * a[1] + a[2] - (2 * b[0] + 5 * b[1] + b[2]);
    return light ? light : memcmp(a, b, 4);
}

/* The palette in its order, and each colour's number in it, from 1 on. */
static void put_in_order(struct set *set, struct zr_palette *palette)
{
    palette->count = palette->transparent = 0;
    for (size_t i = 0; i < SLOTS; i++)
        if (set->numbers[i]) memcpy(palette->colors[palette->count++], &set->colors[i], 4);
    qsort(palette->colors, palette->count, 4, by_alpha_and_light);
    for (uint32_t i = 0; i < palette->count; i++) {
        uint32_t color;
        memcpy(&color, palette->colors[i], 4);
        set->numbers[slot_of(set, color)] = (uint16_t)(i + 1);
        palette->transparent += palette->colors[i][3] < 255;
    }
}

static void map(const struct set *set, const uint8_t *pixels, uint32_t width, uint32_t height, uint8_t *indices)
{
    const size_t stride = (size_t)width * 4;
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t *row = pixels + y * stride;
        uint8_t *out = indices + (size_t)y * width, index = 0;
        if (y > 0 && memcmp(row, row - stride, stride) == 0) {
            memcpy(out, out - width, width);
            continue;
        }
        uint32_t last = ~color_at(set, row);
        for (uint32_t x = 0; x < width; x++) {
            uint32_t color = color_at(set, row + 4 * (size_t)x);
            if (color != last) index = (uint8_t)(set->numbers[slot_of(set, color)] - 1);
            out[x] = index;
            last = color;
        }
    }
}

bool zr_palette_make(struct zr_palette *palette, struct zr_arena *arena, const uint8_t *pixels, uint32_t width,
                     uint32_t height, bool opaque)
{
    struct set set;
    set_init(&set, opaque);
    if (!sample(&set, pixels, (size_t)width * height) || !collect(&set, pixels, width, height)) return false;
    palette->indices = zr_arena_alloc(arena, (size_t)width * height, 1);
    if (!palette->indices) return false;
    put_in_order(&set, palette);
    map(&set, pixels, width, height, palette->indices);
    return true;
}
