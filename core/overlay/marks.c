#include "overlay/marks.h"

#include <math.h>
#include <string.h>

#include "base/trig.h"
#include "overlay/fill.h"
#include "overlay/pen.h"

/* ---- the list ---- */

/* Returns a new mark, or NULL if the arena failed. */
static struct zr_mark *add(struct zr_marks *marks, enum zr_mark_kind kind, struct zr_ink ink)
{
    enum { FIRST_ROOM = 64 };
    if (marks->count == marks->room) {
        const uint32_t room = marks->room ? 2 * marks->room : FIRST_ROOM;
        struct zr_mark *at = zr_arena_alloc(marks->arena, room, sizeof *at);
        if (!at) {
            marks->has_failed = true;
            return NULL;
        }
        if (marks->count > 0) memcpy(at, marks->at, marks->count * sizeof *at);
        marks->at = at;
        marks->room = room;
    }
    marks->at[marks->count] = (struct zr_mark){.kind = kind, .ink = ink};
    return &marks->at[marks->count++];
}

/* Copies a path to the mark. */
static void set_path(struct zr_marks *marks, struct zr_mark *mark, struct zr_path path)
{
    const uint32_t count = path.count > 0 ? path.ends[path.count - 1] : 0;
    if (!mark || count == 0) return;
    const struct zr_point *points = zr_arena_copy(marks->arena, path.points, count * sizeof *points);
    const uint32_t *ends = zr_arena_copy(marks->arena, path.ends, path.count * sizeof *ends);
    if (points && ends)
        mark->path = (struct zr_path){path.count, ends, points};
    else
        marks->has_failed = true;
}

void zr_marks_add_line(struct zr_marks *marks, const struct zr_point *points, uint32_t count, struct zr_ink ink)
{
    set_path(marks, add(marks, ZR_MARK_LINES, ink), (struct zr_path){count > 0, &count, points});
}

void zr_marks_add_area(struct zr_marks *marks, const struct zr_point *points, uint32_t count, struct zr_ink ink)
{
    set_path(marks, add(marks, ZR_MARK_AREA, ink), (struct zr_path){count > 0, &count, points});
}

void zr_marks_add_text(struct zr_marks *marks, const char *text, struct zr_type_place place, struct zr_ink ink)
{
    struct zr_mark *mark = add(marks, ZR_MARK_TEXT, ink);
    if (!mark) return;
    mark->place = place;
    mark->text = zr_arena_copy(marks->arena, text, strlen(text) + 1);
    marks->boxed += mark->text && !zr_type_has_all(text);
    if (mark->text) return;
    marks->count--;
    marks->has_failed = true;
}

/* ---- dashes ---- */

enum { DASHES_MOST = 4096 };

/* Dashes of a polyline: each point of it may be one of a dash. */
struct dashes {
    struct zr_point *points;
    uint32_t *ends;
    uint32_t count, point_count;
    uint32_t index; /* of the current length of the pattern */
    double left;    /* of it */
};

/* Adds a point to the current dash, unless it is there. */
static void put(struct dashes *d, struct zr_point point)
{
    const uint32_t begin = d->count > 0 ? d->ends[d->count - 1] : 0;
    const struct zr_point *last = &d->points[d->point_count > 0 ? d->point_count - 1 : 0];
    if (d->point_count > begin && last->x == point.x && last->y == point.y) return;
    d->points[d->point_count++] = point;
}

static void end_dash(struct dashes *d)
{
    d->ends[d->count++] = d->point_count;
}

/* Walks along a segment and changes between dashes and gaps. */
static void cut(struct dashes *d, struct zr_point a, struct zr_point b, const double *pattern, uint32_t lengths)
{
    const double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);
    double at = 0;
    while (length - at > d->left) {
        at += d->left;
        put(d, (struct zr_point){a.x + x * (at / length), a.y + y * (at / length)});
        if (d->index % 2 == 0) end_dash(d);
        d->index = d->index + 1 < lengths ? d->index + 1 : 0;
        d->left = pattern[d->index];
    }
    d->left -= length - at;
    if (d->index % 2 == 0) put(d, b);
}

/* Returns how many dashes the polyline has, at most; DASHES_MOST + 1 if there are more. */
static uint32_t dashes_of(const struct zr_point *points, uint32_t count, const double *pattern, uint32_t lengths)
{
    double length = 0, period = 0;
    for (uint32_t i = 1; i < count; i++) {
        const double x = points[i].x - points[i - 1].x, y = points[i].y - points[i - 1].y;
        length += sqrt(x * x + y * y);
    }
    for (uint32_t i = 0; i < lengths; i++)
        period += pattern[i];
    const double dashes = (length / period + 2) * (lengths / 2);
    return dashes <= DASHES_MOST ? (uint32_t)dashes : DASHES_MOST + 1;
}

void zr_marks_add_dashes(struct zr_marks *marks, const struct zr_point *points, uint32_t count, const double *pattern,
                         uint32_t lengths, struct zr_ink ink)
{
    const uint32_t most = dashes_of(points, count, pattern, lengths);
    if (most > DASHES_MOST || count < 2) {
        zr_marks_add_line(marks, points, count, ink);
        return;
    }
    struct dashes d = {.points = zr_arena_alloc(marks->arena, count + 2 * (size_t)most, sizeof *d.points),
                       .ends = zr_arena_alloc(marks->arena, (size_t)most + 1, sizeof *d.ends),
                       .left = pattern[0]};
    struct zr_mark *mark = d.points && d.ends ? add(marks, ZR_MARK_LINES, ink) : NULL;
    marks->has_failed = marks->has_failed || !mark;
    if (!mark) return;
    put(&d, points[0]);
    for (uint32_t i = 1; i < count; i++)
        cut(&d, points[i - 1], points[i], pattern, lengths);
    if (d.index % 2 == 0) end_dash(&d);
    mark->path = (struct zr_path){d.count, d.ends, d.points};
}

/* ---- shapes ---- */

void zr_marks_add_arrow(struct zr_marks *marks, struct zr_point tip, double dx, double dy, double length,
                        double half_width, struct zr_ink ink)
{
    const double x = tip.x - length * dx, y = tip.y - length * dy;
    const struct zr_point points[] = {
        tip, {x - half_width * dy, y + half_width * dx}, {x + half_width * dy, y - half_width * dx}};
    zr_marks_add_area(marks, points, 3, ink);
}

/* A dot of a pen that is as wide. */
void zr_marks_add_disc(struct zr_marks *marks, struct zr_point center, double radius, struct zr_ink ink)
{
    ink.width = 2 * radius;
    zr_marks_add_line(marks, &center, 1, ink);
}

void zr_marks_add_ring(struct zr_marks *marks, struct zr_point center, double radius, struct zr_ink ink)
{
    enum { STEPS_LEAST = 24, STEPS_MOST = 360, POINTS = STEPS_MOST + 1 };
    struct zr_point points[POINTS];
    const double fitting = 8 * sqrt(radius > 0 ? radius : 0); /* chords stay within 0.08 pixels, up to 2000 of radius */
    const uint32_t even = fitting < STEPS_MOST ? (uint32_t)fitting / 4 * 4 : STEPS_MOST;
    const uint32_t steps = even > STEPS_LEAST ? even : STEPS_LEAST;
    for (uint32_t i = 0; i <= steps; i++) {
        double sine, cosine;
        zr_sine_cosine(i < steps ? 360.0 * i / steps : 0, &sine, &cosine);
        points[i] = (struct zr_point){center.x + radius * cosine, center.y + radius * sine};
    }
    zr_marks_add_line(marks, points, steps + 1, ink);
}

/* ---- drawing ---- */

double zr_mark_pen(const struct zr_mark *mark)
{
    if (mark->kind == ZR_MARK_AREA) return 0;
    return mark->kind == ZR_MARK_TEXT && mark->ink.width <= 0 ? zr_type_pen(mark->place.height) : mark->ink.width;
}

/* Draws the border of an area. */
static void draw_border(const struct zr_canvas *canvas, const struct zr_mark *mark, double width, uint32_t color)
{
    const uint32_t count = mark->path.ends[0];
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_point side[] = {mark->path.points[i], mark->path.points[i + 1 < count ? i + 1 : 0]};
        const uint32_t end = 2;
        zr_pen_draw(canvas, &(struct zr_path){1, &end, side}, width, color);
    }
}

/* Draws a mark, enlarged by `grow` pixels on all sides. */
static void draw(const struct zr_canvas *canvas, const struct zr_mark *mark, double grow, uint32_t color)
{
    const double pen = zr_mark_pen(mark) + 2 * grow;
    if (mark->kind == ZR_MARK_TEXT) zr_type_draw(canvas, mark->text, mark->place, pen, color);
    if (mark->kind == ZR_MARK_TEXT || mark->path.count == 0) return;
    if (mark->kind == ZR_MARK_LINES) zr_pen_draw(canvas, &mark->path, pen, color);
    if (mark->kind == ZR_MARK_AREA && grow > 0) draw_border(canvas, mark, pen, color);
    if (mark->kind == ZR_MARK_AREA) zr_fill_draw(canvas, mark->path.points, mark->path.ends[0], color);
}

enum zr_status zr_marks_draw(const struct zr_marks *marks, const struct zr_cancel *cancel,
                             const struct zr_canvas *canvas)
{
    for (int is_ink = 0; is_ink < 2; is_ink++)
        for (uint32_t i = 0; i < marks->count; i++) {
            const struct zr_mark *mark = &marks->at[i];
            if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
            if (is_ink)
                draw(canvas, mark, 0, mark->ink.color);
            else if (mark->ink.halo > 0)
                draw(canvas, mark, mark->ink.halo, mark->ink.paper);
        }
    return ZR_OK;
}
