/* channels.h - scene: channels of a view, one row each.
 *
 * Names, checks, memory, NPY files, names in archives and clear values follow from the rows. Only the code in shade/
 * that computes a channel, and the special encodings in encode.c, use its constant. A new channel is a row here and its
 * computation in shade/.
 */
#ifndef ZR_CHANNELS_H
#define ZR_CHANNELS_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/encodings.h"

/* Type of a pixel's values, in words of four bytes. */
enum zr_values {
    ZR_VALUES_RGBA,    /* four bytes in one word */
    ZR_VALUES_FLOAT32, /* one per word */
    ZR_VALUES_UINT32,
    ZR_VALUES_NONE /* no pixels of the frame */
};

/* Clear value of a channel: the word of uncovered pixels, as bits. */
#define ZR_CLEAR_ZERO     UINT32_C(0)
#define ZR_CLEAR_ONE      UINT32_C(0x3f800000) /* as a float */
#define ZR_CLEAR_INFINITY UINT32_C(0x7f800000)
#define ZR_CLEAR_NAN      UINT32_C(0x7fc00000)

/* ROW(ID, name, meaning for people, values, words per pixel, clear value, computed from visible points
 * (shade/visible_points.h), number of spaces to choose from, the first ones of enum zr_space, encodings, the default
 * one first) */
#define ZR_CHANNEL_ROWS(ROW)                                                                                           \
    ROW(COLOR, "color", "the picture; RGBA if the background is not opaque, else RGB", RGBA, 1, ZERO, false, 0,        \
        ZR_ENCODING_PNG, ZR_ENCODING_PNG32, ZR_ENCODING_SVG, ZR_ENCODING_APNG, ZR_ENCODING_JPEG, ZR_ENCODING_WEBP,      \
        ZR_ENCODING_GIF)                                                                                               \
    ROW(DEPTH, "depth", "depth in eye space along the view axis, in scene units", FLOAT32, 1, INFINITY, false, 0,      \
        ZR_ENCODING_NPY, ZR_ENCODING_PNG16, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                                         \
    ROW(WINDOW_DEPTH, "windowDepth", "value of the z-buffer, 0 to 1", FLOAT32, 1, ONE, false, 0, ZR_ENCODING_NPY,      \
        ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                                                                             \
    ROW(FACE_ID, "faceId", "1 + number of the face, line or point, counted over all instances in order", UINT32, 1,    \
        ZERO, false, 0, ZR_ENCODING_NPY)                                                                               \
    ROW(INFO, "info", "facts about the scene: camera, bounds, counts, parts and warnings", NONE, 0, ZERO, false, 0,    \
        ZR_ENCODING_JSON)                                                                                              \
    ROW(DISTANCE, "distance", "length of the ray from the eye, in scene units; the depth if rays are parallel",        \
        FLOAT32, 1, INFINITY, true, 0, ZR_ENCODING_NPY, ZR_ENCODING_PNG16, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)          \
    ROW(INSTANCE_ID, "instanceId", "1 + number of the instance", UINT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)           \
    ROW(FRONT_FACING, "frontFacing", "1: front of a face, 2: back of a face, 0: line or point", UINT32, 1, ZERO,       \
        false, 0, ZR_ENCODING_NPY)                                                                                     \
    /* as given, or (i - 1, i, 0) in the fan of a polygon */                                                           \
    ROW(BARYCENTRICS, "barycentrics", "weights of the three corners of the triangle", FLOAT32, 3, ZERO, true, 0,       \
        ZR_ENCODING_NPY, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                                                            \
    /* PNG in the space nocs only */                                                                                   \
    ROW(POSITION, "position", "visible point, in a space of choice", FLOAT32, 3, ZERO, true, 4, ZR_ENCODING_NPY,       \
        ZR_ENCODING_PFM, ZR_ENCODING_TIFF, ZR_ENCODING_PNG)                                                            \
    ROW(NORMALS, "normals", "unit normal of the visible side, in the space camera or world; 0 on lines", FLOAT32, 3,   \
        ZERO, false, 2, ZR_ENCODING_NPY, ZR_ENCODING_PNG, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                           \
    ROW(TEXCOORD, "texcoord", "u and v of the texture coordinates", FLOAT32, 2, ZERO, true, 0, ZR_ENCODING_NPY,        \
        ZR_ENCODING_TIFF)                                                                                              \
    ROW(LAYERS, "layers", "number of fragments over the centre of the pixel, hidden ones included", UINT32, 1, ZERO,   \
        false, 0, ZR_ENCODING_NPY)                                                                                     \
    ROW(THICKNESS, "thickness", "length of the ray inside closed meshes, in scene units", FLOAT32, 1, ZERO, false, 0,  \
        ZR_ENCODING_NPY, ZR_ENCODING_PNG16, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                                         \
    ROW(FRAGMENTS, "fragments", "all fragments of one pixel, nearest first", NONE, 0, ZERO, false, 0,                  \
        ZR_ENCODING_JSON)                                                                                              \
    ROW(MASKS, "masks", "pixels of each instance, drawn alone and visible", NONE, 0, ZERO, false, 0, ZR_ENCODING_ZIP,  \
        ZR_ENCODING_JSON)                                                                                              \
    /* scene/camera/flow.h */                                                                                          \
    ROW(FLOW, "flow",                                                                                                  \
        "motion of the visible point to another view or pose, in pixels, and whether it is visible there", FLOAT32, 3, \
        NAN, true, 0, ZR_ENCODING_NPY, ZR_ENCODING_PFM, ZR_ENCODING_TIFF)                                              \
    /* render/layers/wall_channel.h */                                                                                 \
    ROW(WALL, "wall", "thickness of the part behind the visible point, along the normal of the face, in scene units",  \
        FLOAT32, 1, ZERO, false, 0, ZR_ENCODING_NPY, ZR_ENCODING_PNG, ZR_ENCODING_PNG16, ZR_ENCODING_PFM,              \
        ZR_ENCODING_TIFF)                                                                                              \
    ROW(TRACE, "trace", "steps of the hidden-surface algorithm, for small windows", NONE, 0, ZERO, false, 0,           \
        ZR_ENCODING_JSON)

enum zr_channel {
#define ZR_CHANNEL_ENUM(ID, ...) ZR_CHANNEL_##ID,
    ZR_CHANNEL_ROWS(ZR_CHANNEL_ENUM)
#undef ZR_CHANNEL_ENUM
        ZR_CHANNEL_COUNT
};

struct zr_channel_row {
    const char *name, *text;
    enum zr_values values;
    uint32_t words;       /* per pixel */
    uint32_t clear_value; /* of uncovered pixels, ZR_CLEAR_* */
    bool of_points;       /* computed from visible points */
    int space_count;      /* 0: no choice of space */
    int encoding_count;   /* at least 1 */
    const enum zr_encoding *encodings;
};

extern const struct zr_channel_row zr_channel_rows[ZR_CHANNEL_COUNT];

/* True if the channel's row lists the encoding. */
bool zr_channel_has(enum zr_channel channel, enum zr_encoding encoding);

#endif
