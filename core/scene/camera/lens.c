#include "scene/camera/lens.h"

#include <math.h>

#include "base/trig.h"

/* Tangent of ZR_LENS_DEGREES_MAX, and the angle in radians. */
static const double TANGENT_MAX = 5.6712818196177095;
static const double ANGLE_MAX = 1.3962634015954636;

/* A step of Newton's method of this length leaves an error of about its square. */
static const double LAST_STEP = 1e-9;

/* ---- the radial part ---- */

/* Distorted radius at t, and its derivative; `defined` is false at and beyond a pole. */
struct radius {
    bool defined;
    double value, slope;
};

static inline struct radius fisheye_radius(const double *k, double t)
{
    const double s = t * t;
    return (struct radius){true, t * (1.0 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))),
                           1.0 + s * (3.0 * k[0] + s * (5.0 * k[1] + s * (7.0 * k[2] + s * (9.0 * k[3]))))};
}

/* The factor g of the model opencv, and its derivative by r^2. */
struct factor {
    double below, g, slope;
};

static inline struct factor factor_of(const double *k, double s)
{
    if (k[3] == 0.0 && k[4] == 0.0 && k[5] == 0.0) /* the same bits, without the divisions */
        return (struct factor){1.0, 1.0 + s * (k[0] + s * (k[1] + s * k[2])),
                               k[0] + s * (2.0 * k[1] + s * (3.0 * k[2]))};
    const double above = 1.0 + s * (k[0] + s * (k[1] + s * k[2])), below = 1.0 + s * (k[3] + s * (k[4] + s * k[5]));
    const double rise = k[0] + s * (2.0 * k[1] + s * (3.0 * k[2])),
                 rise_below = k[3] + s * (2.0 * k[4] + s * (3.0 * k[5]));
    const double g = above / below;
    return (struct factor){below, g, (rise - g * rise_below) / below};
}

static inline struct radius radius_at(const struct zr_lens *lens, double t)
{
    if (lens->model == ZR_LENS_FISHEYE) return fisheye_radius(lens->k, t);
    const struct factor f = factor_of(lens->k, t * t);
    return (struct radius){f.below > 0.0, t * f.g, f.g + 2.0 * (t * t) * f.slope};
}

static bool rises(const struct zr_lens *lens, double t)
{
    const struct radius r = radius_at(lens, t);
    return r.defined && r.slope > 0.0;
}

/* Finds the end of the domain: the first fold or pole, in steps, then by bisection. */
static void find_end(struct zr_lens_inverse *inverse)
{
    enum { STEPS = 2048, HALVINGS = 60 };
    const double limit = inverse->lens.model == ZR_LENS_FISHEYE ? ANGLE_MAX : TANGENT_MAX;
    int step = 1;
    while (step <= STEPS && rises(&inverse->lens, limit * step / STEPS))
        step++;
    inverse->is_folded = step <= STEPS;
    inverse->most = limit;
    if (!inverse->is_folded) return;
    double low = limit * (step - 1) / STEPS, high = limit * step / STEPS;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        if (rises(&inverse->lens, middle))
            low = middle;
        else
            high = middle;
    }
    inverse->most = low;
}

/* Returns t between low and high with a distorted radius, by Newton's method; a step that leaves the bracket becomes
 * its middle. */
static double solve(const struct zr_lens *lens, double low, double high, double guess, double wanted)
{
    enum { STEPS_MAX = 80 };
    double t = guess;
    for (int i = 0; i < STEPS_MAX; i++) {
        const struct radius r = radius_at(lens, t);
        const double beyond = r.value - wanted;
        if (beyond > 0.0)
            high = t;
        else
            low = t;
        double next = t - beyond / r.slope;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        const double moved = fabs(next - t);
        t = next;
        if (moved <= LAST_STEP) break;
    }
    return t;
}

/* A bracket of t, and its guess between them. */
struct bracket {
    double low, high, guess;
};

/* Looks up t of a distorted radius, 0 .. far. */
static inline struct bracket bracket_of(const struct zr_lens_inverse *inverse, double wanted)
{
    const double at = wanted * inverse->steps;
    int i = (int)at;
    if (i >= ZR_LENS_STEPS) i = ZR_LENS_STEPS - 1;
    const double low = inverse->table[i], high = inverse->table[i + 1];
    return (struct bracket){low, high, low + (high - low) * (at - i)};
}

static double radial_inverse(const struct zr_lens_inverse *inverse, double wanted)
{
    const struct bracket b = bracket_of(inverse, wanted);
    return solve(&inverse->lens, b.low, b.high, b.guess, wanted);
}

void zr_lens_invert(const struct zr_lens *lens, struct zr_lens_inverse *inverse)
{
    inverse->lens = *lens;
    find_end(inverse);
    inverse->far = radius_at(lens, inverse->most).value;
    inverse->steps = ZR_LENS_STEPS / inverse->far;
    inverse->table[0] = 0.0;
    for (int i = 1; i < ZR_LENS_STEPS; i++) {
        const double low = inverse->table[i - 1], high = inverse->most;
        inverse->table[i] = solve(lens, low, high, low, inverse->far * i / ZR_LENS_STEPS);
    }
    inverse->table[ZR_LENS_STEPS] = inverse->most;
    inverse->margin = 3.0 * (fabs(lens->p[0]) + fabs(lens->p[1])) * (inverse->most * inverse->most);
}

/* ---- points ---- */

static struct zr_lens_ray no_ray(const struct zr_lens_inverse *inverse)
{
    return (struct zr_lens_ray){.end = inverse->is_folded ? ZR_LENS_FOLDED : ZR_LENS_WIDE};
}

/* Along the ray the radius grows by `along`, and across it by t / r. */
static struct zr_lens_ray radial_ray(const struct zr_lens_inverse *inverse, double x, double y, double distorted)
{
    const double t = radial_inverse(inverse, distorted);
    const struct radius at = radius_at(&inverse->lens, t);
    /* A fold or a pole narrower than a step of find_end leaves no solution, or a wrong one. */
    if (!at.defined || !(at.slope > 0.0) || !(fabs(at.value - distorted) <= 1e-9 * (1.0 + distorted)))
        return no_ray(inverse);
    const bool is_fisheye = inverse->lens.model == ZR_LENS_FISHEYE;
    const double r = is_fisheye && t > 0.0 ? zr_tan(t) : t;
    const double along = is_fisheye ? at.slope / (1.0 + r * r) : at.slope, across = r > 0.0 ? distorted / r : 1.0;
    const double nx = x / distorted, ny = y / distorted, more = along - across;
    return (struct zr_lens_ray){
        ZR_LENS_RAY, r * nx, r * ny, across + more * nx * nx, more * nx * ny, across + more * ny * ny};
}

/* Finds the ray with p1 and p2 by Newton's method, from that without them. */
static struct zr_lens_ray tangential_ray(const struct zr_lens_inverse *inverse, double x, double y, double distorted)
{
    enum { STEPS_MAX = 40 };
    const double p1 = inverse->lens.p[0], p2 = inverse->lens.p[1];
    const double start = bracket_of(inverse, fmin(distorted, 0.999 * inverse->far)).guess / distorted;
    struct zr_lens_ray ray = {ZR_LENS_RAY, x * start, y * start, 1.0, 0.0, 1.0};
    bool is_found = false;
    for (int i = 0; i < STEPS_MAX && !is_found; i++) {
        const double u = ray.x, v = ray.y, s = u * u + v * v;
        const struct factor f = factor_of(inverse->lens.k, s);
        const double beyond_x = f.g * u + 2.0 * p1 * u * v + p2 * (s + 2.0 * u * u) - x,
                     beyond_y = f.g * v + p1 * (s + 2.0 * v * v) + 2.0 * p2 * u * v - y;
        ray.xx = f.g + 2.0 * u * u * f.slope + 2.0 * p1 * v + 6.0 * p2 * u;
        ray.xy = 2.0 * u * v * f.slope + 2.0 * p1 * u + 2.0 * p2 * v;
        ray.yy = f.g + 2.0 * v * v * f.slope + 6.0 * p1 * v + 2.0 * p2 * u;
        const double determinant = ray.xx * ray.yy - ray.xy * ray.xy;
        if (!(f.below > 0.0) || !(determinant > 0.0) || !(ray.xx + ray.yy > 0.0)) return no_ray(inverse);
        const double dx = (ray.yy * beyond_x - ray.xy * beyond_y) / determinant,
                     dy = (ray.xx * beyond_y - ray.xy * beyond_x) / determinant;
        is_found = fabs(dx) + fabs(dy) <= LAST_STEP;
        ray.x = u - dx;
        ray.y = v - dy;
    }
    return is_found && ray.x * ray.x + ray.y * ray.y <= inverse->most * inverse->most ? ray : no_ray(inverse);
}

struct zr_lens_ray zr_lens_undistort(const struct zr_lens_inverse *inverse, double x, double y)
{
    const double distorted = sqrt(x * x + y * y);
    if (distorted == 0.0) return (struct zr_lens_ray){ZR_LENS_RAY, 0.0, 0.0, 1.0, 0.0, 1.0};
    if (!(distorted <= inverse->far + inverse->margin)) return no_ray(inverse);
    if (inverse->lens.p[0] != 0.0 || inverse->lens.p[1] != 0.0) return tangential_ray(inverse, x, y, distorted);
    return distorted <= inverse->far ? radial_ray(inverse, x, y, distorted) : no_ray(inverse);
}
