/* layer_surfaces.h - render: blended primitives of a tile with 16 samples per pixel, each lit once in each pixel.
 *
 * A surface is the part of a pixel that a primitive covers: a mask of samples. It is lit at their middle, without
 * occlusion.
 * X-rays and glass change their opacity quickly at grazing angles. An opacity above 0.35 is the mean over the samples,
 * of which those in a quarter of the pixel have the opacity of one. Surfaces of a pixel are ordered by the depths of
 * their samples nearest to its middle. At equal depth, the earlier primitive is in front. Each is laid over its
 * samples, from the farthest to the nearest. If two cross within a pixel of at most 64 surfaces, by more than 1e-6 of
 * depth, each sample has an order of its own.
 * Exact:  + - * / in one order: every instruction set and thread count gives the same bytes.
 * Source: Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", 1984.
 */
#ifndef ZR_LAYER_SURFACES_H
#define ZR_LAYER_SURFACES_H

#include "base/cancel.h"
#include "base/isa.h"
#include "effects/surfaces.h"
#include "render/layers/layers.h"
#include "shade/lights/lighting.h"

struct zr_layer_surface {
    uint32_t owner;
    uint16_t pixel; /* row * ZR_SURFACES_COLUMNS + column in the tile */
    uint16_t mask;  /* sample i, of column i % 4 and row i / 4, is bit i */
    float depth;    /* of the sample nearest to the middle of the pixel */
    float color[4]; /* linear light, and opacity */
    float near, far, depths[ZR_SURFACES_SIDE * ZR_SURFACES_SIDE]; /* least and largest; of the samples of the mask */
};

/* Surfaces of a tile, in the order of their primitives. */
struct zr_layer_surfaces {
    struct zr_layer_surfaces *next; /* in the pool */
    uint32_t count, room;
    struct zr_layer_surface *at, *spare;    /* spare: NULL until it is needed */
    uint64_t *order;                        /* surface in the lower half; those of a pixel from the nearest on */
    uint32_t first[ZR_SURFACES_PIXELS + 1]; /* of a pixel, in `order` */
};

/* Light of surfaces, and rules of opacity. */
struct zr_layer_light {
    const struct zr_tile_source *tiles;
    const struct zr_linear_lighting *lighting;
    bool has_xrays;    /* or glass */
    bool leaves_glass; /* makes surfaces transparent that are of glass which refracts, or in front of one */
};

/* Lists the blended surfaces of a tile in front of its samples. *out is from the pool of `tiles`, and NULL if there are
 * none. Returns false if cancelled or out of memory. */
bool zr_layer_surfaces_find(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                            struct zr_tile *tile, struct zr_layer_surfaces **out);

/* Lights and orders them. `list`, `room`: working memory. If cancelled, some are neither. */
void zr_layer_surfaces_light(const struct zr_layer_light *light, const struct zr_tile *tile,
                             const struct zr_cancel *cancel, struct zr_surfaces *list, struct zr_sample_room *room,
                             struct zr_layer_surfaces *surfaces);

void zr_layer_surfaces_give(const struct zr_tile_source *tiles, struct zr_layer_surfaces *surfaces);

/* Lists the middles of `count` surfaces, in samples of the window. A kernel. */
typedef void zr_layer_surfaces_list_fn(const struct zr_layer_surface *at, uint32_t count, const struct zr_tile *tile,
                                       struct zr_sample_list *list);

/* Blends the surfaces of a pixel of the tile over its samples. out[0..2]: their mean times opacity, out[3]: opacity.
 * `color`: of the tile's samples, in rows of ZR_TILE_STRIDE, or NULL if the tile shows nothing else. Returns how many
 * samples only the surfaces cover. A kernel. */
typedef uint32_t zr_layer_surfaces_blend_fn(const struct zr_layer_surfaces *surfaces, const struct zr_tile *tile,
                                            uint32_t pixel, const float *const color[3], float out[4]);

ZR_KERNEL_TABLE(zr_layer_surfaces_list_fn, zr_layer_surfaces_list)
ZR_KERNEL_TABLE(zr_layer_surfaces_blend_fn, zr_layer_surfaces_blend)

#endif
