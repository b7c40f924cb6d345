#include "lines/strokes.h"

#include "base/cancel.h"
#include "base/run.h"

enum { ROWS_PER_RANGE = 16, STROKES_PER_CANCEL_CHECK = 1 << 12 };

static const float dash = 4.0f, gap = 2.5f;

/* A straight stroke with round ends. */
struct stroke {
    float from[2], to[2];
    float radius; /* half the width, plus 1/2 */
    float opacity;
};

struct drawing {
    const struct zr_cancel *cancel;
    uint32_t width, height, count;
    struct stroke *strokes; /* NULL while they are counted */
    float *opacity;
};

float zr_stroke_width(float width, uint32_t window_width, uint32_t window_height)
{
    const float side = (float)(window_width < window_height ? window_width : window_height);
    const float scaled = 1.5f * sqrtf(side / 480.0f);
    return width > 0.0f ? width : scaled > 1.0f ? scaled : 1.0f;
}

float zr_stroke_share(enum zr_stroke_class class)
{
    static const float shares[ZR_STROKE_CLASSES] = {1.0f, 0.7f, 0.5f};
    return shares[class];
}

/* ---- polylines to strokes ---- */

static void add(struct drawing *d, enum zr_stroke_class class, float w, const double from[2], const double to[2])
{
    static const float opacities[ZR_STROKE_CLASSES] = {1.0f, 0.85f, 0.5f};
    const float width = w * zr_stroke_share(class);
    if (d->strokes)
        d->strokes[d->count] = (struct stroke){.from = {(float)from[0], (float)from[1]},
                                               .to = {(float)to[0], (float)to[1]},
                                               .radius = 0.5f * (width > 1.0f ? width : 1.0f) + 0.5f,
                                               .opacity = opacities[class] * (width < 1.0f ? width : 1.0f)};
    d->count++;
}

/* Adds the dashes of a segment. `phase`: the length since a dash began, in pixels. */
static void add_dashes(struct drawing *d, float w, const double from[2], const double to[2], double *phase)
{
    const double x = to[0] - from[0], y = to[1] - from[1], length = sqrt(x * x + y * y);
    const double on = (double)(dash * w), period = on + (double)(gap * w);
    double at = 0.0;
    while (at < length) {
        const bool is_on = *phase < on;
        const double left = (is_on ? on : period) - *phase, end = at + left < length ? at + left : length;
        if (is_on)
            add(d, ZR_STROKE_HIDDEN, w, (const double[2]){from[0] + x * (at / length), from[1] + y * (at / length)},
                (const double[2]){from[0] + x * (end / length), from[1] + y * (end / length)});
        *phase += end - at;
        if (at + left <= length) *phase = is_on ? on : 0.0;
        at = end;
    }
}

static void add_polyline(struct drawing *d, const struct zr_polylines *lines, const struct zr_polyline *line, float w)
{
    const double(*points)[2] = (const double(*)[2])lines->points + line->first;
    double phase = 0.0;
    for (uint32_t i = 1; i < line->count; i++) {
        if (line->class == ZR_STROKE_HIDDEN)
            add_dashes(d, w, points[i - 1], points[i], &phase);
        else
            add(d, line->class, w, points[i - 1], points[i]);
    }
}

static void add_polylines(struct drawing *d, const struct zr_polylines *lines, float w)
{
    d->count = 0;
    for (uint32_t i = 0; i < lines->count; i++) {
        if (i % STROKES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(d->cancel)) return;
        add_polyline(d, lines, &lines->at[i], w);
    }
}

/* ---- strokes to pixels ---- */

static float clamp(float value)
{
    return value > 0.0f ? value < 1.0f ? value : 1.0f : 0.0f;
}

/* Returns a pixel within 0 .. count. */
static uint32_t pixel_at(float coordinate, uint32_t count)
{
    return !(coordinate > 0.0f) ? 0 : coordinate >= (float)count ? count : (uint32_t)coordinate;
}

/* Draws the pixels of a stroke in one row. */
static void draw_row(const struct drawing *d, const struct stroke *s, uint32_t row)
{
    const float y = (float)row + 0.5f, dx = s->to[0] - s->from[0], dy = s->to[1] - s->from[1];
    const float square = dx * dx + dy * dy;
    float low = 0.0f, high = 1.0f;
    if (fabsf(dy) > 1e-3f) {
        const float a = (y - s->radius - s->from[1]) / dy, b = (y + s->radius - s->from[1]) / dy;
        low = clamp(a < b ? a : b);
        high = clamp(a < b ? b : a);
    }
    const float x0 = s->from[0] + low * dx, x1 = s->from[0] + high * dx;
    const uint32_t begin = pixel_at((x0 < x1 ? x0 : x1) - s->radius, d->width),
                   end = pixel_at((x0 < x1 ? x1 : x0) + s->radius + 1.0f, d->width);
    float *out = d->opacity + (size_t)row * d->width;
    for (uint32_t x = begin; x < end; x++) {
        const float px = (float)x + 0.5f - s->from[0], py = y - s->from[1];
        const float t = square > 0.0f ? clamp((px * dx + py * dy) / square) : 0.0f;
        const float ex = px - t * dx, ey = py - t * dy;
        const float ink = s->opacity * clamp(s->radius - sqrtf(ex * ex + ey * ey));
        if (ink > out[x]) out[x] = ink;
    }
}

static void draw_rows(void *context, size_t begin, size_t end)
{
    const struct drawing *d = context;
    memset(d->opacity + begin * d->width, 0, (end - begin) * d->width * sizeof *d->opacity);
    for (uint32_t i = 0; i < d->count; i++) {
        const struct stroke *s = &d->strokes[i];
        const float y0 = s->from[1] < s->to[1] ? s->from[1] : s->to[1],
                    y1 = s->from[1] < s->to[1] ? s->to[1] : s->from[1];
        uint32_t row = pixel_at(y0 - s->radius, d->height), last = pixel_at(y1 + s->radius + 1.0f, d->height);
        if (i % STROKES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(d->cancel)) return;
        if (row < begin) row = (uint32_t)begin;
        if (last > end) last = (uint32_t)end;
        for (; row < last; row++)
            draw_row(d, s, row);
    }
}

enum zr_status zr_strokes_draw(const struct zr_run *run, const struct zr_polylines *lines, float w, uint32_t width,
                               uint32_t height, float *opacity)
{
    struct drawing d = {.cancel = run->cancel, .width = width, .height = height, .opacity = opacity};
    add_polylines(&d, lines, w);
    d.strokes = zr_arena_alloc(run->arena, d.count, sizeof *d.strokes);
    if (!d.strokes) return ZR_NO_MEMORY;
    add_polylines(&d, lines, w);
    zr_team_ranges(run->team, height, ROWS_PER_RANGE, draw_rows, &d);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
