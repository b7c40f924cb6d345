/* reference.h - reference: the renderer that ours is held against.
 *
 * What it must be: Mesa's llvmpipe, drawing into a frame buffer object with
 * RGBA8 colour and 32-bit float depth; dither and culling off, depth test LESS,
 * cleared to opaque black and depth 1. How one gets hold of it differs, so each
 * way is a back end in a file of its own.
 * A reference that is missing, or is some other renderer, is a failure.
 */
#ifndef ZR_TEST_REFERENCE_H
#define ZR_TEST_REFERENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

struct reference_options {
    /* false: generated code without fused multiply-add, which is what our own
     * arithmetic equals. true: all that the machine has, for benchmarks. */
    bool native;
    int threads; /* that rasterize; 0: the driver's choice */
};

/* Polygons, each corner written out. Faces with three corners are drawn as
 * triangles in the order given, larger ones as GL_POLYGON, all in face order. */
struct reference_arrays {
    uint32_t face_count;
    const uint32_t *face_offsets;      /* face_count + 1 */
    const zr_vec4 *positions, *colors; /* one a corner, or, with `indices`, one a vertex */
    const uint32_t *indices;           /* NULL, or one a corner: all faces are then triangles */
    bool smooth;                       /* false: flat; all corners of a face must have one colour */
    zr_mat4 modelview, projection;
};

struct reference_error {
    char text[200];
};

/* One context a process and a thread. Functions that return false explain it in
 * *error; `state` is then good for close only. */
struct reference_backend {
    const char *name;
    /* NULL on failure. Changes the environment of the process. */
    void *(*open)(const struct reference_options *options, struct reference_error *error);
    void (*close)(void *state);
    const char *(*renderer)(void *state);
    bool (*resize)(void *state, uint32_t width, uint32_t height, struct reference_error *error);
    /* Clears, draws, and waits for the result. */
    bool (*draw)(void *state, const struct reference_arrays *arrays, struct reference_error *error);
    /* Of the last draw, row 0 on top: 4 bytes RGBA a pixel, and window depth
     * 0..1. Either may be NULL. */
    bool (*read)(void *state, uint8_t *rgba, float *depth, struct reference_error *error);
};

extern const struct reference_backend reference_osmesa;

#endif
