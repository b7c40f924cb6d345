#include "reference/gl/look_surfaces.h"

#include <math.h>
#include <string.h>

#include "scene/picture.h"
#include "support/surface_rule.h"

enum { SIDE = SURFACE_SIDE, SAMPLES = SURFACE_SAMPLES };

bool look_surfaces_are_lit(const struct zr_scene *scene)
{
    return scene->picture->side == SIDE && scene->texture_count == 0;
}

/* ---- samples ---- */

/* Four floats per sample each, row 0 on top: colour, and 1 + a corner of the primitive, or 0; normal, and the side of
 * look_program.c; way from the eye, and 1/w. */
struct told {
    uint32_t width, height;
    float *base, *normal, *way;
};

static bool draw_told(const struct look_twin *twin, const struct reference_arrays *arrays, struct told *told,
                      struct reference_error *error)
{
    float **const lists[] = {&told->base, &told->normal, &told->way};
    const unsigned program = look_program(twin->programs, LOOK_PROGRAM_VALUES, error);
    for (int k = 0; program && k < 3; k++) {
        const float which = (float)k;
        const struct reference_uniform uniform = {"which", 1, 1, &which};
        const struct reference_shader shader = {.program = program, .uniform_count = 1, .uniforms = &uniform};
        *lists[k] = zr_arena_alloc(twin->arena, (size_t)told->width * told->height, 4 * sizeof(float));
        if (!*lists[k] || !reference_draw_floats(twin->reference, arrays, &shader, *lists[k], error)) return false;
    }
    return program;
}

/* Batches have their corners in order. */
static const struct reference_batch *batch_of(const struct reference_arrays *arrays, uint32_t corner)
{
    uint32_t at = 0, end = arrays->batch_count;
    while (end - at > 1) {
        const uint32_t middle = at + (end - at) / 2;
        if (arrays->batches[middle].first <= corner)
            at = middle;
        else
            end = middle;
    }
    return &arrays->batches[at];
}

/* Lines have none, and the number behind all others. */
static uint32_t material_of(const struct zr_scene *scene, const struct reference_arrays *arrays, uint32_t corner)
{
    const struct zr_material *material = batch_of(arrays, corner)->material;
    return material ? (uint32_t)(material - scene->materials) : scene->material_count;
}

/* ---- surfaces ---- */

/* Points that the reference lights. */
struct points {
    uint32_t count;
    uint32_t *samples;   /* the place of each */
    uint32_t *materials; /* of each */
    uint32_t *of;        /* for each sample: the place of its surface; UINT32_MAX: uncovered */
    zr_vec4 *positions, *front, *ways;
    zr_vec3 *normals;
};

static bool make_points(struct zr_arena *arena, size_t samples, struct points *points)
{
    *points = (struct points){.samples = zr_arena_alloc(arena, samples, sizeof *points->samples),
                              .materials = zr_arena_alloc(arena, samples, sizeof *points->materials),
                              .of = zr_arena_alloc(arena, samples, sizeof *points->of),
                              .positions = zr_arena_alloc(arena, samples, sizeof *points->positions),
                              .front = zr_arena_alloc(arena, samples, sizeof *points->front),
                              .ways = zr_arena_alloc(arena, samples, sizeof *points->ways),
                              .normals = zr_arena_alloc(arena, samples, sizeof *points->normals)};
    if (zr_arena_ok(arena)) memset(points->of, 0xFF, samples * sizeof *points->of);
    return zr_arena_ok(arena);
}

static uint32_t place_of(const struct told *told, uint32_t corner, uint32_t sample)
{
    return corner + (SIDE - 1 - sample / SIDE) * told->width + sample % SIDE;
}

/* `corner`: the upper left sample of the pixel. */
static void put_surface(const struct told *told, uint32_t corner, const struct surface *s, struct points *points)
{
    const uint32_t at = place_of(told, corner, s->first), i = points->count++;
    const double x = (at % told->width + 0.5) / told->width, y = (at / told->width + 0.5) / told->height;
    const bool is_line = told->normal[4 * at + 3] == 3.0f;
    for (uint32_t k = 0; k < SAMPLES; k++)
        if (s->samples >> k & 1) points->of[place_of(told, corner, k)] = at;
    points->samples[i] = at;
    points->materials[i] = s->material;
    points->positions[i] = (zr_vec4){(float)(2.0 * x - 1.0), (float)(1.0 - 2.0 * y), 0.0f, 1.0f};
    points->front[i] = (zr_vec4){(float)s->base[0], (float)s->base[1], (float)s->base[2], is_line ? 3.0f : 1.0f};
    points->normals[i] = (zr_vec3){(float)s->normal[0], (float)s->normal[1], (float)s->normal[2]};
    points->ways[i] = (zr_vec4){(float)s->way[0], (float)s->way[1], (float)s->way[2], 1.0f};
}

static void find_points(const struct look_twin *twin, const struct zr_scene *large,
                        const struct reference_arrays *arrays, const struct told *told, struct points *points,
                        uint8_t *gaps)
{
    const double scale = 0.5 * fabs((double)twin->camera->projection.m[5]) * twin->scene->views[0].height;
    struct surface_sample samples[SAMPLES];
    struct surface_pixel pixel;
    for (uint32_t y = 0; y < told->height; y += SIDE)
        for (uint32_t x = 0; x < told->width; x += SIDE) {
            const uint32_t corner = y * told->width + x;
            for (uint32_t k = 0; k < SAMPLES; k++) {
                const size_t at = 4 * (size_t)place_of(told, corner, k);
                const uint32_t primitive = (uint32_t)told->base[at + 3];
                samples[k] =
                    (struct surface_sample){.primitive = primitive,
                                            .material = primitive > 0 ? material_of(large, arrays, primitive - 1) : 0,
                                            .base = told->base + at,
                                            .normal = told->normal + at,
                                            .way = told->way + at,
                                            .over_w = (double)told->way[at + 3]};
            }
            surface_pixel_find(samples, scale, &pixel);
            for (uint32_t i = 0; i < pixel.count; i++)
                put_surface(told, corner, &pixel.surfaces[i], points);
            gaps[corner] |= pixel.is_undecided;
            *twin->undecided += pixel.is_undecided;
        }
}

/* ---- light ---- */

/* The points of one material after those of another. */
static bool make_arrays(const struct look_twin *twin, const struct zr_scene *large, const struct points *points,
                        struct reference_arrays *out)
{
    static const zr_mat4 identity = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const uint32_t materials = large->material_count + 1;
    struct reference_batch *batches = zr_arena_alloc(twin->arena, materials, sizeof *batches);
    uint32_t *indices = zr_arena_alloc(twin->arena, points->count, sizeof *indices), count = 0;
    if (!zr_arena_ok(twin->arena)) return false;
    for (uint32_t m = 0; m < materials; m++) {
        batches[m] = (struct reference_batch){.mode = REFERENCE_POINTS,
                                              .first = count,
                                              .modelview = &identity,
                                              .material = m < large->material_count ? &large->materials[m] : NULL,
                                              .point_size = 1.0f};
        for (uint32_t i = 0; i < points->count; i++)
            if (points->materials[i] == m) indices[count++] = i;
        batches[m].count = count - batches[m].first;
    }
    *out = (struct reference_arrays){.positions = points->positions,
                                     .front = points->front,
                                     .normals = points->normals,
                                     .texcoords = points->ways,
                                     .indices = indices,
                                     .batch_count = materials,
                                     .batches = batches,
                                     .projection = identity};
    return true;
}

/* Gives each sample the light of its surface. */
static void spread(const struct points *points, size_t count, const float *light, float *samples)
{
    static const float none[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++)
        memcpy(samples + 4 * i, points->of[i] == UINT32_MAX ? none : light + 4 * (size_t)points->of[i], sizeof none);
}

/* Draws the surfaces of all batches; the nearest one remains. */
static bool draw_seen(const struct look_twin *twin, const struct zr_scene *large, const struct reference_arrays *arrays,
                      float *samples, uint8_t *gaps, struct reference_error *error)
{
    struct told told = {.width = large->views[0].width, .height = large->views[0].height};
    const size_t count = (size_t)told.width * told.height;
    struct points points;
    struct reference_arrays lit;
    if (!draw_told(twin, arrays, &told, error) || !reference_read_gaps(twin->reference, gaps, error) ||
        !make_points(twin->arena, count, &points))
        return false;
    find_points(twin, large, arrays, &told, &points, gaps);
    const struct reference_shader shader = {.program = look_program(twin->programs, LOOK_PROGRAM_SURFACES, error),
                                            .uniform_count = LOOK_UNIFORMS,
                                            .uniforms = look_twin_uniforms(twin)};
    float *const light = told.base; /* no longer needed */
    if (!shader.program || !make_arrays(twin, large, &points, &lit) ||
        !reference_draw_floats(twin->reference, &lit, &shader, light, error))
        return false;
    spread(&points, count, light, samples);
    return true;
}

/* ---- x-rays ---- */

/* Lays light with its opacity over the samples. */
static void blend(const float *over, size_t count, float *samples)
{
    for (size_t i = 0; i < count; i++) {
        const float *o = over + 4 * i, rest = 1.0f - o[3];
        float *s = samples + 4 * i;
        for (int k = 0; k < 3; k++)
            s[k] = o[k] * o[3] + s[k] * rest;
        s[3] = o[3] + s[3] * rest;
    }
}

/* Surfaces that are as opaque as this have the mean of the opacities of their samples. */
static const float steep = 0.35f, undecided = 1e-4f;

/* Returns the sample, counted from that of the upper left, whose opacity a quarter of the pixel has: the first covered
 * one of its four. Rows of quarters are from below: the first one's samples are (1, 0), (1, 1), (0, 1) and (0, 0), and
 * the others' are turned by quarter turns. -1: none is covered. */
static int sample_of_quarter(uint32_t width, uint32_t corner, const float *over, uint32_t quarter)
{
    static const int turn[4][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
    static const int first[4] = {0, 1, 3, 2};
    for (int k = 0; k < 4; k++) {
        const int *at = turn[(first[quarter] + k) % 4];
        const uint32_t x = quarter % 2 * 2 + (uint32_t)at[0], y = SIDE - 1 - (quarter / 2 * 2 + (uint32_t)at[1]);
        if (over[4 * (size_t)(corner + y * width + x) + 3] > 0.0f) return (int)(y * width + x);
    }
    return -1;
}

/* `corner`: the upper left sample of a pixel. `own`: light of each sample. */
static void mean_in_pixel(uint32_t width, uint32_t corner, const float *own, float *over, uint8_t *gaps)
{
    double sum = 0.0;
    int covered = 0;
    for (uint32_t k = 0; k < SAMPLES; k++) {
        const uint32_t row = k / SIDE, column = k % SIDE;
        const size_t at = corner + row * width + column;
        if (over[4 * at + 3] == 0.0f) continue;
        if (fabsf(over[4 * at + 3] - steep) < undecided) gaps[corner] = 1;
        if (over[4 * at + 3] <= steep) return;
        const uint32_t quarter = (SIDE - 1 - row) / 2 * 2 + column / 2;
        sum += (double)own[4 * (corner + (size_t)sample_of_quarter(width, corner, over, quarter)) + 3];
        covered++;
    }
    for (uint32_t k = 0; k < SAMPLES && covered > 0; k++) {
        const size_t at = corner + k / SIDE * width + k % SIDE;
        if (over[4 * at + 3] > 0.0f) over[4 * at + 3] = (float)(sum / covered);
    }
}

/* Draws the surfaces of one batch. */
static bool draw_xray(const struct look_twin *twin, const struct zr_scene *large, const struct reference_arrays *one,
                      float *over, uint8_t *gaps, struct reference_error *error)
{
    const uint32_t width = large->views[0].width, height = large->views[0].height;
    float *own = zr_arena_alloc(twin->arena, (size_t)width * height, 4 * sizeof *own);
    if (!own || !look_twin_light_samples(twin, large, one, own, gaps, error) ||
        !draw_seen(twin, large, one, over, gaps, error))
        return false;
    for (uint32_t y = 0; y < height; y += SIDE)
        for (uint32_t x = 0; x < width; x += SIDE)
            mean_in_pixel(width, y * width + x, own, over, gaps);
    return true;
}

/* Draws each triangle or polygon by itself: its surfaces are those of its own samples alone. */
static bool draw_xrays(const struct look_twin *twin, const struct zr_scene *large,
                       const struct reference_arrays *arrays, float *samples, uint8_t *gaps,
                       struct reference_error *error)
{
    const size_t count = (size_t)large->views[0].width * large->views[0].height;
    float *over = zr_arena_alloc(twin->arena, count, 4 * sizeof *over);
    uint8_t *own_gaps = zr_arena_alloc(twin->arena, count, sizeof *own_gaps);
    if (!over || !own_gaps) return false;
    memset(samples, 0, 4 * count * sizeof *samples);
    memset(gaps, 0, count);
    for (uint32_t b = 0; b < arrays->batch_count; b++) {
        const struct reference_batch *all = &arrays->batches[b];
        const uint32_t corners = all->mode == REFERENCE_TRIANGLES ? 3 : all->count;
        for (uint32_t k = 0; k < all->count; k += corners) {
            struct reference_batch batch = *all;
            struct reference_arrays one = *arrays;
            batch.first += k;
            batch.count = corners;
            one.batches = &batch;
            one.batch_count = 1;
            one.blended = false;
            if (!draw_xray(twin, large, &one, over, own_gaps, error)) return false;
            blend(over, count, samples);
            for (size_t i = 0; i < count; i++)
                gaps[i] |= own_gaps[i];
        }
    }
    return true;
}

bool look_surfaces_draw(const struct look_twin *twin, const struct zr_scene *large,
                        const struct reference_arrays *arrays, float *samples, uint8_t *gaps,
                        struct reference_error *error)
{
    if (zr_any_is_xray(large->materials, large->material_count))
        return draw_xrays(twin, large, arrays, samples, gaps, error);
    return draw_seen(twin, large, arrays, samples, gaps, error);
}
