/* layers.h - render: what see-through primitives show in a tile, a layer at a time.
 *
 * The fragments of each pixel are sorted (raster/fragments.h); layer k has the k-th of every pixel that has so many. A
 * layer is a tile like any other, and is shaded as opaque ones are, so every model, attribute and channel works here.
 * Masked surfaces come first: the nearest fragment whose opacity reaches the cutoff belongs to the tile from then on,
 * as an opaque one's would. Then what is blended is laid over that, from the farthest to the nearest.
 * Exact:  blending is GL's, in floats: color * opacity + behind * (1 - opacity), each operation rounded.
 */
#ifndef ZR_LAYERS_H
#define ZR_LAYERS_H

#include "render/tile_source.h"
#include "shade/paint.h"

enum { ZR_LAYER_FLOATS = ZR_TILE_STRIDE * ZR_TILE_SIZE };

/* What one thread works with, on one tile. */
struct zr_layers {
    struct zr_layers *next; /* in the pool */
    struct zr_fragments fragments;
    uint32_t most; /* fragments that a pixel of the tile has */
    struct zr_tile tile;
    _Alignas(64) float front[4][ZR_LAYER_FLOATS], sum[4][ZR_LAYER_FLOATS];
};

/* Room for as many threads as work at once, in the request's arena. */
struct zr_layers_pool {
    struct zr_arena *arena;
    pthread_mutex_t lock; /* of all that follows, and of the arena meanwhile */
    struct zr_layers *free;
    uint64_t masked_tiles; /* see geometry/counts.h */
};

/* NULL where there is no memory: the arena has failed then. */
struct zr_layers *zr_layers_take(struct zr_layers_pool *pool);
void zr_layers_give(struct zr_layers_pool *pool, struct zr_layers *layers);

/* Gives the tile, as opaque primitives left it, what masked ones show. All of it is written then where anything
 * see-through may be over it. False where it was cancelled or there is no memory. */
bool zr_layers_mask(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                    struct zr_tile *tile);

/* Finds what is blended over a tile that zr_tile_find_visible gave: into layers->fragments and layers->most. */
bool zr_layers_find(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode,
                    const struct zr_cancel *cancel, struct zr_tile *tile, struct zr_layers *layers);

/* The layer with `depth` others behind it, to layers->tile. */
void zr_layers_show(struct zr_layers *layers, uint32_t depth);

/* Whether anything may be blended over tile `number`. */
bool zr_layers_has_blended(const struct zr_tile_source *tiles, uint32_t number);

/* Finds what is to be over the colours of a tile, before its depths are used up: *blended is NULL where nothing is.
 * summed: blends it by the textbook, too. False as above. */
bool zr_layers_blend(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                     struct zr_tile *tile, bool summed, struct zr_layers **blended);

/* Writes the tile's colours, with that over them, and gives it back. No base may be behind. Returns how many pixels
 * show nothing but what is blended. */
uint32_t zr_layers_put(const struct zr_tile_source *tiles, struct zr_layers *blended, const struct zr_tile *tile,
                       const struct zr_pixel_rows *out);

#endif
