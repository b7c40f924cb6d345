#include "scene/camera.h"

#include <float.h>
#include <math.h>

#include "base/trig.h"

/* Doubles inside, floats out: a view is resolved once a request. */
typedef struct {
    double x, y, z;
} vec;

struct frame_of_reference {
    vec right, up, back, eye;
};

static vec vec_of(zr_vec3 v)
{
    return (vec){(double)v.x, (double)v.y, (double)v.z};
}
static vec sub(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
static vec add_scaled(vec a, vec b, double s)
{
    return (vec){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
static double dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec cross(vec a, vec b)
{
    return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* False where `v` is shorter than `least`: too short to be a direction. */
static bool normalize(vec *v, double least)
{
    double length = sqrt(dot(*v, *v));
    if (!(length > least)) return false;
    *v = (vec){v->x / length, v->y / length, v->z / length};
    return true;
}

/* ---- every point of a scene, in world space ---- */

struct point_walk {
    const struct zr_scene *scene;
    uint32_t instance, position;
};

static bool in_range(vec p)
{
    return fabs(p.x) <= (double)FLT_MAX && fabs(p.y) <= (double)FLT_MAX && fabs(p.z) <= (double)FLT_MAX;
}

/* The next point that is not at infinity, or as good as; false at the end. */
static bool next_point(struct point_walk *walk, vec *out)
{
    while (walk->instance < walk->scene->instance_count) {
        const struct zr_instance *instance = &walk->scene->instances[walk->instance];
        const struct zr_mesh *mesh = &walk->scene->meshes[instance->mesh];
        while (walk->position < mesh->position_count) {
            zr_vec4 p = zr_mat4_apply(&instance->object_to_world, mesh->positions[walk->position++]);
            double w = (double)p.w;
            *out = (vec){(double)p.x / w, (double)p.y / w, (double)p.z / w};
            if (w != 0.0 && in_range(*out)) return true;
        }
        walk->instance++;
        walk->position = 0;
    }
    return false;
}

struct extent {
    vec min, max;
};

static void include(struct extent *e, vec p)
{
    if (p.x < e->min.x) e->min.x = p.x;
    if (p.y < e->min.y) e->min.y = p.y;
    if (p.z < e->min.z) e->min.z = p.z;
    if (p.x > e->max.x) e->max.x = p.x;
    if (p.y > e->max.y) e->max.y = p.y;
    if (p.z > e->max.z) e->max.z = p.z;
}

static const struct extent NOTHING = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

/* Bounds of all points in axes of one's own; all zero where there is no point. */
static struct extent extent_of(const struct zr_scene *scene, const struct frame_of_reference *f)
{
    struct extent e = NOTHING;
    struct point_walk walk = {.scene = scene};
    for (vec p; next_point(&walk, &p);) {
        vec from_eye = sub(p, f->eye);
        vec q = {dot(from_eye, f->right), dot(from_eye, f->up), dot(from_eye, f->back)};
        include(&e, q);
    }
    return e.min.x <= e.max.x ? e : (struct extent){{0, 0, 0}, {0, 0, 0}};
}

struct zr_bounds zr_bounds_of(const struct zr_scene *scene)
{
    struct extent e = NOTHING;
    struct point_walk walk = {.scene = scene};
    for (vec p; next_point(&walk, &p);)
        include(&e, p);
    if (!(e.min.x <= e.max.x)) return (struct zr_bounds){.valid = false};
    return (struct zr_bounds){
        true, {(float)e.min.x, (float)e.min.y, (float)e.min.z}, {(float)e.max.x, (float)e.max.y, (float)e.max.z}};
}

/* ---- pose ---- */

static struct frame_of_reference preset_axes(enum zr_preset preset)
{
    static const struct {
        vec back, up;
    } table[ZR_PRESET_COUNT] = {
        [ZR_PRESET_FRONT] = {{0, 0, 1}, {0, 1, 0}},    [ZR_PRESET_BACK] = {{0, 0, -1}, {0, 1, 0}},
        [ZR_PRESET_LEFT] = {{-1, 0, 0}, {0, 1, 0}},    [ZR_PRESET_RIGHT] = {{1, 0, 0}, {0, 1, 0}},
        [ZR_PRESET_TOP] = {{0, 1, 0}, {0, 0, -1}},     [ZR_PRESET_BOTTOM] = {{0, -1, 0}, {0, 0, 1}},
        [ZR_PRESET_ISOMETRIC] = {{1, 1, 1}, {0, 1, 0}}};
    struct frame_of_reference f = {.back = table[preset].back};
    normalize(&f.back, 0.0);
    f.right = cross(table[preset].up, f.back);
    normalize(&f.right, 0.0);
    f.up = cross(f.back, f.right);
    return f;
}

static enum zr_status look_at_axes(const struct zr_view *view, struct frame_of_reference *f, struct zr_error *error)
{
    f->eye = vec_of(view->eye);
    f->back = sub(f->eye, vec_of(view->target));
    if (!normalize(&f->back, 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/eye",
                            "the eye is at the target: there is no direction to look in");
    vec up = vec_of(view->up);
    f->right = normalize(&up, 0.0) ? cross(up, f->back) : up;
    if (!normalize(&f->right, 1e-9))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/up", "up is zero or along the line of sight");
    f->up = cross(f->back, f->right);
    return ZR_OK;
}

static zr_mat4 matrix_of(const struct frame_of_reference *f)
{
    const vec r = f->right, u = f->up, b = f->back;
    return (zr_mat4){{(float)r.x, (float)u.x, (float)b.x, 0.0f, (float)r.y, (float)u.y, (float)b.y, 0.0f, (float)r.z,
                      (float)u.z, (float)b.z, 0.0f, (float)-dot(r, f->eye), (float)-dot(u, f->eye),
                      (float)-dot(b, f->eye), 1.0f}};
}

/* ---- fit ---- */

static double scene_size(const struct zr_bounds *bounds)
{
    vec diagonal = sub(vec_of(bounds->max), vec_of(bounds->min));
    double size = bounds->valid ? sqrt(dot(diagonal, diagonal)) : 0.0;
    return size > 0.0 ? size : 1.0;
}

/* What rounding may add to a place in eye space when projection and view become one matrix:
 * some operations on the largest numbers there are, `moved` among them, each off by half an
 * ulp at most. Sixteen are ample. */
static double rounding_of(const struct zr_bounds *bounds, vec moved)
{
    const zr_vec3 low = bounds->min, high = bounds->max;
    const float all[] = {low.x, low.y, low.z, high.x, high.y, high.z};
    double largest = fmax(fabs(moved.x), fmax(fabs(moved.y), fabs(moved.z)));
    for (int i = 0; i < 6 && bounds->valid; i++)
        largest = fmax(largest, fabs((double)all[i]));
    return 16.0 * (double)FLT_EPSILON * largest;
}

/* Half sizes of the window that holds half sizes x and y, with room around. */
static void grow_to_window(const struct zr_scene *scene, double x, double y, double *xmag, double *ymag)
{
    double aspect = (double)scene->width / (double)scene->height;
    *ymag = fmax(y, x / aspect) / (1.0 - 2.0 * (double)scene->view.fit_padding);
    if (!(*ymag > 0.0)) *ymag = 1.0;
    *xmag = *ymag * aspect;
}

/* How far back a perspective camera must stand on its axis to see every point. */
static double fit_distance(const struct zr_scene *scene, const struct frame_of_reference *f, double size,
                           double rounding)
{
    double room = 1.0 - 2.0 * (double)scene->view.fit_padding;
    double tan_y = zr_tan((double)scene->view.yfov_radians * 0.5) * room;
    double tan_x = tan_y * (double)scene->width / (double)scene->height;
    double distance = 0.0;
    struct point_walk walk = {.scene = scene};
    for (vec p; next_point(&walk, &p);) {
        vec q = sub(p, f->eye);
        double x = fabs(dot(q, f->right)) + rounding, y = fabs(dot(q, f->up)) + rounding,
               z = dot(q, f->back) + rounding;
        distance = fmax(distance, z + fmax(fmax(x / tan_x, y / tan_y), 0.05 * size));
    }
    return distance > 0.0 ? distance : size;
}

/* Centres the view on the geometry and steps back: an orthographic camera
 * stands one diagonal of the bounds in front of the nearest point. */
static void fit_eye(const struct zr_scene *scene, const struct zr_bounds *bounds, struct frame_of_reference *f)
{
    double size = scene_size(bounds);
    vec min = vec_of(bounds->min), max = vec_of(bounds->max);
    if (bounds->valid) f->eye = (vec){(min.x + max.x) * 0.5, (min.y + max.y) * 0.5, (min.z + max.z) * 0.5};
    struct extent e = extent_of(scene, f);
    f->eye = add_scaled(f->eye, f->right, (e.min.x + e.max.x) * 0.5);
    f->eye = add_scaled(f->eye, f->up, (e.min.y + e.max.y) * 0.5);
    bool perspective = scene->view.projection == ZR_PROJECTION_PERSPECTIVE;
    double back = perspective ? fit_distance(scene, f, size, rounding_of(bounds, f->eye)) : e.max.z + size;
    f->eye = add_scaled(f->eye, f->back, back);
}

/* ---- depth range and projection ---- */

/* Bounds of all points in eye space, by the very matrix and in the very floats that they
 * are drawn with: far from the origin rounding moves them, and the view must hold them
 * where they are, not where they should be. */
static struct extent eye_extent(const struct zr_scene *scene, const zr_mat4 *world_to_eye)
{
    struct extent e = NOTHING;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        zr_mat4 object_to_eye = zr_mat4_mul(world_to_eye, &scene->instances[i].object_to_world);
        for (uint32_t k = 0; k < mesh->position_count; k++) {
            zr_vec4 p = zr_mat4_apply(&object_to_eye, mesh->positions[k]);
            double w = (double)p.w;
            vec q = {(double)p.x / w, (double)p.y / w, (double)p.z / w};
            if (w != 0.0 && in_range(q)) include(&e, q);
        }
    }
    return e.min.x <= e.max.x ? e : (struct extent){{0, 0, 0}, {0, 0, 0}};
}

/* From the nearest and the farthest point, a little wider, so that geometry on
 * the very border is not cut by rounding. */
static enum zr_status depth_range(const struct zr_view *view, const struct extent *e, double rounding,
                                  struct zr_camera *camera, struct zr_error *error)
{
    double nearest = -e->max.z, farthest = -e->min.z;
    double margin = fmax(0.01 * (farthest - nearest), 1e-4 * fmax(fabs(nearest), fabs(farthest)));
    margin = fmax(margin, rounding);
    if (!(margin > 0.0)) margin = 0.01;
    double zfar = view->has_zfar ? (double)view->zfar : farthest + margin;
    double znear = view->has_znear ? (double)view->znear : nearest - margin;
    if (view->projection == ZR_PROJECTION_PERSPECTIVE) {
        if (!(zfar > 0.0)) zfar = view->has_znear ? 2.0 * znear : 1.0; /* all is behind the eye */
        if (!view->has_znear) znear = fmax(znear, zfar * 1e-4);
    }
    if (!(znear < zfar) && !view->has_zfar) zfar = znear + fmax(fabs(znear), 1.0);
    if (!(znear < zfar) && !view->has_znear) znear = zfar - fmax(fabs(zfar) * 0.5, 1e-3);
    camera->znear = (float)znear;
    camera->zfar = (float)zfar;
    if (!(camera->znear < camera->zfar))
        return zr_error_add(error, ZR_BAD_SCENE, "/view", "znear %g and zfar %g leave no depth between them", znear,
                            zfar);
    return ZR_OK;
}

/* glTF 2.0, section 3.10.3 "Projection Matrices". */
static zr_mat4 perspective(double yfov, double aspect, double n, double f)
{
    double t = zr_tan(0.5 * yfov);
    return (zr_mat4){{(float)(1.0 / (aspect * t)), 0, 0, 0, 0, (float)(1.0 / t), 0, 0, 0, 0, (float)((f + n) / (n - f)),
                      -1, 0, 0, (float)(2.0 * f * n / (n - f)), 0}};
}

static zr_mat4 orthographic(double xmag, double ymag, double n, double f)
{
    return (zr_mat4){{(float)(1.0 / xmag), 0, 0, 0, 0, (float)(1.0 / ymag), 0, 0, 0, 0, (float)(2.0 / (n - f)), 0, 0, 0,
                      (float)((f + n) / (n - f)), 1}};
}

static enum zr_status project(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_camera *camera,
                              struct zr_error *error)
{
    const struct zr_view *view = &scene->view;
    if (view->projection == ZR_PROJECTION_MATRIX) { /* nothing is left to the geometry */
        camera->projection = view->projection_matrix;
        return ZR_OK;
    }
    struct extent e = eye_extent(scene, &camera->world_to_eye);
    const float *m = camera->world_to_eye.m;
    double rounding = rounding_of(bounds, (vec){(double)m[12], (double)m[13], (double)m[14]});
    enum zr_status status = depth_range(view, &e, rounding, camera, error);
    if (status != ZR_OK) return status;
    double n = (double)camera->znear, f = (double)camera->zfar;
    if (view->projection == ZR_PROJECTION_PERSPECTIVE) {
        camera->projection =
            perspective((double)view->yfov_radians, (double)scene->width / (double)scene->height, n, f);
        return ZR_OK;
    }
    double xmag = (double)view->xmag, ymag = (double)view->ymag;
    if (!(xmag > 0.0) || !(ymag > 0.0))
        grow_to_window(scene, fmax(fabs(e.min.x), fabs(e.max.x)) + rounding,
                       fmax(fabs(e.min.y), fabs(e.max.y)) + rounding, &xmag, &ymag);
    camera->projection = orthographic(xmag, ymag, n, f);
    return ZR_OK;
}

static enum zr_status check_range(const struct zr_camera *camera, struct zr_error *error)
{
    if (zr_mat4_is_within(&camera->world_to_eye, ZR_MATRIX_MAX) &&
        zr_mat4_is_within(&camera->projection, ZR_MATRIX_MAX) && isfinite(camera->znear) && isfinite(camera->zfar))
        return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, "/view", "the view leads beyond the range of numbers");
}

static enum zr_status resolve(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_camera *camera,
                              struct zr_error *error)
{
    const struct zr_view *view = &scene->view;
    struct frame_of_reference axes = {.eye = {0, 0, 0}};
    *camera = (struct zr_camera){.world_to_eye = view->world_to_camera};
    if (view->pose == ZR_POSE_PRESET) {
        axes = preset_axes(view->preset);
        fit_eye(scene, bounds, &axes);
    } else if (view->pose == ZR_POSE_LOOK_AT) {
        enum zr_status status = look_at_axes(view, &axes, error);
        if (status != ZR_OK) return status;
    }
    if (view->pose != ZR_POSE_MATRIX) camera->world_to_eye = matrix_of(&axes);
    return project(scene, bounds, camera, error);
}

enum zr_status zr_camera_resolve(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_camera *camera,
                                 struct zr_error *error)
{
    enum zr_status status = resolve(scene, bounds, camera, error);
    return status == ZR_OK ? check_range(camera, error) : status;
}
