/* record.h - geometry: from a record's number to what it shows. */
#ifndef ZR_RECORD_H
#define ZR_RECORD_H

#include "geometry/geometry.h"

/* The batch of a record. Takes the logarithm of their count. */
const struct zr_batch *zr_batch_of(const struct zr_geometry *geometry, uint32_t number);

/* The same where it is most often the batch of the record before. */
static inline const struct zr_batch *zr_batch_next(const struct zr_geometry *geometry, const struct zr_batch *last,
                                                   uint32_t number)
{
    return zr_batch_holds(last, number) ? last : zr_batch_of(geometry, number);
}

/* A record as the shading of single pixels wants it: its colours, and its corners turned as rule 6 wants them. Where
 * it is not written out, c[] counts from the batch's own front and back. */
struct zr_record {
    struct zr_triangle triangle;
    const zr_vec4 *colors;  /* of the side that is seen: triangle.c indexes it */
    const zr_vec4 *normals; /* of fronts: n[] indexes it; NULL where there are none */
    uint32_t n[3];
    const struct zr_material *material;
};

/* Id of the face of a record. */
uint32_t zr_face_id(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number);

struct zr_record zr_record_of(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number);

#endif
