/* occlusion_scenes.h - tests: G-buffers of surfaces z = f(x, y), each array in its own pages, with garbage behind the
 * ends of rows. */
#ifndef ZR_TESTS_OCCLUSION_SCENES_H
#define ZR_TESTS_OCCLUSION_SCENES_H

#include <math.h>
#include <stdlib.h>

#include "guarded.h"
#include "shade/lights/gbuffer.h"
#include "support/random.h"

/* The height at x, y, and its slopes. False: there is nothing. */
typedef bool surface_fn(double x, double y, double *z, double *slope_x, double *slope_y);

/* What is seen of it by a window from above: x, y from -extent to extent over the larger side. */
struct sight {
    int width, height;
    double extent;
    double eye; /* height of the eye; 0: rays are parallel */
};

enum { PLANES = 7 }; /* owner, point, normal */

struct buffer {
    struct zr_gbuffer g;
    struct guarded planes[PLANES];
};

static inline struct buffer buffer_make(int width, int height)
{
    struct buffer b = {.g = {.width = width, .height = height, .stride = (width + 15) / 16 * 16}};
    const size_t count = (size_t)b.g.stride * (size_t)height;
    float *blank = malloc(count * sizeof *blank + 1);
    for (size_t i = 0; i < count; i++)
        blank[i] = NAN; /* as an owner, somebody */
    for (int p = 0; p < PLANES; p++)
        b.planes[p] = guarded_copy(blank, count * sizeof *blank);
    free(blank);
    b.g.owner = (uint32_t *)(void *)b.planes[0].bytes;
    for (int c = 0; c < 3; c++) {
        b.g.point[c] = (float *)(void *)b.planes[1 + c].bytes;
        b.g.normal[c] = (float *)(void *)b.planes[4 + c].bytes;
    }
    return b;
}

static inline void buffer_free(struct buffer *b)
{
    for (int p = 0; p < PLANES; p++)
        guarded_free(&b->planes[p]);
}

static inline void buffer_set(struct zr_gbuffer *g, ptrdiff_t at, bool is_seen, const double point[3],
                              const double normal[3])
{
    g->owner[at] = is_seen ? 5 : 0;
    for (int c = 0; c < 3; c++) {
        g->point[c][at] = is_seen ? (float)point[c] : ZR_FAR_POINT;
        g->normal[c][at] = is_seen ? (float)normal[c] : 0.0f;
    }
}

static inline double sight_pixel(const struct sight *sight, int side)
{
    return 2.0 * sight->extent / (sight->width > sight->height ? sight->width : sight->height) / side;
}

/* Where the surface is met by the ray through x, y of height 0. It is low, so a few steps find it. */
static inline bool sight_meet(const struct sight *sight, surface_fn *surface, double x, double y, double point[3],
                              double normal[3])
{
    double z = 0.0, slope_x, slope_y;
    bool is_seen = true;
    for (int i = 0; i < (sight->eye > 0.0 ? 40 : 1); i++) {
        const double share = sight->eye > 0.0 ? 1.0 - z / sight->eye : 1.0;
        point[0] = x * share;
        point[1] = y * share;
        is_seen = surface(point[0], point[1], &z, &slope_x, &slope_y);
    }
    const double length = sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
    point[2] = z - sight->eye;
    normal[0] = -slope_x / length;
    normal[1] = -slope_y / length;
    normal[2] = 1.0 / length;
    return is_seen;
}

/* Samples of a window of side x side a pixel, from sample x0, y0 on, as far as the buffer goes. */
static inline void buffer_draw(struct buffer *b, const struct sight *sight, int side, int x0, int y0,
                               surface_fn *surface)
{
    const double pixel = sight_pixel(sight, side);
    for (int y = 0; y < b->g.height; y++)
        for (int x = 0; x < b->g.width; x++) {
            double point[3], normal[3];
            const bool is_seen = sight_meet(sight, surface, (x0 + x + 0.5 - 0.5 * sight->width * side) * pixel,
                                            (y0 + y + 0.5 - 0.5 * sight->height * side) * pixel, point, normal);
            buffer_set(&b->g, y * b->g.stride + x, is_seen, point, normal);
        }
}

/* What was drawn of a plane with parallel rays, seen from an eye above: each point moves along the plane, to where the
 * eye's ray meets it, which steps would not find where the plane is steep. */
static inline void buffer_see_from(struct buffer *b, float eye)
{
    static const double none[3];
    for (ptrdiff_t at = 0; at < b->g.stride * b->g.height; at++) {
        const float z = b->g.point[2][at], share = 1.0f / (1.0f + z / eye);
        b->g.point[0][at] *= share;
        b->g.point[1][at] *= share;
        b->g.point[2][at] = z * share - eye;
        if (!(z > -0.5f * eye)) buffer_set(&b->g, at, false, none, none);
    }
}

/* Some pixels become lines, and some nobody's. */
static inline void buffer_spoil(struct buffer *b, struct random *numbers)
{
    for (int y = 0; y < b->g.height; y++)
        for (int x = 0; x < b->g.width; x++) {
            const ptrdiff_t at = y * b->g.stride + x;
            const uint32_t chance = random_below(numbers, 25);
            if (chance == 0) buffer_set(&b->g, at, false, NULL, NULL);
            if (chance == 1 && b->g.owner[at]) b->g.normal[0][at] = b->g.normal[1][at] = b->g.normal[2][at] = 0.0f;
        }
}

/* ---- surfaces ---- */

static inline bool bumps(double x, double y, double *z, double *slope_x, double *slope_y)
{
    const double f = 25.0, a = 0.03;
    *z = a * (sin(f * x) * sin(f * y) + 0.5 * sin(2.3 * f * x + y));
    *slope_x = a * f * (cos(f * x) * sin(f * y) + 1.15 * cos(2.3 * f * x + y));
    *slope_y = a * (f * sin(f * x) * cos(f * y) + 0.5 * cos(2.3 * f * x + y));
    return x * x + 0.8 * y * y < 0.09;
}

/* Two planes that meet at 90 degrees, the joint at x = 0. */
static inline bool corner(double x, double y, double *z, double *slope_x, double *slope_y)
{
    (void)y;
    *z = fabs(x);
    *slope_x = x < 0.0 ? -1.0 : 1.0;
    *slope_y = 0.0;
    return true;
}

static double tilt_x, tilt_y;

static inline bool plane(double x, double y, double *z, double *slope_x, double *slope_y)
{
    *slope_x = tilt_x;
    *slope_y = tilt_y;
    *z = tilt_x * x + tilt_y * y;
    return true;
}

#endif
