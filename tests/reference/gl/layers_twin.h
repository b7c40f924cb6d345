/* layers_twin.h - reference: scenes with see-through surfaces.
 *
 * The reference draws what is opaque, and then each see-through face, outline and line by itself, into floats: so it
 * tells where each of them is, how deep, in which colour and how opaque. Masks and the order of layers are decided
 * here; layers are laid over one another by the reference again, by GL's blending into 32-bit floats, the farthest
 * first.
 */
#ifndef ZR_TEST_LAYERS_TWIN_H
#define ZR_TEST_LAYERS_TWIN_H

#include "reference/generate/batches.h"

/* Row 0 on top. */
struct layers_picture {
    uint8_t *rgba, *gaps;
    float *depth;    /* of what is opaque, or passes its mask */
    uint32_t *owner; /* likewise */
    float *sum;      /* four a pixel: what blending gave, colours times opacity; not looked at where count is 0 */
    uint32_t *count; /* how many layers were blended over the pixel */
};

struct layers_twin {
    struct reference *reference;
    struct zr_arena *arena;
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct batches_options options; /* but for its purpose, and for what is drawn of the scene */
};

/* Whether the scene needs this. */
bool layers_twin_is_for(const struct zr_scene *scene);

/* To *picture, whose arrays have room for the window. */
bool layers_twin_draw(const struct layers_twin *twin, const struct layers_picture *picture,
                      struct reference_error *error);

/* How many pixels of the scene's own sums, as core/render/layers/layers.h makes them, differ from the picture's by a
 * bit. */
uint64_t layers_twin_compare(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                             const struct zr_camera *camera, const struct layers_picture *picture);

#endif
