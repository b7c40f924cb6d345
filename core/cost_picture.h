/* cost_picture.h - the core: what pictures of several samples, in linear light and with effects take, beside drawing.
 *
 * Why:    a picture may be drawn some times: at pixels' centres, at samples, along lamps; and lighting a sample takes
 *         longer than drawing it. What is predicted is to be right to a factor of two or three.
 */
#ifndef ZR_COST_PICTURE_H
#define ZR_COST_PICTURE_H

#include "scene/resolved_view.h"
#include "scene/scene.h"

/* How often the scene is drawn. */
struct zr_cost_passes {
    uint32_t centres; /* in its window: for channels and, in linear light, for effects */
    uint32_t samples; /* in one of `side` times the size: 0 or 1 */
    uint32_t side;
    uint32_t maps;      /* for shadows, of lamps and on the ground */
    uint32_t lamp_maps; /* those of lamps, */
    uint32_t spot_maps; /* and of spots among them */
    double map_texels;  /* of all of them */
    bool makes_normals; /* averages them over faces */
};

struct zr_cost_passes zr_cost_passes_of(const struct zr_scene *scene, const struct zr_resolved_view *resolved);

/* What passes are made of: pixels, and samples, at which something is. */
struct zr_cost_covered {
    double centres, samples;
    double samples_a_face; /* of those that are seen */
    double layered;        /* samples of see-through faces, in all layers */
};

/* All but drawing, in samples of unlit surfaces. */
double zr_cost_of_light(const struct zr_scene *scene, const struct zr_cost_passes *passes,
                        const struct zr_cost_covered *covered);

/* Bytes of the depth maps of lamps with shadows. */
double zr_cost_lamp_map_bytes(const struct zr_cost_passes *passes);

/* Bytes that a request has at once for arrays of whole windows: what it takes at least. */
double zr_cost_window_bytes(const struct zr_scene *scene, const struct zr_cost_passes *passes,
                            const struct zr_cost_covered *covered);

#endif
