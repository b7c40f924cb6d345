/* part_features.h - mesh: features of the parts of a scene (scene/parts/part_list.h): holes, planes and others.
 *
 * Space:  world space, in double precision. A part that is closed and inside out is turned first.
 * Work:   counted in steps (mesh/features/surface.h). Each part has ZR_FEATURE_STEPS for each of its triangles, and an
 *         equal share of ZR_FEATURE_STEPS_MIN. A part that takes more, or more memory than is left, has no features.
 *         The parts of a mesh with more than ZR_FEATURE_FACES_MOST faces, some two seconds of work, have none either.
 * Exact:  holes are found by one thread and the rest by another, in a fixed order, without libm but for sqrt.
 */
#ifndef ZR_PART_FEATURES_H
#define ZR_PART_FEATURES_H

#include "base/run.h"
#include "core.h"
#include "mesh/facts/part_facts.h"
#include "mesh/features/borders.h"
#include "mesh/features/bounding_cylinder.h"
#include "mesh/features/holes.h"
#include "mesh/features/planes.h"
#include "mesh/features/symmetry.h"
#include "mesh/features/tunnels.h"

/* Steps for all parts together, and for each of their triangles: for holes, and as many for the rest. */
enum { ZR_FEATURE_FACES_MOST = 1 << 19, ZR_FEATURE_STEPS_MIN = 1 << 22, ZR_FEATURE_STEPS = 128 };

/* Bytes of scratch: per triangle, per position, and beside. */
enum { ZR_FEATURE_BYTES = 320, ZR_FEATURE_BYTES_OF_POSITION = 64, ZR_FEATURE_BYTES_LEAST = 8 << 20 };

/* Bytes for the features other than holes: per triangle, and a constant, which is doubled for many triangles. */
enum { ZR_FEATURE_BYTES_OF_REST = 64, ZR_FEATURE_BYTES_OF_REST_LEAST = 1 << 19 };

/* Reasons why holes are not searched. */
enum zr_feature_limit {
    ZR_FEATURE_LIMIT_NONE,
    ZR_FEATURE_LIMIT_FACES,
    ZR_FEATURE_LIMIT_MEMORY,
    ZR_FEATURE_LIMIT_STEPS
};

struct zr_part_features {
    double size;                 /* diagonal of the part's box */
    bool is_omitted;             /* too much work, or no memory for it: no features */
    enum zr_feature_limit limit; /* why, if omitted */
    uint64_t steps_most;         /* of the part; 0 if its search was not begun */
    struct zr_holes holes;
    struct zr_planes planes;
    struct zr_borders borders;
    struct zr_tunnels tunnels; /* not known if shells overlap */
    struct zr_bounding_cylinder cylinder;
    bool has_symmetry; /* false: too much work */
    struct zr_symmetry symmetry;
};

/* Fills in features[0 .. parts->count - 1], whose lists are in run->arena. `facts` has those of the parts. Fails with
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_part_features_find(const struct zr_run *run, const struct zr_scene *scene,
                                     const struct zr_part_list *parts, const struct zr_part_facts *facts,
                                     struct zr_part_features *features);

#endif
