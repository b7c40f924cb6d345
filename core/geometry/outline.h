/* outline.h - geometry: turns the edges of a triangle, or of its clipped part, into lines.
 *
 * Space:  window space.
 * Exact:  llvmpipe's glPolygonMode(GL_FRONT_AND_BACK, GL_LINE), the reference's rule 14: the triangle is clipped as for
 *         filling, and edges along the view volume are omitted. Each remaining edge is a line whose direction
 *         (raster/line.h) and position in the order matter: at equal depths the earlier line stays. */
#ifndef ZR_OUTLINE_H
#define ZR_OUTLINE_H

#include "geometry/clip.h"
#include "geometry/viewport.h"

enum {
    ZR_SIDE_FRONT = 1,
    ZR_SIDE_BACK = 2,
    ZR_SIDE_BOTH = 3,
    ZR_SIDE_MIRRORED_FRONT = 4 /* clockwise is the front; a triangle without area still counts as a back */
};

struct zr_outline_line {
    uint8_t from, to;
    bool back; /* its piece shows the back: colours of the back */
};

/* Returns which edges of the fan triangle (i - 1, i, 0) lie on the outline of the polygon of `count` corners, 2 <= i <
 * count: for zr_clip_triangle and zr_outline_make. */
unsigned zr_outline_fan_edges(uint32_t i, uint32_t count);

/* Writes the lines of a polygon clipped by zr_clip_triangle, or, with `clipped` false, of a whole triangle, and returns
 * their number. `faces` selects the drawn sides; a front is counterclockwise with y up. Each piece (i - 1, i, 0) of the
 * fan is classified by its own float coordinates; one without area counts as a back but has the colours of the front.
 * zr_viewport_apply must have placed the vertices. */
int zr_outline_make(const struct zr_window_vertex *vertices, int count, unsigned edges, bool clipped, unsigned faces,
                    struct zr_outline_line out[ZR_CLIP_MAX]);

#endif
