#include "lines/contour_steps.h"

#include "base/cancel.h"
#include "lines/links.h"

enum { BRIDGES_SEEN_MOST = 64 /* free ends that are compared per cell */ };

static const float step_least = 1.0f, step_of_line = 4.0f;
static const double run_most = 6.0, bridge_most = 6.0, bridge_cosine = 0.7, length_least = 12.0;

/* The contours that are left, linked. */
struct contours {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct zr_line_pieces *pieces;
    uint32_t count, *numbers; /* of pieces */
    struct zr_segment *segments;
    struct zr_links links;
    bool *is_seen;
};

static bool is_contour(const struct zr_line_piece *piece)
{
    return piece->kind == ZR_LINE_CONTOUR && !piece->is_hidden && !piece->is_dropped;
}

static enum zr_status link_contours(struct contours *c)
{
    c->count = 0;
    for (uint32_t i = 0; i < c->pieces->count; i++)
        c->count += is_contour(&c->pieces->at[i]);
    c->numbers = zr_arena_alloc(c->arena, c->count, sizeof *c->numbers);
    c->segments = zr_arena_alloc(c->arena, c->count, sizeof *c->segments);
    c->is_seen = zr_arena_zero(c->arena, c->count, sizeof *c->is_seen);
    if (!zr_arena_ok(c->arena)) return ZR_NO_MEMORY;
    for (uint32_t i = 0, n = 0; i < c->pieces->count; i++) {
        const struct zr_line_piece *piece = &c->pieces->at[i];
        if (!is_contour(piece)) continue;
        c->numbers[n] = i;
        c->segments[n++] = (struct zr_segment){.ends = {piece->ends[0], piece->ends[1]}};
    }
    return zr_links_make(c->arena, c->cancel, c->segments, c->count, &c->links);
}

static struct zr_line_piece *piece_at(const struct contours *c, uint32_t end)
{
    return &c->pieces->at[c->numbers[end / 2]];
}

/* ---- runs without a step ---- */

static bool is_low(const struct zr_line_piece *piece)
{
    return piece->step < step_least && !piece->is_at_background;
}

/* Drops `count` pieces from an end on. */
static void drop(const struct contours *c, uint32_t end, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++, end = zr_links_next(&c->links, end))
        piece_at(c, end)->is_dropped = true;
}

/* Drops the runs of a line; `first` is its first end. A ring is walked from one of its steps, so that runs are whole.
 */
static void drop_runs(const struct contours *c, uint32_t first)
{
    const bool is_ring = c->links.ends[first] != ZR_NO_END;
    uint32_t begin = ZR_NO_END, count = 0, seen = 0;
    double length = 0.0;
    for (uint32_t end = first; end != ZR_NO_END && (seen == 0 || end != first); seen++) {
        const struct zr_line_piece *piece = piece_at(c, end);
        c->is_seen[end / 2] = true;
        if (is_low(piece)) {
            if (count == 0) begin = end;
            count++;
            length += zr_line_piece_length(piece);
        } else {
            if (count > 0 && (length > run_most || (begin == first && !is_ring))) drop(c, begin, count);
            count = 0;
            length = 0.0;
        }
        end = zr_links_next(&c->links, end);
    }
    if (count > 0 && (length > run_most || !is_ring || count == seen)) drop(c, begin, count);
}

/* Returns where the walk of a line begins: its first end; in a ring, behind a step if it has one. */
static uint32_t begin_of(const struct contours *c, uint32_t segment)
{
    const uint32_t first = zr_links_first(&c->links, segment);
    uint32_t end = first;
    if (c->links.ends[first] == ZR_NO_END) return first;
    do {
        const uint32_t next = zr_links_next(&c->links, end);
        if (!is_low(piece_at(c, end))) return end;
        end = next;
    } while (end != first);
    return first;
}

/* ---- bridges ---- */

/* A free end, and the direction away from its piece. */
struct free_end {
    uint32_t end, next; /* next: index + 1 of the next one in the cell */
    double x, y, out_x, out_y;
    bool is_used;
};

static struct free_end free_end_of(const struct contours *c, uint32_t end)
{
    const struct zr_window_point *p = &c->segments[end / 2].ends[end % 2], *q = &c->segments[end / 2].ends[1 - end % 2];
    const double x = p->x - q->x, y = p->y - q->y, length = sqrt(x * x + y * y);
    return (struct free_end){.end = end,
                             .x = p->x,
                             .y = p->y,
                             .out_x = length > 0.0 ? x / length : 0.0,
                             .out_y = length > 0.0 ? y / length : 0.0};
}

/* Returns the distance of two ends that may be bridged, else HUGE_VAL. */
static double gap_of(const struct free_end *a, const struct free_end *b)
{
    const double x = b->x - a->x, y = b->y - a->y, length = sqrt(x * x + y * y);
    if (a->end / 2 == b->end / 2 || b->is_used || !(length < bridge_most)) return HUGE_VAL;
    if (length == 0.0) return a->out_x * b->out_x + a->out_y * b->out_y <= -bridge_cosine ? 0.0 : HUGE_VAL;
    const bool a_looks = a->out_x * x + a->out_y * y >= bridge_cosine * length,
               b_looks = b->out_x * x + b->out_y * y <= -bridge_cosine * length;
    return a_looks && b_looks ? length : HUGE_VAL;
}

struct bridging {
    const struct contours *of;
    uint32_t columns, rows;
    uint32_t *cells; /* index + 1 of the first free end of each cell */
    struct free_end *ends;
    uint32_t count;
};

static uint32_t nearest_of(const struct bridging *b, uint32_t number)
{
    const struct free_end *own = &b->ends[number];
    const uint32_t column = zr_cell_at(own->x, b->columns), row = zr_cell_at(own->y, b->rows);
    double least = HUGE_VAL;
    uint32_t found = ZR_NO_END;
    for (uint32_t y = row > 0 ? row - 1 : 0; y <= row + 1 && y < b->rows; y++)
        for (uint32_t x = column > 0 ? column - 1 : 0; x <= column + 1 && x < b->columns; x++) {
            uint32_t seen = 0;
            for (uint32_t n = b->cells[y * b->columns + x]; n != 0 && seen < BRIDGES_SEEN_MOST; seen++) {
                const double gap = gap_of(own, &b->ends[n - 1]);
                if (gap < least || (gap == least && gap < HUGE_VAL && n - 1 < found)) {
                    least = gap;
                    found = n - 1;
                }
                n = b->ends[n - 1].next;
            }
        }
    return found;
}

static bool list_free_ends(struct bridging *b, const struct zr_cells *cells)
{
    const struct contours *c = b->of;
    for (uint32_t end = 0; end < 2 * c->count; end++)
        b->count += c->links.ends[end] == ZR_NO_END;
    b->ends = zr_arena_alloc(c->arena, b->count, sizeof *b->ends);
    b->cells = zr_arena_zero(c->arena, (size_t)cells->columns * cells->rows, sizeof *b->cells);
    if (!zr_arena_ok(c->arena)) return false;
    b->count = 0;
    for (uint32_t end = 0; end < 2 * c->count; end++) {
        if (c->links.ends[end] != ZR_NO_END) continue;
        struct free_end own = free_end_of(c, end);
        uint32_t *cell = &b->cells[zr_cell_at(own.y, b->rows) * b->columns + zr_cell_at(own.x, b->columns)];
        own.next = *cell;
        b->ends[b->count++] = own;
        *cell = b->count;
    }
    return true;
}

static struct zr_line_piece bridge_of(const struct contours *c, uint32_t a, uint32_t b)
{
    return (struct zr_line_piece){.ends = {c->segments[a / 2].ends[a % 2], c->segments[b / 2].ends[b % 2]},
                                  .line = ZR_NO_LINE,
                                  .kind = ZR_LINE_CONTOUR};
}

static enum zr_status add_bridges(const struct contours *c, const struct zr_cells *cells, struct zr_arena *keeping,
                                  struct zr_line_piece **bridges, uint32_t *bridge_count)
{
    struct bridging b = {.of = c, .columns = cells->columns, .rows = cells->rows};
    if (!list_free_ends(&b, cells)) return ZR_NO_MEMORY;
    *bridges = zr_arena_alloc(keeping, b.count / 2 + 1, sizeof **bridges);
    if (!*bridges) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < b.count && !zr_is_cancelled(c->cancel); i++) {
        const uint32_t other = b.ends[i].is_used ? ZR_NO_END : nearest_of(&b, i);
        if (other == ZR_NO_END) continue;
        b.ends[i].is_used = b.ends[other].is_used = true;
        (*bridges)[(*bridge_count)++] = bridge_of(c, b.ends[i].end, b.ends[other].end);
    }
    return zr_is_cancelled(c->cancel) ? ZR_CANCELLED : ZR_OK;
}

/* ---- whole lines ---- */

static void judge_line(const struct contours *c, uint32_t first)
{
    double length = 0.0;
    uint32_t seen = 0;
    bool has_step = false, is_at_background = false;
    for (uint32_t end = first; end != ZR_NO_END && (seen == 0 || end != first); seen++) {
        const struct zr_line_piece *piece = piece_at(c, end);
        c->is_seen[end / 2] = true;
        length += zr_line_piece_length(piece);
        has_step = has_step || piece->step_most >= step_of_line;
        is_at_background = is_at_background || piece->is_at_background;
        end = zr_links_next(&c->links, end);
    }
    if (is_at_background || (has_step && length >= length_least)) return;
    drop(c, first, seen);
}

/* Links the remaining pieces, and calls `use` with the first piece of each line. */
static enum zr_status each_line(struct contours *c, void (*use)(const struct contours *, uint32_t))
{
    const enum zr_status status = link_contours(c);
    for (uint32_t i = 0; status == ZR_OK && i < c->count; i++)
        if (!c->is_seen[i]) use(c, begin_of(c, i));
    return status;
}

enum zr_status zr_contour_steps_apply(struct zr_arena *arena, const struct zr_cancel *cancel,
                                      const struct zr_cells *cells, struct zr_line_pieces *pieces)
{
    struct contours c = {.arena = arena, .cancel = cancel, .pieces = pieces};
    struct zr_line_piece *bridges = NULL;
    uint32_t bridge_count = 0;
    enum zr_status status = each_line(&c, drop_runs);
    if (status == ZR_OK) status = link_contours(&c);
    if (status == ZR_OK) status = add_bridges(&c, cells, arena, &bridges, &bridge_count);
    if (status != ZR_OK) return status;
    const uint32_t count = pieces->count + bridge_count;
    struct zr_line_piece *grown = zr_arena_grow(arena, pieces->at, pieces->count, count, sizeof *grown);
    if (!grown) return ZR_NO_MEMORY;
    memcpy(grown + pieces->count, bridges, bridge_count * sizeof *grown);
    *pieces = (struct zr_line_pieces){.count = count, .at = grown};
    return each_line(&c, judge_line);
}
