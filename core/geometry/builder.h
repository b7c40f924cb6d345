/* builder.h - geometry: state shared by the steps that process the instances one after another. */
#ifndef ZR_BUILDER_H
#define ZR_BUILDER_H

#include "base/arena.h"
#include "base/run.h"
#include "geometry/cap_samples.h"
#include "geometry/clip.h"
#include "geometry/fans.h"
#include "geometry/geometry.h"
#include "geometry/transform.h"
#include "geometry/triangulate.h"

/* Scratch for triangulating faces, reused from face to face. */
struct zr_cutting {
    struct zr_triangulator triangulator;
    uint32_t corner_room, ring_room;
    zr_vec4 *points;          /* one per corner of the face */
    uint32_t *offsets;        /* of the face's rings */
    uint32_t (*triangles)[3]; /* corner numbers */
};

/* An edge of a cap with its direction: 1 upwards, -1 downwards. */
struct zr_wound_edge {
    struct zr_grid_edge edge;
    int32_t sign;
};

/* Scratch for winding numbers (winding.h), reused from cap to cap. */
struct zr_winding_scratch {
    struct zr_wound_edge *edges; /* of the current cap */
    uint32_t edge_count, edge_room;
    void *rows, *walls, *numbers; /* arrays by row and by column of the window, and by edge; NULL: no cap yet */
    uint32_t number_room;
    struct zr_cap_samples cap_samples;
};

/* Arrays for primitives that are placed one by one. A draw never spans two of these arrays, so nothing moves. */
struct zr_placed {
    uint32_t count, room;
    uint32_t *corners, *slots, *faces, *traits; /* as in zr_draw */
};

struct zr_builder {
    const struct zr_run *run;
    uint64_t unchecked; /* work since the last check of `run->cancel`, summed over instances */
    const struct zr_scene *scene;
    struct zr_geometry *geometry;
    bool singly; /* each primitive is placed by itself */
    /* capacities of the geometry's arrays */
    uint32_t vertex_room, eye_room, shape_room, edge_room, cut_room, draw_room;
    struct zr_placed placed;
    struct zr_viewport viewport;
    struct zr_cutting cutting;
    struct zr_winding_scratch winding;
    struct zr_fans *fans; /* one per mesh of the scene */

    /* current instance */
    uint32_t instance;
    const struct zr_mesh *mesh;
    uint32_t first_face_id, first_vertex;
    zr_mat4 object_to_eye, object_to_clip;
    uint8_t *outcodes;     /* one per position */
    unsigned any_outcodes; /* OR of all outcodes */
    bool mirrored;         /* the transform is a reflection: it reverses windings */
};

/* Adds `work`, in corners or steps that take as long, and checks for cancellation each time enough has accumulated.
 * Returns false if the request is cancelled. */
bool zr_builder_go_on(struct zr_builder *builder, uint64_t work);

/* Ensure room for `more` vertices, or for one shape and `edges` edges. Return false if the arena failed or a count
 * would exceed ZR_GEOMETRY_MAX. */
bool zr_builder_reserve_vertices(struct zr_builder *builder, uint64_t more);
bool zr_builder_reserve_shape(struct zr_builder *builder, uint64_t edges);

/* Ensures an entry of geometry->eyes for each vertex that there is room for. Lines and clipped vertices need them; other
 * scenes have none. Returns false if the arena failed. */
bool zr_builder_reserve_eyes(struct zr_builder *builder);

/* Appends a draw of the current instance; an empty draw is ignored. Sets the members that describe the instance, and
 * `first`. Returns false if the arena failed. */
bool zr_builder_add_draw(struct zr_builder *builder, struct zr_draw draw);

/* Properties shared by all primitives of a face, a line or a point. */
struct zr_common {
    uint32_t face; /* as in zr_draw.faces */
    const struct zr_material *material;
    enum zr_draw_kind kind;
    bool depth_offset;
    uint32_t shape; /* number of the shape that the face makes */
    bool back;      /* shapes and lines: the back is visible; other triangles derive it from their winding */
    bool skip_thin; /* drop triangles for which zr_place_is_thin holds */
};

/* Corner of a primitive, in the numbering of zr_draw: a vertex relative to first_vertex, and a slot. */
struct zr_corner {
    uint32_t vertex, slot;
};

/* Appends one primitive, to the last draw if that is of the same kind. On failure, the arena has failed. */
void zr_builder_place(struct zr_builder *builder, const struct zr_common *common, const struct zr_corner ends[3]);

/* Returns a position in clip space. */
static inline zr_vec4 zr_builder_clip_position(const struct zr_builder *builder, uint32_t position)
{
    return zr_mat4_apply(&builder->object_to_clip, builder->mesh->positions[position]);
}

/* Returns a position's homogeneous depth in eye space. */
static inline struct zr_eye zr_builder_eye(const struct zr_builder *builder, uint32_t position)
{
    zr_vec4 p = builder->mesh->positions[position];
    return (struct zr_eye){zr_mat4_row(&builder->object_to_eye, 2, p), zr_mat4_row(&builder->object_to_eye, 3, p)};
}

/* View-volume planes that some corner is outside of, with ZR_OUTCODE_UNPLACED; planes that all corners are outside
 * of. */
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

/* Appends the vertices of a clipped primitive, whose corners are positions, and records the cut (zr_cut). Sets ends[i]
 * to vertex i, and placed[i] to whether it has a window position. Returns false if the arena failed. */
bool zr_builder_append_cut(struct zr_builder *builder, const struct zr_clipped *clipped,
                           const struct zr_corner *corners, struct zr_corner ends[ZR_CLIP_MAX],
                           bool placed[ZR_CLIP_MAX]);

#endif
