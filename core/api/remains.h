/* remains.h - api: the parts of a scene and its frame that encoding needs, without meshes, images and materials. */
#ifndef ZR_LIBRARY_REMAINS_H
#define ZR_LIBRARY_REMAINS_H

#include "output/json/warnings.h"
#include "shade/frame.h"

struct zr_remains {
    struct zr_scene scene; /* names, counts, instances and keys of outputs; no geometry */
    struct zr_frame frame;
    struct zr_drawing_warnings warnings;
    struct zr_base base;
};

/* Copies these parts of a drawn scene. The frame's channels stay in place, in the same arena. The copy does not point
 * to the scene. NULL without memory. */
struct zr_remains *zr_remains_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_frame *frame);

#endif
