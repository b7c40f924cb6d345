/* finish.h - render, last step: converts averaged samples in linear light to the bytes of the channel color.
 *
 * Each pixel is laid over the background, which the ground's shadow darkens. The ink of edges is laid over the result,
 * which is then encoded as sRGB. Over a transparent background, the shadow is black with opacity 1 - T^(1/2.2), since
 * viewers blend encoded values. A gradient is moved by up to half a step before it is rounded, in a
 * pattern of 4 x 4 pixels, where no surface is in front of it.
 */
#ifndef ZR_FINISH_H
#define ZR_FINISH_H

#include "base/team.h"
#include "effects/ground.h"
#include "render/supersample.h"

struct zr_post_desc {
    const struct zr_scene *scene;
    const struct zr_linear_frame *light;
    const struct zr_ground *ground; /* NULL or without light: no ground */
    struct zr_ground_frame ground_frame;
    struct zr_ground_sun sun; /* of the ground; without a map: none */
    struct zr_rays rays;
    const float *ink; /* opacity of edges, rows of light->width, row 0 the lowest; NULL: no edges */
    uint8_t *out;     /* RGBA, row 0 on top */
};

void zr_finish_picture(struct zr_team *team, const struct zr_post_desc *desc, const struct zr_cancel *cancel);

/* Writes each pixel over the background: linear red, green and blue, and 1, without ink, encoding and dithering, in
 * rows of light->width. The background must be opaque. */
void zr_finish_compose(struct zr_team *team, const struct zr_post_desc *desc, const struct zr_cancel *cancel,
                       float (*out)[4]);

/* True if no pixel of the picture is transparent. */
bool zr_background_is_opaque(const struct zr_scene *scene);

/* Input of one row. `background`: linear red, green and blue, and opacity. `share`: the ground's T per pixel, or NULL.
 * `ink`: opacities of the linear `ink_color`, or NULL. `dither`: added to encoded values of pixels x with cover 0, from
 * [x & 15] on, of period 4, or NULL. The kernel reads up to 15 values past the end of each array but this. */
struct zr_finish_row {
    const float *color[3], *cover, *share, *ink, *dither;
    float background[4], ink_color[3];
    uint32_t count;
};

/* Dither values, added to pixels before rounding. Row y of the picture, from the lowest row up, uses row y & 3. */
enum { ZR_DITHER_SIDE = 4, ZR_DITHER_ROOM = 16 };
extern const float zr_finish_dither[ZR_DITHER_SIDE][ZR_DITHER_ROOM];

typedef void zr_finish_row_fn(const struct zr_finish_row *row, uint32_t *out);

ZR_KERNEL_TABLE(zr_finish_row_fn, zr_finish_row)

/* Converts three sRGB-encoded values to linear light. */
typedef void zr_decode_fn(const float encoded[3], float linear[3]);

ZR_KERNEL_TABLE(zr_decode_fn, zr_decode)

#endif
