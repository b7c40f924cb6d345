/* painter.c - raster: paints from back to front without a z-buffer: the depth sort of Newell, Newell & Sancha ("A
 * Solution to the Hidden Surface Problem", Proc. ACM National Conference, 1972; Sutherland, Sproull & Schumacker, "A
 * Characterization of Ten Hidden-Surface Algorithms", 1974).
 *
 * Pieces are listed from the farthest on. The first is painted if it hides nothing of the later ones that overlap its
 * range of depths: their boxes are apart, or it is nearer at none of their common samples. A piece that it hides has to
 * be painted first and is tried in its place. So a chain of pieces grows, each partly hidden by the one before. If each
 * of two pieces is nearer somewhere, one is cut. A chain that returns to one of its own pieces is cut, too.
 *
 * Exact: pieces are sets of samples (piece.h), so no cut is rounded. The order at one sample is total: depth, then the
 *        number of the primitive. In a chain C1 .. Ck that returns to C1, each hides the next wherever both are, and Ck
 *        hides C1. If each were contained in the next, and Ck in C1, all would be the same samples, and the order at
 *        each would be cyclic. So some piece extends beyond the next, and is cut into its parts inside and outside of
 *        that. Every cut leaves two parts that are not empty, so the algorithm ends.
 *
 * Cost: pieces that overlap in depth are compared two by two. If all polygons of a scene overlap in depth, time grows
 *       with the square of their number, and more with cuts. The number of polygons does not predict the time, so work
 *       is counted and limited.
 */
#include <assert.h>

#include "base/run.h"
#include "raster/textbook/piece.h"
#include "raster/textbook/trace.h"

enum { PIECES_PER_CANCEL_CHECK = 4096 };

struct painting {
    struct zr_pieces pieces;
    uint32_t ranks;   /* ranks in use: 1 .. ranks - 1 */
    uint32_t *firsts; /* by rank: its first piece in the list; 0: all are painted */
    uint32_t *skips;  /* by rank without a piece: a higher rank, with no piece in between */
    uint32_t *chain;  /* pieces under test, each partly hidden by the one before */
    uint32_t length, room;
};

/* ---- the list ---- */

/* Merges the ordered items begin .. middle - 1 and middle .. end - 1, the farthest first. */
static void merge(const struct zr_piece *from, struct zr_piece *to, uint32_t begin, uint32_t middle, uint32_t end)
{
    uint32_t a = begin, b = middle;
    for (uint32_t i = begin; i < end; i++)
        to[i] = b == end || (a < middle && from[a].far >= from[b].far) ? from[a++] : from[b++];
}

/* Sorts pieces by a bottom-up merge sort, so that neighbours in the list are neighbours in memory. */
static bool sort(struct zr_pieces *pieces)
{
    struct zr_piece *from = pieces->items, *to = zr_arena_alloc(pieces->arena, pieces->room, sizeof *to);
    if (!to) return false;
    for (uint64_t run = 1; run < pieces->count; run *= 2) {
        for (uint64_t begin = 1; begin < pieces->count; begin += 2 * run) {
            uint64_t middle = begin + run, end = begin + 2 * run;
            if (middle > pieces->count) middle = pieces->count;
            if (end > pieces->count) end = pieces->count;
            merge(from, to, (uint32_t)begin, (uint32_t)middle, (uint32_t)end);
        }
        struct zr_piece *swap = from;
        from = to;
        to = swap;
    }
    pieces->items = from;
    return true;
}

static bool make_list(struct painting *painting)
{
    struct zr_pieces *pieces = &painting->pieces;
    painting->ranks = pieces->count;
    painting->firsts = zr_arena_alloc(pieces->arena, painting->ranks, sizeof *painting->firsts);
    painting->skips = zr_arena_alloc(pieces->arena, painting->ranks, sizeof *painting->skips);
    if (!zr_arena_ok(pieces->arena)) return false;
    for (uint32_t i = 1; i < pieces->count; i++) {
        struct zr_piece *piece = &pieces->items[i];
        piece->order = piece->far;
        piece->rank = i;
        piece->clear = 1;
        piece->previous = i - 1;
        piece->next = i + 1 < pieces->count ? i + 1 : 0;
        painting->firsts[i] = i;
        painting->skips[i] = i + 1;
    }
    return true;
}

/* Returns the first piece in the list whose rank is not below `rank`, or 0. */
static uint32_t first_from(struct painting *painting, uint32_t rank)
{
    uint32_t found = rank;
    while (found < painting->ranks && painting->firsts[found] == 0)
        found = painting->skips[found];
    for (uint32_t next; rank < found; rank = next) { /* path compression */
        next = painting->skips[rank];
        painting->skips[rank] = found;
    }
    return found < painting->ranks ? painting->firsts[found] : 0;
}

/* Links a before b; 0 for either is the list's end. */
static void link_up(struct zr_piece *items, uint32_t a, uint32_t b)
{
    if (a > 0) items[a].next = b;
    if (b > 0) items[b].previous = a;
}

static void take_out(struct painting *painting, uint32_t piece)
{
    struct zr_piece *items = painting->pieces.items;
    uint32_t rank = items[piece].rank, next = items[piece].next;
    if (painting->firsts[rank] == piece) painting->firsts[rank] = next > 0 && items[next].rank == rank ? next : 0;
    link_up(items, items[piece].previous, next);
}

/* Replaces a piece by its parts. */
static void put_in_place(struct painting *painting, uint32_t whole, uint32_t first, uint32_t second)
{
    struct zr_piece *items = painting->pieces.items;
    items[first].order = items[second].order = items[whole].order;
    items[first].rank = items[second].rank = items[whole].rank;
    items[first].clear = items[second].clear = items[whole].clear;
    if (painting->firsts[items[whole].rank] == whole) painting->firsts[items[whole].rank] = first;
    link_up(items, items[whole].previous, first);
    link_up(items, first, second);
    link_up(items, second, items[whole].next);
}

/* ---- trace ---- */

static struct zr_trace *trace_of(const struct painting *painting)
{
    return painting->pieces.samples->trace;
}

static int64_t id_of(const struct painting *painting, uint32_t piece)
{
    return painting->pieces.items[piece].id;
}

static void trace_piece(const struct painting *painting, uint32_t number)
{
    const struct zr_piece *piece = &painting->pieces.items[number];
    struct zr_trace *trace = trace_of(painting);
    zr_trace_begin(trace, NULL, '{');
    zr_trace_integer(trace, "piece", piece->id);
    zr_trace_integer(trace, "primitive", piece->primitive + 1);
    zr_trace_float(trace, "near", piece->near);
    zr_trace_float(trace, "far", piece->far);
    zr_trace_begin(trace, "spans", '[');
    for (uint32_t s = piece->first_span; s > 0; s = painting->pieces.spans[s].next) {
        const struct zr_span *span = &painting->pieces.spans[s];
        zr_trace_integers(trace, NULL, (int64_t[]){span->y, span->begin, span->end}, 3);
    }
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

/* Records the list before anything is painted. */
static void trace_list(const struct painting *painting)
{
    struct zr_trace *trace = trace_of(painting);
    zr_trace_step(trace);
    zr_trace_begin(trace, "order", '[');
    for (uint32_t i = 1; i < painting->pieces.count; i++)
        trace_piece(painting, i);
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

/* Records a step of one or two pieces; 0: no second one. */
static void trace_pieces(const struct painting *painting, const char *key, uint32_t a, uint32_t b)
{
    struct zr_trace *trace = trace_of(painting);
    zr_trace_step(trace);
    if (b == 0)
        zr_trace_integer(trace, key, id_of(painting, a));
    else
        zr_trace_integers(trace, key, (int64_t[]){id_of(painting, a), id_of(painting, b)}, 2);
}

/* Records which test has compared two pieces. overlap: of their common samples, NULL: not looked at. */
static void trace_compare(const struct painting *painting, uint32_t p, uint32_t q, const struct zr_overlap *overlap)
{
    const struct zr_piece *a = &painting->pieces.items[p], *b = &painting->pieces.items[q];
    struct zr_trace *trace = trace_of(painting);
    trace_pieces(painting, "compare", p, q);
    zr_trace_text(trace, "test", overlap ? "pixels" : b->far < a->near ? "depth" : "box");
    zr_trace_bool(trace, "nearer", overlap && overlap->nearer > 0);
    zr_trace_bool(trace, "farther", overlap && overlap->farther > 0);
    zr_trace_end(trace, '}');
}

static void trace_cycle(const struct painting *painting, uint32_t start)
{
    struct zr_trace *trace = trace_of(painting);
    bool is_in = false;
    zr_trace_step(trace);
    zr_trace_begin(trace, "cycle", '[');
    for (uint32_t i = 0; i < painting->length; i++) {
        is_in |= painting->chain[i] == start;
        if (is_in) zr_trace_integer(trace, NULL, id_of(painting, painting->chain[i]));
    }
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

static void trace_cut(const struct painting *painting, uint32_t piece, uint32_t other, uint32_t first, uint32_t second)
{
    struct zr_trace *trace = trace_of(painting);
    trace_pieces(painting, "split", piece, 0);
    zr_trace_integer(trace, "by", id_of(painting, other));
    zr_trace_begin(trace, "into", '[');
    trace_piece(painting, first);
    trace_piece(painting, second);
    zr_trace_end(trace, ']');
    zr_trace_end(trace, '}');
}

/* ---- the chain ---- */

static bool push(struct painting *painting, uint32_t piece)
{
    if (painting->length == painting->room) {
        uint32_t room = painting->room > 0 ? 2 * painting->room : 64;
        uint32_t *chain = zr_arena_grow(painting->pieces.arena, painting->chain, painting->length, room, sizeof *chain);
        if (!chain) return false;
        painting->chain = chain;
        painting->room = room;
    }
    painting->chain[painting->length++] = piece;
    painting->pieces.items[piece].in_chain = true;
    return true;
}

/* Puts a piece onto the chain. It has to be painted before the last one, which hides a part of it. */
static bool try_first(struct painting *painting, uint32_t piece)
{
    if (trace_of(painting)) {
        trace_pieces(painting, "swap", painting->chain[painting->length - 1], piece);
        zr_trace_end(trace_of(painting), '}');
    }
    return push(painting, piece);
}

static void shorten(struct painting *painting, uint32_t length)
{
    while (painting->length > length)
        painting->pieces.items[painting->chain[--painting->length]].in_chain = false;
}

/* Paints the last piece of the chain, which hides nothing of the rest. */
static void paint_last(struct painting *painting)
{
    uint32_t piece = painting->chain[painting->length - 1];
    if (trace_of(painting)) {
        trace_pieces(painting, "draw", piece, 0);
        zr_trace_end(trace_of(painting), '}');
    }
    zr_pieces_paint(&painting->pieces, piece);
    shorten(painting, painting->length - 1);
    take_out(painting, piece);
    zr_pieces_free(&painting->pieces, piece);
}

/* Cuts the piece at `place` of the chain by another. The chain then ends before it, and the part that may be hidden
 * comes first in the list. */
static bool cut(struct painting *painting, uint32_t place, uint32_t other, bool nearer)
{
    uint32_t piece = painting->chain[place], inside, rest;
    shorten(painting, place);
    if (!zr_pieces_split(&painting->pieces, piece, other, nearer, &inside, &rest)) return false;
    if (trace_of(painting)) trace_cut(painting, piece, other, rest, inside);
    put_in_place(painting, piece, rest, inside);
    zr_pieces_free(&painting->pieces, piece);
    return true;
}

/* Cuts a chain whose last piece hides a part of `start`, a piece of the chain. */
static enum zr_status cut_cycle(struct painting *painting, uint32_t start)
{
    struct zr_pieces *pieces = &painting->pieces;
    uint32_t hidden = start;
    if (trace_of(painting)) trace_cycle(painting, start);
    for (uint32_t place = painting->length; place-- > 0;) {
        uint32_t piece = painting->chain[place];
        struct zr_overlap overlap = zr_pieces_compare(pieces, &pieces->items[piece], &pieces->items[hidden]);
        if (zr_is_cancelled(pieces->cancel)) return ZR_CANCELLED;
        if (trace_of(painting)) trace_compare(painting, piece, hidden, &overlap);
        if (overlap.nearer < pieces->items[piece].size)
            return cut(painting, place, hidden, false) ? ZR_OK : ZR_NO_MEMORY;
        assert(piece != start); /* the head of this file shows that some piece extends beyond the next */
        hidden = piece;
    }
    return ZR_INTERNAL;
}

/* ---- painting ---- */

static bool boxes_overlap(const struct zr_piece *p, const struct zr_piece *q)
{
    return p->min_x <= q->max_x && q->min_x <= p->max_x && p->min_y <= q->max_y && q->min_y <= p->max_y;
}

/* Returns a piece that the last of the chain partly hides, or 0. Pieces that it is clear of are not compared again. */
static uint32_t find_hidden(struct painting *painting, struct zr_overlap *overlap)
{
    struct zr_pieces *pieces = &painting->pieces;
    const uint32_t last = painting->chain[painting->length - 1];
    const bool is_traced = trace_of(painting);
    struct zr_piece *p = &pieces->items[last];
    uint32_t steps = 0;
    for (uint32_t number = first_from(painting, p->clear); number > 0; number = pieces->items[number].next) {
        const struct zr_piece *q = &pieces->items[number];
        if (q->order < p->near) {
            if (is_traced) trace_compare(painting, last, number, NULL);
            return 0;
        }
        if (++steps % PIECES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(pieces->cancel)) return 0;
        pieces->work++;
        if (q->far < p->near || q == p || !boxes_overlap(p, q)) {
            if (is_traced && q != p) trace_compare(painting, last, number, NULL);
            continue;
        }
        p->clear = q->rank;
        *overlap = zr_pieces_compare(pieces, p, q);
        if (is_traced) trace_compare(painting, last, number, overlap);
        if (overlap->nearer > 0) return number;
    }
    return 0;
}

static enum zr_status paint(struct painting *painting, uint64_t work_max)
{
    for (uint32_t first; (first = first_from(painting, 1)) > 0;) {
        struct zr_overlap overlap;
        if (painting->length == 0 && !push(painting, first)) return ZR_NO_MEMORY;
        uint32_t hidden = find_hidden(painting, &overlap);
        if (zr_is_cancelled(painting->pieces.cancel)) return ZR_CANCELLED;
        if (painting->pieces.work > work_max) return ZR_BAD_SCENE;
        enum zr_status status = ZR_OK;
        if (hidden == 0)
            paint_last(painting);
        else if (overlap.farther > 0)
            status = cut(painting, painting->length - 1, hidden, true) ? ZR_OK : ZR_NO_MEMORY;
        else if (painting->pieces.items[hidden].in_chain)
            status = cut_cycle(painting, hidden);
        else
            status = try_first(painting, hidden) ? ZR_OK : ZR_NO_MEMORY;
        if (status != ZR_OK) return status;
    }
    return zr_is_cancelled(painting->pieces.cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_painter_within(struct zr_arena *arena, const struct zr_geometry *geometry, uint64_t work_max,
                                 const struct zr_cancel *cancel, struct zr_samples *samples)
{
    struct painting painting = {.room = 0};
    enum zr_status status = zr_pieces_make(arena, geometry, cancel, samples, &painting.pieces);
    if (status != ZR_OK) return status;
    if (!sort(&painting.pieces) || !make_list(&painting)) return ZR_NO_MEMORY;
    if (samples->trace) trace_list(&painting);
    return paint(&painting, work_max);
}

enum zr_status zr_painter(const struct zr_run *run, const struct zr_geometry *geometry, struct zr_samples *samples)
{
    return zr_painter_within(run->arena, geometry, ZR_PAINTER_WORK_MAX, run->cancel, samples);
}
