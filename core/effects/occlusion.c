#include "effects/occlusion.h"

#include "base/run.h"
#include "base/trig.h"

/* Ordered 4 x 4 pattern: neighbours differ strongly, and each 4 x 4 pixels contain all 16 values. */
static const int bayer[ZR_OCCLUSION_TILE][ZR_OCCLUSION_TILE] = {
    {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

/* Pixel i of 16 rotates its axes by i / 16 of the angle between two. It shifts its steps by sixteenths in another
 * order, so that few pixels share both. Squaring puts more steps near the pixel. */
static void set_pattern(struct zr_occlusion_work *work, int y, int x)
{
    const int i = bayer[y][x % ZR_OCCLUSION_TILE];
    for (int k = 0; k < ZR_OCCLUSION_AXES; k++) {
        double sine, cosine;
        zr_sine_cosine(180.0 / ZR_OCCLUSION_AXES * (k + i / 16.0), &sine, &cosine);
        work->sine[y][k][x] = (float)sine;
        work->cosine[y][k][x] = (float)cosine;
    }
    for (int j = 0; j < ZR_OCCLUSION_STEPS; j++) {
        const float share = ((float)j + ((float)(5 * i % 16) + 0.5f) / 16.0f) / ZR_OCCLUSION_STEPS;
        work->step[y][j][x] = share * share;
    }
}

/* Parameters, kernels and cancellation of the row tasks. */
struct job {
    struct zr_occlusion_work work;
    zr_occlusion_row_fn *points, *row, *blur;
    const struct zr_cancel *cancel;
};

static void do_rows(const struct job *job, zr_occlusion_row_fn *row, size_t begin, size_t end)
{
    for (size_t y = begin; y < end && !zr_is_cancelled(job->cancel); y++)
        row(&job->work, (int32_t)y);
}

static void lay_out_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    do_rows(job, job->points, begin, end);
}

static void find_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    do_rows(job, job->row, begin, end);
}

static void blur_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    do_rows(job, job->blur, begin, end);
}

const float *zr_occlusion_make(const struct zr_run *run, const struct zr_gbuffer *pixels,
                               const struct zr_occlusion *occlusion, const struct zr_pixel_scale *scale, float diagonal)
{
    const size_t height = (size_t)pixels->height, size = (size_t)pixels->stride * height;
    const float radius = occlusion->radius * diagonal;
    const enum zr_isa isa = zr_team_isa(run->team);
    struct job job = {.points = zr_occlusion_points_of(isa),
                      .row = zr_occlusion_row_of(isa),
                      .blur = zr_occlusion_blur_of(isa),
                      .cancel = run->cancel};
    struct zr_occlusion_work *work = &job.work;
    work->light = zr_arena_alloc(run->arena, size, sizeof *work->light);
    /* One array, since only the newest one can be given back. */
    work->points = zr_arena_alloc(run->arena, size, sizeof *work->points + sizeof *work->rows);
    if (!zr_arena_ok(run->arena)) return NULL;
    work->rows = (void *)(work->points + size);
    work->pixels = pixels;
    work->scale = *scale;
    work->radius = radius;
    work->over_radius = 1.0f / radius;
    work->strength = occlusion->strength;
    work->plane_limit = ZR_OCCLUSION_PLANE * diagonal;
    for (int y = 0; y < ZR_OCCLUSION_TILE; y++)
        for (int x = 0; x < 16; x++)
            set_pattern(work, y, x);
    zr_team_ranges(run->team, height, 8, lay_out_rows, &job);
    zr_team_ranges(run->team, height, 2, find_rows, &job);
    zr_team_ranges(run->team, height, 8, blur_rows, &job);
    zr_arena_trim(run->arena, work->points, size, 0, sizeof *work->points + sizeof *work->rows);
    return work->light;
}

/* ---- pixels ---- */

/* Points of the G-buffer are relative to the eye, so the offset includes the eye's position. */
struct zr_pixel_scale zr_pixel_scale_of(const struct zr_camera *camera, uint32_t height)
{
    const float *p = camera->projection.m;
    const zr_vec4 eye = zr_camera_eye(camera);
    const zr_vec3 slope = {p[3], p[7], p[11]};
    float offset = p[15];
    if (eye.w != 0.0f) offset = p[15] + zr_vec3_dot(slope, (zr_vec3){eye.x, eye.y, eye.z});
    return (struct zr_pixel_scale){
        .scale = 0.5f * (float)height * fabsf(p[5]), .slope = {slope.x, slope.y, slope.z}, .offset = offset};
}
