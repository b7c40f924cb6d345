/* interpolation.h - reference: what float interpolation may lose of a value that varies over a triangle.
 *
 * Why:    the renderer makes channels like depth from the mesh's own triangle, in double; llvmpipe interpolates them in
 *         float (RULES.md, rule 17). Two right answers differ by what this file says, and by no more.
 * How:    plane_v/plane_oow loses, at each pixel of a triangle (or of a piece that clipping left),
 *             (F + |value| W) / |w over clip w|, for which F, of the values over clip w, and W, of their own w, are
 *             e reach + span (e pixels (1 + reach of clip space) / height + outside)
 *         e       2^-24
 *         reach   the largest of the sums of magnitudes on a corner's way there, over clip w
 *         span    how much corners differ
 *         pixels  the window's longer side: a plane's constant is its value at pixel 0, 0
 *         height  the triangle's smallest, in pixels: a plane's slope is divided by twice the area
 *         outside how far a sample that is covered on the subpixel grid only lies outside of the triangle, as a share
 *                 of corners: ours is kept within them
 *         What may be lost is one or two of these.
 */
#ifndef ZR_TEST_INTERPOLATION_H
#define ZR_TEST_INTERPOLATION_H

#include "geometry/clip.h"
#include "reference/gl/reference.h"
#include "scene/camera/camera.h"

/* What varies, as homogeneous points. */
enum interpolation_of {
    INTERPOLATION_EYE, /* the place in eye space */
    INTERPOLATION_WORLD,
    INTERPOLATION_OBJECT,
    INTERPOLATION_SHARES,   /* 1 for each corner, times w of eye space, and that w itself */
    INTERPOLATION_TEXCOORD, /* u, v and 0, with a w of 1 */
    INTERPOLATION_OF_COUNT
};

struct interpolation_piece {
    double x[3], y[3], height; /* in pixels, y up */
    double over_w[3][4];       /* the value of each corner, over clip w */
    double most_over_w;        /* the largest 1/w */
};

/* Of the last triangle. All but the first five start as zeros. */
struct interpolation {
    const struct reference_arrays *arrays;
    const zr_mat4 *world_to_eye;
    uint32_t width, height;
    enum interpolation_of of;

    bool known;
    uint32_t first;
    double reach, reach_w, reach_clip;
    int count;
    struct interpolation_piece pieces[ZR_CLIP_MAX];
};

/* Readies it for the triangle whose corners are `first` and the next two of the arrays. */
void interpolation_enter(struct interpolation *interpolation, uint32_t first);

/* Of that triangle, at pixel x, y (y up) of the window, for a value of that magnitude. 0 where it has no area: nothing
 * is explained then. */
double interpolation_loss(const struct interpolation *interpolation, uint32_t x, uint32_t y, double magnitude);

#endif
