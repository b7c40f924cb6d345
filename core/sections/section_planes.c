#include "sections/section_planes.h"

#include <stdio.h>

#include "base/matrix.h"

static double dot(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static struct zr_section_plane plane_of(const struct zr_section *section, const struct zr_bounds *bounds)
{
    const double length = sqrt(dot(section->normal, section->normal));
    const double low[3] = {(double)bounds->min.x, (double)bounds->min.y, (double)bounds->min.z};
    const double high[3] = {(double)bounds->max.x, (double)bounds->max.y, (double)bounds->max.z};
    struct zr_section_plane plane;
    double point[3];
    for (int k = 0; k < 3; k++) {
        plane.normal[k] = section->normal[k] / length;
        point[k] = section->has_fraction ? low[k] + section->fraction * (high[k] - low[k]) : section->point[k];
    }
    plane.offset = -dot(plane.normal, point);
    return plane;
}

static void turn(struct zr_section_plane *plane)
{
    for (int k = 0; k < 3; k++)
        plane->normal[k] = 0.0 - plane->normal[k];
    plane->offset = 0.0 - plane->offset;
}

/* Returns a positive number if the camera is on the positive side, or parallel rays come from there; 0 for a plane seen
 * edge-on. */
static double side_of_eye(const struct zr_section_plane *plane, const struct zr_camera *camera)
{
    const zr_vec4 eye = zr_camera_eye(camera);
    const double at[4] = {(double)eye.x, (double)eye.y, (double)eye.z, (double)eye.w};
    struct zr_matrix to_eye = zr_matrix_of(&camera->world_to_eye), to_world;
    double world[4];
    if (!zr_matrix_invert(&to_eye, &to_world)) return 0.0;
    zr_matrix_apply(&to_world, at, world);
    const double side = dot(plane->normal, world) + plane->offset * world[3];
    const double size = sqrt(dot(world, world)) + fabs(plane->offset * world[3]);
    return fabs(side) > 1e-9 * size ? side : 0.0;
}

/* Range of signed distances of the bounds from the plane. */
static void range_of(const struct zr_section_plane *plane, const struct zr_bounds *bounds, double *low, double *high)
{
    const double ends[2][3] = {{(double)bounds->min.x, (double)bounds->min.y, (double)bounds->min.z},
                               {(double)bounds->max.x, (double)bounds->max.y, (double)bounds->max.z}};
    *low = *high = plane->offset;
    for (int k = 0; k < 3; k++) {
        const bool rises = plane->normal[k] > 0.0;
        *low += plane->normal[k] * ends[rises ? 0 : 1][k];
        *high += plane->normal[k] * ends[rises ? 1 : 0][k];
    }
}

enum zr_status zr_section_planes_find(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                      struct zr_section_planes *planes, struct zr_error *error)
{
    planes->count = scene->sections.count;
    for (uint32_t i = 0; i < planes->count; i++) {
        const struct zr_section *section = &scene->sections.planes[i];
        struct zr_section_plane plane = plane_of(section, &resolved->bounds);
        char pointer[ZR_POINTER_SIZE];
        double low, high;
        snprintf(pointer, sizeof pointer, "/sections/planes/%u", i);
        range_of(&plane, &resolved->bounds, &low, &high);
        if (!resolved->bounds.valid || low > 0.0 || high < 0.0)
            return zr_error_add(error, ZR_BAD_SCENE, pointer,
                                "the plane does not meet the scene: distances along its normal are %g to %g", low,
                                high);
        if (section->keep == ZR_SECTION_KEEP_FAR) {
            const double side = side_of_eye(&plane, &resolved->camera);
            if (side == 0.0)
                return zr_error_add(error, ZR_BAD_SCENE, pointer,
                                    "the camera sees the plane edge-on, so neither side is far: keep \"positive\" or "
                                    "\"negative\"");
            if (side > 0.0) turn(&plane);
        } else if (section->keep == ZR_SECTION_KEEP_NEGATIVE) {
            turn(&plane);
        }
        planes->at[i] = plane;
    }
    return ZR_OK;
}
