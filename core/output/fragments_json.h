/* fragments_json.h - output: what lies over a pixel, in words. */
#ifndef ZR_FRAGMENTS_JSON_H
#define ZR_FRAGMENTS_JSON_H

#include "output/buffer.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Fragments are listed one by one up to this many, the nearest ones. */
enum { ZR_FRAGMENTS_LISTED_MAX = 1000 };

/* Appends JSON to `out`: the pixel, how many fragments there are, and of each what it belongs to and where it lies. */
enum zr_status zr_fragments_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                       struct zr_buffer *out);

#endif
