/* painter.c - raster: from back to front, each over what is there, without a z-buffer: the depth
 * sort of Newell, Newell & Sancha ("A Solution to the Hidden Surface Problem", Proc. ACM
 * National Conference, 1972; Sutherland, Sproull & Schumacker, "A Characterization of
 * Ten Hidden-Surface Algorithms", 1974).
 *
 * Pieces are listed from the farthest on. The first is painted where it hides nothing of those
 * behind it in the list that reach as far back as it does: because their boxes are apart, or
 * because where they overlap it is nowhere the nearer. Where it hides one, that one
 * has to be painted first, and is tried in its place. So a chain of pieces grows, of which each is
 * hidden in part by the one before. Two that are each the nearer somewhere are cut; and so is a
 * chain that comes back to one of its own pieces.
 *
 * Exact: pieces are sets of samples (piece.h), so no cut is rounded. At one sample an order
 * is total: depth, and then the number of the record. In a chain C1 .. Ck that comes back to C1,
 * each hides the next wherever both are, and Ck hides C1: were each within the next, and Ck
 * within C1, all would be the same samples, and at each of them the order would go round. So one
 * reaches beyond the next and is cut into what is inside of it and what is not.
 * Every cut leaves two parts that are not empty; so it ends.
 *
 * Cost: what overlaps in depth is compared two by two, so a scene whose polygons all reach
 * through one range of depths takes time by the square of their number, and more with cuts.
 */
#include <assert.h>

#include "raster/piece.h"

enum { PIECES_A_CANCEL_CHECK = 4096 };

/* A piece that is tried, and what it is compared with next: what comes before that in the
 * list, or before it was cut, is known to be hidden nowhere by the piece. */
struct link {
    uint32_t piece, other;
};

struct painting {
    struct zr_pieces pieces;
    uint32_t first; /* of the list */
    struct link *chain;
    uint32_t length, room;
};

/* ---- the list ---- */

/* Merges the ordered items begin .. middle - 1 and middle .. end - 1; the farther comes first. */
static void merge(const struct zr_piece *from, struct zr_piece *to, uint32_t begin, uint32_t middle, uint32_t end)
{
    uint32_t a = begin, b = middle;
    for (uint32_t i = begin; i < end; i++)
        to[i] = b == end || (a < middle && from[a].far >= from[b].far) ? from[a++] : from[b++];
}

/* A merge sort from below, so that neighbours in the list are neighbours in memory. */
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

static void make_list(struct painting *painting)
{
    struct zr_pieces *pieces = &painting->pieces;
    painting->first = pieces->count > 1 ? 1 : 0;
    for (uint32_t i = 1; i < pieces->count; i++) {
        struct zr_piece *piece = &pieces->items[i];
        piece->order = piece->far;
        piece->previous = i - 1;
        piece->next = i + 1 < pieces->count ? i + 1 : 0;
    }
}

/* Makes b follow a; 0 for either is the list's end. */
static void link_up(struct painting *painting, uint32_t a, uint32_t b)
{
    struct zr_piece *items = painting->pieces.items;
    if (a > 0)
        items[a].next = b;
    else
        painting->first = b;
    if (b > 0) items[b].previous = a;
}

/* ---- the chain ---- */

static bool push(struct painting *painting, uint32_t piece)
{
    if (painting->length == painting->room) {
        uint32_t room = painting->room > 0 ? 2 * painting->room : 64;
        struct link *chain =
            zr_arena_grow(painting->pieces.arena, painting->chain, painting->length, room, sizeof *chain);
        if (!chain) return false;
        painting->chain = chain;
        painting->room = room;
    }
    painting->chain[painting->length++] = (struct link){piece, painting->first};
    painting->pieces.items[piece].in_chain = 1;
    return true;
}

static void shorten(struct painting *painting, uint32_t length)
{
    while (painting->length > length)
        painting->pieces.items[painting->chain[--painting->length].piece].in_chain = 0;
}

/* The last piece hides nothing of the rest. */
static void paint_last(struct painting *painting)
{
    struct zr_pieces *pieces = &painting->pieces;
    uint32_t piece = painting->chain[painting->length - 1].piece, next = pieces->items[piece].next;
    zr_pieces_paint(pieces, piece);
    shorten(painting, painting->length - 1);
    link_up(painting, pieces->items[piece].previous, next);
    zr_pieces_free(pieces, piece);
    if (painting->length > 0) painting->chain[painting->length - 1].other = next;
}

/* Cuts the piece at `place` of the chain by another. The chain ends before it; its parts take its
 * place in the list, that which may be hidden first. */
static bool cut(struct painting *painting, uint32_t place, uint32_t other, bool nearer)
{
    struct zr_pieces *pieces = &painting->pieces;
    uint32_t piece = painting->chain[place].piece, inside, rest;
    shorten(painting, place);
    if (!zr_pieces_split(pieces, piece, other, nearer, &inside, &rest)) return false;
    pieces->items[inside].order = pieces->items[rest].order = pieces->items[piece].order;
    link_up(painting, pieces->items[piece].previous, rest);
    link_up(painting, rest, inside);
    link_up(painting, inside, pieces->items[piece].next);
    zr_pieces_free(pieces, piece);
    if (place > 0) painting->chain[place - 1].other = rest;
    return true;
}

/* The last piece hides a part of `start`, with which the chain has come round. */
static bool cut_cycle(struct painting *painting, uint32_t start)
{
    struct zr_pieces *pieces = &painting->pieces;
    uint32_t hidden = start;
    for (uint32_t place = painting->length; place-- > 0;) {
        uint32_t piece = painting->chain[place].piece;
        struct zr_overlap overlap = zr_pieces_compare(pieces, &pieces->items[piece], &pieces->items[hidden]);
        if (zr_is_cancelled(pieces->cancel)) return true;
        if (overlap.nearer < pieces->items[piece].size) return cut(painting, place, hidden, false);
        assert(piece != start);
        hidden = piece;
    }
    return true;
}

/* ---- painting ---- */

static bool boxes_overlap(const struct zr_piece *p, const struct zr_piece *q)
{
    return p->min_x <= q->max_x && q->min_x <= p->max_x && p->min_y <= q->max_y && q->min_y <= p->max_y;
}

/* Goes on in the list to a piece that the last one hides in part. 0: there is none. */
static uint32_t find_hidden(struct painting *painting, struct zr_overlap *overlap)
{
    const struct zr_pieces *pieces = &painting->pieces;
    struct link *link = &painting->chain[painting->length - 1];
    const struct zr_piece *p = &pieces->items[link->piece];
    for (uint32_t steps = 1; link->other > 0; link->other = pieces->items[link->other].next, steps++) {
        const struct zr_piece *q = &pieces->items[link->other];
        if (q->order < p->near) return 0;
        if (steps % PIECES_A_CANCEL_CHECK == 0 && zr_is_cancelled(pieces->cancel)) return 0;
        if (q->far < p->near || q == p || !boxes_overlap(p, q)) continue;
        *overlap = zr_pieces_compare(pieces, p, q);
        if (overlap->nearer > 0) return link->other;
    }
    return 0;
}

static enum zr_status paint(struct painting *painting)
{
    while (painting->first > 0) {
        struct zr_overlap overlap;
        if (painting->length == 0 && !push(painting, painting->first)) return ZR_NO_MEMORY;
        uint32_t hidden = find_hidden(painting, &overlap);
        if (zr_is_cancelled(painting->pieces.cancel)) return ZR_CANCELLED;
        bool ok = true;
        if (hidden == 0)
            paint_last(painting);
        else if (overlap.farther > 0)
            ok = cut(painting, painting->length - 1, hidden, true);
        else if (painting->pieces.items[hidden].in_chain)
            ok = cut_cycle(painting, hidden);
        else
            ok = push(painting, hidden);
        if (!ok) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}

enum zr_status zr_painter(struct zr_arena *arena, const struct zr_geometry *geometry, const struct zr_cancel *cancel,
                          struct zr_samples *samples)
{
    struct painting painting = {.room = 0};
    enum zr_status status = zr_pieces_make(arena, geometry, cancel, samples, &painting.pieces);
    if (status != ZR_OK) return status;
    if (!sort(&painting.pieces)) return ZR_NO_MEMORY;
    make_list(&painting);
    return paint(&painting);
}
