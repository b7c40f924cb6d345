/* lens.h - render: a frame through a lens, from the frame of the pinhole picture behind it. */
#ifndef ZR_RENDER_LENS_H
#define ZR_RENDER_LENS_H

#include "base/run.h"
#include "effects/remap.h"
#include "scene/camera/resolved_view.h"
#include "scene/picture.h"
#include "shade/frame.h"

/* The scene and the view of the pinhole picture. */
struct zr_lens_drawing {
    struct zr_scene scene;
    struct zr_picture picture; /* the scene's */
    struct zr_resolved_view resolved;
};

/* Sets the window and the camera of the pinhole picture, and scales lines with it. `resolved` has a lens. The drawing
 * points into itself. */
void zr_lens_drawing_open(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                          struct zr_lens_drawing *drawing);

/* Lists the fragments along the ray of the pixel that an output asks for, as zr_pixel_fragments_find does. A pixel
 * without a ray has none. */
enum zr_status zr_lens_list_fragments(const struct zr_run *run, const struct zr_lens_drawing *drawing,
                                      const struct zr_remap *remap, struct zr_frame *pinhole);

/* Fills the channels and counts of a frame through the lens. Parts are not set. ZR_OK or ZR_CANCELLED. */
enum zr_status zr_lens_take(const struct zr_run *run, const struct zr_scene *scene, const struct zr_remap *remap,
                            const struct zr_frame *pinhole, struct zr_frame *frame);

#endif
