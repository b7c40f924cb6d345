/* layer_pass.h - render: the scene with all surfaces transparent, so that every fragment is kept (raster/fragments.h),
 * hidden ones included.
 *
 * Alpha masks are ignored: a masked surface has a fragment wherever it covers a pixel's centre.
 */
#ifndef ZR_LAYER_PASS_H
#define ZR_LAYER_PASS_H

#include "base/run.h"
#include "render/pass.h"
#include "shade/frame.h"

struct zr_layer_pass {
    struct zr_pass pass;
    struct zr_scene scene; /* the given scene with edited copies of its materials, in the same order */
};

enum zr_layer_kind {
    ZR_LAYERS_AS_DRAWN,   /* without culled faces */
    ZR_LAYERS_BOTH_SIDES, /* with culled faces */
    ZR_LAYERS_SOLID       /* faces only, filled and from both sides */
};

/* Makes the pass. pass.tiles.layers is NULL if nothing is drawn.
 * Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY or ZR_INTERNAL. *out points into the arena, to the scene and into
 * itself. */
enum zr_status zr_layer_pass_make(const struct zr_run *run, const struct zr_scene *scene, enum zr_layer_kind kind,
                                  const struct zr_frame *frame, struct zr_layer_pass *out);

/* Lists the fragments of a tile. The caller returns them to pass->tiles.layers. Overwrites `tile`. Returns NULL if
 * cancelled or out of memory. Any thread may call it. */
struct zr_layers *zr_layer_pass_find(const struct zr_layer_pass *pass, uint32_t number, const struct zr_cancel *cancel,
                                     struct zr_tile *tile);

#endif
