/* info.h - output: the channel that is not a picture: what was drawn, and how. */
#ifndef ZR_INFO_H
#define ZR_INFO_H

#include "output/buffer.h"
#include "output/warnings.h"
#include "zraster.h"

/* Faces, lines and points are listed one by one up to this many in the scene. */
enum { ZR_INFO_FACES_MAX = 1000 };

/* Of the placed meshes, so many are listed, the first ones. */
enum { ZR_INFO_MESHES_MAX = 1000 };

/* Appends JSON to `out`: window, camera, bounds, counts, pixels and boxes a placed
 * mesh and a face, warnings. `depth_scale` is 0 where no 16-bit depth was made. Needs frame->face_id. */
enum zr_status zr_info_write(const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                             uint64_t misfits, const struct zr_warning_list *warnings, struct zr_buffer *out);

#endif
