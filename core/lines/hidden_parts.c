#include "lines/hidden_parts.h"

#include "base/cancel.h"
#include "base/run.h"

/* Parts within a cell: a cell holds less than 23 pixels of a line, and parts are a gap apart from one another. */
enum { PARTS_PER_CELL = 48, PARTS_KEPT = 4, LINES_PER_RANGE = 16, HIDERS_PER_CANCEL_CHECK = 1 << 14 };

/* Widens the boxes of lines, in pixels: more than rounding moves them. */
static const double box_rim = 1e-4;

struct finding {
    const struct zr_window_mesh *mesh;
    const struct zr_cells *cells;
    const struct zr_cancel *cancel;
    const struct zr_line *lines;
    struct zr_part_of_line (*kept)[PARTS_KEPT]; /* the first ones of each line */
    uint32_t *counts;                           /* by line: parts; then the number of its first one */
    struct zr_part_of_line *parts;
};

/* A line as it is walked, and where its parts go. */
struct walk {
    const struct zr_line *line;
    double dx, dy, gap;          /* the gap in t */
    struct zr_part_of_line open; /* the last part, which may still grow; empty: begin > end */
    uint32_t count, room;
    uint32_t unchecked;            /* triangles since the last check of `cancel` */
    struct zr_part_of_line *parts; /* `room` of them are written */
};

/* ---- sorted parts of a cell ---- */

struct parts {
    uint32_t count;
    struct zr_part_of_line at[PARTS_PER_CELL];
};

/* Adds a part, and joins it with the parts whose distance from it is below `gap`. */
static void add_part(struct parts *parts, double begin, double end, double gap)
{
    uint32_t first = 0;
    while (first < parts->count && parts->at[first].end + gap <= begin)
        first++;
    uint32_t last = first;
    for (; last < parts->count && parts->at[last].begin < end + gap; last++) {
        if (parts->at[last].begin < begin) begin = parts->at[last].begin;
        if (parts->at[last].end > end) end = parts->at[last].end;
    }
    if (last == first && parts->count == PARTS_PER_CELL) return; /* impossible: see PARTS_PER_CELL */
    memmove(&parts->at[first + 1], &parts->at[last], (parts->count - last) * sizeof *parts->at);
    parts->count = parts->count + 1 - (last - first);
    parts->at[first] = (struct zr_part_of_line){begin, end};
}

/* ---- one triangle ---- */

/* Cuts the interval to where from + t (to - from) > 0, both values being at its ends in t = 0 and t = 1. */
static bool cut(double from, double to, double interval[2])
{
    if (from <= 0.0 && to <= 0.0) return false;
    if (from > 0.0 && to > 0.0) return true;
    const double t = from / (from - to);
    if (from < to) {
        if (t > interval[0]) interval[0] = t;
    } else if (t < interval[1]) {
        interval[1] = t;
    }
    return interval[0] < interval[1];
}

static double side_of(const struct zr_window_point *a, const struct zr_window_point *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* Finds the interval of a line that a triangle hides. */
static bool hides(const struct zr_window_point *const corners[3], const struct walk *w, double interval[2])
{
    const struct zr_window_point *a = corners[0], *b = corners[1], *c = corners[2];
    const struct zr_window_point *p = &w->line->ends[0], *q = &w->line->ends[1];
    for (int k = 0; k < 3; k++) {
        const struct zr_window_point *from = corners[k], *to = corners[(k + 1) % 3];
        const double x = to->x - from->x, y = to->y - from->y, rim = ZR_HIDDEN_RIM * (fabs(x) + fabs(y));
        if (!cut(side_of(from, to, p->x, p->y) + rim, side_of(from, to, q->x, q->y) + rim, interval)) return false;
    }
    const double area = side_of(a, b, c->x, c->y);
    const double slope_x = ((b->z - a->z) * (c->y - a->y) - (c->z - a->z) * (b->y - a->y)) / area;
    const double slope_y = ((c->z - a->z) * (b->x - a->x) - (b->z - a->z) * (c->x - a->x)) / area;
    const double limit = ZR_HIDDEN_DEPTH + ZR_HIDDEN_SLOPE * sqrt(slope_x * slope_x + slope_y * slope_y);
    const double over_p = p->z - (a->z + (slope_x * (p->x - a->x) + slope_y * (p->y - a->y))) - limit;
    const double over_q = q->z - (a->z + (slope_x * (q->x - a->x) + slope_y * (q->y - a->y))) - limit;
    return cut(over_p, over_q, interval);
}

/* ---- one line ---- */

static void flush(struct walk *w)
{
    const bool is_at_end = w->open.begin <= 0.0 || w->open.end >= 1.0, is_empty = !(w->open.begin < w->open.end);
    if (is_empty || (!is_at_end && w->open.end - w->open.begin < w->gap)) return;
    if (w->count < w->room) w->parts[w->count] = w->open;
    w->count++;
}

/* Appends the parts of a cell, which begin where those before end or behind. */
static void append(struct walk *w, const struct parts *parts)
{
    for (uint32_t i = 0; i < parts->count; i++) {
        if (w->open.begin <= w->open.end && parts->at[i].begin < w->open.end + w->gap) {
            if (parts->at[i].end > w->open.end) w->open.end = parts->at[i].end;
            continue;
        }
        flush(w);
        w->open = parts->at[i];
    }
}

/* Returns the box of a line between two t in a cell. */
static struct zr_cell_box box_of(const struct finding *f, const struct walk *w, uint32_t cell, double begin, double end)
{
    const struct zr_window_point *p = &w->line->ends[0];
    const uint32_t column = cell % f->cells->columns, row = cell / f->cells->columns;
    const double x0 = p->x + begin * w->dx, x1 = p->x + end * w->dx, y0 = p->y + begin * w->dy, y1 = p->y + end * w->dy;
    return (struct zr_cell_box){
        zr_box_step((x0 < x1 ? x0 : x1) - box_rim, column), zr_box_step((y0 < y1 ? y0 : y1) - box_rim, row),
        zr_box_step((x0 < x1 ? x1 : x0) + box_rim, column), zr_box_step((y0 < y1 ? y1 : y0) + box_rim, row)};
}

static void visit_cell(const struct finding *f, struct walk *w, uint32_t cell, double begin, double end)
{
    const double back = w->line->ends[0].z > w->line->ends[1].z ? w->line->ends[0].z : w->line->ends[1].z;
    const struct zr_cell_box box = box_of(f, w, cell, begin, end);
    struct parts parts = {.count = 0};
    const uint32_t first = f->cells->firsts[cell], count = f->cells->firsts[cell + 1] - first;
    for (uint32_t i = first; i < first + count && !zr_cell_ends(&f->cells->entries[i], back, count); i++) {
        if (++w->unchecked > HIDERS_PER_CANCEL_CHECK) {
            if (zr_is_cancelled(f->cancel)) return;
            w->unchecked = 0;
        }
        const struct zr_cell_entry *entry = &f->cells->entries[i];
        if (zr_boxes_are_apart(&entry->box, &box) || back < (double)entry->near) continue;
        const uint32_t hider = entry->hider, source = zr_hider_source(f->mesh, hider);
        const uint32_t *corners = f->mesh->corners[hider];
        const struct zr_window_point *points[3] = {&f->mesh->points[corners[0]], &f->mesh->points[corners[1]],
                                                   &f->mesh->points[corners[2]]};
        double interval[2] = {begin, end};
        if (source == w->line->triangles[0] || source == w->line->triangles[1]) continue;
        if (!hides(points, w, interval)) continue;
        add_part(&parts, interval[0], interval[1], w->gap);
        if (parts.at[0].begin <= begin && parts.at[0].end >= end) break;
    }
    append(w, &parts);
}

/* Returns the t at which a coordinate leaves a cell; never if it does not change. */
static double exit_of(double from, double change, uint32_t cell)
{
    if (change == 0.0) return HUGE_VAL;
    return (zr_cell_border(change > 0.0 ? cell + 1 : cell) - from) / change;
}

static void find_line(const struct finding *f, uint32_t number, struct walk *w)
{
    const struct zr_line *line = &f->lines[number];
    const struct zr_window_point *p = &line->ends[0], *q = &line->ends[1];
    w->line = line;
    w->dx = q->x - p->x;
    w->dy = q->y - p->y;
    w->gap = ZR_HIDDEN_GAP_PIXELS / sqrt(w->dx * w->dx + w->dy * w->dy);
    w->open = (struct zr_part_of_line){1.0, 0.0};
    w->count = 0;
    uint32_t column = zr_cell_at(p->x, f->cells->columns), row = zr_cell_at(p->y, f->cells->rows);
    const uint32_t steps_most = f->cells->columns + f->cells->rows;
    double begin = 0.0;
    for (uint32_t step = 0; step <= steps_most && begin < 1.0; step++) {
        if (zr_is_cancelled(f->cancel)) return;
        const double at_x = exit_of(p->x, w->dx, column), at_y = exit_of(p->y, w->dy, row);
        double end = at_x < at_y ? at_x : at_y;
        if (!(end < 1.0)) end = 1.0;
        if (end > begin) visit_cell(f, w, row * f->cells->columns + column, begin, end);
        if (end > begin) begin = end;
        if (at_x <= at_y) {
            if (w->dx > 0.0 ? column + 1 == f->cells->columns : column == 0) break;
            column = w->dx > 0.0 ? column + 1 : column - 1;
        } else {
            if (w->dy > 0.0 ? row + 1 == f->cells->rows : row == 0) break;
            row = w->dy > 0.0 ? row + 1 : row - 1;
        }
    }
    flush(w);
}

/* ---- all lines ---- */

static void count_range(void *context, size_t begin, size_t end)
{
    const struct finding *f = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(f->cancel); i++) {
        struct walk w = {.room = PARTS_KEPT, .parts = f->kept[i]};
        find_line(f, (uint32_t)i, &w);
        f->counts[i] = w.count;
    }
}

static void write_range(void *context, size_t begin, size_t end)
{
    const struct finding *f = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(f->cancel); i++) {
        const uint32_t count = f->counts[i + 1] - f->counts[i];
        struct walk w = {.room = count, .parts = f->parts + f->counts[i]};
        if (count <= PARTS_KEPT)
            memcpy(w.parts, f->kept[i], count * sizeof *w.parts);
        else
            find_line(f, (uint32_t)i, &w);
    }
}

enum zr_status zr_hidden_parts_find(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                    const struct zr_cells *cells, const struct zr_lines *lines,
                                    struct zr_hidden_parts *out)
{
    struct finding f = {.mesh = mesh, .cells = cells, .cancel = run->cancel, .lines = lines->at};
    uint64_t sum = 0;
    f.kept = zr_arena_alloc(run->arena, lines->count, sizeof *f.kept);
    f.counts = zr_arena_alloc(run->arena, (size_t)lines->count + 1, sizeof *f.counts);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, lines->count, LINES_PER_RANGE, count_range, &f);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    for (uint32_t i = 0; i <= lines->count; i++) {
        const uint32_t own = i < lines->count ? f.counts[i] : 0;
        f.counts[i] = (uint32_t)sum;
        sum += own;
    }
    f.parts = sum <= UINT32_MAX ? zr_arena_alloc(run->arena, sum, sizeof *f.parts) : NULL;
    if (!f.parts) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, lines->count, LINES_PER_RANGE, write_range, &f);
    *out = (struct zr_hidden_parts){.firsts = f.counts, .parts = f.parts};
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
