/* feature_at.h - mesh: the feature of a part on which a place lies: a hole, a boss or a large plane.
 *
 * Hole:  the place lies on its wall, as far from the axis as the facets are, between the ends, and the normal is
 *        square to the axis; on a cone of its steps, the normal has the cone's angle.
 * Plane: the place lies on it, and the normals agree.
 * Order: holes, then bosses, then planes; the first one that fits. */
#ifndef ZR_FEATURE_AT_H
#define ZR_FEATURE_AT_H

#include <stdint.h>

struct zr_part_features;

enum zr_feature_kind { ZR_FEATURE_NONE, ZR_FEATURE_HOLE, ZR_FEATURE_BOSS, ZR_FEATURE_PLANE };

struct zr_feature_at {
    enum zr_feature_kind kind;
    uint32_t number; /* in its list of the part */
    uint32_t step;   /* of a hole or boss: 0 is the cylinder itself, else 1 + number of the step */
};

/* `at` and the unit normal, which may look either way, are in world space. */
struct zr_feature_at zr_feature_find_at(const struct zr_part_features *features, const double at[3],
                                        const double normal[3]);

#endif
