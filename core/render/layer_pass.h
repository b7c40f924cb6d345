/* layer_pass.h - render: the scene drawn as if everything were see-through: all that lies over a pixel is kept
 * (raster/fragments.h), hidden ones too.
 *
 * What opacity masks is not looked at: a masked surface is there wherever it covers a pixel's centre.
 */
#ifndef ZR_LAYER_PASS_H
#define ZR_LAYER_PASS_H

#include "render/pass.h"
#include "shade/frame.h"

struct zr_layer_pass {
    struct zr_pass pass;
    struct zr_scene scene; /* the one that was given, with materials of its own, one for each, in their order */
};

/* solid: faces alone, filled, and from both sides. pass.tiles.layers is NULL where nothing is drawn. ZR_OK,
 * ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. *out points into the arena, to the scene and into itself. */
enum zr_status zr_layer_pass_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  bool solid, const struct zr_frame *frame, const struct zr_cancel *cancel,
                                  struct zr_layer_pass *out);

/* What lies over a tile, to be given back to pass->tiles.layers; `tile` is used up. NULL where it was cancelled or
 * there is no memory. Any thread. */
struct zr_layers *zr_layer_pass_find(const struct zr_layer_pass *pass, uint32_t number, const struct zr_cancel *cancel,
                                     struct zr_tile *tile);

#endif
