/* supersample.h - render: the channel color with several samples per pixel: the scene at `side` times the size,
 * averaged.
 *
 * Works tile by tile and keeps nothing of the larger picture. Samples need a visibility of their own: with side 2, 4 or
 * 8, none lies at a pixel's centre.
 * Exact:  bytes are averaged as integers, rounded half up, and weighted by opacity if the background is not opaque. The
 *         reference can therefore draw the same.
 */
#ifndef ZR_SUPERSAMPLE_H
#define ZR_SUPERSAMPLE_H

#include "base/run.h"
#include "effects/edges.h"
#include "effects/occlusion.h"
#include "effects/surfaces.h"
#include "render/pass.h"
#include "shade/lights/lighting.h"

/* Colours of all pixels in linear light, for finish.h. Row 0 is the lowest; a row has `stride` values. */
struct zr_linear_frame {
    uint32_t width, height;
    size_t stride;
    float *color[3]; /* sum over covered samples, divided by the number of all samples: premultiplied */
    float *cover;    /* covered share of the samples, 0..1 */
};

/* Glass that refracts (zr_material_refracts) shows a picture of the other surfaces, which is drawn first. */
enum zr_glass_step {
    ZR_GLASS_WITH_ALL, /* there is none, or it does not refract */
    ZR_GLASS_LEFT_OUT, /* all but such glass, and layers in front of it */
    ZR_GLASS_REPEATED  /* tiles with layers are drawn again, with it */
};

/* Input of the samples of a picture in linear light. */
struct zr_sample_stages {
    const struct zr_linear_lighting *lighting;
    const struct zr_occlusion_map *occlusion; /* or NULL */
    struct zr_edge_marks *edges;              /* or NULL */
    const struct zr_surface_rule *surfaces;   /* of 16 samples per pixel; NULL: each sample is lit */
    bool has_xrays;                           /* true if a material has the shading xray, or is glass */
    enum zr_glass_step glass;
    struct zr_linear_frame *out;
};

/* Writes frame->color and the sample counts. The pass has side times the frame's size. Returns ZR_OK, ZR_CANCELLED or
 * ZR_NO_MEMORY. */
enum zr_status zr_supersample_bytes(struct zr_team *team, const struct zr_pass *pass, uint32_t side,
                                    const struct zr_cancel *cancel, struct zr_frame *frame);

/* Lights the samples in linear light and writes their averages to stages->out. Otherwise as above; ZR_GLASS_REPEATED
 * leaves the counts. */
enum zr_status zr_supersample_light(const struct zr_run *run, const struct zr_pass *pass,
                                    const struct zr_sample_stages *stages, uint32_t side, struct zr_frame *frame);

/* Kernels that average a tile's samples. */
struct zr_averages {
    /* Averages bytes for a row of `pixels` pixels. Rows of samples have ZR_TILE_SIZE words. is_opaque: every sample is
     * opaque. */
    void (*bytes)(const uint32_t *samples, uint32_t side, uint32_t pixels, bool is_opaque, uint32_t *out);

    /* Averages light. Rows of samples have ZR_TILE_STRIDE values and are summed row by row, in one order. */
    void (*light)(const float *const color[3], const uint32_t *owner, uint32_t side, uint32_t pixels,
                  float *const out[4]);

    /* Averages blended light: colours times opacity, and opacity. */
    void (*blended)(const float *const sum[4], uint32_t side, uint32_t pixels, float *const out[4]);
};

ZR_KERNEL_TABLE(const struct zr_averages, zr_averages)

#endif
