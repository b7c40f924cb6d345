/* line_pieces.h - tests: pieces of lines in window space, and the polylines that they make. */
#ifndef ZR_TESTS_LINE_PIECES_H
#define ZR_TESTS_LINE_PIECES_H

#include "lines/polylines.h"
#include "support/tests.h"

static inline struct zr_line_piece piece(double x0, double y0, double x1, double y1, enum zr_line_kind kind)
{
    return (struct zr_line_piece){.ends = {{x0, y0, 0}, {x1, y1, 0}}, .kind = (uint8_t)kind};
}

static inline struct zr_polylines join(struct zr_arena *arena, struct zr_line_piece *at, uint32_t count)
{
    const struct zr_line_pieces pieces = {.count = count, .at = at};
    struct zr_polylines out;
    assert_int_equal(zr_polylines_make(arena, NULL, &pieces, ZR_POLYLINE_STRAIGHT, &out), ZR_OK);
    return out;
}

#endif
