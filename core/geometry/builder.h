/* builder.h - geometry: the floor's state while it works through the instances. */
#ifndef ZR_BUILDER_H
#define ZR_BUILDER_H

#include "base/arena.h"
#include "geometry/clip.h"
#include "geometry/colors.h"
#include "geometry/eye_normals.h"
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

struct zr_builder {
    struct zr_arena *arena;
    struct zr_team *team;
    const struct zr_cancel *cancel;
    uint64_t unlooked; /* work since the last look at `cancel`; of the whole request, whatever instances it is in */
    const struct zr_scene *scene;
    struct zr_geometry *geometry;
    bool written;                   /* all records are to be written out */
    bool uncolored;                 /* no colour picture is wanted: colours are not made */
    bool separate_backs;            /* back_colors is an array of its own */
    bool all_normals, some_normals; /* of all surfaces, of some: are wanted */
    bool points;                    /* in eye space are wanted */
    zr_vec4 eye;                    /* zr_camera_eye */
    uint32_t normal_room;
    uint32_t vertex_room, color_room, triangle_room; /* capacities of the geometry's arrays */
    uint32_t shape_room, edge_room, cut_room, batch_room;
    uint32_t next_number, batched_records; /* of the next batch; how many of geometry->triangles are in batches */
    uint32_t outline_color;                /* 1 + index of the colour that outlines had last, or 0 */
    struct zr_viewport viewport;
    struct zr_cutting cutting;
    struct zr_fans *fans;           /* one a mesh of the scene */
    uint32_t *packed;               /* room for the packed colours of this instance and of those to come */
    const zr_vec4 **vertex_normals; /* of each mesh's vertices, or NULL: not needed so far */

    /* of the instance under way */
    uint32_t instance;
    const struct zr_mesh *mesh;
    struct zr_colors colors;
    const zr_vec4 *normals[ZR_BATCH_UNCOLORED]; /* at each rate; NULL: not made so far */
    uint32_t flat_face, flat_normal;            /* 1 + the face whose normal was written out last, and where */
    const struct zr_lighting *lighting;
    uint32_t first_face_id, first_vertex, first_color;
    zr_mat4 object_to_eye, object_to_clip;
    uint8_t *outcodes;     /* one a position */
    unsigned any_outcodes; /* the OR of all */
    bool mirrored;         /* so that what went counter-clockwise goes clockwise */
};

/* Counts work, in corners or what takes as long, and looks at the flag of cancellation once there is enough of
 * it. False: it is raised. */
bool zr_builder_go_on(struct zr_builder *builder, uint64_t work);

/* Makes room for so many more of each. False where the arena has failed, or where
 * there would be more of them than indices can tell apart. */
bool zr_builder_reserve(struct zr_builder *builder, uint64_t vertices, uint64_t colors, uint64_t triangles);
bool zr_builder_reserve_normals(struct zr_builder *builder, uint64_t more); /* the first one is 0 */
bool zr_builder_reserve_shape(struct zr_builder *builder, uint64_t edges);
bool zr_builder_reserve_cut(struct zr_builder *builder);

/* Appends a batch, numbered behind those that are there; batch.first need not be filled. False where the arena has
 * failed. */
bool zr_builder_add_batch(struct zr_builder *builder, struct zr_batch batch);

/* Batches for the records that have been written out since the last call. */
bool zr_builder_add_written(struct zr_builder *builder);

/* The window vertex of a position. */
static inline uint32_t zr_builder_vertex(const struct zr_builder *builder, uint32_t position)
{
    return builder->first_vertex + position;
}

/* Sees to it that the colours of a face of the instance under way are among the geometry's, where records that are
 * written out find them: all of its mesh, or, of those that are packed, the face's one. False where the arena has
 * failed. */
bool zr_builder_own_colors(struct zr_builder *builder, uint32_t face);

/* Makes the colours of the instance under way, all of its mesh, among the geometry's. False where the arena has
 * failed. */
bool zr_builder_make_colors(struct zr_builder *builder);

/* Whether surfaces of the material are shaded by their normals. */
static inline bool zr_builder_wants_normals(const struct zr_builder *builder, const struct zr_material *material)
{
    return builder->all_normals || (builder->some_normals && zr_material_is_shaded_late(material));
}

/* The normals of the instance under way, at the rate that the material has (eye_normals.h). NULL where the arena has
 * failed. */
const zr_vec4 *zr_builder_normals(struct zr_builder *builder, enum zr_batch_rate rate);

/* Appends the normals of three corners of a face, by their slots in its mesh, to the geometry's; `out`: where. False
 * where the arena has failed. */
bool zr_builder_add_normals(struct zr_builder *builder, uint32_t face, const uint32_t slots[3], uint32_t out[3]);

/* The geometry's colour of a face at corner `slot` of its mesh; zr_builder_own_colors has been called for it. */
uint32_t zr_builder_color(const struct zr_builder *builder, uint32_t face, bool smooth, uint32_t slot);

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

/* The way from the eye to a position, times its w: that is linear over a face, as the quotient is not. */
static inline zr_vec4 zr_builder_point(const struct zr_builder *builder, uint32_t position)
{
    const zr_vec4 p = zr_mat4_apply(&builder->object_to_eye, builder->mesh->positions[position]), eye = builder->eye;
    if (eye.w == 0.0f) return p;
    return (zr_vec4){p.x - eye.x * p.w, p.y - eye.y * p.w, p.z - eye.z * p.w, 0.0f};
}

/* Planes that some of the positions are outside of, ZR_OUTCODE_UNPLACED with them, and planes that all are outside of.
 */
struct zr_outcodes {
    unsigned any, all;
};

static inline struct zr_outcodes zr_builder_outcodes(const struct zr_builder *builder, const uint32_t *positions,
                                                     int count)
{
    struct zr_outcodes codes = {0, ~(unsigned)ZR_OUTCODE_UNPLACED};
    for (int k = 0; k < count; k++) {
        codes.any |= builder->outcodes[positions[k]];
        codes.all = ZR_MUTANT(one_outside_rejects, codes.all & builder->outcodes[positions[k]],
                              codes.all | (builder->outcodes[positions[k]] & ~(unsigned)ZR_OUTCODE_UNPLACED));
    }
    return codes;
}

/* A corner that clipping cuts: a position of the mesh, and a colour of the geometry. */
struct zr_builder_corner {
    uint32_t position, color, normal;
};

/* Appends what clipping left of the corners: its vertices, and, where their colours or normals are not all the same, as
 * many of these, all behind what the geometry has. placed[i]: whether vertex i has a place in the window. False where
 * the arena has failed. */
bool zr_builder_append_clipped(struct zr_builder *builder, const struct zr_clipped *clipped,
                               const struct zr_builder_corner *corners, bool placed[ZR_CLIP_MAX]);

#endif
