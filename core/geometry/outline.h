/* outline.h - geometry: the edges of a triangle, or of what clipping left of it, as lines.
 *
 * Space:  window space.
 * Exact:  llvmpipe's glPolygonMode(GL_FRONT_AND_BACK, GL_LINE), the reference's rule 14: the
 *         triangle is clipped as for filling, edges that the view volume made are left out,
 *         and each of the others is a line whose direction (raster/line.h) and place in the
 *         order matter: of equal depths the earlier stays.
 */
#ifndef ZR_OUTLINE_H
#define ZR_OUTLINE_H

#include "geometry/clip.h"
#include "geometry/viewport.h"

enum {
    ZR_SIDE_FRONT = 1,
    ZR_SIDE_BACK = 2,
    ZR_SIDE_BOTH = 3,
    ZR_SIDE_MIRRORED_FRONT = 4 /* clockwise is the front: what has no area counts as back there too */
};

struct zr_outline_line {
    uint8_t from, to;
    bool back; /* of a piece seen from behind: colours of the back */
};

/* Which edges of the triangle (i - 1, i, 0) of a polygon of `count` corners are its own
 * and not inside of it, 2 <= i < count: for zr_clip_triangle and zr_outline_make. */
unsigned zr_outline_fan_edges(uint32_t i, uint32_t count);

/* The lines of a polygon as zr_clip_triangle wrote it, or, with `clipped` false, of
 * a whole triangle. `faces` says which sides are drawn, front being counterclockwise with y
 * up: each piece (i - 1, i, 0) of the fan is judged by itself, from its floats; one without area
 * counts as back there and yet has the colours of the front. Returns how many lines.
 * The vertices must have been placed by zr_viewport_apply. */
int zr_outline_make(const struct zr_window_vertex *vertices, int count, unsigned edges, bool clipped, unsigned faces,
                    struct zr_outline_line out[ZR_CLIP_MAX]);

#endif
