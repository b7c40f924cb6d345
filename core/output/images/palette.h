/* palette.h - output: the palette of a picture with at most 256 colours.
 *
 * Dark colours precede light ones: neighbours on a shaded surface then have neighbouring indices, whose differences are
 * small (bunny, flat: 184 KB; in order of appearance 210). Colours that a sample of a few thousand pixels misses come
 * last, so that the indices are known before the pixels are mapped. */
#ifndef ZR_PALETTE_H
#define ZR_PALETTE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/column_span.h"

enum { ZR_PALETTE_MAX = 256 };

struct zr_palette {
    uint32_t count, transparent;       /* colours; number of leading colours that include all non-opaque ones */
    uint8_t colors[ZR_PALETTE_MAX][4]; /* RGBA */
    uint8_t *indices;                  /* one per pixel */
};

/* Makes the palette of RGBA pixels; with `opaque`, alpha counts as 255. `spans` as in zr_png, or NULL. Returns false
 * if there are more than ZR_PALETTE_MAX colours, which a few thousand pixels show for most pictures, or if the arena
 * failed. */
bool zr_palette_make(struct zr_palette *palette, struct zr_arena *arena, const uint8_t *pixels, uint32_t width,
                     uint32_t height, const struct zr_column_span *spans, bool opaque);

/* Returns the number of colours, or ZR_PALETTE_MAX + 1 if there are more. */
uint32_t zr_palette_count(const uint8_t *pixels, size_t count, bool opaque);

#endif
