/* rays.h - scene: view rays through the pixels of a window, in eye space. */
#ifndef ZR_RAYS_H
#define ZR_RAYS_H

#include "scene/camera/camera.h"

/* The ray through window position X, Y (in pixels, row 0 the lowest, centres at + 1/2) starts at origin + X * origin_x
 * + Y * origin_y. Its direction, of any length, is direction + X * direction_x + Y * direction_y.
 * Perspective rays start at the eye: origin_x and origin_y are 0. Parallel rays start on the near plane and have one
 * direction: direction_x and direction_y are 0. */
struct zr_rays {
    zr_vec3 origin, origin_x, origin_y;
    zr_vec3 direction, direction_x, direction_y;
};

/* Computes the rays of a window of width x height pixels. False: the projection has no inverse. */
bool zr_rays_of(const struct zr_camera *camera, uint32_t width, uint32_t height, struct zr_rays *rays);

#endif
