/* channels.h - scene: what can be had of a picture, one row each.
 *
 * Names, checks, memory, NPY files, their names in archives and what is where nothing is follow from the rows. Only who
 * makes the values of a channel, in shade/, and who has an encoding of its own for it, in encode.c, know it by its
 * constant. A new channel is a row here, and its values in shade/.
 */
#ifndef ZR_CHANNELS_H
#define ZR_CHANNELS_H

#include <stdbool.h>
#include <stdint.h>

enum zr_encoding { ZR_ENCODING_PNG, ZR_ENCODING_PNG16, ZR_ENCODING_NPY, ZR_ENCODING_JSON, ZR_ENCODING_COUNT };

/* What the values of a pixel are; each word has four bytes. */
enum zr_values {
    ZR_VALUES_RGBA,    /* a byte each */
    ZR_VALUES_FLOAT32, /* a word each */
    ZR_VALUES_UINT32,
    ZR_VALUES_NONE /* it has no pixels */
};

/* Where something lies, or points. */
enum zr_space { ZR_SPACE_CAMERA, ZR_SPACE_WORLD, ZR_SPACE_OBJECT, ZR_SPACE_COUNT };

/* A word of the channel where nothing is, as bits. */
#define ZR_NOTHING_ZERO     UINT32_C(0)
#define ZR_NOTHING_ONE      UINT32_C(0x3f800000) /* as a float */
#define ZR_NOTHING_INFINITY UINT32_C(0x7f800000)

/* ROW(ID, name, values, words per pixel, nothing, made from the point that is seen (shade/visible_points.h),
 *     how many spaces it may be in, in the order of enum zr_space,
 *     its encodings, the default one first) */
#define ZR_CHANNEL_ROWS(ROW)                                                                                           \
    /* RGB, or RGBA where the background is not opaque, which is what is seen where nothing is */                      \
    ROW(COLOR, "color", RGBA, 1, ZERO, false, 0, ZR_ENCODING_PNG)                                                      \
    /* eye-space depth along the view axis, scene units */                                                             \
    ROW(DEPTH, "depth", FLOAT32, 1, INFINITY, false, 0, ZR_ENCODING_NPY, ZR_ENCODING_PNG16)                            \
    /* the z-buffer, 0..1 */                                                                                           \
    ROW(WINDOW_DEPTH, "windowDepth", FLOAT32, 1, ONE, false, 0, ZR_ENCODING_NPY)                                       \
    /* 1 + number of the polygon, counted over all instances in order */                                               \
    ROW(FACE_ID, "faceId", UINT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)                                                 \
    /* JSON: what was drawn and how */                                                                                 \
    ROW(INFO, "info", NONE, 0, ZERO, false, 0, ZR_ENCODING_JSON)                                                       \
    /* length of the ray from the eye; of parallel rays, depth */                                                      \
    ROW(DISTANCE, "distance", FLOAT32, 1, INFINITY, true, 0, ZR_ENCODING_NPY)                                          \
    /* 1 + number of the instance */                                                                                   \
    ROW(INSTANCE_ID, "instanceId", UINT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)                                         \
    /* 1: the front of a face is seen, 2: its back; 0 on lines */                                                      \
    ROW(FRONT_FACING, "frontFacing", UINT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)                                       \
    /* shares of the corners of the triangle: as given, or of a polygon (i - 1, i, 0) */                               \
    ROW(BARYCENTRICS, "barycentrics", FLOAT32, 3, ZERO, true, 0, ZR_ENCODING_NPY)                                      \
    /* of the point that is seen */                                                                                    \
    ROW(POSITION, "position", FLOAT32, 3, ZERO, true, 3, ZR_ENCODING_NPY)                                              \
    /* of the side that is seen, as it is shaded; unit length, 0 on lines */                                           \
    ROW(NORMALS, "normals", FLOAT32, 3, ZERO, false, 2, ZR_ENCODING_NPY, ZR_ENCODING_PNG)                              \
    /* u and v of texcoord 0; 0 on lines, and of meshes that have none */                                              \
    ROW(TEXCOORD, "texcoord", FLOAT32, 2, ZERO, true, 0, ZR_ENCODING_NPY)                                              \
    /* how many surfaces and lines lie over one another, hidden ones too */                                            \
    ROW(LAYERS, "layers", UINT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)                                                  \
    /* how much of the ray lies inside of closed meshes, scene units */                                                \
    ROW(THICKNESS, "thickness", FLOAT32, 1, ZERO, false, 0, ZR_ENCODING_NPY)                                           \
    /* JSON: all that lies over one pixel, one by one, nearest first */                                                \
    ROW(FRAGMENTS, "fragments", NONE, 0, ZERO, false, 0, ZR_ENCODING_JSON)

enum zr_channel {
#define ZR_CHANNEL_ENUM(ID, ...) ZR_CHANNEL_##ID,
    ZR_CHANNEL_ROWS(ZR_CHANNEL_ENUM)
#undef ZR_CHANNEL_ENUM
        ZR_CHANNEL_COUNT
};

struct zr_channel_row {
    const char *name;
    enum zr_values values;
    uint32_t words; /* a pixel */
    uint32_t nothing;
    bool of_points;     /* made from the point that is seen */
    int space_count;    /* 0: it lies in none, or in one of its own */
    int encoding_count; /* at least 1 */
    const enum zr_encoding *encodings;
};

extern const struct zr_channel_row zr_channel_rows[ZR_CHANNEL_COUNT];

bool zr_channel_has(enum zr_channel channel, enum zr_encoding encoding);

#endif
