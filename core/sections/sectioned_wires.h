/* sectioned_wires.h - sections: the lines and points of a mesh that is cut open.
 *
 * Space:  object space; planes in double (slices.h). What lies on a plane counts as cut away. */
#ifndef ZR_SECTIONED_WIRES_H
#define ZR_SECTIONED_WIRES_H

#include "base/run.h"
#include "sections/slices.h"

struct zr_wires {
    uint32_t line_count, point_count, end_count;
    uint32_t *lines;            /* two per line: positions of the mesh, and then made ends */
    uint32_t *line_numbers;     /* per line: its number in the mesh */
    uint32_t *points;           /* positions of the mesh */
    uint32_t *point_numbers;    /* per point: its number in the mesh */
    struct zr_mesh_blend *ends; /* made ends, between two positions */
};

/* Clips the lines and selects the points. Results lie in the arena. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_wires_cut(const struct zr_run *run, const struct zr_mesh *mesh, const struct zr_slice_plane *planes,
                            uint32_t plane_count, bool is_corner, struct zr_wires *wires);

/* Gives lines and points to the mesh `out`, whose made ends begin at position `first_end`. Writes the numbers of lines
 * and points among faces, lines and points of `mesh`. */
void zr_wires_put(const struct zr_wires *wires, const struct zr_mesh *mesh, uint32_t first_end, uint32_t *numbers,
                  struct zr_mesh *out);

#endif
