/* info.h - output: the channel info: camera, counts, covered pixels and warnings as JSON. */
#ifndef ZR_INFO_H
#define ZR_INFO_H

#include "core.h"
#include "output/bytes/buffer.h"
#include "output/json/warnings.h"

/* Faces, lines and points are listed if the scene has at most this many. */
enum { ZR_INFO_FACES_MAX = 1000 };

/* Maximum number of listed instances, the first ones. */
enum { ZR_INFO_MESHES_MAX = 1000 };

/* Appends JSON to `out`: window, camera, bounds, counts, pixels and boxes per instance and face, warnings.
 * `depth_scale` is 0 if no 16-bit depth was made. Without frame->face_id, nothing was drawn, and all
 * keys about pixels are left out. */
enum zr_status zr_info_write(const struct zr_scene *scene, const struct zr_frame *frame, float depth_scale,
                             uint64_t clamped, const struct zr_warning_list *warnings, const char *encoders,
                             const struct zr_cancel *cancel, struct zr_buffer *out);

#endif
