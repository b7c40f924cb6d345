/* features.h - lines: which edges of the mesh are lines, before visibility.
 *
 * Border:   an edge of one triangle.
 * Contour:  of two triangles, one faces the eye and the other does not (by their planes). Three and more triangles all
 *           lie on one side of the edge in the window.
 * Crease:   the normals of the two triangles, and their smoothed ones (smooth_normal.h), differ by more than the crease
 *           angle (weak), or the smoothed ones by more than 1.5 times that angle (strong). Triangles wound against each
 *           other are turned first. Diagonals of polygons and noise of scans (mesh/noise_edges.h) are no creases. Given
 *           normals that agree within 10 degrees at both ends make an edge smooth, unless the rule ignores them.
 * Cut:      an edge of the cap of a section is a strong crease at any angle.
 * More:     an edge of three and more triangles is a strong crease, unless two of them go on within the crease angle
 *           and no other lies in front of both. Absent triangles (ZR_TRIANGLE_ABSENT) do not count. */
#ifndef ZR_FEATURES_H
#define ZR_FEATURES_H

#include "base/run.h"
#include "lines/window_mesh.h"

enum {
    ZR_FEATURE_BORDER = 1,
    ZR_FEATURE_CONTOUR = 2,
    ZR_FEATURE_WEAK = 4,
    ZR_FEATURE_STRONG = 8, /* with ZR_FEATURE_WEAK */
    ZR_FEATURE_CONVEX = 16,
    ZR_FEATURE_MORE = 32,   /* three and more triangles; with ZR_FEATURE_STRONG */
    ZR_FEATURE_CUT = 64,    /* of a cap; with ZR_FEATURE_STRONG, or with ZR_FEATURE_BORDER */
    ZR_FEATURE_SMOOTH = 128 /* a border of a triangle whose normals of the file count; with ZR_FEATURE_BORDER */
};

struct zr_feature_rule {
    float crease_degrees;
    bool ignores_normals; /* given normals make no edge smooth */
    bool keeps_noise;     /* normals are not smoothed, and no edge is noise */
};

/* Returns the bits of each edge, numbered through all instances. NULL if the arena failed. If cancelled, they are
 * undefined. */
uint8_t *zr_features_find(const struct zr_run *run, const struct zr_window_mesh *mesh,
                          const struct zr_feature_rule *rule);

#endif
