/* part_changes.h - measure: parts of two models that were added, removed, moved or changed.
 *
 * Same:   parts of one name (scene/parts/part_list.h).
 * Moved:  area and volume are the same to a millionth, and the middle of the surface or the box is at another place.
 * Changed: area or volume differ.
 */
#ifndef ZR_PART_CHANGES_H
#define ZR_PART_CHANGES_H

#include "measure/solid.h"
#include "scene/parts/part_list.h"

/* Parts of a model that are compared, and changes that are listed. */
enum { ZR_PART_CHANGES_PARTS = 4096, ZR_PART_CHANGES_MAX = 256 };

enum zr_part_change_kind { ZR_PART_REMOVED, ZR_PART_ADDED, ZR_PART_MOVED, ZR_PART_CHANGED };

struct zr_part_change {
    enum zr_part_change_kind kind;
    const char *name;
    double by[3]; /* moved: from the middle of its surface in a to that in b */
};

struct zr_part_changes {
    uint32_t count, omitted; /* omitted: beyond ZR_PART_CHANGES_MAX */
    const struct zr_part_change *at;
};

/* Lists the changes in the arena, by the order of parts in a, then in b. `tolerance`: moves up to it count as none.
 * Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_part_changes_find(const struct zr_run *run, const struct zr_solid *a,
                                    const struct zr_part_list *parts_a, const struct zr_solid *b,
                                    const struct zr_part_list *parts_b, double tolerance, struct zr_part_changes *out);

#endif
