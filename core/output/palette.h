/* palette.h - output: the colours of a picture, where there are few of them.
 *
 * Dark colours come before light ones: neighbours on a shaded surface have neighbouring indices then, whose differences
 * are small (bunny, flat: 184 KB, and 210 in the order of their appearance). Those that a few thousand pixels from all
 * over the picture do not show come last, so that indices are known when pixels are first seen.
 */
#ifndef ZR_PALETTE_H
#define ZR_PALETTE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/column_span.h"

enum { ZR_PALETTE_MAX = 256 };

struct zr_palette {
    uint32_t count, transparent;       /* colours; how many of them are not opaque */
    uint8_t colors[ZR_PALETTE_MAX][4]; /* RGBA */
    uint8_t *indices;                  /* one a pixel */
};

/* Of RGBA pixels, whose alpha counts as 255 if `opaque`; `reaches` as in zr_png, or NULL. False, after a look at a few
 * thousand pixels for most pictures, where there are more than ZR_PALETTE_MAX colours, or the arena has failed. */
bool zr_palette_make(struct zr_palette *palette, struct zr_arena *arena, const uint8_t *pixels, uint32_t width,
                     uint32_t height, const struct zr_column_span *reaches, bool opaque);

/* How many colours; ZR_PALETTE_MAX + 1: more than ZR_PALETTE_MAX. */
uint32_t zr_palette_count(const uint8_t *pixels, size_t count, bool opaque);

#endif
