/* Bounds, and where the eye must stand so that the window holds them. */
#include <float.h>
#include <string.h>

#include "scene/camera_parts.h"

static bool is_fitted_to(const struct zr_view *view, uint32_t mesh)
{
    return !view->fit_to_mesh || view->fit_mesh == mesh;
}

static bool in_range(zr_dvec3 p)
{
    return fabs(p.x) <= (double)FLT_MAX && fabs(p.y) <= (double)FLT_MAX && fabs(p.z) <= (double)FLT_MAX;
}

/* False for what is at infinity, or as good as. By 1 nothing need be divided, and mostly that is w: a third of the time
 * of a walk. */
static inline bool place_of(zr_vec4 p, zr_dvec3 *out)
{
    *out = (zr_dvec3){(double)p.x, (double)p.y, (double)p.z};
    if (p.w != 1.0f) {
        const double w = (double)p.w;
        *out = (zr_dvec3){out->x / w, out->y / w, out->z / w};
    }
    return p.w != 0.0f && in_range(*out);
}

/* ---- every point of a scene that has a place ---- */

enum { POINTS_AT_ONCE = 64 };

/* A point, all of it at once. */
typedef float point __attribute__((vector_size(16)));
typedef int32_t point_truth __attribute__((vector_size(16)));

static inline point load_point(const void *at)
{
    point p;
    memcpy(&p, at, sizeof p);
    return p;
}

struct point_walk {
    const struct zr_scene *scene;
    const struct zr_cancel *cancel;
    bool fitted_only;
    const zr_mat4 *world_to_eye; /* NULL: points are in world space */
    uint32_t instance;           /* the next one */
    zr_mat4 matrix;              /* of the one under way, */
    bool moves;                  /* which is not the identity, */
    const zr_vec4 *begin, *end;  /* and its positions that are still to come */
    const zr_vec4 *points;       /* those under way: `transformed`, or the mesh's own where nothing moves */
    uint32_t count;              /* of them; 0 at the end */
    zr_vec4 transformed[POINTS_AT_ONCE];
};

/* False at the end, and where it was cancelled, as all below. */
static bool next_instance(struct point_walk *walk)
{
    const zr_mat4 identity = zr_mat4_identity();
    const struct zr_scene *scene = walk->scene;
    while (walk->instance < scene->instance_count && !zr_is_cancelled(walk->cancel)) {
        const struct zr_instance *instance = &scene->instances[walk->instance++];
        const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
        if (walk->fitted_only && !is_fitted_to(&scene->view, instance->mesh)) continue;
        walk->matrix = walk->world_to_eye ? zr_mat4_mul(walk->world_to_eye, &instance->object_to_world)
                                          : instance->object_to_world;
        walk->moves = memcmp(&walk->matrix, &identity, sizeof identity) != 0;
        walk->begin = mesh->positions;
        walk->end = mesh->positions + mesh->position_count;
        return true;
    }
    return false;
}

/* As zr_mat4_apply, a column of the matrix at a time. */
static void transform_all(const zr_mat4 *m, const zr_vec4 *positions, uint32_t count, zr_vec4 *out)
{
    const point x = load_point(m->m), y = load_point(m->m + 4), z = load_point(m->m + 8), w = load_point(m->m + 12);
    for (uint32_t i = 0; i < count; i++) {
        const zr_vec4 *v = &positions[i];
        const point p = ((x * v->x + y * v->y) + z * v->z) + w * v->w;
        memcpy(&out[i], &p, sizeof p);
    }
}

/* Most scenes are one mesh where it stands: not to transform it, and to take its least and most many at once, is worth
 * a sixth of the time of an STL of 70 000 triangles at 640x480. */
static bool next_points(struct point_walk *walk)
{
    walk->count = 0;
    while (walk->begin == walk->end)
        if (!next_instance(walk)) return false;
    const size_t left = (size_t)(walk->end - walk->begin);
    walk->count = left < POINTS_AT_ONCE ? (uint32_t)left : POINTS_AT_ONCE;
    walk->points = walk->begin;
    walk->begin += walk->count;
    if (!walk->moves) return true;
    transform_all(&walk->matrix, walk->points, walk->count, walk->transformed);
    walk->points = walk->transformed;
    return true;
}

/* ---- extents ---- */

static const struct zr_extent NOTHING = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

static void include(struct zr_extent *e, zr_dvec3 p)
{
    e->min.x = p.x < e->min.x ? p.x : e->min.x;
    e->min.y = p.y < e->min.y ? p.y : e->min.y;
    e->min.z = p.z < e->min.z ? p.z : e->min.z;
    e->max.x = p.x > e->max.x ? p.x : e->max.x;
    e->max.y = p.y > e->max.y ? p.y : e->max.y;
    e->max.z = p.z > e->max.z ? p.z : e->max.z;
}

static inline point either(point_truth which, point a, point b)
{
    return (point)(((point_truth)a & which) | ((point_truth)b & ~which));
}

/* The same of many at once, where all have a place and none is to be divided; else false. The least and the most of
 * floats are those of the doubles that they become. */
static bool include_plain(struct zr_extent *e, const zr_vec4 *points, uint32_t count)
{
    const point zero = {0, 0, 0, 0}, first = load_point(&points[0]);
    point least = first, most = first;
    point_truth finite = first - first == zero;
    for (uint32_t i = 1; i < count; i++) {
        const point p = load_point(&points[i]);
        finite &= p - p == zero;
        least = either(p < least, p, least);
        most = either(p > most, p, most);
    }
    if (!(finite[0] & finite[1] & finite[2] & finite[3]) || least[3] != 1.0f || most[3] != 1.0f) return false;
    include(e, (zr_dvec3){(double)least[0], (double)least[1], (double)least[2]});
    include(e, (zr_dvec3){(double)most[0], (double)most[1], (double)most[2]});
    return true;
}

/* Of zeros, which are found in no order, none has a sign. */
static zr_dvec3 without_signed_zeros(zr_dvec3 v)
{
    return (zr_dvec3){v.x + 0.0, v.y + 0.0, v.z + 0.0};
}

static struct zr_extent extent_of(struct point_walk *walk)
{
    struct zr_extent e = NOTHING;
    while (next_points(walk)) {
        if (include_plain(&e, walk->points, walk->count)) continue;
        for (uint32_t i = 0; i < walk->count; i++) {
            zr_dvec3 p;
            if (place_of(walk->points[i], &p)) include(&e, p);
        }
    }
    e.min = without_signed_zeros(e.min);
    e.max = without_signed_zeros(e.max);
    return e;
}

static struct zr_extent or_zero(struct zr_extent e)
{
    return e.min.x <= e.max.x ? e : (struct zr_extent){{0, 0, 0}, {0, 0, 0}};
}

/* A place from the eye, along the axes. */
static zr_dvec3 along(const struct zr_axes *axes, zr_dvec3 p)
{
    zr_dvec3 q = zr_dvec3_sub(p, axes->eye);
    return (zr_dvec3){zr_dvec3_dot(q, axes->right), zr_dvec3_dot(q, axes->up), zr_dvec3_dot(q, axes->back)};
}

static inline bool place_along(const struct zr_axes *axes, zr_vec4 position, zr_dvec3 *out)
{
    zr_dvec3 place;
    if (!place_of(position, &place)) return false;
    *out = along(axes, place);
    return true;
}

static struct zr_extent extent_along(const struct zr_scene *scene, const struct zr_cancel *cancel,
                                     const struct zr_axes *axes, bool fitted_only)
{
    struct zr_extent e = NOTHING;
    struct point_walk walk = {.scene = scene, .cancel = cancel, .fitted_only = fitted_only};
    while (next_points(&walk))
        for (uint32_t i = 0; i < walk.count; i++) {
            zr_dvec3 q;
            if (place_along(axes, walk.points[i], &q)) include(&e, q);
        }
    return or_zero(e);
}

/* Far from the origin rounding moves points, and the view must hold them where they are,
 * not where they should be. */
struct zr_extent zr_extent_in_eye_space(const struct zr_scene *scene, const struct zr_cancel *cancel,
                                        const zr_mat4 *world_to_eye, bool fitted_only)
{
    struct point_walk walk = {
        .scene = scene, .cancel = cancel, .fitted_only = fitted_only, .world_to_eye = world_to_eye};
    return or_zero(extent_of(&walk));
}

static struct zr_bounds bounds_of(const struct zr_scene *scene, const struct zr_cancel *cancel, bool fitted_only)
{
    struct point_walk walk = {.scene = scene, .cancel = cancel, .fitted_only = fitted_only};
    const struct zr_extent e = extent_of(&walk);
    if (!(e.min.x <= e.max.x)) return (struct zr_bounds){.valid = false};
    return (struct zr_bounds){
        true, {(float)e.min.x, (float)e.min.y, (float)e.min.z}, {(float)e.max.x, (float)e.max.y, (float)e.max.z}};
}

struct zr_bounds zr_bounds_of(const struct zr_scene *scene, const struct zr_cancel *cancel)
{
    return bounds_of(scene, cancel, false);
}

struct zr_bounds zr_fit_bounds(const struct zr_scene *scene, const struct zr_bounds *whole,
                               const struct zr_cancel *cancel)
{
    return scene->view.fit_to_mesh ? bounds_of(scene, cancel, true) : *whole;
}

/* ---- fit ---- */

static double size_of(const struct zr_bounds *bounds)
{
    zr_dvec3 diagonal = zr_dvec3_sub(zr_dvec3_of(bounds->max), zr_dvec3_of(bounds->min));
    double size = bounds->valid ? sqrt(zr_dvec3_dot(diagonal, diagonal)) : 0.0;
    return size > 0.0 ? size : 1.0;
}

/* Some operations on the largest numbers there are, `moved` among them, each off by half an
 * ulp at most. Sixteen are ample. */
double zr_rounding_of(const struct zr_bounds *bounds, zr_dvec3 moved)
{
    const zr_vec3 low = bounds->min, high = bounds->max;
    const float all[] = {low.x, low.y, low.z, high.x, high.y, high.z};
    double largest = fmax(fabs(moved.x), fmax(fabs(moved.y), fabs(moved.z)));
    for (int i = 0; i < 6 && bounds->valid; i++)
        largest = fmax(largest, fabs((double)all[i]));
    return 16.0 * (double)FLT_EPSILON * largest;
}

/* What a fit is measured with. */
struct fitting {
    const struct zr_scene *scene;
    const struct zr_cancel *cancel;
    struct zr_opening opening;
    double size, rounding;
};

/* From a point at x along the axis, z towards the camera, it takes a distance of d with
 * left (d - z) <= x - e <= right (d - z) to see the point from e: so e is from the largest
 * x + right z - right d to the smallest x + left z - left d, and the least distance is where
 * the two meet. */
struct wedge {
    double low, high; /* of x + right z, of x + left z */
};

static void widen(struct wedge *wedge, double x, double z, double left, double right, double rounding)
{
    wedge->low = fmax(wedge->low, x + right * z + rounding * (1.0 + fabs(right)));
    wedge->high = fmin(wedge->high, x + left * z - rounding * (1.0 + fabs(left)));
}

/* Moves the eye sideways and back until the opening just holds every point. */
static void fit_freely(const struct fitting *fitting, struct zr_axes *axes)
{
    const struct zr_opening *o = &fitting->opening;
    struct wedge wide = {-HUGE_VAL, HUGE_VAL}, tall = {-HUGE_VAL, HUGE_VAL};
    double nearest = -HUGE_VAL, rounding = fitting->rounding;
    struct point_walk walk = {.scene = fitting->scene, .cancel = fitting->cancel, .fitted_only = true};
    while (next_points(&walk))
        for (uint32_t i = 0; i < walk.count; i++) {
            zr_dvec3 q;
            if (!place_along(axes, walk.points[i], &q)) continue;
            widen(&wide, q.x - o->shear * q.y, q.z, o->left, o->right, rounding * (1.0 + fabs(o->shear)));
            widen(&tall, q.y, q.z, o->bottom, o->top, rounding);
            nearest = fmax(nearest, q.z + rounding);
        }
    double distance = fitting->size, x = 0.0, y = 0.0;
    if (nearest > -HUGE_VAL) {
        distance = fmax((wide.low - wide.high) / (o->right - o->left), (tall.low - tall.high) / (o->top - o->bottom));
        distance = fmax(distance, nearest + 0.05 * fitting->size);
        y = 0.5 * ((tall.low - o->top * distance) + (tall.high - o->bottom * distance));
        x = 0.5 * ((wide.low - o->right * distance) + (wide.high - o->left * distance)) + o->shear * y;
    }
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->right, x);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->up, y);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, distance);
}

/* Moves the eye back only: what it turns around stays on its axis. */
static enum zr_status fit_on_axis(const struct fitting *fitting, struct zr_axes *axes, struct zr_error *error)
{
    const struct zr_opening *o = &fitting->opening;
    if (!(o->left < 0.0 && o->right > 0.0 && o->bottom < 0.0 && o->top > 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/target",
                            "no distance shows what is around it: the principal point is outside of the window");
    double distance = -HUGE_VAL, rounding = fitting->rounding;
    struct point_walk walk = {.scene = fitting->scene, .cancel = fitting->cancel, .fitted_only = true};
    while (next_points(&walk))
        for (uint32_t i = 0; i < walk.count; i++) {
            zr_dvec3 q;
            if (!place_along(axes, walk.points[i], &q)) continue;
            double x = q.x - o->shear * q.y, around = rounding * (1.0 + fabs(o->shear));
            double wide = fmax((x + around) / o->right, (x - around) / o->left);
            double tall = fmax((q.y + rounding) / o->top, (q.y - rounding) / o->bottom);
            distance = fmax(distance, q.z + rounding + fmax(fmax(wide, tall), 0.05 * fitting->size));
        }
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, distance > 0.0 ? distance : fitting->size);
    return ZR_OK;
}

/* Without perspective only the middle matters: the camera stands one diagonal of the bounds
 * in front of the nearest point of the whole scene. */
static void fit_parallel(const struct zr_scene *scene, const struct zr_cancel *cancel, double size, bool free,
                         struct zr_axes *axes)
{
    struct zr_extent fitted = extent_along(scene, cancel, axes, true);
    double nearest = scene->view.fit_to_mesh ? extent_along(scene, cancel, axes, false).max.z : fitted.max.z;
    if (free) {
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->right, (fitted.min.x + fitted.max.x) * 0.5);
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->up, (fitted.min.y + fitted.max.y) * 0.5);
    }
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, nearest + size);
}

enum zr_status zr_fit_eye(const struct zr_scene *scene, const struct zr_bounds *bounds, const struct zr_cancel *cancel,
                          struct zr_axes *axes, struct zr_error *error)
{
    const struct zr_view *view = &scene->view;
    bool free = view->pose != ZR_POSE_ORBIT || !view->has_target;
    zr_dvec3 min = zr_dvec3_of(bounds->min), max = zr_dvec3_of(bounds->max);
    if (!free)
        axes->eye = zr_dvec3_of(view->target);
    else if (bounds->valid)
        axes->eye = (zr_dvec3){(min.x + max.x) * 0.5, (min.y + max.y) * 0.5, (min.z + max.z) * 0.5};
    if (view->pose == ZR_POSE_ORBIT && view->distance > 0.0f) {
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, (double)view->distance);
        return ZR_OK;
    }
    if (!zr_view_is_perspective(view)) {
        fit_parallel(scene, cancel, size_of(bounds), free, axes);
        return ZR_OK;
    }
    struct fitting fitting = {scene, cancel, zr_opening_of(scene), size_of(bounds), zr_rounding_of(bounds, axes->eye)};
    if (!free) return fit_on_axis(&fitting, axes, error);
    fit_freely(&fitting, axes);
    return ZR_OK;
}
