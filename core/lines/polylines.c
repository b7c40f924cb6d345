#include "lines/polylines.h"

#include "base/cancel.h"
#include "lines/links.h"

static const double speck_visible = 12.0, speck_hidden = 3.0;

struct joining {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    const struct zr_line_pieces *pieces;
    double straight;
    uint32_t count, *numbers; /* of the pieces that are drawn */
    struct zr_segment *segments;
    struct zr_links links, near; /* `near`: of ends within a pixel */
    bool *is_seen, *is_speck;    /* by segment */
    struct zr_polylines *out;
};

static enum zr_stroke_class class_of(const struct zr_line_piece *piece)
{
    if (piece->is_hidden) return ZR_STROKE_HIDDEN;
    const bool is_outline = piece->kind == ZR_LINE_BORDER || piece->kind == ZR_LINE_CONTOUR;
    return is_outline || piece->is_cut || piece->is_at_background ? ZR_STROKE_OUTLINE : ZR_STROKE_INNER;
}

static bool make_segments(struct joining *j)
{
    for (uint32_t i = 0; i < j->pieces->count; i++)
        j->count += !j->pieces->at[i].is_dropped;
    j->numbers = zr_arena_alloc(j->arena, j->count, sizeof *j->numbers);
    j->segments = zr_arena_alloc(j->arena, j->count, sizeof *j->segments);
    j->is_seen = zr_arena_zero(j->arena, j->count, sizeof *j->is_seen);
    j->is_speck = zr_arena_zero(j->arena, j->count, sizeof *j->is_speck);
    if (!zr_arena_ok(j->arena)) return false;
    for (uint32_t i = 0, n = 0; i < j->pieces->count; i++) {
        const struct zr_line_piece *piece = &j->pieces->at[i];
        if (piece->is_dropped) continue;
        j->numbers[n] = i;
        j->segments[n++] =
            (struct zr_segment){.ends = {piece->ends[0], piece->ends[1]}, .class = (uint32_t)class_of(piece)};
    }
    return true;
}

/* ---- specks: connected lines, by a forest over nodes for each of visible and hidden ---- */

struct group {
    double length;
    bool is_at_background;
};

static uint32_t root_of(uint32_t *parents, uint32_t node)
{
    while (parents[node] != node)
        node = parents[node] = parents[parents[node]];
    return node;
}

/* Returns the node of an end among 2 * node_count: hidden lines touch hidden ones only. */
static uint32_t node_of(const struct joining *j, uint32_t end)
{
    const bool is_hidden = j->segments[end / 2].class == ZR_STROKE_HIDDEN;
    return j->near.nodes[end] + (is_hidden ? j->near.node_count : 0);
}

/* Joins the ends within a pixel, by links of a drawing of that share of the size. */
static enum zr_status join_near(struct joining *j)
{
    struct zr_segment *small = zr_arena_alloc(j->arena, j->count, sizeof *small);
    if (!small) return ZR_NO_MEMORY;
    for (uint32_t s = 0; s < j->count; s++) {
        small[s] = j->segments[s];
        for (int k = 0; k < 2; k++) {
            small[s].ends[k].x *= ZR_NODE_PIXELS;
            small[s].ends[k].y *= ZR_NODE_PIXELS;
        }
    }
    return zr_links_make(j->arena, j->cancel, small, j->count, &j->near);
}

static bool find_specks(struct joining *j)
{
    const uint32_t nodes = 2 * j->near.node_count;
    uint32_t *parents = zr_arena_alloc(j->arena, nodes, sizeof *parents);
    struct group *groups = zr_arena_zero(j->arena, nodes, sizeof *groups);
    if (!zr_arena_ok(j->arena)) return false;
    for (uint32_t n = 0; n < nodes; n++)
        parents[n] = n;
    for (uint32_t s = 0; s < j->count; s++) {
        const uint32_t a = root_of(parents, node_of(j, 2 * s)), b = root_of(parents, node_of(j, 2 * s + 1));
        parents[a < b ? b : a] = a < b ? a : b;
    }
    for (uint32_t s = 0; s < j->count; s++) {
        const struct zr_line_piece *piece = &j->pieces->at[j->numbers[s]];
        struct group *group = &groups[root_of(parents, node_of(j, 2 * s))];
        group->length += zr_line_piece_length(piece);
        group->is_at_background = group->is_at_background || piece->is_at_background;
    }
    for (uint32_t s = 0; s < j->count; s++) {
        const struct group *group = &groups[root_of(parents, node_of(j, 2 * s))];
        const double least = j->segments[s].class == ZR_STROKE_HIDDEN ? speck_hidden : speck_visible;
        j->is_speck[s] = !group->is_at_background && group->length < least;
    }
    return true;
}

/* ---- polylines ---- */

static void add_point(struct zr_polylines *out, const struct zr_window_point *p)
{
    out->points[out->point_count][0] = p->x;
    out->points[out->point_count++][1] = p->y;
}

/* Returns the distance of a point from the chord between two others. */
static double distance_of(const double p[2], const double from[2], const double to[2])
{
    const double x = to[0] - from[0], y = to[1] - from[1], square = x * x + y * y;
    double t = square > 0.0 ? ((p[0] - from[0]) * x + (p[1] - from[1]) * y) / square : 0.0;
    if (t < 0.0) t = 0.0;
    if (t > 1.0) t = 1.0;
    const double dx = p[0] - (from[0] + t * x), dy = p[1] - (from[1] + t * y);
    return sqrt(dx * dx + dy * dy);
}

/* Removes points near the chord of the last kept one and the next. All points since the last kept one are compared, so
 * that errors do not add up; from 16 points on, one is kept. */
static void simplify(struct zr_polylines *out, double straight, struct zr_polyline *line)
{
    enum { SINCE_MOST = 16 };
    double(*points)[2] = out->points + line->first;
    uint32_t kept = 1, last = 0; /* `last`: index before removal of the last kept point */
    for (uint32_t i = 1; i + 1 < line->count; i++) {
        bool is_straight = i - last < SINCE_MOST;
        for (uint32_t k = last + 1; is_straight && k <= i; k++)
            is_straight = distance_of(points[k], points[kept - 1], points[i + 1]) <= straight;
        if (is_straight) continue;
        points[kept][0] = points[i][0];
        points[kept++][1] = points[i][1];
        last = i;
    }
    memmove(points[kept], points[line->count - 1], sizeof *points);
    line->count = kept + 1;
    out->point_count = line->first + line->count;
}

/* Adds the polyline that begins at an end. */
static void add_polyline(const struct joining *j, uint32_t first)
{
    struct zr_polylines *out = j->out;
    const struct zr_line_piece *piece = &j->pieces->at[j->numbers[first / 2]];
    struct zr_polyline *line = &out->at[out->count++];
    *line = (struct zr_polyline){.first = out->point_count,
                                 .class = (uint8_t)j->segments[first / 2].class,
                                 .kind = piece->kind,
                                 .line = piece->line};
    add_point(out, &j->segments[first / 2].ends[first % 2]);
    uint32_t end = first;
    do {
        j->is_seen[end / 2] = true;
        add_point(out, &j->segments[end / 2].ends[1 - end % 2]);
        end = zr_links_next(&j->links, end);
    } while (end != ZR_NO_END && end != first);
    line->count = out->point_count - line->first;
    simplify(out, j->straight, line);
}

enum zr_status zr_polylines_make(struct zr_arena *arena, const struct zr_cancel *cancel,
                                 const struct zr_line_pieces *pieces, double straight, struct zr_polylines *out)
{
    struct joining j = {.arena = arena, .cancel = cancel, .pieces = pieces, .straight = straight, .out = out};
    *out = (struct zr_polylines){0};
    if (!make_segments(&j)) return ZR_NO_MEMORY;
    enum zr_status status = zr_links_make(arena, cancel, j.segments, j.count, &j.links);
    if (status == ZR_OK) status = join_near(&j);
    if (status != ZR_OK) return status;
    out->at = zr_arena_alloc(arena, j.count, sizeof *out->at);
    out->points = zr_arena_alloc(arena, 2 * (size_t)j.count, sizeof *out->points);
    if (!zr_arena_ok(arena) || !find_specks(&j)) return ZR_NO_MEMORY;
    for (uint32_t s = 0; s < j.count; s++)
        if (!j.is_seen[s] && !j.is_speck[s]) add_polyline(&j, zr_links_first(&j.links, s));
    return ZR_OK;
}
