#include "mesh/features/bounding_cylinder.h"

#include "mesh/features/cylinder_fit.h"

enum { ROUNDS = 64, PLACES_PER_STEP = 8 };

static const double INSIDE = 1.0 + 1e-12; /* of the radius */
static const double LESS = 1.0 - 1e-6;    /* of the volume: a later direction is better */

struct point {
    double x, y;
};

struct circle {
    struct point center;
    double square; /* of the radius */
};

static double square_of(const struct circle *circle, struct point p)
{
    const double x = p.x - circle->center.x, y = p.y - circle->center.y;
    return x * x + y * y;
}

static struct circle around_two(struct point a, struct point b)
{
    struct circle circle = {{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, 0.0};
    circle.square = zr_most_of(square_of(&circle, a), square_of(&circle, b));
    return circle;
}

/* The circle through three points. False if they are on a line. */
static bool around_three(struct point a, struct point b, struct point c, struct circle *out)
{
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, turn = 2.0 * (bx * cy - by * cx);
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    if (turn == 0.0) return false;
    out->center = (struct point){a.x + (cy * b2 - by * c2) / turn, a.y + (bx * c2 - cx * b2) / turn};
    out->square = zr_most_of(square_of(out, a), zr_most_of(square_of(out, b), square_of(out, c)));
    return isfinite(out->square);
}

static bool contains(const struct circle *circle, const struct point *points, int count)
{
    for (int i = 0; i < count; i++)
        if (square_of(circle, points[i]) > circle->square * INSIDE) return false;
    return true;
}

/* Finds the least circle around up to four points, and keeps those on its border. */
static struct circle around_few(struct point *points, int *count)
{
    struct circle best = {points[0], HUGE_VAL}, own;
    struct point kept[3] = {points[0]};
    int most = 1;
    if (*count == 1) return (struct circle){points[0], 0.0};
    for (int i = 0; i < *count; i++)
        for (int k = i + 1; k < *count; k++) {
            own = around_two(points[i], points[k]);
            if (own.square >= best.square || !contains(&own, points, *count)) continue;
            best = own;
            kept[0] = points[i];
            kept[1] = points[k];
            most = 2;
        }
    for (int i = 0; i < *count; i++)
        for (int k = i + 1; k < *count; k++)
            for (int l = k + 1; l < *count; l++) {
                if (!around_three(points[i], points[k], points[l], &own) || own.square >= best.square ||
                    !contains(&own, points, *count))
                    continue;
                best = own;
                kept[0] = points[i];
                kept[1] = points[k];
                kept[2] = points[l];
                most = 3;
            }
    for (int i = 0; i < most; i++)
        points[i] = kept[i];
    *count = most;
    return best;
}

/* Finds the least circle, and the range along the axis. False without steps, or if rounding keeps it from ending. */
static bool enclose(struct zr_feature_work *work, const struct zr_surface *surface,
                    const struct zr_cylinder_frame *frame, struct circle *out, double range[2])
{
    struct point held[4] = {{zr_dvec3_dot(surface->places[0], frame->u), zr_dvec3_dot(surface->places[0], frame->v)}};
    int count = 1;
    for (int round = 0; round < ROUNDS; round++) {
        struct point farthest = held[0];
        double most = 0.0;
        *out = around_few(held, &count);
        range[0] = HUGE_VAL;
        range[1] = -HUGE_VAL;
        for (uint32_t i = 0; i < surface->place_count; i++) {
            const zr_dvec3 p = surface->places[i];
            const struct point own = {zr_dvec3_dot(p, frame->u), zr_dvec3_dot(p, frame->v)};
            const double square = square_of(out, own), z = zr_dvec3_dot(p, frame->axis);
            if (i % PLACES_PER_STEP == 0 && !zr_feature_has_steps(work, 1)) return false;
            range[0] = zr_least_of(range[0], z);
            range[1] = zr_most_of(range[1], z);
            if (square <= most) continue;
            most = square;
            farthest = own;
        }
        if (most <= out->square * (1.0 + 1e-9)) return true;
        held[count++] = farthest;
    }
    return false;
}

struct zr_bounding_cylinder zr_bounding_cylinder_find(struct zr_feature_work *work, const struct zr_surface *surface,
                                                      const zr_dvec3 *directions, uint32_t count)
{
    struct zr_bounding_cylinder best = {.is_found = false};
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < count && surface->place_count > 0; i++) {
        struct zr_cylinder_frame frame;
        struct circle circle;
        double range[2];
        zr_cylinder_frame_turn(&frame, directions[i]);
        if (!enclose(work, surface, &frame, &circle, range)) continue;
        const double volume = circle.square * (range[1] - range[0]);
        if (volume >= least * LESS) continue;
        least = volume;
        best = (struct zr_bounding_cylinder){
            true, directions[i], {0, 0, 0}, 2.0 * sqrt(circle.square), range[1] - range[0]};
        best.at = zr_dvec3_add_scaled(best.at, frame.u, circle.center.x);
        best.at = zr_dvec3_add_scaled(best.at, frame.v, circle.center.y);
        best.at = zr_dvec3_add_scaled(best.at, frame.axis, range[0]);
    }
    return best;
}
