/* piece.h - raster: what the painter sorts and cuts: a primitive, or a part of one, as the set
 * of samples that it covers.
 *
 * Why:    a cut along a plane would be rounded; a set of samples is cut exactly, and each part
 *         keeps the depth and the owner of its primitive at every sample.
 * Space:  window space, y up.
 */
#ifndef ZR_PIECE_H
#define ZR_PIECE_H

#include "raster/textbook/algorithms.h"

_Static_assert(ZR_SNAP_MAX / ZR_SUBPIXELS <= UINT16_MAX, "columns and rows fit 16 bits");

struct zr_span {
    uint16_t y, begin, end; /* columns begin .. end - 1 */
    uint32_t next;          /* of the piece: from below to above and from left to right; 0: none */
};

struct zr_piece {
    uint32_t primitive;
    uint32_t first_span;
    uint32_t size; /* samples */
    uint16_t min_x, min_y, max_x, max_y;
    float near, far; /* of its samples' depths */
    /* the painter's own: */
    float order;             /* at least `far`; pieces are listed by it, and so */
    uint32_t rank;           /* by this; parts have both from the whole */
    uint32_t clear;          /* nothing of a lower rank is hidden by the piece, or by a part of it */
    uint32_t previous, next; /* in the list; 0: none */
    bool in_chain;
};

/* All pieces and their spans; number 0 is none. What is given back is used again, so there
 * are never more spans than samples that the primitives cover, each counted by itself; while a piece is cut, its
 * own and those of its parts. Where `cancel` is raised, what works on them ends early, half done. */
struct zr_pieces {
    struct zr_arena *arena;
    const struct zr_geometry *geometry;
    const struct zr_cancel *cancel;
    uint64_t work; /* spans and samples that were compared or cut */
    struct zr_samples *samples;
    struct zr_primitives primitives;
    struct zr_hit *hits, *other_hits; /* of a row, */
    bool *marks;                      /* and one column more */
    struct zr_piece *items;
    struct zr_span *spans;
    uint32_t count, room, free; /* of items; `free` chained by `next` */
    uint32_t span_count, span_room, free_span;
};

/* One piece for each primitive that is seen at a sample at least, were it alone: numbers
 * 1 .. count - 1. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_pieces_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                              const struct zr_cancel *cancel, struct zr_samples *samples, struct zr_pieces *pieces);

/* At how many of the samples that both have one is nearer than the other: by depth, and where that
 * is equal, by being earlier. Ends early, with less, where both are somewhere nearer. */
struct zr_overlap {
    uint32_t nearer, farther;
};
struct zr_overlap zr_pieces_compare(struct zr_pieces *pieces, const struct zr_piece *p, const struct zr_piece *q);

/* Two new pieces: what of p lies in q, and where `nearer` is said is nearer than q as well; and the
 * rest. p stays as it was, for the caller to free. False where the arena has failed. */
bool zr_pieces_split(struct zr_pieces *pieces, uint32_t p, uint32_t q, bool nearer, uint32_t *inside, uint32_t *rest);

/* Writes its samples over what is there. */
void zr_pieces_paint(struct zr_pieces *pieces, uint32_t number);

/* Its spans and its number may be used again. */
void zr_pieces_free(struct zr_pieces *pieces, uint32_t number);

#endif
