/* batch.h - geometry: runs of records, whose numbers lead to what they show (record.h).
 *
 * Most records are triangles of a mesh as it is: they are never written out. A batch says where their
 * corners stand, so that a record is the triangle's number and nothing else. Records that are more
 * than that (pieces of clipped triangles, lines, parts of shapes) are written out as zr_triangle.
 * Numbers keep the order of the scene, over all batches: of two records at the same depth
 * the one with the smaller number is seen.
 */
#ifndef ZR_BATCH_H
#define ZR_BATCH_H

#include <stddef.h>

#include "geometry/viewport.h"
#include "scene/scene.h"

/* A record: one thing with one plane for each of its attributes, and one owner of pixels.
 * Most are triangles, oriented so that the reference's area (rule 6) is positive. */
struct zr_triangle {
    uint32_t v[3];       /* window vertices; of a line two, v[2] being v[1] again */
    uint32_t c[3];       /* colours; all three the same: flat */
    uint32_t face;       /* id of the polygon or line: 1 + its number over all instances */
    uint32_t back : 1;   /* seen from behind, so its colours are the back ones */
    uint32_t line : 1;   /* from v[0] to v[1], one pixel wide */
    uint32_t pushed : 1; /* moved back by a depth offset, so that outlines are seen on it */
    uint32_t turned : 1; /* corner 0 has changed places, by rule 6 (zr_swapped_corner) */
    uint32_t shape : 28; /* 0: the triangle is seen wherever it covers a sample. Else 1 + the number
                          * of the shape that it is a part of */
};

/* How a triangle of a mesh finds its colours. */
enum zr_batch_rate {
    ZR_BATCH_PER_FACE,         /* flat: colour f for face f */
    ZR_BATCH_PER_FIRST_CORNER, /* flat: that of the position of the face's first corner */
    ZR_BATCH_PER_FIRST_SLOT,   /* flat: that of the first corner's slot in mesh->indices */
    ZR_BATCH_PER_VERTEX,       /* smooth: that of each corner's position */
    ZR_BATCH_PER_CORNER,       /* smooth: that of each corner's slot in mesh->indices */
    ZR_BATCH_UNCOLORED         /* there are none, since no colour picture is wanted */
};

/* Words for samples of the batch's triangles, which raster/ carries along beside owners and knows nothing of: those who
 * shade find them done. Worked out while corners are at hand, by a kernel for as many triangles as it has lanes.
 * numbers: of the triangles; corners: [corner][x, y, 1/w][triangle] as they stand in the mesh, bit i of `turned`: two
 * of triangle i are to change places (rule 6). Samples: of which triangle each is (NULL: sample i of triangle i), and
 * where in the window; what follows the last one may be read, and written, a vector at a time. A word is never 0. */
struct zr_batch;
typedef void zr_payload_fn(const struct zr_batch *batch, const uint32_t *numbers, uint32_t turned, const float *corners,
                           const uint32_t *triangles, const float *x, const float *y, uint32_t count, uint32_t *words);

struct zr_batch {
    uint32_t first, count; /* numbers of its records */
    uint32_t instance;     /* that all of them are of */

    bool written;          /* records first_record, and so on, of the geometry */
    bool plain;            /* all are triangles, neither pushed nor parts of shapes */
    uint32_t first_record; /* where written */

    /* Else, triangles of one instance of a mesh, all inside the view volume, in one material. */
    const struct zr_mesh *mesh;
    const uint32_t *corners; /* three a triangle: positions of the mesh */
    const uint32_t *slots;   /* three a triangle, into mesh->indices; NULL: as in a mesh of triangles */
    const uint32_t *faces;   /* of the mesh, one a triangle; NULL: first_face and those that follow */
    uint32_t first_face;
    uint32_t first_id;     /* of face 0 */
    uint32_t first_vertex; /* of position 0 */
    enum zr_batch_rate colors;
    const zr_vec4 *front, *back; /* NULL where there are only packed ones, or none */
    const uint32_t *packed; /* of a flat batch, as zr_rgba_opaque: its fronts and, where it is sided, behind them its
                               backs; NULL: not made */
    uint32_t color_count;   /* fronts: those of all the mesh */
    bool sided;             /* backs are drawn, in colours of their own */
    uint32_t *backs;        /* of a flat batch that is sided: bit t % 32 of backs[t / 32] where triangle t shows its
                               back, known when it is sorted (raster/bins.h); of those that are seen */
    bool mirrored, double_sided;
    const struct zr_material *material; /* where not written */

    /* For the channel of them, and for what is shaded pixel by pixel; NULL where nothing needs them. */
    const zr_vec4 *normals; /* eye_normals.h */
    enum zr_batch_rate normals_rate;

    zr_payload_fn *payload; /* tiny and small triangles get words when they are drawn; NULL: none */
};

/* The face of triangle `t` of a batch that is not written. */
static inline uint32_t zr_batch_face(const struct zr_batch *batch, uint32_t t)
{
    return batch->faces ? batch->faces[t] : batch->first_face + t;
}

/* Which colour corner `k`, 0..2, of triangle `t` of a smooth batch has. Where many are asked for, all the cases below
 * take a tenth of the time of sorting a million triangles. */
static inline uint32_t zr_batch_corner_color(const struct zr_batch *batch, uint32_t t, uint32_t k)
{
    if (batch->colors == ZR_BATCH_PER_VERTEX) return batch->corners[3 * (size_t)t + k];
    return batch->slots ? batch->slots[3 * (size_t)t + k] : 3 * (batch->first_face + t) + k;
}

/* Which value of what varies at this rate corner `k` of triangle `t` has. */
static inline uint32_t zr_batch_value(const struct zr_batch *batch, enum zr_batch_rate rate, uint32_t t, int k)
{
    const struct zr_mesh *mesh = batch->mesh;
    switch (rate) {
    case ZR_BATCH_PER_FACE:
        return zr_batch_face(batch, t);
    case ZR_BATCH_PER_FIRST_CORNER:
        if (!batch->faces) return batch->corners[3 * (size_t)t];
        return mesh->indices[mesh->face_offsets[zr_batch_face(batch, t)]];
    case ZR_BATCH_PER_FIRST_SLOT:
        return mesh->face_offsets[zr_batch_face(batch, t)];
    case ZR_BATCH_PER_VERTEX:
        return batch->corners[3 * (size_t)t + (size_t)k];
    case ZR_BATCH_PER_CORNER:
        return batch->slots ? batch->slots[3 * (size_t)t + (size_t)k] : 3 * (batch->first_face + t) + (uint32_t)k;
    case ZR_BATCH_UNCOLORED:
        break;
    }
    return 0;
}

static inline uint32_t zr_batch_color(const struct zr_batch *batch, uint32_t t, int k)
{
    return zr_batch_value(batch, batch->colors, t, k);
}

static inline bool zr_batch_is_smooth(const struct zr_batch *batch)
{
    return batch->colors == ZR_BATCH_PER_VERTEX || batch->colors == ZR_BATCH_PER_CORNER;
}

/* Where painting looks first for the colours of triangle 0; those of each one behind it are `step` bytes farther. */
struct zr_batch_lookup {
    uintptr_t first;
    size_t step;
};

static inline struct zr_batch_lookup zr_batch_lookup(const struct zr_batch *batch)
{
    const size_t word = sizeof(uint32_t);
    if (batch->written || batch->colors == ZR_BATCH_UNCOLORED)
        return (struct zr_batch_lookup){(uintptr_t)batch, 0}; /* which is at hand: nothing to ask for */
    if (zr_batch_is_smooth(batch)) return (struct zr_batch_lookup){(uintptr_t)batch->corners, 3 * word};
    if (batch->faces) return (struct zr_batch_lookup){(uintptr_t)batch->faces, word};
    if (batch->colors == ZR_BATCH_PER_FIRST_CORNER)
        return (struct zr_batch_lookup){(uintptr_t)batch->corners, 3 * word};
    if (batch->colors == ZR_BATCH_PER_FIRST_SLOT)
        return (struct zr_batch_lookup){(uintptr_t)(batch->mesh->face_offsets + batch->first_face), word};
    if (batch->packed) return (struct zr_batch_lookup){(uintptr_t)(batch->packed + batch->first_face), word};
    return (struct zr_batch_lookup){(uintptr_t)(batch->front + batch->first_face), sizeof *batch->front};
}

/* Of triangles t and so on, a bit each, all in one word. */
static inline void zr_batch_add_backs(const struct zr_batch *batch, uint32_t t, uint32_t backs)
{
    batch->backs[t / 32] |= backs << t % 32;
}

static inline bool zr_batch_holds(const struct zr_batch *batch, uint32_t number)
{
    return number - batch->first < batch->count;
}

#endif
