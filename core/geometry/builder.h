/* builder.h - geometry: the floor's state while it works through the instances. */
#ifndef ZR_BUILDER_H
#define ZR_BUILDER_H

#include "base/arena.h"
#include "geometry/clip.h"
#include "geometry/fans.h"
#include "geometry/geometry.h"
#include "geometry/transform.h"
#include "geometry/triangulate.h"

/* Scratch for faces that have to be triangulated, used again from face to face. */
struct zr_cutting {
    struct zr_triangulator triangulator;
    uint32_t corner_room, ring_room;
    zr_vec4 *points;          /* one a corner of the face */
    uint32_t *offsets;        /* its rings */
    uint32_t (*triangles)[3]; /* numbers of corners */
};

/* Room for primitives that are placed one by one, in which a draw ends: so nothing moves. */
struct zr_placed {
    uint32_t count, room;
    uint32_t *corners, *slots, *faces, *traits; /* as in zr_draw */
};

struct zr_builder {
    struct zr_arena *arena;
    struct zr_team *team;
    const struct zr_cancel *cancel;
    uint64_t unlooked; /* work since the last look at `cancel`; of the whole request, whatever instances it is in */
    const struct zr_scene *scene;
    struct zr_geometry *geometry;
    bool singly;                                                      /* all primitives are to be placed one by one */
    uint32_t vertex_room, shape_room, edge_room, cut_room, draw_room; /* capacities of the geometry's arrays */
    struct zr_placed placed;
    struct zr_viewport viewport;
    struct zr_cutting cutting;
    struct zr_fans *fans; /* one a mesh of the scene */

    /* of the instance under way */
    uint32_t instance;
    const struct zr_mesh *mesh;
    uint32_t first_face_id, first_vertex;
    zr_mat4 object_to_eye, object_to_clip;
    uint8_t *outcodes;     /* one a position */
    unsigned any_outcodes; /* the OR of all */
    bool mirrored;         /* so that what went counter-clockwise goes clockwise */
};

/* Counts work, in corners or what takes as long, and looks at the flag of cancellation once there is enough of
 * it. False: it is raised. */
bool zr_builder_go_on(struct zr_builder *builder, uint64_t work);

/* Makes room for so many more. False where the arena has failed, or where there would be more than ZR_GEOMETRY_MAX. */
bool zr_builder_reserve_vertices(struct zr_builder *builder, uint64_t more);
bool zr_builder_reserve_shape(struct zr_builder *builder, uint64_t edges);

/* Appends a draw of the instance under way, numbered behind those that are there; what the instance is need not be
 * filled in, nor `first`. False where the arena has failed. */
bool zr_builder_add_draw(struct zr_builder *builder, struct zr_draw draw);

/* What all primitives of a face, a line, or points have in common. */
struct zr_common {
    uint32_t face; /* as in zr_draw.faces */
    const struct zr_material *material;
    enum zr_draw_kind kind;
    bool depth_offset;
    uint32_t shape; /* number of the shape that the face is */
    bool back;      /* of a shape or a line: which side is seen; other triangles tell by their winding */
    bool skip_thin; /* leave out what zr_place_is_thin says */
};

/* A corner of a primitive, as zr_draw has it: a vertex, counted from first_vertex, and a slot. */
struct zr_corner {
    uint32_t vertex, slot;
};

/* Appends a primitive by itself, to the last draw where that is of the same kind. Failure is the arena's. */
void zr_builder_place(struct zr_builder *builder, const struct zr_common *common, const struct zr_corner ends[3]);

/* A position in clip space. */
static inline zr_vec4 zr_builder_clip_position(const struct zr_builder *builder, uint32_t position)
{
    return zr_mat4_apply(&builder->object_to_clip, builder->mesh->positions[position]);
}

/* A position's homogeneous depth in eye space. */
static inline struct zr_eye zr_builder_eye(const struct zr_builder *builder, uint32_t position)
{
    zr_vec4 p = builder->mesh->positions[position];
    return (struct zr_eye){zr_mat4_row(&builder->object_to_eye, 2, p), zr_mat4_row(&builder->object_to_eye, 3, p)};
}

/* Planes that some of the corners are outside of, ZR_OUTCODE_UNPLACED with them, and planes that all are outside of. */
struct zr_outcodes {
    unsigned any, all;
};

static inline struct zr_outcodes zr_builder_outcodes(const struct zr_builder *builder, const struct zr_corner *ends,
                                                     int count)
{
    struct zr_outcodes codes = {0, ~(unsigned)ZR_OUTCODE_UNPLACED};
    for (int k = 0; k < count; k++) {
        const unsigned code = builder->outcodes[ends[k].vertex];
        codes.any |= code;
        codes.all =
            ZR_MUTANT(one_outside_rejects, codes.all & code, codes.all | (code & ~(unsigned)ZR_OUTCODE_UNPLACED));
    }
    return codes;
}

/* Appends the vertices that clipping left of a primitive, whose corners are positions, and notes how (zr_cut). ends[i]
 * is then vertex i, and placed[i] whether it has a place in the window. False where the arena has failed. */
bool zr_builder_append_cut(struct zr_builder *builder, const struct zr_clipped *clipped,
                           const struct zr_corner *corners, struct zr_corner ends[ZR_CLIP_MAX],
                           bool placed[ZR_CLIP_MAX]);

#endif
