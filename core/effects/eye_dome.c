#include "effects/eye_dome.h"

#include "base/cancel.h"
#include "base/run.h"
#include "scene/scene.h"

enum { DIRECTIONS = 8, RINGS = 3 };

/* Ring steps per window height. A step is at least one pixel. */
#define STEPS_PER_HEIGHT 240

/* STEEPEST: limit of slopes. DARKENING: weight of the mean slope. */
#define STEEPEST  6.0f
#define DARKENING 1.6f

bool zr_eye_dome_fits(const struct zr_scene *scene)
{
    uint64_t points = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        if (scene->meshes[i].face_count > 0 || scene->meshes[i].line_count > 0) return false;
        points += scene->meshes[i].point_count;
    }
    return points > 0 && !zr_any_is_see_through(scene->materials, scene->material_count);
}

struct job {
    const struct zr_gbuffer *pixels;
    const struct zr_pixel_scale *scale;
    const struct zr_cancel *cancel;
    float strength;
    int32_t step;
    float *raw, *light;
};

/* Returns the length of a pixel at the point of pixel `at`, in scene units. */
static float pixel_length(const struct job *job, ptrdiff_t at)
{
    const struct zr_pixel_scale *scale = job->scale;
    float *const *point = job->pixels->point;
    const float w =
        ((scale->slope[0] * point[0][at] + scale->slope[1] * point[1][at]) + scale->slope[2] * point[2][at]) +
        scale->offset;
    return w / scale->scale;
}

/* Returns the slope from a pixel to a nearer neighbour; 0 if it is farther, uncovered or outside.
 * Eye space looks along -z. */
static float rise(const struct job *job, ptrdiff_t at, int32_t x, int32_t y, float over_length)
{
    const struct zr_gbuffer *pixels = job->pixels;
    if (x < 0 || y < 0 || x >= pixels->width || y >= pixels->height) return 0.0f;
    const ptrdiff_t there = y * pixels->stride + x;
    if (pixels->owner[there] == 0) return 0.0f;
    const float slope = (pixels->point[2][there] - pixels->point[2][at]) * over_length;
    return slope > STEEPEST ? STEEPEST : slope > 0.0f ? slope : 0.0f;
}

static float find(const struct job *job, int32_t x, int32_t y)
{
    static const int32_t aside[DIRECTIONS][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    const ptrdiff_t at = y * job->pixels->stride + x;
    const float length = pixel_length(job, at);
    float sum = 0.0f;
    if (!(length > 0.0f)) return 1.0f;
    for (int32_t ring = 1; ring <= RINGS; ring++)
        for (int k = 0; k < DIRECTIONS; k++) {
            const int32_t reach = ring * job->step;
            const float over_length = 1.0f / (length * (float)reach * (k & 1 ? 1.41421356f : 1.0f));
            sum = sum + rise(job, at, x + aside[k][0] * reach, y + aside[k][1] * reach, over_length);
        }
    return 1.0f / (1.0f + job->strength * DARKENING * sum / (float)(DIRECTIONS * RINGS));
}

static void find_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    const struct zr_gbuffer *pixels = job->pixels;
    for (size_t y = begin; y < end && !zr_is_cancelled(job->cancel); y++)
        for (int32_t x = 0; x < pixels->width; x++) {
            const ptrdiff_t at = (ptrdiff_t)y * pixels->stride + x;
            job->raw[at] = pixels->owner[at] ? find(job, x, (int32_t)y) : 1.0f;
        }
}

/* Averages covered pixels in a square of three. */
static float blur(const struct job *job, int32_t x, int32_t y)
{
    const struct zr_gbuffer *pixels = job->pixels;
    float sum = 0.0f, count = 0.0f;
    for (int32_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < pixels->height; v++)
        for (int32_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < pixels->width; u++) {
            const ptrdiff_t at = v * pixels->stride + u;
            if (pixels->owner[at] == 0) continue;
            sum = sum + job->raw[at];
            count = count + 1.0f;
        }
    return count > 0.0f ? sum / count : 1.0f;
}

static void blur_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    for (size_t y = begin; y < end && !zr_is_cancelled(job->cancel); y++)
        for (int32_t x = 0; x < job->pixels->width; x++)
            job->light[(ptrdiff_t)y * job->pixels->stride + x] = blur(job, x, (int32_t)y);
}

const float *zr_eye_dome_make(const struct zr_run *run, const struct zr_gbuffer *pixels,
                              const struct zr_occlusion *occlusion, const struct zr_pixel_scale *scale)
{
    const size_t height = (size_t)pixels->height, size = (size_t)pixels->stride * height;
    struct job job = {.pixels = pixels,
                      .scale = scale,
                      .cancel = run->cancel,
                      .strength = occlusion->strength,
                      .step = pixels->height / STEPS_PER_HEIGHT > 1 ? pixels->height / STEPS_PER_HEIGHT : 1,
                      .raw = zr_arena_alloc(run->arena, size, sizeof *job.raw),
                      .light = zr_arena_alloc(run->arena, size, sizeof *job.light)};
    if (!zr_arena_ok(run->arena)) return NULL;
    zr_team_ranges(run->team, height, 4, find_rows, &job);
    zr_team_ranges(run->team, height, 8, blur_rows, &job);
    return job.light;
}

struct applying {
    const struct zr_gbuffer *pixels;
    const struct zr_cancel *cancel;
    const float *light;
    float *const *color;
    size_t stride;
};

static void apply_rows(void *context, size_t begin, size_t end)
{
    const struct applying *of = context;
    for (size_t y = begin; y < end && !zr_is_cancelled(of->cancel); y++)
        for (int k = 0; k < 3; k++)
            for (size_t x = 0; x < (size_t)of->pixels->width; x++)
                of->color[k][y * of->stride + x] *= of->light[y * (size_t)of->pixels->stride + x];
}

void zr_eye_dome_apply(const struct zr_run *run, const struct zr_gbuffer *pixels, const float *light,
                       float *const color[3], size_t stride)
{
    struct applying applying = {pixels, run->cancel, light, color, stride};
    zr_team_ranges(run->team, (size_t)pixels->height, 8, apply_rows, &applying);
}
