/* layers.h - render: masked and blended primitives of a tile, one layer at a time.
 *
 * The fragments of each pixel are sorted (raster/fragments.h). Layer k holds the k-th fragment of every pixel that has
 * so many. A layer is a tile and is shaded like one, so every model, attribute and channel works.
 * Masked surfaces come first: the nearest fragment whose opacity is at least the cutoff replaces the tile's sample, as
 * an opaque one would. Blended layers are then laid over it, from the farthest to the nearest.
 * Exact:  blending is GL's, in floats: color * opacity + behind * (1 - opacity), each operation rounded.
 */
#ifndef ZR_LAYERS_H
#define ZR_LAYERS_H

#include "base/rgba.h"
#include "render/layers/tile_source.h"
#include "shade/paint.h"

enum { ZR_LAYER_FLOATS = ZR_TILE_STRIDE * ZR_TILE_SIZE };

/* Working memory of one thread for one tile. */
struct zr_layers {
    struct zr_layers *next; /* in the pool */
    struct zr_fragments fragments;
    uint32_t most;              /* largest number of fragments in any pixel of the tile */
    struct zr_solid_walk *walk; /* solid_walk.h; NULL: not made yet */
    struct zr_tile tile;
    _Alignas(64) float front[4][ZR_LAYER_FLOATS], sum[4][ZR_LAYER_FLOATS];
};

/* Pool of working memory, allocated in the request's arena: one for each thread at work. */
struct zr_layers_pool {
    struct zr_arena *arena;
    pthread_mutex_t lock; /* guards the arena and the members below */
    struct zr_layers *free;
    struct zr_layer_surfaces *free_surfaces; /* layer_surfaces.h */
    uint64_t masked_tiles;                   /* zr_counts.masked_tiles */
};

/* Takes working memory from the pool. Returns NULL if out of memory; the arena has failed then. */
struct zr_layers *zr_layers_take(struct zr_layers_pool *pool);
void zr_layers_give(struct zr_layers_pool *pool, struct zr_layers *layers);

/* Writes all samples of a tile: blocks that are unwritten, or uncovered samples if it is empty. */
void zr_layers_write_all(const struct zr_tile_source *tiles, struct zr_tile *tile);

/* Adds masked surfaces to a tile of opaque ones. Writes all samples of the tile if masked or blended fragments may
 * cover it. Returns false if cancelled or out of memory. */
bool zr_layers_mask(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                    struct zr_tile *tile);

/* Lists the fragments of `mode` in a tile from zr_tile_find_visible, sorted: those in front of its samples, and blended
 * ones of equal depth, such as decals. Sets layers->most. Returns false if cancelled or out of memory. */
bool zr_layers_find(const struct zr_tile_source *tiles, uint32_t number, enum zr_alpha_mode mode,
                    const struct zr_cancel *cancel, struct zr_tile *tile, struct zr_layers *layers);

/* Puts the blended fragments in front of a tile's samples, and those of equal depth. Returns false if cancelled. */
bool zr_layers_put_blended(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                           struct zr_tile *tile, struct zr_fragments *fragments);

/* Writes layer `depth` to layers->tile. Layer 0 holds the farthest fragment of each pixel. */
void zr_layers_show(struct zr_layers *layers, uint32_t depth);

/* Returns true if blended fragments may cover tile `number`. */
bool zr_layers_has_blended(const struct zr_tile_source *tiles, uint32_t number);

/* Lists the blended fragments of a tile; call it before the tile's depths are overwritten. *blended is NULL if there
 * are none. `summed`: also blends their colours. Returns false if cancelled or out of memory. */
bool zr_layers_blend(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                     struct zr_tile *tile, bool summed, struct zr_layers **blended);

/* Writes the tile's blended colours and returns `blended` to the pool. The frame has no base. Returns the number of
 * pixels that only blended fragments cover. */
uint32_t zr_layers_put(const struct zr_tile_source *tiles, struct zr_layers *blended, const struct zr_tile *tile,
                       const struct zr_pixel_rows *out);

/* Compares an opacity with the cutoff as GL does in 8-bit RGBA: both are rounded first. */
static inline bool zr_passes_cutoff(const struct zr_material *material, float opacity)
{
    return zr_rgba_byte(opacity) >= zr_rgba_byte(material->alpha_cutoff);
}

#endif
