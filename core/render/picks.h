/* picks.h - render: the surfaces at picked pixels (zr_view.picks), for the channel info.
 *
 * Pick:   the surface that the channel faceId has at the pixel's centre; if it has none, the nearest translucent one.
 *         Surfaces behind it are listed, those in front of it, which are translucent, are not.
 * Solids: of combined solids (scene/csg.h), only fragments at which the value of the tree changes are surfaces.
 * Point:  that of the pixel's ray at the face, moved onto the face's plane in doubles.
 */
#ifndef ZR_RENDER_PICKS_H
#define ZR_RENDER_PICKS_H

#include "base/run.h"
#include "effects/remap.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Surfaces listed behind a pick. */
enum { ZR_PICK_BEHIND_MAX = 64 };

/* Finds the surfaces at pixels, with the ids of the drawn scene. Results lie in `arena`, the rest in `scratch`. `remap`: of a lens, whose pinhole picture the frame is; NULL: none. The frame has its windowDepth
 * and faceId. Fails with ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL. */
enum zr_status zr_picks_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_remap *remap,
                             const struct zr_pick_pixels *pixels, const struct zr_frame *frame, struct zr_picks *out);

/* Finds the ends of dimensions that are pixels: frame->ends. Fails likewise. */
enum zr_status zr_pick_ends_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
