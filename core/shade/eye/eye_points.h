/* eye_points.h - shade: visible points of many samples at a time: channels distance, position in camera or world space,
 * and barycentrics. A kernel.
 *
 * Space:  as in eye_depth.h, on whose planes the points lie.
 * Exact:  in double. shade/visible_points.c has the same formulas for one sample, in the same order.
 */
#ifndef ZR_EYE_POINTS_H
#define ZR_EYE_POINTS_H

#include "base/isa.h"
#include "base/matrix.h"
#include "shade/eye/eye_depth.h"

/* Corner shares of a triangle, as given by its mesh. All zeros but `one`: a primitive without shares. */
struct zr_eye_shares {
    struct zr_eye_plane parts[2], one; /* shares of corners 1 and 2, and 1, all times one common factor */
    double w[3];                       /* eye-space w of the corners */
};

/* Returns the shares of lines and of uncovered samples: their barycentrics are 0. */
static inline struct zr_eye_shares zr_eye_shares_none(void)
{
    return (struct zr_eye_shares){.one = {1.0, 0.0, 0.0}};
}

/* The rays of a window, and the channels wanted of it. */
struct zr_eye_rays {
    double width, height; /* of the window */
    struct zr_matrix projection, to_world;
    double eye[3];     /* origin of the rays, if they are not parallel */
    bool is_parallel;  /* the distance is the depth */
    bool is_in_camera; /* space of the positions; else the world's */
    double origin[3];  /* added to positions in the world */
    bool has_origin;
};

/* Rows of a tile, and the structures that their runs number. */
struct zr_eye_band {
    const struct zr_eye_depth *depths;
    const struct zr_eye_shares *shares; /* NULL: not wanted */
    const struct zr_eye_runs *runs;     /* per row */
    int32_t x, y, width, rows;          /* first pixel in the window; rows <= ZR_EYE_BAND */
};

/* Lowest left pixel of the tile in the channels, NULL if not wanted. The row above is `stride` pixels on. */
struct zr_eye_targets {
    float *distance, *position, *barycentrics;
    ptrdiff_t stride;
};

struct zr_eye_points {
    /* Makes the shares of `count` triangles of one instance; as `make` of eye_depth.h, corners in the mesh's order. */
    void (*make)(const struct zr_source_instance *instance, const zr_vec4 *(*corners)[3], uint32_t count,
                 const struct zr_eye_rays *rays, struct zr_eye_shares *out);

    /* Writes the channels of a band, whose rows are those from `first` on of the targets. Samples of number 0 get the
     * channels' clear values. */
    void (*fill)(const struct zr_eye_rays *rays, const struct zr_eye_band *band, const struct zr_eye_targets *to,
                 int32_t first);
};

ZR_KERNEL_TABLE(const struct zr_eye_points, zr_eye_points)

#endif
