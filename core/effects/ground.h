/* ground.h - effects: the soft shadow of a scene on the plane under it.
 *
 * Space:  ground space: x and y on the plane, z the height over it, all in scene units (struct zr_ground_frame).
 * In:     an orthographic map of the scene from below: the height of the lowest surface over the plane. Out: T, the
 *         share of light that reaches each point of the plane.
 * How:    T = (1 - 0.55 near) * (1 - 0.45 far). Both are clamp(1 - height / H), blurred by three passes of a box of
 *         half width q. H and q are 0.06 D and 0.02 D for near, and 0.35 D and 0.07 D for far; D is the diagonal of the
 *         scene's bounds. Under scenes of height h below 1.2 H, H and q are multiplied by f = h / 1.2 H, at least 0.12,
 *         and 0.55 and 0.45 by (1 + f) / 2: a plate has a line of contact, no halo. */
#ifndef ZR_GROUND_H
#define ZR_GROUND_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/run.h"
#include "base/team.h"
#include "scene/camera/camera.h"
#include "scene/camera/rays.h"
#include "shade/lights/shadow_map.h"

enum { ZR_GROUND_SIDE = 192 };

/* T over the plane: `light` has ZR_GROUND_SIDE squared values, row by row. Texel x, y has its centre at ((x + 1/2) /
 * ZR_GROUND_SIDE * 2 - 1) * half_size from the middle. Outside the map, T is 1. */
struct zr_ground {
    float half_size;
    const float *light;
};

/* Makes the shadow from the heights, INFINITY for texels with nothing above; heights below the plane count as 0.
 * `height`: h. `light` is NULL if the arena failed. Every team gives the same bytes.
 */
struct zr_ground zr_ground_make(const struct zr_run *run, const float *heights, float half_size, float diagonal,
                                float height);

/* Returns T at a point of the plane, bilinear between texel centres. Texels outside the map are 1, so T has no step at
 * its border. */
float zr_ground_at(const struct zr_ground *ground, float x, float y);

/* ---- T per pixel. Space: eye space ---- */

/* Position and axes of the plane. */
struct zr_ground_frame {
    zr_vec3 origin;                 /* the centre of the map */
    zr_vec3 x_axis, y_axis, z_axis; /* unit length, or 1 / (scale of eye space), which converts to the map's units; z is
                                     * the plane's normal, up */
};

/* Computes T for a row's first `width` pixels, at the points in which the rays through their centres meet the plane,
 * from above or from below. T is 1 for rays that miss the plane or meet it behind their start. A kernel. */
typedef void zr_ground_row_fn(const struct zr_ground *ground, const struct zr_ground_frame *frame,
                              const struct zr_rays *rays, int32_t y, int32_t width, float *out);

ZR_KERNEL_TABLE(zr_ground_row_fn, zr_ground_row)

/* A lamp's shadow on the plane. */
struct zr_ground_sun {
    const struct zr_shadow_map *map; /* of a directional lamp */
    zr_vec3 start;                   /* of points of the G-buffer, in eye space: the eye, or 0 if rays are parallel */
};

/* Multiplies `out`, T of a row, by 1 - 0.5 (1 - v), where v is the share of the lamp's light that reaches the points
 * above. Outside the lamp's map, v is 1. A kernel. */
typedef void zr_ground_sun_row_fn(const struct zr_ground_sun *sun, const struct zr_ground_frame *frame,
                                  const struct zr_rays *rays, int32_t y, int32_t width, float *out);

ZR_KERNEL_TABLE(zr_ground_sun_row_fn, zr_ground_sun_row)

/* Plane under a scene, and the camera below it that draws the map of its shadow. */
struct zr_ground_view {
    struct zr_camera below;       /* orthographic, with a square window of half_size to each side */
    struct zr_ground_frame frame; /* in the eye space of the scene's camera */
    float half_size;              /* of the map, scene units */
    float height;                 /* of the scene over the plane */
};

/* Finds plane and camera. `camera` and `bounds` are the scene's. False: the bounds are empty or a point, or the camera
 * is not above the plane. */
bool zr_ground_view_find(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_ground_view *view);

#endif
