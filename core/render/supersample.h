/* supersample.h - render: the channel color of several samples a pixel: the same scene at `side` times the size,
 * averaged.
 *
 * Tile by tile: nothing of the larger picture is kept. Samples have a visibility of their own, for none but with side 1
 * lies at a pixel's centre.
 * Exact:  bytes are averaged as integers, half up, by opacity where the background is not opaque; so the reference can
 *         draw it, too.
 */
#ifndef ZR_SUPERSAMPLE_H
#define ZR_SUPERSAMPLE_H

#include "effects/edges.h"
#include "effects/occlusion.h"
#include "render/pass.h"
#include "shade/lights/lighting.h"

/* Colours in linear light of all pixels, for finish.h. Rows run upwards; a row has `stride` values. */
struct zr_linear_frame {
    uint32_t width, height;
    size_t stride;
    float *color[3]; /* the sum over what is covered, a share of all samples: premultiplied */
    float *cover;    /* 0..1 */
};

/* What a linear picture's samples are made with. */
struct zr_sample_stages {
    const struct zr_linear_lighting *lighting;
    const struct zr_occlusion_map *occlusion; /* or NULL */
    struct zr_edge_marks *edges;              /* or NULL */
    bool has_xrays;                           /* some material is of that shading */
    struct zr_linear_frame *out;
};

/* To frame->color, and what else is known of the frame then. The pass is of frame's size times side. ZR_OK,
 * ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_supersample_bytes(struct zr_team *team, const struct zr_pass *pass, uint32_t side,
                                    const struct zr_cancel *cancel, struct zr_frame *frame);

/* The same, lit in linear light, to stages->out. */
enum zr_status zr_supersample_light(struct zr_team *team, const struct zr_pass *pass,
                                    const struct zr_sample_stages *stages, uint32_t side,
                                    const struct zr_cancel *cancel, struct zr_frame *frame);

/* Averages of a tile's samples. A kernel. */
struct zr_averages {
    /* `pixels` pixels of a row: samples have rows of ZR_TILE_SIZE words. is_opaque: all of them are. */
    void (*bytes)(const uint32_t *samples, uint32_t side, uint32_t pixels, bool is_opaque, uint32_t *out);

    /* Of samples in rows of ZR_TILE_STRIDE, row by row in one order. */
    void (*light)(const float *const color[3], const uint32_t *owner, uint32_t side, uint32_t pixels,
                  float *const out[4]);

    /* The same where things are blended: of colours times opacity, and opacity. */
    void (*blended)(const float *const sum[4], uint32_t side, uint32_t pixels, float *const out[4]);
};

ZR_KERNEL_TABLE(const struct zr_averages, zr_averages)

#endif
