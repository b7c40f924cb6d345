#include "scene/camera/lens_plan.h"

#include <inttypes.h>
#include <math.h>

#include "base/run.h"
#include "base/trig.h"
#include "scene/camera/camera_parts.h"

/* Points of the view, per side, at which the lens is examined. */
enum { PROBES = 32 };

/* Rounding of positions, in pixels: a window does not grow by less. */
static const double SLACK = 1e-6;

/* A lens that magnifies gets a picture this much finer, since it may magnify more between two probes. */
static const double FINER = 1.002;

struct box {
    double left, right, top, bottom;
};

static struct zr_lens_ray ray_of(const struct zr_lens_plan *plan, double x, double y)
{
    const struct zr_intrinsics *k = &plan->intrinsics;
    const double v = (y - k->cy) / k->fy, u = ((x - k->cx) - k->skew * v) / k->fx;
    return zr_lens_undistort(&plan->inverse, u, v);
}

struct zr_lens_ray zr_lens_look_up(const struct zr_lens_plan *plan, double x, double y)
{
    const struct zr_intrinsics *k = &plan->intrinsics;
    struct zr_lens_ray ray = ray_of(plan, x, y);
    if (ray.end != ZR_LENS_RAY) return ray;
    const double u = (k->fx * ray.x + k->skew * ray.y) + k->cx, v = k->fy * ray.y + k->cy;
    ray.x = plan->scale * u - plan->left;
    ray.y = plan->scale * v - plan->top;
    return ray;
}

/* ---- scale ---- */

/* Returns the largest factor by which the lens stretches lengths of the pinhole's pixels. */
static double stretch_of(const struct zr_intrinsics *k, const struct zr_lens_ray *ray)
{
    /* A J A^-1 with the upper 2x2 of the intrinsics, A. */
    const double lean = k->skew / k->fy;
    const double m00 = ray->xx + k->skew / k->fx * ray->xy, m10 = ray->xy * k->fy / k->fx;
    const double m01 = (k->fx * ray->xy + k->skew * ray->yy) / k->fy - m00 * lean;
    const double m11 = ray->yy - m10 * lean;
    const double sum = m00 * m00 + m01 * m01 + m10 * m10 + m11 * m11, determinant = m00 * m11 - m01 * m10;
    return sqrt(0.5 * (sum + sqrt(fmax(sum * sum - 4.0 * determinant * determinant, 0.0))));
}

static double find_scale(const struct zr_lens_plan *plan)
{
    double most = 1.0;
    for (int row = 0; row <= PROBES; row++)
        for (int column = 0; column <= PROBES; column++) {
            const struct zr_lens_ray ray =
                ray_of(plan, (double)plan->view_width * column / PROBES, (double)plan->view_height * row / PROBES);
            if (ray.end == ZR_LENS_RAY) most = fmax(most, stretch_of(&plan->intrinsics, &ray));
        }
    return most > 1.0 + 1e-9 ? most * FINER : 1.0;
}

/* ---- window ---- */

static enum zr_status refuse_wide(uint32_t x, uint32_t y, struct zr_error *error)
{
    return zr_error_add(error, ZR_BAD_SCENE, "/view/distortion",
                        "the ray of pixel %" PRIu32 ", %" PRIu32 " is more than %d degrees from the axis of the lens, "
                        "the maximum: give a smaller window or a longer focal length",
                        x, y, ZR_LENS_DEGREES_MAX);
}

struct border {
    struct box box;
    bool is_whole; /* all pixels have a ray */
};

static enum zr_status add_pixel(const struct zr_lens_plan *plan, uint32_t x, uint32_t y, struct border *border,
                                struct zr_error *error)
{
    const struct zr_lens_ray ray = zr_lens_look_up(plan, (double)x + 0.5, (double)y + 0.5);
    struct box *box = &border->box;
    if (ray.end == ZR_LENS_WIDE) return refuse_wide(x, y, error);
    border->is_whole &= ray.end == ZR_LENS_RAY;
    if (ray.end != ZR_LENS_RAY) return ZR_OK;
    box->left = fmin(box->left, ray.x);
    box->right = fmax(box->right, ray.x);
    box->top = fmin(box->top, ray.y);
    box->bottom = fmax(box->bottom, ray.y);
    return ZR_OK;
}

/* The lens maps its domain without folds, so rays of the border surround all others. */
static enum zr_status walk_border(const struct zr_lens_plan *plan, const struct zr_cancel *cancel,
                                  struct border *border, struct zr_error *error)
{
    enum { PIXELS_PER_CANCEL_CHECK = 1024 };
    const uint32_t right = plan->view_width - 1, bottom = plan->view_height - 1;
    enum zr_status status = ZR_OK;
    for (uint32_t x = 0; status == ZR_OK && x <= right; x++) {
        if (x % PIXELS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_CANCELLED;
        status = add_pixel(plan, x, 0, border, error);
        if (status == ZR_OK) status = add_pixel(plan, x, bottom, border, error);
    }
    for (uint32_t y = 0; status == ZR_OK && y <= bottom; y++) {
        if (y % PIXELS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_CANCELLED;
        status = add_pixel(plan, 0, y, border, error);
        if (status == ZR_OK) status = add_pixel(plan, right, y, border, error);
    }
    return status;
}

/* A fold within the window surrounds the rays, too. */
static void add_fold(const struct zr_lens_plan *plan, struct box *box)
{
    const struct zr_intrinsics *k = &plan->intrinsics;
    const double t = plan->inverse.most;
    const double r = plan->inverse.lens.model == ZR_LENS_FISHEYE ? zr_tan(t) : t;
    const double across = plan->scale * r * (k->fx + fabs(k->skew)), down = plan->scale * r * k->fy;
    const double x = plan->scale * k->cx, y = plan->scale * k->cy;
    *box = (struct box){fmin(box->left, x - across), fmax(box->right, x + across), fmin(box->top, y - down),
                        fmax(box->bottom, y + down)};
}

static enum zr_status set_window(struct zr_lens_plan *plan, const struct box *box, struct zr_error *error)
{
    const double left = floor(box->left - 0.5 + SLACK), top = floor(box->top - 0.5 + SLACK);
    const double width = ceil(box->right + 0.5 - SLACK) - left, height = ceil(box->bottom + 0.5 - SLACK) - top;
    if (!(width <= ZR_LENS_SIDE_MAX && height <= ZR_LENS_SIDE_MAX && width * height <= (double)ZR_LENS_PIXELS_MAX))
        return zr_error_add(
            error, ZR_BAD_SCENE, "/view/distortion",
            "the rays of this lens need a pinhole picture of %.0f x %.0f pixels; up to %d on a side and "
            "%" PRIu64 " in all are allowed: give a smaller window",
            width, height, ZR_LENS_SIDE_MAX, ZR_LENS_PIXELS_MAX);
    plan->left = left;
    plan->top = top;
    plan->width = (uint32_t)width;
    plan->height = (uint32_t)height;
    return ZR_OK;
}

enum zr_status zr_lens_plan_make(const struct zr_run *run, const struct zr_view *view, const struct zr_lens_plan **out)
{
    struct zr_lens_plan *plan = zr_arena_zero(run->arena, 1, sizeof *plan);
    const double infinity = (double)INFINITY;
    struct border border = {{infinity, -infinity, infinity, -infinity}, true};
    if (!plan) return ZR_NO_MEMORY;
    zr_lens_invert(&view->lens, &plan->inverse);
    plan->intrinsics = zr_view_intrinsics(view);
    plan->view_width = view->width;
    plan->view_height = view->height;
    plan->scale = find_scale(plan);
    const enum zr_status status = walk_border(plan, run->cancel, &border, run->error);
    if (status != ZR_OK) return status;
    if (!border.is_whole) add_fold(plan, &border.box);
    *out = plan;
    return set_window(plan, &border.box, run->error);
}

struct zr_camera zr_lens_pinhole(const struct zr_lens_plan *plan, const struct zr_camera *camera)
{
    struct zr_camera pinhole = *camera;
    float *m = pinhole.projection.m;
    const double width = plan->scale * (double)plan->view_width, height = plan->scale * (double)plan->view_height;
    const double across = width / (double)plan->width, right = (width - 2.0 * plan->left) / (double)plan->width - 1.0;
    const double up = height / (double)plan->height, above = 1.0 - (height - 2.0 * plan->top) / (double)plan->height;
    for (int column = 0; column < 4; column++) {
        const double w = (double)m[4 * column + 3];
        m[4 * column] = (float)(across * (double)m[4 * column] + right * w);
        m[4 * column + 1] = (float)(up * (double)m[4 * column + 1] + above * w);
    }
    return pinhole;
}
