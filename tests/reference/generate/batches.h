/* batches.h - reference: a scene -> what GL draws.
 *
 * Made from the scene itself, not from our triangles: object-space positions, a
 * modelview matrix an instance, faces as triangles and polygons. The reference lights:
 * it gets the colour of the surface, and of ours only what goes into the equations: the
 * normals of faces and vertices, the matrix that takes them to eye space, and the
 * directions of the lights there.
 */
#ifndef ZR_TEST_BATCHES_H
#define ZR_TEST_BATCHES_H

#include "core.h"
#include "reference/gl/reference.h"
#include "scene/camera/camera.h"

enum batches_purpose {
    BATCHES_COLORS,  /* as the scene looks */
    BATCHES_OWNERS,  /* each face and line in a flat colour of its own, batches_owner_color, on black */
    BATCHES_LIGHT,   /* for look_twin.h: areas as for channels, in the surfaces' own colours and with the normals of
                      * creases; lines are in their own colours */
    BATCHES_CHANNELS /* for twins.h: all areas are triangles, also those of polygons, and have normals; they are smooth
                      * where their normals are those of vertices */
};

/* What of a scene is drawn. */
enum batches_kind { BATCHES_FACE, BATCHES_OUTLINE, BATCHES_LINE, BATCHES_POINT };
struct batches_only {
    enum zr_alpha_mode mode; /* of materials; */
    bool one;                /* and this part of it alone: */
    uint32_t instance, number;
    enum batches_kind kind;
};

struct batches_options {
    enum batches_purpose purpose;
    const struct batches_only *only; /* NULL: everything */
    bool transformed;   /* positions brought to clip space here, in double, and GL's matrices left at identity */
    bool all_parity;    /* convex polygons of more than three corners are drawn by the odd-even rule too */
    float more_ambient; /* added to the ambient light, to see a comparison fail */
    float more_to_x;    /* added to x of the directions to the lights, likewise */
};

/* A piece of a shape's triangle that ours finds too thin to tell a plane (geometry/place.h), on the snapped grid. */
struct batches_thin {
    int32_t x[3], y[3];
};

struct batches {
    struct reference_arrays arrays;
    uint32_t thin_count;
    struct batches_thin *thin;
    uint64_t triangles;    /* of faces cut to triangles; a line or a point counts as one */
    uint32_t parity_faces; /* drawn by the odd-even rule */
};

/* Points into the arena. False where the arena has failed, or where the scene has more faces than there are
 * colours (BATCHES_OWNERS_MAX). */
bool batches_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                  const struct batches_options *options, struct batches *batches);

/* A face or line's number (from 1; 0 is the background) <-> a colour that 8 bits a
 * channel hold exactly. The numbers are scattered over the colours, so that neighbours
 * can be told apart by eye; number 0 is black. */
enum { BATCHES_OWNERS_MAX = (1 << 24) - 1 };
zr_vec4 batches_owner_color(uint32_t number);
uint32_t batches_owner_number(const uint8_t rgba[4]);

/* True where the face is drawn by the odd-even rule, on both sides alike. */
bool batches_face_is_parity(const struct zr_mesh *mesh, uint32_t face);

/* Sets gaps[pixel], row 0 on top, where thin pieces cover a sample: there ours takes another plane. */
void batches_mark_thin(const struct batches *batches, uint32_t width, uint32_t height, uint8_t *gaps);

/* The triangles that a face which is no convex one is cut into, by its corners: those of core/geometry, which
 * decide which plane a sample takes. False where the arena has failed. */
struct batches_cut {
    uint32_t count;
    uint32_t (*triangles)[3];
};
bool batches_cut_face(struct zr_arena *arena, const struct zr_mesh *mesh, uint32_t face, struct batches_cut *cut);

/* projection * world_to_eye * object_to_world * position, one matrix after the other, in double and from the right:
 * the same place as ours and GL's, reached by another way. */
void batches_transform(const struct zr_camera *camera, const zr_mat4 *object_to_world, zr_vec4 position,
                       double clip[4]);

/* The scene's lights, in eye space, and wrong where the options want that; NULL where the arena has failed. */
const struct reference_lighting *batches_light(struct zr_arena *arena, const struct zr_scene *scene,
                                               const struct zr_camera *camera, const struct batches_options *options);

#endif
