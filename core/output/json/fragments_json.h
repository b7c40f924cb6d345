/* fragments_json.h - output: lists the fragments of a pixel as JSON. */
#ifndef ZR_FRAGMENTS_JSON_H
#define ZR_FRAGMENTS_JSON_H

#include "output/bytes/buffer.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Maximum number of listed fragments, the nearest ones. */
enum { ZR_FRAGMENTS_LISTED_MAX = 1000 };

/* Appends JSON to `out`: the pixel, the number of its fragments, and for each listed one its face, mesh and
 * position. */
enum zr_status zr_fragments_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                       struct zr_buffer *out);

#endif
