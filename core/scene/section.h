/* section.h - scene: planes that cut the scene open, as requested (resolved by sections/section_planes.h).
 *
 * Space:  world space.
 */
#ifndef ZR_SECTION_H
#define ZR_SECTION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

enum { ZR_SECTION_PLANES_MAX = 6 };

/* Side of a plane that stays. */
enum zr_section_keep {
    ZR_SECTION_KEEP_FAR,      /* the one away from the camera */
    ZR_SECTION_KEEP_POSITIVE, /* the one that the normal, or the axis, points to */
    ZR_SECTION_KEEP_NEGATIVE,
    ZR_SECTION_KEEPS
};

struct zr_section {
    enum zr_section_keep keep;
    double normal[3]; /* of any length but 0 */
    bool has_fraction;
    double fraction; /* along the bounds of the scene, where the normal is an axis; 0..1 */
    double point[3]; /* without a fraction: a point of the plane */
};

struct zr_sections {
    uint32_t count; /* 0: nothing is cut */
    struct zr_section planes[ZR_SECTION_PLANES_MAX];
    bool is_corner; /* only what all planes cut away is removed; else what any of them cuts away */
    bool has_hatch; /* caps are hatched */
    uint32_t uncut_count;
    const char *const *uncut; /* names of parts that stay whole, UTF-8 */
};

#endif
