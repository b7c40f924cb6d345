/* eye_depth.h - shade: depth of a primitive along the view axis, at each sample. A kernel.
 *
 * Space:  window space, y up, samples at pixel centres. Depth is eye space's -z / w, in scene units.
 * Exact:  for triangles, to the last bit but one of a float: the intersection of the sample's ray with the plane of the
 *         mesh's own triangle, in double, independent of clipping and window. No reference has to match.
 * Source: Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
 */
#ifndef ZR_EYE_DEPTH_H
#define ZR_EYE_DEPTH_H

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* A zr_plane in double. */
struct zr_eye_plane {
    double a0, dadx, dady;
};

/* Depths are clamped to the range. Coverage is decided on the subpixel grid, so a ray may narrowly miss the triangle;
 * in an edge-on triangle, the plane is then far away. NaN becomes min. */
struct zr_eye_depth {
    struct zr_eye_plane depth, one; /* planes of depth and of 1, both times one common factor */
    double min, max;                /* over the corners of the mesh's triangle that are in front of the eye */
};

/* Returns the depth of uncovered samples: INFINITY everywhere. */
static inline struct zr_eye_depth zr_eye_depth_uncovered(void)
{
    return (struct zr_eye_depth){{(double)INFINITY, 0, 0}, {1, 0, 0}, (double)INFINITY, (double)INFINITY};
}

/* Makes the depth of a line or a point. */
struct zr_eye_depth zr_eye_depth_of_line(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                         uint32_t number);

/* Widen the range, or take the range of a clipped piece, widened. For triangles with corners that are not in front of
 * the eye. The margin is so wide that only edge-on triangles can be clamped. */
void zr_eye_depth_widen(struct zr_eye_depth *depth);
void zr_eye_depth_take_piece(const struct zr_geometry *geometry, const struct zr_triangle *piece,
                             struct zr_eye_depth *depth);

/* Rows of a tile per call of `fill`. */
enum { ZR_EYE_BAND = 8 };

/* Runs of pixels with one depth in a row of a tile; a set bit ends a run. */
struct zr_eye_runs {
    uint64_t ends;
    int32_t numbers[ZR_TILE_SIZE]; /* depth number of each run */
};

/* Padding behind the triangles passed to `make`, which it may write. */
enum { ZR_EYE_ROOM = 16 };

struct zr_eye_depths {
    /* Makes the depths of `count` triangles of one instance from their corners in object space, in drawing order (rule
     * 6): another order may change the last bit. Returns the number of triangles with corners that are not in front of
     * the eye; their ranges are widened. `corners` has ZR_EYE_ROOM more elements, which may be written. */
    uint32_t (*make)(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                     uint32_t width, uint32_t height, struct zr_eye_depth *out);

    /* Writes the depths of ZR_TILE_SIZE pixels in up to ZR_EYE_BAND rows, starting at x, y; `out` has a tile's stride.
     * depths[0] is that of uncovered pixels and of those after a row's last run. Returns the greatest finite depth, or
     * 0. */
    float (*fill)(const struct zr_eye_depth *depths, const struct zr_eye_runs *runs, int32_t rows, int32_t x, int32_t y,
                  float *out);
};

ZR_KERNEL_TABLE(const struct zr_eye_depths, zr_eye_depths)

#endif
