#include "scene/camera/face_on.h"

#include <math.h>
#include <stdatomic.h>

#include "scene/camera/face_area.h"

/* Largest thickness of a flat model, as a share of either other extent. */
static const double thickness_most = 0.04;

/* A face counts for a side if more than this share of its area shows there. Walls of a sheet count for neither. */
static const double shown_least = 0.5;

enum { FACES_PER_RANGE = 1 << 14 };

/* The presets on the positive and on the negative side of an axis. */
static const enum zr_preset sides[3][2] = {
    {ZR_PRESET_RIGHT, ZR_PRESET_LEFT}, {ZR_PRESET_TOP, ZR_PRESET_BOTTOM}, {ZR_PRESET_FRONT, ZR_PRESET_BACK}};

struct counting {
    const struct zr_mesh *mesh;
    const struct zr_cancel *cancel;
    double axis[3];               /* the flat axis of the world, in object space */
    atomic_uint_fast64_t *fronts; /* counts for the positive and the negative side */
};

static void count_range(void *context, size_t begin, size_t end)
{
    const struct counting *counting = context;
    uint64_t fronts[2] = {0, 0};
    if (zr_is_cancelled(counting->cancel)) return;
    for (size_t face = begin; face < end; face++) {
        const struct zr_face_area area = zr_face_area_of(counting->mesh, (uint32_t)face);
        double shown = 0.0, square = 0.0;
        for (int a = 0; a < 3; a++) {
            shown += area.along[a] * counting->axis[a];
            square += area.along[a] * area.along[a];
        }
        if (fabs(shown) > shown_least * sqrt(square)) fronts[shown < 0.0]++;
    }
    for (int side = 0; side < 2; side++)
        atomic_fetch_add_explicit(&counting->fronts[side], fronts[side], memory_order_relaxed);
}

/* Returns the flat axis, or -1. */
static int flat_axis_of(const struct zr_bounds *bounds)
{
    const double extents[3] = {(double)bounds->max.x - (double)bounds->min.x,
                               (double)bounds->max.y - (double)bounds->min.y,
                               (double)bounds->max.z - (double)bounds->min.z};
    for (int a = 0; a < 3; a++)
        if (extents[a] < thickness_most * fmin(extents[(a + 1) % 3], extents[(a + 2) % 3])) return a;
    return -1;
}

bool zr_face_on_find(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_team *team,
                     const struct zr_cancel *cancel, enum zr_preset *preset)
{
    const int axis = bounds->valid ? flat_axis_of(bounds) : -1;
    atomic_uint_fast64_t fronts[2] = {0, 0};
    if (axis < 0) return false;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        const float *m = instance->object_to_world.m;
        struct counting counting = {&scene->meshes[instance->mesh],
                                    cancel,
                                    {(double)m[axis], (double)m[axis + 4], (double)m[axis + 8]},
                                    fronts};
        zr_team_ranges(team, counting.mesh->face_count, FACES_PER_RANGE, count_range, &counting);
    }
    *preset = sides[axis][atomic_load(&fronts[0]) < atomic_load(&fronts[1])];
    return true;
}
