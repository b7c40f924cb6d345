/* lines.h - lines: the lines of a window mesh before visibility, as straight segments in the window.
 *
 * Space:  window_view.h. Segments are cut at the near and far plane and at ZR_WINDOW_MARGIN around the window. */
#ifndef ZR_LINES_H
#define ZR_LINES_H

#include "lines/features.h"

enum zr_line_kind { ZR_LINE_BORDER, ZR_LINE_CONTOUR, ZR_LINE_CREASE, ZR_LINE_INTERSECTION, ZR_LINE_KINDS };

#define ZR_NO_TRIANGLE UINT32_MAX

struct zr_line {
    struct zr_window_point ends[2];
    uint32_t triangles[2]; /* that it lies on; ZR_NO_TRIANGLE: none. Contours: [0] faces the eye */
    uint8_t kind;          /* enum zr_line_kind */
    bool is_sharp;         /* a crease that is a contour as well */
    bool is_weak;          /* a crease without ZR_FEATURE_STRONG */
    bool is_cut;           /* of a cap */
    bool is_smooth;        /* ZR_FEATURE_SMOOTH */
};

struct zr_lines {
    uint32_t count;
    struct zr_line *at;
};

/* Makes the lines of all edges with features (after chains.h), in the order of edges. Returns ZR_OK, ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_lines_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_window_mesh *mesh,
                             const uint8_t *features, struct zr_lines *out);

/* Cuts a segment at ZR_WINDOW_MARGIN around the window. False if nothing is left, or less than 1e-9 pixel. */
bool zr_line_cut(const struct zr_window_view *view, struct zr_window_point ends[2]);

#endif
