/* lens.h - scene: distortion of a lens, as OpenCV models it, and its inverse.
 *
 * Space:  undistorted points (x, y) are those of a pinhole at depth 1, x to the right and y down: x = X / Z, y = Y / Z.
 *         The intrinsics map distorted points to pixels.
 * Domain: from the axis up to a fold, from which on points move back towards the axis, or up to ZR_LENS_DEGREES_MAX.
 *         Distorted points outside of its image have no ray.
 * Exact:  doubles in a stated order, without libm, so that every machine gets the same bits.
 * Source: OpenCV 4, calib3d: projectPoints and fisheye::projectPoints. With r^2 = x^2 + y^2:
 *         opencv:  g = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6),
 *                  x' = g x + 2 p1 x y + p2 (r^2 + 2 x^2), y' = g y + p1 (r^2 + 2 y^2) + 2 p2 x y.
 *         fisheye: a = atan(r), x' = x / r * a (1 + k1 a^2 + k2 a^4 + k3 a^6 + k4 a^8), and y' likewise.
 */
#ifndef ZR_LENS_H
#define ZR_LENS_H

#include <stdbool.h>

#include "scene/view.h"

/* Rays farther from the axis have no place in a pinhole picture. */
#define ZR_LENS_DEGREES_MAX 80

enum { ZR_LENS_STEPS = 1024 };

/* Tables for the inverse of a lens. The parameter t of its radial part is r, or the angle a of a fisheye. */
struct zr_lens_inverse {
    struct zr_lens lens;
    bool is_folded;                  /* the domain ends at a fold, else at ZR_LENS_DEGREES_MAX */
    double most;                     /* t at the end of the domain */
    double far;                      /* distorted radius there, without p1 and p2 */
    double steps;                    /* ZR_LENS_STEPS / far */
    double margin;                   /* bound of the displacement by p1 and p2 */
    double table[ZR_LENS_STEPS + 1]; /* t at distorted radii i / ZR_LENS_STEPS * far */
};

enum zr_lens_end { ZR_LENS_RAY, ZR_LENS_FOLDED, ZR_LENS_WIDE };

/* A ray of the pinhole, and d(x', y') / d(x, y) there: the rows xx, xy and yx, yy, of which xy = yx. */
struct zr_lens_ray {
    enum zr_lens_end end; /* ZR_LENS_FOLDED: no ray; ZR_LENS_WIDE: beyond ZR_LENS_DEGREES_MAX; the rest is not set */
    double x, y;
    double xx, xy, yy;
};

void zr_lens_invert(const struct zr_lens *lens, struct zr_lens_inverse *inverse);

/* Finds the ray of a distorted point. Thread-safe. */
struct zr_lens_ray zr_lens_undistort(const struct zr_lens_inverse *inverse, double x, double y);

#endif
