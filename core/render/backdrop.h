/* backdrop.h - render: makes the picture that glass refracts (shade/lights/backdrop.h), from the light of the
 * other surfaces. */
#ifndef ZR_RENDER_BACKDROP_H
#define ZR_RENDER_BACKDROP_H

#include "base/run.h"
#include "render/finish.h"
#include "shade/lights/backdrop.h"

/* Sets all but the texels. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_backdrop_open(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                                struct zr_backdrop *out);

/* Makes the levels from pixels over their background, which is opaque. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_backdrop_fill(const struct zr_run *run, const struct zr_post_desc *picture, struct zr_backdrop *out);

/* Returns the bytes of the levels for so many pixels, at least. */
double zr_backdrop_bytes(double pixels);

#endif
