/* piece.h - raster: unit of the painter's algorithm: the set of samples that a primitive, or a part of one, covers.
 *
 * Why:    cutting along a plane would round; a set of samples is cut exactly, and each part keeps the depth and the
 *         owner of its primitive at every sample.
 * Space:  window space, y up. */
#ifndef ZR_PIECE_H
#define ZR_PIECE_H

#include "raster/textbook/algorithms.h"

_Static_assert(ZR_SNAP_MAX / ZR_SUBPIXELS <= UINT16_MAX, "columns and rows fit 16 bits");

struct zr_span {
    uint16_t y, begin, end; /* columns begin .. end - 1 */
    uint32_t next;          /* next span of the piece, from bottom to top and from left to right; 0: none */
};

struct zr_piece {
    uint32_t id; /* in a trace: 1 + primitive; halves of cut pieces are numbered on from there */
    uint32_t primitive;
    uint32_t first_span;
    uint32_t size; /* samples */
    uint16_t min_x, min_y, max_x, max_y;
    float near, far; /* least and greatest depth of its samples */
    /* for the painter: */
    float order;             /* at least `far`; the list is sorted by it */
    uint32_t rank;           /* second sort key; parts inherit both */
    uint32_t clear;          /* the piece and its parts hide nothing of a lower rank than this */
    uint32_t previous, next; /* in the list; 0: none */
    bool in_chain;
};

/* All pieces and their spans; number 0 means none. Freed items are reused, so there are never more spans than the
 * samples that the primitives cover, counted once per primitive. While a piece is cut, the spans of its parts are
 * added. If `cancel` is raised, operations end early and leave partial results. */
struct zr_pieces {
    struct zr_arena *arena;
    const struct zr_geometry *geometry;
    const struct zr_cancel *cancel;
    uint64_t work; /* spans and samples that were compared or cut */
    struct zr_samples *samples;
    struct zr_primitives primitives;
    struct zr_hit *hits, *other_hits; /* of one row */
    bool *marks;                      /* of one row, and one column more */
    struct zr_piece *items;
    struct zr_span *spans;
    uint32_t last_id;
    uint32_t count, room, free; /* of items; free items are linked by `next` */
    uint32_t span_count, span_room, free_span;
};

/* Makes one piece for each primitive that would be visible at some sample if it were alone, numbered 1 .. count - 1.
 * Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_pieces_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                              const struct zr_cancel *cancel, struct zr_samples *samples, struct zr_pieces *pieces);

/* Number of common samples at which p is nearer than q, and farther: by depth, and on a tie by order. The comparison
 * ends early, with lower counts, once both are above 0. */
struct zr_overlap {
    uint32_t nearer, farther;
};
struct zr_overlap zr_pieces_compare(struct zr_pieces *pieces, const struct zr_piece *p, const struct zr_piece *q);

/* Divides p into two new pieces: the samples that lie in q, with `nearer` only those at which p is nearer; and the
 * rest. p is unchanged, and the caller frees it. Returns false if the arena failed. */
bool zr_pieces_split(struct zr_pieces *pieces, uint32_t p, uint32_t q, bool nearer, uint32_t *inside, uint32_t *rest);

/* Overwrites depth and owner of its samples. */
void zr_pieces_paint(struct zr_pieces *pieces, uint32_t number);

/* Frees a piece and its spans for reuse. */
void zr_pieces_free(struct zr_pieces *pieces, uint32_t number);

#endif
