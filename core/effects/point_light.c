#include "effects/point_light.h"

enum { DIRECTIONS = 8, RINGS = 2, ROWS_A_RANGE = 4 };

/* DEPTH: difference of depths that darkens fully, in diagonals. DARKENING: weight of a tap. */
#define DEPTH     0.02f
#define DARKENING 0.25f

struct job {
    const struct zr_gbuffer *pixels;
    const struct zr_cancel *cancel;
    float darkening, over_depth; /* over_depth: 1 / (DEPTH * D) */
    int32_t step;
    float *light;
};

/* Returns how much a tap darkens: 0 .. 1. */
static float darkening_by(const struct job *job, ptrdiff_t at, int32_t x, int32_t y)
{
    const struct zr_gbuffer *pixels = job->pixels;
    if (x < 0 || y < 0 || x >= pixels->width || y >= pixels->height) return 0.0f;
    const ptrdiff_t there = y * pixels->stride + x;
    if (pixels->owner[there] == 0) return 0.0f;
    const float nearer = (pixels->point[2][there] - pixels->point[2][at]) * job->over_depth;
    return nearer > 1.0f ? 1.0f : nearer > 0.0f ? nearer : 0.0f; /* NaN: 0 */
}

static float find(const struct job *job, int32_t x, int32_t y)
{
    static const int32_t aside[DIRECTIONS][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    const ptrdiff_t at = y * job->pixels->stride + x;
    float sum = 0.0f;
    for (int32_t ring = 1; ring <= RINGS; ring++)
        for (int k = 0; k < DIRECTIONS; k++)
            sum += darkening_by(job, at, x + aside[k][0] * ring * job->step, y + aside[k][1] * ring * job->step);
    return 1.0f / (1.0f + job->darkening * sum);
}

static void find_rows(void *context, size_t begin, size_t end)
{
    const struct job *job = context;
    const struct zr_gbuffer *pixels = job->pixels;
    for (size_t y = begin; y < end && !zr_is_cancelled(job->cancel); y++)
        for (int32_t x = 0; x < pixels->width; x++) {
            const ptrdiff_t at = (ptrdiff_t)y * pixels->stride + x;
            job->light[at] = pixels->owner[at] ? find(job, x, (int32_t)y) : 1.0f;
        }
}

const float *zr_point_light_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                 const struct zr_gbuffer *pixels, float share, float diagonal)
{
    const int32_t side = pixels->width < pixels->height ? pixels->width : pixels->height;
    const int32_t step = (side + 300) / 600;
    struct job job = {.pixels = pixels,
                      .cancel = cancel,
                      .darkening = DARKENING * share,
                      .over_depth = 1.0f / (DEPTH * diagonal),
                      .step = step > 1 ? step : 1,
                      .light = zr_arena_alloc(arena, (size_t)(pixels->stride * pixels->height), sizeof *job.light)};
    if (!job.light) return NULL;
    zr_team_ranges(team, (size_t)pixels->height, ROWS_A_RANGE, find_rows, &job);
    return job.light;
}
