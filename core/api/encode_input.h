/* encode_input.h - api: the parts of a scene and its frame that encoding needs: no meshes, images or materials. */
#ifndef ZR_API_ENCODE_INPUT_H
#define ZR_API_ENCODE_INPUT_H

#include "output/json/warnings.h"
#include "shade/frame.h"

struct zr_encode_input {
    struct zr_scene scene; /* names, counts, instances and keys of outputs; no geometry */
    struct zr_frame frame;
    struct zr_drawing_warnings warnings;
    struct zr_base base;
};

/* Copies these parts of a drawn scene. The frame's channels stay in place, in the same arena. The copy does not point
 * to the scene. NULL without memory. */
struct zr_encode_input *zr_encode_input_make(struct zr_arena *arena, const struct zr_scene *scene,
                                             const struct zr_frame *frame);

#endif
