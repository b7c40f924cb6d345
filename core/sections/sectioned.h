/* sectioned.h - sections: one mesh, cut open by the planes of a section.
 *
 * Space:  object space; planes in double (slices.h).
 * What:   kept faces stay as they are. Faces that a plane crosses become pieces; their corners get interpolated
 *         texture coordinates, colours, tangents and normals. Closed parts get caps, one face per part and plane, as
 * the last faces of the mesh. Lines are clipped, and points are kept or dropped. Planes: without `is_corner`, what all
 * planes keep is kept. With it, only what all planes cut away is removed.
 */
#ifndef ZR_SECTIONED_H
#define ZR_SECTIONED_H

#include "base/run.h"
#include "sections/slices.h"

struct zr_sectioned {
    struct zr_mesh mesh;
    /* Per face, line and point of the mesh: its number in the whole mesh, counted over faces, lines and points. Caps:
     * the number of these, and then the number of the cap. */
    const uint32_t *numbers;
    const struct zr_slice_cap *caps; /* per cap */
    const uint32_t *cap_numbers;     /* per face from the first cap on: its number in `caps` */
};

/* Side of a mesh. */
enum zr_section_side { ZR_SECTION_WHOLE, ZR_SECTION_CUT, ZR_SECTION_GONE };

/* Returns whether all positions of the mesh are kept, some or none. If cancelled, returns any of these. */
enum zr_section_side zr_section_side_of(const struct zr_section_cut *cut, const struct zr_mesh *mesh,
                                        const struct zr_cancel *cancel);

/* Makes the sectioned mesh; `parts`: per part of the mesh, ZR_SLICE_OPEN and so on. All positions have w > 0. Results
 * lie in the arena. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_sectioned_make(const struct zr_run *run, const struct zr_mesh *mesh, const uint8_t *parts,
                                 const struct zr_section_cut *cut, struct zr_sectioned *out);

#endif
