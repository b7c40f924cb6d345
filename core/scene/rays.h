/* rays.h - scene: the rays of sight through the pixels of a window. Space: eye space. */
#ifndef ZR_RAYS_H
#define ZR_RAYS_H

#include "scene/camera.h"

/* The ray through window position X, Y (in pixels, row 0 the lowest, centres at + 1/2) starts at origin + X * origin_x
 * + Y * origin_y and leads along direction + X * direction_x + Y * direction_y, which has any length.
 * The rays of a perspective start at the eye: origin_x and origin_y are 0. Parallel rays start on the near plane and
 * have one direction: direction_x and direction_y are 0. */
struct zr_rays {
    zr_vec3 origin, origin_x, origin_y;
    zr_vec3 direction, direction_x, direction_y;
};

/* False: the projection has no inverse. */
bool zr_rays_of(const struct zr_camera *camera, uint32_t width, uint32_t height, struct zr_rays *rays);

#endif
