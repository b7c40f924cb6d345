#include "drawing/center_lines.h"

static const double beyond = 3.0, same = 0.01; /* mm */
static const double parallel = 0.9999, across = 0.005;

enum zr_hole_side zr_hole_side_of(const struct zr_placed_views *placed, enum zr_page_view view,
                                  const struct zr_part_hole *hole)
{
    const zr_dvec3 back = placed->views[view].axes.back;
    const double along = fabs(zr_dvec3_dot(back, hole->hole.axis));
    if (view == ZR_PAGE_ISOMETRIC) return ZR_HOLE_OBLIQUE;
    if (placed->is_cut && placed->cut == view) {
        const double a = zr_dvec3_dot(back, hole->ends[0]), b = zr_dvec3_dot(back, hole->ends[1]);
        if ((a < b ? a : b) > placed->cut_place + 1e-6 * hole->radius) return ZR_HOLE_GONE;
    }
    return along > parallel ? ZR_HOLE_ROUND : along < across ? ZR_HOLE_ALONG : ZR_HOLE_OBLIQUE;
}

/* A line on the paper: along x at y = at, or along y at x = at; or any other one. */
struct line {
    enum { LEVEL, UPRIGHT, OTHER } kind;
    double at, low, high;
    struct zr_point from, to; /* of the others */
    bool has_middle, is_gone;
};

static struct line line_between(struct zr_point a, struct zr_point b, bool has_middle)
{
    if (fabs(a.y - b.y) <= same)
        return (struct line){.kind = LEVEL,
                             .at = 0.5 * (a.y + b.y),
                             .low = zr_least_of(a.x, b.x),
                             .high = zr_most_of(a.x, b.x),
                             .has_middle = has_middle};
    if (fabs(a.x - b.x) <= same)
        return (struct line){.kind = UPRIGHT,
                             .at = 0.5 * (a.x + b.x),
                             .low = zr_least_of(a.y, b.y),
                             .high = zr_most_of(a.y, b.y),
                             .has_middle = has_middle};
    return (struct line){.kind = OTHER, .from = a, .to = b, .has_middle = has_middle};
}

/* True if the hole is hidden in a view without hidden lines: it is seen from the side, and no plane cuts it. */
static bool is_hidden(const struct zr_placed_views *placed, enum zr_page_view view, const struct zr_part_hole *hole)
{
    const double from = zr_dvec3_dot(placed->views[view].axes.back, hole->ends[0]) - placed->cut_place;
    if (placed->is_cut && placed->cut == view) return !(fabs(from) < hole->radius);
    return !placed->has_hidden;
}

/* Adds lines of a hole. Returns how many. */
static uint32_t lines_of(const struct zr_placed_views *placed, enum zr_page_view view, const struct zr_part_hole *hole,
                         struct line out[2])
{
    const enum zr_hole_side side = zr_hole_side_of(placed, view, hole);
    const double reach = zr_placed_factor(placed) * hole->radius + beyond;
    const struct zr_point a = zr_placed_world(placed, view, hole->ends[0]),
                          b = zr_placed_world(placed, view, hole->ends[1]);
    if (side == ZR_HOLE_ROUND) {
        out[0] = line_between((struct zr_point){a.x - reach, a.y}, (struct zr_point){a.x + reach, a.y}, true);
        out[1] = line_between((struct zr_point){a.x, a.y - reach}, (struct zr_point){a.x, a.y + reach}, true);
        return 2;
    }
    const double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);
    if (side != ZR_HOLE_ALONG || !(length > 0.0) || is_hidden(placed, view, hole)) return 0;
    const double dx = beyond * (x / length), dy = beyond * (y / length);
    out[0] = line_between((struct zr_point){a.x - dx, a.y - dy}, (struct zr_point){b.x + dx, b.y + dy}, false);
    return 1;
}

/* Joins lines that lie on one another. At most 2 * ZR_PART_HOLES_MAX lines: a million pairs. */
static void join(struct line *lines, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < i; k++) {
            struct line *a = &lines[i], *b = &lines[k];
            if (b->is_gone || a->kind == OTHER || a->kind != b->kind || fabs(a->at - b->at) > same) continue;
            if (a->low > b->high + same || b->low > a->high + same) continue;
            a->has_middle =
                a->has_middle && b->has_middle && fabs(a->low - b->low) <= same && fabs(a->high - b->high) <= same;
            if (b->low < a->low) a->low = b->low;
            if (b->high > a->high) a->high = b->high;
            b->is_gone = true;
        }
}

/* Drops lines that lie on the cutting line of the section, which is a chain line, too. */
static void drop_at_cut(const struct zr_placed_views *placed, struct line *lines, uint32_t count)
{
    struct zr_point ends[2];
    zr_placed_cut_line(placed, ends);
    const struct line line = line_between(ends[0], ends[1], false);
    for (uint32_t i = 0; i < count; i++)
        if (lines[i].kind == line.kind && line.kind != OTHER && fabs(lines[i].at - line.at) <= same)
            lines[i].is_gone = true;
}

static void add_line(struct zr_plot *plot, const struct line *line)
{
    struct zr_point from = line->from, to = line->to;
    if (line->is_gone) return;
    if (line->kind == LEVEL) {
        from = (struct zr_point){line->low, line->at};
        to = (struct zr_point){line->high, line->at};
    } else if (line->kind == UPRIGHT) {
        from = (struct zr_point){line->at, line->low};
        to = (struct zr_point){line->at, line->high};
    }
    zr_plot_add_straight(plot, ZR_PLOT_CENTER, from, to, line->has_middle);
}

bool zr_center_lines_add(struct zr_plot *plot, struct zr_arena *scratch, const struct zr_placed_views *placed,
                         enum zr_page_view view, const struct zr_part_holes *holes)
{
    struct line *lines = zr_arena_alloc(scratch, 2 * (size_t)holes->count, sizeof *lines);
    uint32_t count = 0;
    if (!lines) return false;
    for (uint32_t i = 0; i < holes->count; i++)
        count += lines_of(placed, view, &holes->at[i], &lines[count]);
    join(lines, count);
    if (placed->is_cut && placed->shown == view) drop_at_cut(placed, lines, count);
    for (uint32_t i = 0; i < count; i++)
        add_line(plot, &lines[i]);
    return true;
}
