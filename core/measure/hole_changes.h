/* hole_changes.h - measure: holes that one of two solids has alone, or that are at another place or of another size.
 *
 * Holes:   those of mesh/features/holes.h, on all triangles of a solid together.
 * Equal:   diameter and depth differ by at most a thousandth, axes by at most half a degree, and places by at most
 *          `tolerance`, or a hundred-thousandth of the diagonal.
 * Changed: of another size around the same axis. The nearest of the rest that have one size are moved, whatever their
 *          distance.
 * Box:     around the cylinder, and if it is moved, around both.
 * Work:    solids of more than ZR_FEATURE_FACES_MOST triangles, or whose holes take more steps or memory than those of
 *          a part may (mesh/features/part_features.h), have none: is_omitted.
 * Exact:   the same for all numbers of threads.
 */
#ifndef ZR_HOLE_CHANGES_H
#define ZR_HOLE_CHANGES_H

#include "base/run.h"
#include "base/status.h"
#include "measure/solid.h"
#include "mesh/features/holes.h"

/* Holes of a solid that are compared, and changes that are listed. */
enum { ZR_HOLE_CHANGES_HOLES = 2048, ZR_HOLE_CHANGES_MAX = 256 };

enum zr_hole_change_kind { ZR_HOLE_REMOVED, ZR_HOLE_ADDED, ZR_HOLE_MOVED, ZR_HOLE_CHANGED, ZR_HOLE_CHANGE_KINDS };

struct zr_hole_change {
    enum zr_hole_change_kind kind;
    struct zr_hole a, b; /* that of the first and of the second solid; 0 if there is none */
    double min[3], max[3];
};

struct zr_hole_changes {
    bool is_omitted;         /* the rest is 0 */
    uint32_t equal;          /* holes that both have */
    uint32_t count, omitted; /* omitted: beyond ZR_HOLE_CHANGES_MAX */
    const struct zr_hole_change *at;
};

/* Lists the changes in the arena, whose places are relative to the middle of both solids: those of a by its holes, then
 * holes that b alone has. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_hole_changes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                    double tolerance, struct zr_hole_changes *out);

#endif
