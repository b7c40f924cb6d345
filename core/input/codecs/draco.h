/* draco.h - input: decodes meshes of the Draco bitstream, version 2.2 (Google, 2018), as KHR_draco_mesh_compression
 * stores them. Source: its specification, docs/spec of github.com/google/draco.
 *
 * Read:    meshes with sequential or edgebreaker connectivity, standard or by valences. Others are refused by name:
 * point clouds, other versions, predictive connectivity, and predictions that version 2.2 does not write. Order:
 * points, faces and corners have the order of the reference decoder. Bounds:  ZR_DRACO_PER_BYTE faces or points per
 * compressed byte, then the ceiling of the arena, before memory is allocated. Time is linear in bytes, corners and
 * values. Threads: one call uses one arena. */
#ifndef ZR_DRACO_H
#define ZR_DRACO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "input/text/text.h"

enum { ZR_DRACO_PER_BYTE = 2048, ZR_DRACO_ATTRIBUTES = 32, ZR_DRACO_WIDTH = 16 };

/* Types of numbers, as the bitstream counts them. */
enum zr_draco_type {
    ZR_DRACO_INT8 = 1,
    ZR_DRACO_UINT8,
    ZR_DRACO_INT16,
    ZR_DRACO_UINT16,
    ZR_DRACO_INT32,
    ZR_DRACO_UINT32,
    ZR_DRACO_FLOAT32 = 9
};

struct zr_draco_attribute {
    uint32_t id; /* the unique id that other files refer to */
    int type;    /* enum zr_draco_type */
    uint32_t width;
    bool is_normalized;
    const unsigned char *values; /* per point: `width` numbers, packed, in little-endian order */
};

struct zr_draco_mesh {
    uint32_t point_count, face_count;
    const uint32_t *corners; /* three points per face, each below point_count */
    uint32_t attribute_count;
    struct zr_draco_attribute attributes[ZR_DRACO_ATTRIBUTES];
};

/* Returns the bytes of a number, or 0 for other types. */
size_t zr_draco_type_bytes(int type);

/* Decodes a mesh to new arrays of the arena. False with the reason; without one if memory is lacking or if cancelled.
 */
bool zr_draco_decode(struct zr_arena *arena, const struct zr_cancel *cancel, const void *bytes, size_t size,
                     struct zr_draco_mesh *out, struct zr_reason *reason);

#endif
