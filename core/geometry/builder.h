/* builder.h - geometry: the floor's state while it works through the instances. */
#ifndef ZR_BUILDER_H
#define ZR_BUILDER_H

#include "base/arena.h"
#include "geometry/geometry.h"

/* Beside the six plane bits: inside the volume, but without a place in the window. */
enum { ZR_OUTCODE_UNPLACED = 1 << 7 };

struct zr_builder {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_geometry *geometry;
    bool separate_backs;                             /* back_colors is an array of its own */
    uint32_t vertex_room, color_room, triangle_room; /* capacities of the geometry's arrays */
    struct zr_viewport viewport;

    /* of the instance under way */
    uint32_t first_vertex, first_color;
    zr_vec4 *clip_positions; /* one a position */
    uint8_t *outcodes;
    bool mirrored; /* so that what went counter-clockwise goes clockwise */
};

/* Makes room for so many more of each. False where the arena has failed, or where
 * there would be more of them than indices can tell apart. */
bool zr_builder_reserve(struct zr_builder *builder, uint64_t vertices, uint64_t colors, uint64_t triangles);

#endif
