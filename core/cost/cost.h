/* cost.h - cost: predicted time of rendering and encoding a scene, and a lower bound of its memory.
 *
 * How:    ms = 1e-6 * sum over all kinds of counts[kind] * ns. Most counts follow from sizes. The window area that
 *         faces cover is estimated from a sample of faces.
 * Unit:   processor time of one thread of the reference machine, with AVX-512. The daemon multiplies the sum by the
 *         factor of its own machine (server/jobs/slowness.h).
 * Why:    the daemon classes requests by the sum as small, large or refused. The weights were fitted together, so that
 *         the sum is right within a factor of three. A single weight is not the time of its quantity.
 */
#ifndef ZR_COST_H
#define ZR_COST_H

#include <stdint.h>

/* ROW(ID, ns, words: the quantity, for messages). A pass draws the scene once: at pixel centres, at samples, or into a
 * depth map. */
#define ZR_COST_ROWS(ROW)                                                                                              \
    ROW(REQUEST, 35e3, "requests")                                                                                     \
    ROW(INSTANCE, 1600.0, "instances")                                                                                 \
    ROW(VERTEX, 25.0, "vertices")                                                                                      \
    ROW(TRIANGLE, 25.0, "triangles")                                                                                   \
    ROW(RUN, 600.0, "changes of the material from one face to the next")                                               \
    ROW(NORMAL, 67.0, "triangles whose normals are averaged")                                                          \
    ROW(VERTEX_LAMP, 0.25, "vertices times lamps")                                                                     \
    ROW(VERTEX_PLACED_LAMP, 0.8, "vertices times point and spot lamps")                                                \
    ROW(FRAGMENT, 0.25, "pixels of faces, hidden ones too")                                                            \
    ROW(LINE_FRAGMENT, 7.0, "pixels of lines and points")                                                              \
    ROW(SHAPE_CORNER, 5.5, "squared corners of faces that are not convex")                                             \
    ROW(SHAPE_SAMPLE, 0.3, "pixels times corners of faces that are not convex")                                        \
    ROW(COMPARISON, 1.0, "pixels that the painter compares")                                                           \
    ROW(LAYER, 32.0, "pixels of translucent faces, hidden ones too")                                                   \
    ROW(SOLID_SAMPLE, 14.0, "samples of faces, hidden ones too, of scenes with csg")                                   \
    ROW(CHANNEL_LAYER, 6.0, "pixels of faces, hidden ones too, for channels of all layers")                            \
    ROW(WINDOW_SAMPLE, 1.5, "samples of the window")                                                                   \
    ROW(CHANNEL_PIXEL, 12.0, "pixels of data channels that are computed")                                              \
    ROW(WALL_PIXEL, 700.0, "pixels whose walls are measured, more in meshes of more than 1000 triangles")              \
    ROW(LINEAR_PIXEL, 26.0, "pixels in linear light")                                                                  \
    ROW(LIT_SAMPLE, 10.0, "samples that are lit")                                                                      \
    ROW(LAMP_SAMPLE, 1.0, "samples times lamps")                                                                       \
    ROW(PLACED_LAMP_SAMPLE, 4.2, "samples times point and spot lamps")                                                 \
    ROW(SHADOW_SAMPLE, 5.0, "samples times lamps with shadows")                                                        \
    ROW(TEXTURE_SAMPLE, 10.0, "samples times textures")                                                                \
    ROW(OCCLUSION_PIXEL, 42.0, "pixels with occlusion")                                                                \
    ROW(EDGE_SAMPLE, 0.1, "samples with edges")                                                                        \
    ROW(EDGE_WIDTH_SAMPLE, 0.02, "samples times the width of edges")                                                   \
    ROW(DRAWN_TRIANGLE, 1000.0, "triangles whose lines are found")                                                     \
    ROW(DRAWN_PIXEL, 4.0, "fine pixels of faces in which lines are found, hidden ones too")                            \
    ROW(DRAWN_PAIR, 0.35, "pairs of triangles within 16 x 16 fine pixels, for lines of the mesh")                      \
    ROW(DRAWN_NARROW, 3000.0, "cells of 16 x 16 fine pixels along narrow triangles, for lines of the mesh")            \
    ROW(FRAME_OBJECT, 500.0, "objects of the file that frames read again")                                             \
    ROW(CUT_PIXEL, 8.0, "pixels that the painter compares for faces that cut one another")                             \
    ROW(DRAWN_CROSSING, 50.0,                                                                                          \
        "pairs of triangles that cut one another within 16 x 16 fine pixels, for lines of the mesh")                   \
    ROW(MAP_TEXEL, 18.0, "texels of shadow maps")                                                                      \
    ROW(MAP_FRAGMENT, 0.24, "texels of faces in shadow maps")                                                          \
    ROW(LEVEL_TEXEL, 4.0, "texels of textures' levels")                                                                \
    ROW(LINEAR_LEVEL_TEXEL, 7.0, "texels of textures' levels in linear light")                                         \
    ROW(FACT, 800.0, "triangles of parts that info measures")                                                          \
    ROW(FEATURE, 2000.0, "triangles among which info finds features, and 100 per part")                                \
    ROW(INFO, 4e6, "scenes whose overlaps info measures")                                                              \
    ROW(PART, 60e3, "parts that info lists")                                                                           \
    ROW(SECTION_CORNER, 60.0, "corners of faces times planes of sections")                                             \
    ROW(CAP_TILE, 6.0, "corners of caps times tiles of the window")                                                    \
    ROW(LENS_PIXEL, 100.0, "pixels that a lens distorts")                                                              \
    ROW(TRACED_PIXEL, 550.0, "pixels of faces, hidden ones too, in a trace")                                           \
    ROW(TRACED_SHAPE, 25.0, "pixels times corners of faces that are not convex, in a trace")                           \
    ROW(TRACED_EDGE, 400.0, "edges times rows in a trace, and faces between them")                                     \
    ROW(TRACED_COMPARISON, 20.0, "pixels that the painter compares in a trace")                                        \
    ROW(OUTPUT_WORD, 1.6, "words of outputs")                                                                          \
    ROW(PNG_PIXEL, 0.4, "pixels of PNG files")                                                                         \
    ROW(SMALL_PNG_PIXEL, 18.0, "pixels of PNG files that are compressed well")                                         \
    ROW(JPEG_PIXEL, 8.0, "pixels of JPEG files, for each try of a quality")                                            \
    ROW(WEBP_PIXEL, 70.0, "pixels of WebP files, for each try of a quality")                                           \
    ROW(LOSSLESS_WEBP_PIXEL, 80.0, "pixels of lossless WebP files")                                                    \
    ROW(GIF_PIXEL, 15.0, "pixels of GIF files")

enum zr_cost_kind {
#define ZR_COST_ENUM(ID, ...) ZR_COST_##ID,
    ZR_COST_ROWS(ZR_COST_ENUM)
#undef ZR_COST_ENUM
        ZR_COST_KINDS
};

struct zr_cost {
    double ms; /* of rendering and encoding */
    double counts[ZR_COST_KINDS];
    double window_bytes;   /* lower bound of the bytes that rendering holds at once, in arrays of the window's size */
    double lamp_map_bytes; /* part of window_bytes for shadow maps of lights */
    double mesh_bytes;     /* estimate of those in arrays of the sizes of meshes, without the scene */
    uint32_t lamp_maps;    /* number of these maps */
};

/* The row with the largest share of zr_cost.ms. */
struct zr_cost_most {
    double ms, count; /* of this row alone */
    const char *words;
};
struct zr_cost_most zr_cost_most(const struct zr_cost *cost);

/* Adds work of a kind. */
void zr_cost_add(struct zr_cost *cost, enum zr_cost_kind kind, double count);

/* Removes the work of a kind, which another view of the request does. */
void zr_cost_remove(struct zr_cost *cost, enum zr_cost_kind kind);

#endif
