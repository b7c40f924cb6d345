/* line.h - raster: the parallelogram that a line of integer width covers, and its attribute planes.
 *
 * Space:  window space, y up; corners on the snapped grid of geometry/viewport.h.
 * Exact:  equal to llvmpipe's GL_LINES without antialiasing, to the last bit (the reference's rule 12).
 * Terms:  the major axis is the one along which the line is longer, x on a tie; the other one is minor. The direction,
 *         v0 to v1, matters: in a chain of lines, each pixel belongs to the line that leaves the diamond |x| + |y| <
 *         1/2 around its centre. */
#ifndef ZR_LINE_H
#define ZR_LINE_H

#include "raster/plane.h"

/* Corners in clockwise order. The parallelogram is 256 subpixels thick along the minor axis per pixel of width, with
 * ends parallel to that axis: each column of pixel centres between the ends (row, for a major y axis) has `width`
 * centres inside. */
struct zr_line_corners {
    int32_t x[4], y[4];
    int32_t width;           /* pixels */
    bool along_x;            /* x is the major axis */
    int32_t low[2], high[2]; /* x, y of the ends of its centre line, the lower along the major axis first */
};

/* Makes the parallelogram, whose pixels are those that rule 7 keeps for its four edges. Returns false if it has no
 * pixels: no length, or none left after the ends have moved. zr_viewport_apply must have placed the vertices.
 * zr_snapped_x and zr_snapped_y are not used, since ends are moved first and then snapped. */
bool zr_line_corners_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1, int32_t width,
                          struct zr_line_corners *out);

/* Common terms of all planes of one line. Values vary along the major axis only. */
struct zr_line_basis {
    float dx, dy; /* v1 to v0; the major one times 1 + slope squared, the minor one 0 */
    float ooa;    /* 1 / squared length; 0 for a point */
    float x0, y0; /* v0, relative to the centre of pixel (0, 0) */
};

/* For lines that zr_line_corners_make keeps, and for points: v0 and v1 are equal, so all planes are constant. */
struct zr_line_basis zr_line_basis_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1);

/* Returns the plane with the values p0 at v0 and p1 at v1, at their positions before the ends were moved. */
static inline struct zr_plane zr_line_plane_make(const struct zr_line_basis *basis, float p0, float p1)
{
    float d = p0 - p1;
    float dadx = d * basis->dx * basis->ooa, dady = d * basis->dy * basis->ooa;
    return (struct zr_plane){p0 - (dadx * basis->x0 + dady * basis->y0), dadx, dady};
}

/* Returns the first of the `width` pixels in column `at` (row, for a major y axis): its row (column). The centre of the
 * column must lie between the ends, the lower end included and the higher one excluded. */
int32_t zr_line_pixel(const struct zr_line_corners *line, int32_t at);

/* Returns the range of columns (rows) that have pixels of the line; empty if first > last. */
void zr_line_range(const struct zr_line_corners *line, int32_t *first, int32_t *last);

#endif
