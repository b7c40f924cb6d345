/* line.h - raster: a line of some whole width -> the parallelogram that it covers, and its planes.
 *
 * Space:  window space, y up; corners on the snapped grid of geometry/viewport.h.
 * Exact:  as llvmpipe draws GL_LINES without antialiasing, to the last bit (the reference's rule 12).
 * Terms:  a line's major axis is the one it goes farther along, x where both are alike; the
 *         other one is minor. Its direction, v0 to v1, matters: of a chain of lines each
 *         pixel belongs to the line that leaves the diamond |x| + |y| < 1/2 around its centre.
 */
#ifndef ZR_LINE_H
#define ZR_LINE_H

#include "raster/plane.h"

/* Clockwise. 256 subpixels thick along the minor axis for each pixel of width, ends parallel to it: each column
 * (row, where y is major) of pixel centres between the ends has so many centres inside. */
struct zr_line_corners {
    int32_t x[4], y[4];
    int32_t width;           /* pixels */
    bool along_x;            /* the major axis */
    int32_t low[2], high[2]; /* x, y of the ends of its middle, the lower along the major axis first */
};

/* The parallelogram's pixels are those that rule 7's four edges keep. False where there are
 * none: no length, or none left after the ends have moved. The vertices must have been
 * placed by zr_viewport_apply; zr_snapped_x and zr_snapped_y are not asked, for ends are moved
 * first and then snapped. */
bool zr_line_corners_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1, int32_t width,
                          struct zr_line_corners *out);

/* What all planes of one line share. Values vary along the major axis alone. */
struct zr_line_basis {
    float dx, dy; /* v1 to v0; the major one lengthened by 1 + slope squared, the minor one 0 */
    float ooa;    /* 1 over the squared length; of a point 0 */
    float x0, y0; /* v0, from the centre of pixel (0, 0) */
};

/* For lines that zr_line_corners_make does not drop, and for points: v0 and v1 are one, and so all planes are level. */
struct zr_line_basis zr_line_basis_make(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1);

/* The plane through the values p0 at v0 and p1 at v1, as they were before the ends moved. */
static inline struct zr_plane zr_line_plane_make(const struct zr_line_basis *basis, float p0, float p1)
{
    float d = p0 - p1;
    float dadx = d * basis->dx * basis->ooa, dady = d * basis->dy * basis->ooa;
    return (struct zr_plane){p0 - (dadx * basis->x0 + dady * basis->y0), dadx, dady};
}

/* The first of the `width` pixels that the line has in column `at`, where x is major, or in row `at`: its row or
 * column; the others follow. Only for
 * columns (rows) whose centre lies between the ends, the lower end included and the higher one not. */
int32_t zr_line_pixel(const struct zr_line_corners *line, int32_t at);

/* The columns (rows) that the line has pixels in: first to last, none where first > last. */
void zr_line_range(const struct zr_line_corners *line, int32_t *first, int32_t *last);

#endif
