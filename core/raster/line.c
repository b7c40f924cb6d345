#include "raster/line.h"

#include "base/mutant.h"

enum { X, Y, HALF_PIXEL = ZR_SUBPIXELS / 2 };

/* Returns the subpixels from the centre line to a side. */
static int32_t half_of(int32_t width)
{
    return ZR_MUTANT(wide_lines_off_middle, width * HALF_PIXEL, HALF_PIXEL);
}

/* Direction of a line, by axis, so that the same code serves x-major and y-major lines. */
struct course {
    float d[2]; /* from v1 to v0: against the direction of travel */
    int major, minor;
    float slope; /* minor over major */
};

/* One end, relative to the centre of its pixel. */
struct end {
    float at[2];
    float offset[2]; /* -1/2 .. 1/2 */
    bool ahead[2];   /* in the half of the pixel towards which the line travels */
    bool in_diamond;
};

/* Zero counts as positive. The axes differ in the zero that they compare, as in the reference. */
static bool is_ahead(int axis, float offset, float d)
{
    return axis == X ? (offset >= 0.0f) == (-d >= 0.0f) : (-offset >= 0.0f) == (d >= 0.0f);
}

static struct end end_make(const struct zr_window_vertex *v, const struct course *course, bool last)
{
    struct end end = {.at = {v->x, v->y}};
    for (int axis = X; axis <= Y; axis++)
        end.offset[axis] = end.at[axis] - floorf(end.at[axis]) - 0.5f;
    /* The last end on the border of two rows, reached from the lower one, counts as that row's upper border. */
    float *minor = &end.offset[course->minor];
    if (last && *minor == -0.5f && course->d[course->minor] < 0.0f) *minor = 0.5f;
    for (int axis = X; axis <= Y; axis++)
        end.ahead[axis] = is_ahead(axis, end.offset[axis], course->d[axis]);
    end.in_diamond = fabsf(end.offset[X]) + fabsf(end.offset[Y]) < 0.5f;
    return end;
}

/* Returns where the extended line crosses the pixel's centre column (or row): 0..1 inside the pixel. */
static float crossing(const struct end *end, const struct course *course)
{
    float minor = end->at[course->minor];
    return (minor - floorf(minor)) + end->offset[course->major] * course->slope;
}

/* Returns true if the line leaves the diamond of its first pixel. */
static bool first_pixel_is_drawn(const struct end *end, const struct course *course)
{
    if (end->in_diamond) return true;
    if (end->ahead[course->major]) return false;
    if (!end->ahead[course->minor]) return true;
    float c = crossing(end, course);
    return c < 1.0f && c > 0.0f;
}

/* Returns true if the line has left the diamond of its last pixel. */
static bool last_pixel_is_drawn(const struct end *end, const struct course *course)
{
    if (end->in_diamond || !end->ahead[course->major]) return false;
    if (end->ahead[course->minor]) return true;
    float c = crossing(end, course);
    return c < 1.0f && c >= 0.0f;
}

/* Snaps like corners of triangles. Mesa 22.3 rounded half away from zero. */
static int32_t snap(float window)
{
    float v = (window - 0.5f) * (float)ZR_SUBPIXELS;
    return (int32_t)ZR_MUTANT(older_mesa, zr_viewport_snap(window), v + copysignf(0.5f, v));
}

/* Returns true if the fill rule alone draws the pixel of an end. `high` is the end farther up the major axis: it gets
 * the pixel if the pixel's centre lies below it; the other end gets it if the centre lies above or on it. Mesa 22.3 was
 * wrong for an end on the centre, except for the first end of an x-major line: a y-major line down from a centre lacked
 * its first pixel. */
static bool fill_rule_draws(float offset, const struct course *course, bool high, bool last)
{
    bool draws = high == (offset > 0.0f);
    return ZR_MUTANT(older_mesa, draws, offset == 0.0f ? last || (course->major == X) != high : draws);
}

/* Computes the snapped end, by axis. If the fill rule disagrees with `is_drawn`, the end is first moved back to the
 * border of its pixel. */
static void place_end(const struct end *end, const struct course *course, bool fill_draws, bool is_drawn,
                      int32_t out[2])
{
    float move[2] = {0.0f, 0.0f}, offset = end->offset[course->major];
    if (ZR_MUTANT(no_diamonds, fill_draws != is_drawn, false)) {
        move[course->major] = course->d[course->major] < 0.0f ? -offset - 0.5f : -offset + 0.5f;
        move[course->minor] = move[course->major] * course->slope;
    }
    for (int axis = X; axis <= Y; axis++)
        out[axis] = snap(end->at[axis] + move[axis]);
}

static bool course_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1, struct course *course)
{
    course->d[X] = v0->x - v1->x;
    course->d[Y] = v0->y - v1->y;
    if (!(course->d[X] * course->d[X] + course->d[Y] * course->d[Y] > 0.0f)) return false;
    course->major = fabsf(course->d[X]) >= fabsf(course->d[Y]) ? X : Y;
    course->minor = Y - course->major;
    course->slope = course->d[course->minor] / course->d[course->major];
    return true;
}

bool zr_line_corners_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1, int32_t width,
                          struct zr_line_corners *out)
{
    const int32_t half = half_of(width);
    struct course course;
    if (!course_make(v0, v1, &course)) return false;
    bool rising = course.d[course.major] < 0.0f;
    struct end first = end_make(v0, &course, false), last = end_make(v1, &course, true);
    int32_t low[2], high[2];
    bool fill_first = fill_rule_draws(first.offset[course.major], &course, !rising, false);
    bool fill_last = fill_rule_draws(last.offset[course.major], &course, rising, true);
    place_end(&first, &course, fill_first, first_pixel_is_drawn(&first, &course), rising ? low : high);
    place_end(&last, &course, fill_last, last_pixel_is_drawn(&last, &course), rising ? high : low);
    if (low[course.major] >= high[course.major]) return false;
    if (course.major == X)
        *out = (struct zr_line_corners){.x = {high[X], low[X], low[X], high[X]},
                                        .y = {high[Y] - half, low[Y] - half, low[Y] + half, high[Y] + half}};
    else
        *out = (struct zr_line_corners){.x = {low[X] - half, high[X] - half, high[X] + half, low[X] + half},
                                        .y = {low[Y], high[Y], high[Y], low[Y]}};
    out->width = width;
    out->along_x = course.major == X;
    for (int axis = X; axis <= Y; axis++) {
        out->low[axis] = low[axis];
        out->high[axis] = high[axis];
    }
    return true;
}

static int64_t divide_down(int64_t numerator, int64_t denominator)
{
    int64_t quotient = numerator / denominator;
    return quotient * denominator > numerator ? quotient - 1 : quotient;
}

/* Intersects the side half a width below the centre line with the column's centre. The other side is `width` pixels
 * above, so that many centres lie between them. A centre on a side is inside if that is a left or a bottom side (rule
 * 7): the upper one for a rising line, else the lower. */
int32_t zr_line_pixel(const struct zr_line_corners *line, int32_t at)
{
    int major = line->along_x ? X : Y, minor = Y - major;
    int64_t run = (int64_t)line->high[major] - line->low[major], rise = (int64_t)line->high[minor] - line->low[minor];
    int64_t first = line->low[minor] - half_of(line->width);
    int64_t side = first * run + rise * ((int64_t)at * ZR_SUBPIXELS - line->low[major]);
    int64_t step = run * ZR_SUBPIXELS;
    bool upper_counts = line->along_x && rise > 0;
    return (int32_t)(upper_counts ? divide_down(side, step) + 1 : -divide_down(-side, step));
}

void zr_line_range(const struct zr_line_corners *line, int32_t *first, int32_t *last)
{
    int major = line->along_x ? X : Y;
    *first = (line->low[major] + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS;
    *last = ((line->high[major] + ZR_SUBPIXELS - 1) >> ZR_SUBPIXEL_BITS) - 1;
}

struct zr_line_basis zr_line_basis_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1)
{
    struct zr_line_basis basis = {.x0 = v0->x - 0.5f, .y0 = v0->y - 0.5f};
    float dx = v0->x - v1->x, dy = v0->y - v1->y;
    if (dx == 0.0f && dy == 0.0f) return basis;
    basis.ooa = 1.0f / (dx * dx + dy * dy);
    if (fabsf(dx) >= fabsf(dy))
        basis.dx = dx * (1.0f + (dy / dx) * ZR_MUTANT(line_depth_along, dy / dx, 0.0f));
    else
        basis.dy = dy * (1.0f + (dx / dy) * (dx / dy));
    return basis;
}
