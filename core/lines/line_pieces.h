/* line_pieces.h - lines: lines cut into visible and hidden pieces, and what lies beside the visible ones.
 *
 * Space:  window_view.h.
 * How:    visible parts are cut to at most 16 pixels. The middle of each piece is probed to both sides:
 *         - background 1 pixel beside it;
 *         - contours: the step, from the line to the nearest triangle 1 pixel outside, also near both ends;
 *         - seams: a crease or intersection is dropped if one plane (4 degrees, 0.1 pixel) lies 0.1 pixel to both
 *           sides, as of coincident walls of parts that overlap. Weak creases below 6 pixels are also dropped if the
 *           normals 3 pixels to both sides are within 30 degrees, without a step. A border is dropped if its instance
 *           goes on 1 pixel to both sides, without a step (0.25 pixel) and with normals of the file that agree within
 *           10 degrees: patches of CAD faces that share no corners.
 * Exact:  pieces are in the order of lines; the same for any number of threads. */
#ifndef ZR_LINE_PIECES_H
#define ZR_LINE_PIECES_H

#include "base/run.h"
#include "lines/hidden_parts.h"

enum { ZR_LINE_PIECE_PIXELS = 16 };

struct zr_line_piece {
    struct zr_window_point ends[2];
    uint32_t line; /* index; ZR_NO_LINE: a bridge (contour_steps.h) */
    uint8_t kind;  /* enum zr_line_kind */
    bool is_sharp; /* a crease that is a contour as well */
    bool is_cut;   /* of a cap */
    bool is_hidden;
    bool is_at_background; /* visible, and background on at least one side */
    bool is_dropped;
    float step, step_most; /* visible contours: of the middle, and largest; pixels; HUGE_VALF at the background */
};

#define ZR_NO_LINE UINT32_MAX

struct zr_line_pieces {
    uint32_t count;
    struct zr_line_piece *at;
};

/* Makes the pieces; without `with_hidden`, the visible ones only. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_line_pieces_make(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                   const struct zr_cells *cells, const struct zr_lines *lines,
                                   const struct zr_hidden_parts *hidden, bool with_hidden, struct zr_line_pieces *out);

static inline double zr_line_piece_length(const struct zr_line_piece *piece)
{
    const double x = piece->ends[1].x - piece->ends[0].x, y = piece->ends[1].y - piece->ends[0].y;
    return sqrt(x * x + y * y);
}

#endif
