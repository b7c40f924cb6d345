/* links.h - lines: joins ends of segments that meet in the window.
 *
 * How:    ends within 1/32 pixel of the first end of a node belong to the node. At each node, ends of the same class
 *         are linked, the straightest pair first, if the line turns by at most 80 degrees there. Where a node has two
 *         ends of a class only, they are linked at any turn.
 * Exact:  ties go to the lower numbers. */
#ifndef ZR_LINKS_H
#define ZR_LINKS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "core.h"
#include "lines/window_view.h"

/* End k of segment s has the number 2 s + k. */
struct zr_segment {
    struct zr_window_point ends[2];
    uint32_t class; /* only ends of one class are linked */
};

#define ZR_NO_END UINT32_MAX

#define ZR_NODE_PIXELS (1.0 / 32.0)

enum { ZR_NODE_ENDS_MOST = 32 /* ends at a node; if there are more, none are linked */ };

struct zr_links {
    const uint32_t *nodes; /* by end: its node, numbered in the order of ends */
    uint32_t node_count;
    uint32_t *ends; /* by end: the end that it is linked to, or ZR_NO_END */
};

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_links_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_segment *segments,
                             uint32_t count, struct zr_links *out);

/* Returns the end at which a walk along the links begins, for a walk that visits the segment: an end without a link, or
 * in a ring the lower end of the segment. */
uint32_t zr_links_first(const struct zr_links *links, uint32_t segment);

/* Returns the next end of a walk: entering a segment at `end`, it leaves at the other one. ZR_NO_END: the walk ends. */
static inline uint32_t zr_links_next(const struct zr_links *links, uint32_t end)
{
    return links->ends[end ^ 1u];
}

#endif
