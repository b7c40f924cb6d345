/* comparison.h - measure: what two models share and where they differ, in numbers.
 *
 * Space:  that of the first file (measure/solid.h). Lengths are in its unit.
 * Closed: volumes, IoU and signs of distances need closed surfaces. Without them, boxes, areas and distances without
 *         sign are left; a warning names the rest.
 * Same:   no place of either surface is farther from the other one than the tolerance. Without distances,
 *         as without deviation (measure/deviation.h), closed solids are the same if they share their whole volume.
 * Exact:  the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_COMPARISON_H
#define ZR_COMPARISON_H

#include "base/warning_list.h"
#include "measure/align.h"
#include "measure/deviation.h"
#include "measure/hole_changes.h"
#include "measure/part_changes.h"
#include "measure/regions.h"
#include "measure/volumes.h"

/* The default tolerance, relative to the diagonal of the first model. */
#define ZR_COMPARISON_SAME 1e-6

/* Intervals up to this thickness are in no region of change, relative to the diagonal, or up to the tolerance. */
#define ZR_COMPARISON_THIN 1e-5

/* Distances up to this share of the diagonal count as near for F1. */
#define ZR_COMPARISON_NEAR 0.01

struct zr_comparison_options {
    double tolerance; /* negative: the default */
    bool is_quick;    /* fewer rays and points */
    bool is_drawn;    /* zr_comparison has trees, for a picture */
    bool has_no_deviation, has_no_features;
    enum zr_align align;
    bool can_scale; /* the alignment */
};

struct zr_comparison {
    struct zr_solid a, b;
    struct zr_surface_tree trees[2]; /* of a and b, if something needs them */
    enum zr_align align;
    struct zr_alignment alignment; /* b is moved by it */
    double silhouettes[3];         /* IoU of the silhouettes along the axes of the file (silhouettes.h) */
    bool has_volumes;              /* both are closed */
    struct zr_volumes volumes;
    struct zr_deviation a_to_b, b_to_a;
    bool has_deviation;
    double hausdorff;                     /* larger of both largest distances */
    struct zr_world_place hausdorff_at;   /* there */
    double chamfer, chamfer_square;       /* sums of both mean distances, and of both mean squares */
    double threshold, f1;                 /* of points whose normals are alike (deviation.h) */
    double normal_consistency, tolerance; /* tolerance: as given or by default */
    bool is_same;
    struct zr_regions regions;                /* if has_volumes */
    const char *region_parts[ZR_REGIONS_MAX]; /* names of the parts that the regions belong to */
    bool has_parts;                           /* one of the models has several parts */
    struct zr_part_changes parts;
    struct zr_hole_changes holes;
    struct zr_warning_list warnings; /* of comparing; those of the scenes are not among them */
};

/* Compares the faces of two scenes. The solids stay in the arena; scratch is given back. The team may be NULL. Fails
 * with ZR_BAD_SCENE if one of them has no faces, or combined solids (scene/csg.h), or with ZR_NO_MEMORY or ZR_CANCELLED;
 * *run->error explains the first. */
enum zr_status zr_comparison_make(const struct zr_run *run, const struct zr_scene *a, const struct zr_scene *b,
                                  const struct zr_comparison_options *options, struct zr_comparison *out);

#endif
