/* align.h - measure: lays one model on another one, by rigid motions.
 *
 * bounds:    the middles of the boxes.
 * principal: axes of the second moments of the volume, or of an open surface: 4 turns; if two moments are equal to 2 %,
 *            36 angles around the third axis, both ways up; if all are, the 24 turns of a cube. The nearest ones, by
 *            points of the second model, are refined as by icp.
 * icp:       refines the given place alone: points to planes of the nearest triangles (Chen and Medioni, 1992). Pairs
 *            beyond two and a half times the median distance do not count, so that a changed feature moves nothing.
 * Identity:  the given place wins unless another one is 5 % better.
 * Symmetric: places within 5 % of the best one are listed as ambiguous.
 * Scaled:    only if allowed: sizes are made equal before, by the diagonals of the boxes, or by the moments. Refining
 *            then scales, too.
 * Mirrored:  reflections are never taken; is_mirrored says that one would be much better.
 * Work:      counted in steps of searching; beyond ZR_ALIGN_STEPS nothing is moved.
 * Exact:     one thread, without libm but for sqrt.
 */
#ifndef ZR_ALIGN_H
#define ZR_ALIGN_H

#include "measure/rigid.h"
#include "measure/surface_tree.h"

enum zr_align { ZR_ALIGN_NONE, ZR_ALIGN_BOUNDS, ZR_ALIGN_PRINCIPAL, ZR_ALIGN_ICP };

/* Their names, by enum zr_align. */
extern const char *const zr_align_words[4];

enum { ZR_ALIGN_STEPS = 1 << 28, ZR_ALIGN_AMBIGUOUS_MAX = 8 };

struct zr_alignment {
    struct zr_rigid motion; /* of places of b */
    double scale;           /* of it; 0: it may not scale */
    double before, after;   /* root of the mean square distance of points of b from a */
    bool is_omitted;        /* too much work: nothing is moved */
    bool is_mirrored;
    uint32_t ambiguous_count; /* other motions that are as good */
    struct zr_rigid ambiguous[ZR_ALIGN_AMBIGUOUS_MAX];
};

/* Finds the motion that lays b, whose places are relative to the same middle, on the solid of `a`. Takes scratch from
 * the arena and gives it back. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_align_find(const struct zr_run *run, const struct zr_surface_tree *a, const struct zr_solid *b,
                             enum zr_align kind, bool can_scale, struct zr_alignment *out);

/* Returns the scaling around its middle that makes b as large as a. */
struct zr_rigid zr_align_size(const struct zr_solid *a, const struct zr_solid *b, enum zr_align kind,
                              const struct zr_cancel *cancel);

/* Moves a solid, and its area, volume and diagonal if it is scaled. If cancelled, returns early, and the solid is
 * undefined. */
void zr_align_move(struct zr_solid *solid, const struct zr_rigid *motion, const struct zr_cancel *cancel);

#endif
