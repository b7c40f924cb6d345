/* pixel_fragments.h - render: all fragments of one pixel: the channel fragments, which picking reads.
 *
 * Draws the pixel's tile with every surface transparent (layer_pass.h). A fragment is `is_shown` if it contributes to
 * the pixel: the visible opaque or masked one, whose windowDepth and faceId the frame has, and blended ones in front of
 * it. */
#ifndef ZR_PIXEL_FRAGMENTS_H
#define ZR_PIXEL_FRAGMENTS_H

#include "base/run.h"
#include "base/team.h"
#include "render/layer_pass.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Finds the fragments of pixel x, y of the window and writes frame->fragments, allocated in `arena`; the rest goes to
 * `scratch`, which may be the same. The frame has its windowDepth and faceId. Returns ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY
 * or ZR_INTERNAL. */
enum zr_status zr_pixel_fragments_find(const struct zr_run *run, const struct zr_scene *scene, uint32_t x, uint32_t y,
                                       struct zr_frame *frame);

/* The scene and the room for fragments of several pixels. */
struct zr_fragment_source {
    const struct zr_scene *scene; /* the original one */
    struct zr_layer_pass *pass;
    struct zr_tile *tile;
};

/* Makes a source in run->arena for zr_fragments_list. Fails as zr_pixel_fragments_find does. */
enum zr_status zr_fragment_source_make(const struct zr_run *run, const struct zr_scene *scene, enum zr_layer_kind kind,
                                       const struct zr_frame *frame, struct zr_fragment_source *out);

/* Lists the fragments of pixel x, y in the arena. Fails likewise. */
enum zr_status zr_fragments_list(const struct zr_run *run, const struct zr_fragment_source *source, uint32_t x,
                                 uint32_t y, const struct zr_frame *frame, struct zr_pixel_fragments *out);

#endif
