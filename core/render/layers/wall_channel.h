/* wall_channel.h - render: the channel wall: how thick the part is behind each visible point.
 *
 * Value:  from the visible point, along the inner normal of its face, to the first face of the same part that the ray
 *         leaves through. 0: no surface, or none on the other side, as in parts that are open there.
 * Point:  by the channel depth, then the nearest place of the scene's triangles in a tree of boxes. Pixels with no
 *         triangle there, such as those of caps, lines and points, have 0.
 * Work:   counted in steps: ZR_WALL_STEPS_OF_PIXEL per pixel on average, per row; the rest of a row that takes more has 0.
 * Exact:  the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_WALL_CHANNEL_H
#define ZR_WALL_CHANNEL_H

#include "base/run.h"
#include "scene/scene.h"
#include "shade/frame.h"

enum { ZR_WALL_STEPS_OF_PIXEL = 4096 };

/* Writes the channel, a number per pixel. The frame has its depth. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_wall_channel_draw(const struct zr_run *run, const struct zr_scene *scene,
                                    const struct zr_frame *frame, float *out);

#endif
