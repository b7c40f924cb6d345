/* draco_mesh.h - input: the steps of the decoder of Draco meshes; private to it.
 *
 * Corners: face f has the corners 3f .. 3f + 2. A corner is opposite to the edge of the other two. Two corners are
 *          opposite to each other if their faces share that edge.
 * Swings:  opposite corners are pairs, so swinging around a vertex ends at a boundary or where it began.
 * Errors:  functions return false if the stream is broken, without memory, or if cancelled. They give a reason only for
 *          contents that are not read. */
#ifndef ZR_DRACO_MESH_H
#define ZR_DRACO_MESH_H

#include "input/codecs/draco.h"
#include "input/codecs/draco_stream.h"

#define ZR_DRACO_NONE UINT32_MAX

/* Faces with their vertices and neighbours. */
struct zr_draco_corners {
    uint32_t corner_count, vertex_count;
    uint32_t *vertices;  /* per corner */
    uint32_t *opposites; /* per corner; NONE at a boundary or a seam */
    uint32_t *first;     /* per vertex: its corner at the left end of its faces, or any; NONE: no corner */
};

static inline uint32_t zr_draco_next(uint32_t corner)
{
    return corner == ZR_DRACO_NONE ? corner : corner % 3 == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t zr_draco_previous(uint32_t corner)
{
    return corner == ZR_DRACO_NONE ? corner : corner % 3 == 0 ? corner + 2 : corner - 1;
}

/* Return the corner of the same vertex in the neighbouring face, or NONE. */
static inline uint32_t zr_draco_right(const struct zr_draco_corners *of, uint32_t corner)
{
    return zr_draco_previous(of->opposites[zr_draco_previous(corner)]);
}

static inline uint32_t zr_draco_left(const struct zr_draco_corners *of, uint32_t corner)
{
    return zr_draco_next(of->opposites[zr_draco_next(corner)]);
}

/* Vertices in the order of their values. */
struct zr_draco_order {
    const struct zr_draco_corners *of; /* NULL: sequential connectivity, value i belongs to point i */
    uint32_t count;
    uint32_t *corners;  /* per value */
    uint32_t *values;   /* per vertex; NONE: not reached */
    uint32_t *of_point; /* per point: its value */
};

/* Coders of attributes, as the bitstream counts them. */
enum { ZR_DRACO_GENERIC, ZR_DRACO_INTEGER, ZR_DRACO_QUANTIZED, ZR_DRACO_NORMAL };

/* An attribute while it is decoded. */
struct zr_draco_values {
    struct zr_draco_attribute *made;
    uint32_t kind, coder; /* kind: 0 is the position */
    const struct zr_draco_order *order;
    uint32_t width;             /* numbers per value of `integers` */
    int32_t *integers;          /* NULL if generic, or not decoded yet */
    const unsigned char *bytes; /* generic: all values; quantized: the lowest value of each component */
    uint32_t bits;              /* of quantization */
    float range;
};

enum { ZR_DRACO_POSITION = 0 };

struct zr_draco {
    struct zr_arena *arena;  /* holds the result; only zr_arena_alloc_beside may use it */
    struct zr_arena scratch; /* holds everything else */
    const struct zr_cancel *cancel;
    struct zr_reason *reason;
    uint32_t steps; /* of loops that may be long */
    size_t size;    /* compressed bytes */
    struct zr_draco_stream stream;
    struct zr_draco_mesh *mesh;
    uint32_t *points;             /* per corner: mesh->corners */
    bool has_table;               /* the connectivity is edgebreaker's */
    struct zr_draco_corners base; /* of positions */
    bool *is_inner;               /* per vertex of `base`: it is not at a boundary */
    uint32_t seam_count;
    struct zr_draco_corners seams[ZR_DRACO_ATTRIBUTES]; /* tables of attributes with seams */
    struct zr_draco_values values[ZR_DRACO_ATTRIBUTES];
};

/* Counts a step of a loop. True if the loop must end; it looks at the flag every ZR_DRACO_AT_ONCE steps. */
static inline bool zr_draco_stops(struct zr_draco *draco)
{
    return ++draco->steps % ZR_DRACO_AT_ONCE == 0 && zr_is_cancelled(draco->cancel);
}

/* ---- draco_memory.c ---- */

/* Gives a reason and returns false. */
bool zr_draco_refuse(struct zr_draco *draco, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Sets numbers to NONE. False if cancelled. */
bool zr_draco_clear(struct zr_draco *draco, uint32_t *numbers, size_t count);

/* Allocate in the scratch memory; zr_draco_nones sets the numbers to NONE. */
uint32_t *zr_draco_numbers(struct zr_draco *draco, size_t count);
uint32_t *zr_draco_nones(struct zr_draco *draco, size_t count);

/* Allocates corners, and sets the numbers of faces and points, after a check that the bytes can back them. */
bool zr_draco_set_faces(struct zr_draco *draco, uint64_t faces);
bool zr_draco_set_points(struct zr_draco *draco, uint64_t points);

/* ---- steps ---- */

/* draco_sequential.c: reads the faces of sequential connectivity. */
bool zr_draco_read_sequential(struct zr_draco *draco);

/* draco_edgebreaker.c: reads the faces of edgebreaker connectivity. Makes all tables and the points. */
bool zr_draco_read_edgebreaker(struct zr_draco *draco);

/* draco_seams.c: makes the table of an attribute from `base` with the seams is_seam[corner]. */
bool zr_draco_make_seams(struct zr_draco *draco, const bool *is_seam, struct zr_draco_corners *out);

/* draco_points.c: gives each corner a point. Corners of a vertex that no seam parts share one. */
bool zr_draco_make_points(struct zr_draco *draco);

/* draco_order.c: orders the vertices by a walk over the faces, depth first or by the degree of prediction. */
bool zr_draco_make_order(struct zr_draco *draco, const struct zr_draco_corners *of, bool by_degree,
                         struct zr_draco_order *out);

/* draco_predict.c: reads the integers of an attribute, for each value of its order. */
bool zr_draco_read_integers(struct zr_draco *draco, struct zr_draco_values *of);

/* draco_attribute.c: reads all attributes, after the connectivity. */
bool zr_draco_read_attributes(struct zr_draco *draco);

/* ---- draco_traversal.c: the symbols of edgebreaker connectivity ---- */

/* The sides at which a new face meets faces that are decoded: both, both after a split, left, right, none. */
enum zr_draco_symbol { ZR_DRACO_C, ZR_DRACO_S, ZR_DRACO_L, ZR_DRACO_R, ZR_DRACO_E, ZR_DRACO_NO_SYMBOL };

enum { ZR_DRACO_VALENCES = 6 };

struct zr_draco_traversal {
    bool by_valence;
    struct zr_draco_bits symbols;            /* if not by_valence */
    uint32_t *of_valence[ZR_DRACO_VALENCES]; /* symbols of each context, read from their ends */
    uint32_t left[ZR_DRACO_VALENCES];
    uint32_t *valences;           /* per vertex, of the faces so far */
    uint32_t context;             /* of the next symbol; ZR_DRACO_VALENCES: it is E */
    struct zr_draco_flags starts; /* a component starts at a face inside */
    struct zr_draco_flags seams[ZR_DRACO_ATTRIBUTES];
};

/* Reads the start of all codes. `vertices`: the most vertices that the faces may make. */
bool zr_draco_traversal_open(struct zr_draco *draco, bool by_valence, uint32_t vertices,
                             struct zr_draco_traversal *out);

/* Returns the next symbol, or ZR_DRACO_NO_SYMBOL. */
enum zr_draco_symbol zr_draco_traversal_next(struct zr_draco_traversal *of);

/* Counts the valences of the vertices of a new face. tip: the vertex opposite to the active edge. */
void zr_draco_traversal_add(struct zr_draco_traversal *of, enum zr_draco_symbol symbol, uint32_t tip, uint32_t next,
                            uint32_t previous);

/* Adds the valence of a vertex to that of the vertex that replaces it. */
void zr_draco_traversal_merge(struct zr_draco_traversal *of, uint32_t kept, uint32_t merged);

/* ---- draco_transform.c: how corrections are added to predicted values ---- */

/* Values within low .. high: a sum beyond them wraps around. */
struct zr_draco_wrap {
    int32_t low, high;
    uint32_t width;
};
bool zr_draco_wrap_read(struct zr_draco_stream *stream, uint32_t width, struct zr_draco_wrap *out);

/* Adds the predicted values to the corrections, in place. */
static inline void zr_draco_wrap_add(const struct zr_draco_wrap *of, const int32_t *predicted, int32_t *values)
{
    const uint32_t span = (uint32_t)of->high - (uint32_t)of->low + 1;
    for (uint32_t k = 0; k < of->width; k++) {
        const int32_t p = predicted[k] > of->high ? of->high : predicted[k] < of->low ? of->low : predicted[k];
        const uint32_t sum = (uint32_t)p + (uint32_t)values[k];
        values[k] = (int32_t)((int32_t)sum > of->high ? sum - span : (int32_t)sum < of->low ? sum + span : sum);
    }
}

/* Unit vectors on an octahedron that is unfolded to the square 0 .. 2 * center (Cigolle and others, A survey of
 * efficient representations for independent unit vectors, 2014). */
struct zr_draco_octahedron {
    int32_t center;
    bool is_canonical; /* corrections are turned to one quadrant */
};

/* Sets the square of `bits` bits. False if there is none. */
bool zr_draco_octahedron_set(uint32_t bits, struct zr_draco_octahedron *out);

bool zr_draco_octahedron_read(struct zr_draco_stream *stream, bool is_canonical, struct zr_draco_octahedron *out);

/* Adds a predicted point of the square to a correction, in place. */
void zr_draco_octahedron_add(const struct zr_draco_octahedron *of, const int32_t predicted[2], int32_t values[2]);

/* Finds the point of the square for a direction, or for the opposite one. Magnitudes are at most 2^29. */
void zr_draco_octahedron_point(const struct zr_draco_octahedron *of, bool is_flipped, const int32_t direction[3],
                               int32_t out[2]);

/* Finds the unit vector of a point of the square, in float32 as the reference decoder does. */
void zr_draco_octahedron_vector(const struct zr_draco_octahedron *of, const int32_t point[2], float out[3]);

/* Positions as integers: value i of an order is at integers[3 * of_value[i]]. */
struct zr_draco_positions {
    const int32_t *integers;
    const uint32_t *of_value;
};

/* draco_texcoords.c, draco_normal.c: read what the prediction needs, and add predictions from positions to corrections,
 * in place. */
bool zr_draco_predict_texcoords(struct zr_draco *draco, struct zr_draco_values *of,
                                const struct zr_draco_positions *positions);
bool zr_draco_predict_normals(struct zr_draco *draco, struct zr_draco_values *of, bool is_canonical,
                              const struct zr_draco_positions *positions);

#endif
