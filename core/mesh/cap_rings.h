/* cap_rings.h - mesh: groups the rings of a cap into polygons with holes.
 *
 * Space:  object space, projected along the axis that is nearest to the normal of ring 0; in double.
 * Why:    triangulation fills by parity, and a cap by the non-zero rule. Rings of solids that overlap within one part
 *         cross one another. Each solid by itself is filled by parity.
 * How:    a ring that turns as ring 0 begins a group. Any other ring is a hole of the smallest of these that contains
 *         it, by most of three of its points, and of which no earlier hole contains it or coincides with it: bores of two
 *         solids at one place are holes of both. A hole outside of all is a group of its own. */
#ifndef ZR_CAP_RINGS_H
#define ZR_CAP_RINGS_H

#include "base/cancel.h"
#include "scene/scene.h"

/* Sets groups[r] to the ring that begins the group of ring r: r itself, or a ring with a larger area. Rings of a group
 * are not consecutive. If cancelled, groups may be too small. */
void zr_cap_rings_group(const struct zr_mesh *mesh, const struct zr_rings *rings, const struct zr_cancel *cancel,
                        uint32_t *groups);

#endif
