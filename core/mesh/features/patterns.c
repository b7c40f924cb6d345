#include "mesh/features/patterns.h"

#include "mesh/features/angles.h"

static const double SAME = 1e-3, SAME_SIZE = 2e-5;

struct points {
    double (*at)[2];
    uint32_t count;
    double size; /* of the part */
};

static bool are_same(double a, double b, double scale, double size)
{
    return fabs(a - b) <= SAME * scale + SAME_SIZE * size;
}

/* ---- circles ---- */

/* Sorts the angles around a place, and returns whether they are equally far apart. */
static bool is_even(struct zr_feature_work *work, const struct points *points, double x, double y)
{
    double before = -1.0, first = 0.0;
    const double step = 360.0 / points->count;
    for (uint32_t i = 0; i < points->count; i++) { /* the least angle above the one before */
        double least = 720.0;
        if (!zr_feature_has_steps(work, 1 + points->count / 4)) return false;
        for (uint32_t k = 0; k < points->count; k++) {
            const double angle = zr_angle_of(points->at[k][0] - x, points->at[k][1] - y);
            if (angle > before && angle < least) least = angle;
        }
        if (i == 0) first = least;
        if (fabs(least - (first + i * step)) > 0.1) return false;
        before = least;
    }
    return true;
}

static bool is_circle(struct zr_feature_work *work, const struct points *points, double center[2], double *radius)
{
    struct zr_circle_sums sums = {0};
    for (uint32_t i = 0; i < points->count; i++)
        zr_circle_sums_add(&sums, points->at[i][0], points->at[i][1]);
    if (!zr_circle_sums_fit(&sums, &center[0], &center[1], radius)) return false;
    for (uint32_t i = 0; i < points->count; i++) {
        const double x = points->at[i][0] - center[0], y = points->at[i][1] - center[1];
        if (!are_same(sqrt(x * x + y * y), *radius, *radius, points->size)) return false;
    }
    return is_even(work, points, center[0], center[1]);
}

/* ---- grids ---- */

/* Turns the points so that the nearest neighbour of the first one lies along x. False if two are at one place. */
static bool turn(struct points *points)
{
    double best = HUGE_VAL, dx = 0.0, dy = 0.0;
    for (uint32_t i = 1; i < points->count; i++) {
        const double x = points->at[i][0] - points->at[0][0], y = points->at[i][1] - points->at[0][1];
        if (x * x + y * y >= best * (1.0 - 1e-6)) continue;
        best = x * x + y * y;
        dx = x;
        dy = y;
    }
    const double length = sqrt(best);
    if (!(length > SAME_SIZE * points->size)) return false;
    for (uint32_t i = 0; i < points->count; i++) {
        const double x = points->at[i][0], y = points->at[i][1];
        points->at[i][0] = (x * dx + y * dy) / length;
        points->at[i][1] = (y * dx - x * dy) / length;
    }
    return true;
}

/* Finds the range of a coordinate and the least distance above the lowest one; 0: all are the same. */
static double pitch_of(const struct points *points, int k, double *low, double *high)
{
    double least = HUGE_VAL;
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (uint32_t i = 0; i < points->count; i++) {
        *low = zr_least_of(*low, points->at[i][k]);
        *high = zr_most_of(*high, points->at[i][k]);
    }
    for (uint32_t i = 0; i < points->count; i++) {
        const double above = points->at[i][k] - *low;
        if (above > 10.0 * SAME_SIZE * points->size && above < least) least = above;
    }
    return least < HUGE_VAL ? least : 0.0;
}

/* Each place is a whole number of pitches from the lowest, and each cell has one. The points become numbers of cells. */
static bool fill(struct zr_feature_work *work, struct points *points, const double low[2], struct zr_pattern *out)
{
    for (uint32_t i = 0; i < points->count; i++)
        for (int k = 0; k < 2; k++) {
            const double off = points->at[i][k] - low[k],
                         cell = out->pitch[k] > 0.0 ? floor(off / out->pitch[k] + 0.5) : 0.0;
            if (!are_same(off, cell * out->pitch[k], out->pitch[k], points->size)) return false;
            points->at[i][k] = cell;
        }
    for (uint32_t i = 0; i < points->count; i++) {
        if (!zr_feature_has_steps(work, 1 + i / 16)) return false;
        for (uint32_t k = 0; k < i; k++)
            if (points->at[i][0] == points->at[k][0] && points->at[i][1] == points->at[k][1]) return false;
    }
    return true;
}

static bool is_grid(struct zr_feature_work *work, struct points *points, struct zr_pattern *out)
{
    double low[2], high[2];
    if (!turn(points)) return false;
    for (int k = 0; k < 2; k++) {
        out->pitch[k] = pitch_of(points, k, &low[k], &high[k]);
        const double cells = out->pitch[k] > 0.0 ? (high[k] - low[k]) / out->pitch[k] + 1.5 : 1.0;
        if (cells > ZR_PATTERN_PLACES_MAX) return false;
        out->counts[k] = (uint32_t)cells;
        if (out->counts[k] > 1) out->pitch[k] = (high[k] - low[k]) / (out->counts[k] - 1);
    }
    if ((uint64_t)out->counts[0] * out->counts[1] != points->count || !fill(work, points, low, out)) return false;
    if (out->counts[0] >= out->counts[1]) return true;
    const double pitch = out->pitch[0];
    const uint32_t count = out->counts[0];
    out->pitch[0] = out->pitch[1];
    out->counts[0] = out->counts[1];
    out->pitch[1] = pitch;
    out->counts[1] = count;
    return true;
}

struct zr_pattern zr_pattern_of(struct zr_feature_work *work, const zr_dvec3 *places, uint32_t count, zr_dvec3 axis,
                                double size, double (*room)[2])
{
    struct zr_pattern out = {.kind = ZR_PATTERN_NONE};
    struct points points = {room, count, size};
    struct zr_cylinder_frame frame;
    double center[2];
    if (count < 3 || count > ZR_PATTERN_PLACES_MAX) return out;
    zr_cylinder_frame_turn(&frame, axis);
    for (uint32_t i = 0; i < count; i++) {
        const zr_dvec3 p = zr_dvec3_sub(places[i], places[0]);
        if (fabs(zr_dvec3_dot(p, axis)) > 10.0 * SAME_SIZE * size) return out;
        room[i][0] = zr_dvec3_dot(p, frame.u);
        room[i][1] = zr_dvec3_dot(p, frame.v);
        out.center = zr_dvec3_add_scaled(out.center, places[i], 1.0 / count);
    }
    if (count != 4 && is_circle(work, &points, center, &out.diameter)) {
        out.kind = ZR_PATTERN_CIRCLE;
        out.diameter *= 2.0;
    } else if (is_grid(work, &points, &out)) {
        out.kind = ZR_PATTERN_GRID;
    }
    return out;
}
