/* eye_depth.h - shade: how far a record lies in front of the camera, at each sample. With a kernel, for many of both.
 *
 * Space:  window space, y up, the sample of pixel X, Y in its middle; depth is eye space's
 *         -z / w, in scene units.
 * Exact:  of a triangle, to the last bit of a float but one: where the sample's ray meets the
 *         plane of the mesh's own triangle, in double, whatever clipping and the window have
 *         made of it. Nothing here has to equal a reference.
 * Source: Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
 */
#ifndef ZR_EYE_DEPTH_H
#define ZR_EYE_DEPTH_H

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* As zr_plane, in double. */
struct zr_eye_plane {
    double a0, dadx, dady;
};

struct zr_eye_depth {
    struct zr_eye_plane depth, one; /* depth and 1, both times the same value that varies over the window */
    double min, max;
};

/* Everywhere infinite: where nothing is seen. */
static inline struct zr_eye_depth zr_eye_depth_nothing(void)
{
    return (struct zr_eye_depth){{(double)INFINITY, 0, 0}, {1, 0, 0}, (double)INFINITY, (double)INFINITY};
}

/* Of a line or a triangle. */
void zr_eye_depth_make(const struct zr_geometry *geometry, const struct zr_triangle *record, uint32_t width,
                       uint32_t height, struct zr_eye_depth *out);

/* Of a triangle that was not cut, by its corners in object space, in the order that its record has them (rule 6):
 * another order may give another last bit. */
void zr_eye_depth_of_corners(const struct zr_source_instance *instance, const zr_vec4 *const corners[3], uint32_t width,
                             uint32_t height, struct zr_eye_depth *out);

/* Kept within the depths of the corners: samples are covered on the subpixel grid, so that a ray may miss
 * the triangle by a hair, and the plane of one seen from its edge is then far away. NaN gives the least. */
static inline float zr_eye_depth_at(const struct zr_eye_depth *depth, int32_t x, int32_t y)
{
    const struct zr_eye_plane d = depth->depth, one = depth->one;
    double above = (d.a0 + d.dady * (double)y) + d.dadx * (double)x;
    double below = (one.a0 + one.dady * (double)y) + one.dadx * (double)x, value = above / below;
    value = value > depth->min ? value : depth->min;
    return (float)(value < depth->max ? value : depth->max);
}

/* Rows of a tile that are filled at once. */
enum { ZR_EYE_BAND = 8 };

/* Runs of pixels in a row of a tile that have the same depths: they end where a bit is set. */
struct zr_eye_runs {
    uint64_t ends;
    int32_t numbers[ZR_TILE_SIZE]; /* of the depths, run by run */
};

struct zr_eye_depths {
    /* As zr_eye_depth_of_corners, of `count` triangles of one instance. `corners` has room for 16
     * more, which may be written. */
    void (*make)(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                 uint32_t width, uint32_t height, struct zr_eye_depth *out);

    /* As zr_eye_depth_at, of the ZR_TILE_SIZE pixels of up to ZR_EYE_BAND rows, from x, y on: out has a tile's stride.
     * depths[0] is that of nothing, as behind a row's last run. Returns the greatest that is not infinite, or 0. */
    float (*fill)(const struct zr_eye_depth *depths, const struct zr_eye_runs *runs, int32_t rows, int32_t x, int32_t y,
                  float *out);
};

extern const struct zr_eye_depths zr_eye_depths_scalar, zr_eye_depths_sse2, zr_eye_depths_avx2, zr_eye_depths_avx512,
    zr_eye_depths_neon;

const struct zr_eye_depths *zr_eye_depths_of(enum zr_isa isa);

#endif
