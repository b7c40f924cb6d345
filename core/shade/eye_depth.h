/* eye_depth.h - shade: how far a primitive lies in front of the camera, at each sample. A kernel.
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

/* The depth of a sample is kept within the range: samples are covered on the subpixel grid, so that a ray may miss the
 * triangle by a hair, and the plane of one seen from its edge is then far away. NaN gives the least. */
struct zr_eye_depth {
    struct zr_eye_plane depth, one; /* depth and 1, both times the same value that varies over the window */
    double min, max;                /* of all corners of the mesh's triangle, where they are in front of the eye */
};

/* Everywhere infinite: where nothing is seen. */
static inline struct zr_eye_depth zr_eye_depth_nothing(void)
{
    return (struct zr_eye_depth){{(double)INFINITY, 0, 0}, {1, 0, 0}, (double)INFINITY, (double)INFINITY};
}

/* Of a line. */
struct zr_eye_depth zr_eye_depth_of_line(const struct zr_geometry *geometry, const struct zr_triangle *line);

/* The range of a triangle some of whose corners are not in front of the eye: it is unknown, or that of the piece that
 * clipping left. With so much room that only what is seen from its edge could be kept from its depth. */
void zr_eye_depth_widen(struct zr_eye_depth *depth);
void zr_eye_depth_take_piece(const struct zr_geometry *geometry, const struct zr_triangle *piece,
                             struct zr_eye_depth *depth);

/* Rows of a tile that are filled at once. */
enum { ZR_EYE_BAND = 8 };

/* Runs of pixels in a row of a tile that have the same depths: they end where a bit is set. */
struct zr_eye_runs {
    uint64_t ends;
    int32_t numbers[ZR_TILE_SIZE]; /* of the depths, run by run */
};

/* Triangles that may be written behind those that are made. */
enum { ZR_EYE_ROOM = 16 };

struct zr_eye_depths {
    /* Of `count` triangles of one instance, by their corners in object space, in the order that they are drawn in
     * (rule 6): another order may give another last bit. Returns how many have corners that are not in front of the
     * eye: their ranges are widened. `corners` has ZR_EYE_ROOM more, which may be written. */
    uint32_t (*make)(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                     uint32_t width, uint32_t height, struct zr_eye_depth *out);

    /* The ZR_TILE_SIZE pixels of up to ZR_EYE_BAND rows, from x, y on: out has a tile's stride. depths[0] is that of
     * nothing, as behind a row's last run. Returns the greatest that is not infinite, or 0. */
    float (*fill)(const struct zr_eye_depth *depths, const struct zr_eye_runs *runs, int32_t rows, int32_t x, int32_t y,
                  float *out);
};

ZR_KERNEL_TABLE(const struct zr_eye_depths, zr_eye_depths)

#endif
