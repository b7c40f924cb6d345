/* sectioned_attributes.h - sections: corners, positions and their attributes while a sectioned mesh is made; for
 * sectioned*.c.
 *
 * Space:  object space. Corners are numbered as in slices.h. */
#ifndef ZR_SECTIONED_ATTRIBUTES_H
#define ZR_SECTIONED_ATTRIBUTES_H

#include "sections/sectioned_wires.h"

enum { ZR_SECTIONING_CANCEL_CHECK = 1 << 14 };

/* Lists of faces: those of uncut parts, and the kept ones with their caps. */
enum { ZR_LIST_UNCUT, ZR_LIST_KEPT, ZR_LISTS };

/* The kept faces, and arrays of the new mesh. */
struct zr_sectioning {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    const struct zr_mesh *mesh;
    const struct zr_section_cut *cut;
    struct zr_slices slices;
    struct zr_slice_faces lists[ZR_LISTS];
    uint32_t face_count, ring_count, corner_count;
    struct zr_wires wires;
    /* of the new mesh */
    uint32_t *offsets, *face_rings, *ring_offsets, *indices, *corners, *numbers, *cap_numbers, *cap_planes;
};

/* Returns true once per ZR_SECTIONING_CANCEL_CHECK corners if the request is cancelled; results are then not used. */
static inline bool zr_sectioning_stops(const struct zr_sectioning *m, uint32_t number)
{
    return number % ZR_SECTIONING_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel);
}

/* Returns the position of a corner in the new mesh. */
static inline uint32_t zr_sectioning_position(const struct zr_sectioning *m, uint32_t corner)
{
    return corner < m->slices.slot_count ? m->mesh->indices[corner]
                                         : m->mesh->position_count + (corner - m->slices.slot_count);
}

/* Sets the attributes of positions, corners and faces of the new mesh, whose faces and caps are listed. False: the
 * arena has no memory. If cancelled, they may be undefined. */
bool zr_sectioned_attributes_make(const struct zr_sectioning *m, struct zr_mesh *out);

#endif
