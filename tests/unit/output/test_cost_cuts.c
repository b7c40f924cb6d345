/* Predicted work of faces that cut one another, beside the work done. */
#include "cost/cost.h"

#include <math.h>

#include "lines/cells.h"
#include "lines/intersections.h"
#include "raster/textbook/algorithms.h"
#include "support/geometries.h"
#include "support/scenes.h"
#include "support/tests.h"

static struct test_scene test;

enum { WIDTH = 200, HEIGHT = 150, COUNT_MAX = 400 };
static zr_vec4 crossing[COUNT_MAX * 3];

static float random_within(uint32_t *state, float size)
{
    *state = *state * 1664525u + 1013904223u;
    return size * ((float)(*state >> 8) / (float)(1 << 24) * 2.0f - 1.0f);
}

/* Triangles with corners within `size` of their centres. */
static void make_crossing(uint32_t count, float size, struct test_geometry *geometry)
{
    uint32_t state = 1;
    geometry_clear(geometry);
    for (uint32_t i = 0; i < count; i++) {
        struct test_corner corners[3];
        const zr_vec4 centre = {random_within(&state, 1.0f - size), random_within(&state, 1.0f - size),
                                random_within(&state, 1.0f - size), 1.0f};
        for (int k = 0; k < 3; k++) {
            const zr_vec4 at = {centre.x + random_within(&state, size), centre.y + random_within(&state, size),
                                centre.z + random_within(&state, size), 1.0f};
            crossing[3 * i + (uint32_t)k] = at;
            corners[k] = (struct test_corner){(int32_t)(128.0f * WIDTH * (1.0f + at.x)),
                                              (int32_t)(128.0f * HEIGHT * (1.0f + at.y)), 0.5f + 0.5f * at.z};
        }
        assert_true(geometry_add_triangle(geometry, corners));
    }
}

/* Whether the painter ends within so much work. */
static bool paints_within(const struct test_geometry *geometry, double work)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 30);
    struct zr_samples samples = {.width = WIDTH,
                                 .height = HEIGHT,
                                 .depth = zr_arena_alloc(&arena, WIDTH * HEIGHT, sizeof *samples.depth),
                                 .owner = zr_arena_zero(&arena, WIDTH * HEIGHT, sizeof *samples.owner)};
    for (int k = 0; k < WIDTH * HEIGHT; k++)
        samples.depth[k] = 1.0f;
    const enum zr_status status = zr_painter_within(&arena, &geometry->geometry, (uint64_t)work, NULL, &samples);
    zr_arena_free(&arena);
    return status == ZR_OK;
}

TEST(the_painters_work_is_foretold_within_ten_times)
{
    static struct test_geometry geometry;
    static const struct {
        uint32_t count;
        float size;
    } CASES[] = {{10, 1.0f}, {50, 1.0f}, {100, 1.0f}, {50, 0.5f}, {200, 0.5f}, {100, 0.25f}, {400, 0.25f}, {400, 0.1f}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        make_crossing(CASES[i].count, CASES[i].size, &geometry);
        scene_of_triangles(&test, WIDTH, HEIGHT, crossing, CASES[i].count);
        test.picture = (struct zr_picture){.side = 1, .line_width = 1, .crease_degrees = 180, .exposure = 1};
        test.scene.algorithm = ZR_ALGORITHM_PAINTER;
        const struct zr_cost cost = scene_cost(&test.scene);
        const double foretold = cost.counts[ZR_COST_COMPARISON] + cost.counts[ZR_COST_CUT_PIXEL];
        double work = 1024;
        while (work < 1e8 && !paints_within(&geometry, work))
            work *= 2.0;
        print_message("# %u triangles of %g: %.3g foretold, up to %.3g done\n", CASES[i].count, (double)CASES[i].size,
                      foretold, work);
        assert_true(foretold > work / 10.0 && foretold < work * 5.0); /* work is up to twice that of the painter */
    }
}

/* Returns the number of cells of the box that two triangles have in common, in the fine window. */
static double common_cells(const struct zr_window_point *const a[3], const struct zr_window_point *const b[3])
{
    const double fine = 2048.0 / hypot(WIDTH, HEIGHT);
    double low[2] = {0, 0}, high[2] = {fine * WIDTH, fine * HEIGHT};
    for (int which = 0; which < 2; which++)
        for (int axis = 0; axis < 2; axis++) {
            double least = HUGE_VAL, most = -HUGE_VAL;
            for (int k = 0; k < 3; k++) {
                const struct zr_window_point *p = (which ? b : a)[k];
                least = fmin(least, axis ? p->y : p->x);
                most = fmax(most, axis ? p->y : p->x);
            }
            low[axis] = fmax(low[axis], least);
            high[axis] = fmin(high[axis], most);
        }
    return (1 + fmax(high[0] - low[0], 0) / ZR_CELL_PIXELS) * (1 + fmax(high[1] - low[1], 0) / ZR_CELL_PIXELS);
}

/* Returns the pairs of triangles that cut one another, times the cells that both are in. */
static double count_crossings(uint32_t count)
{
    static struct zr_window_point points[COUNT_MAX * 3];
    const double half_fine = 1024.0 / hypot(WIDTH, HEIGHT);
    double sum = 0;
    for (uint32_t i = 0; i < 3 * count; i++)
        points[i] = (struct zr_window_point){half_fine * WIDTH * (1 + (double)crossing[i].x),
                                             half_fine * HEIGHT * (1 + (double)crossing[i].y),
                                             half_fine * WIDTH * (1 + (double)crossing[i].z)};
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < i; k++) {
            const struct zr_window_point *const a[3] = {&points[3 * i], &points[3 * i + 1], &points[3 * i + 2]};
            const struct zr_window_point *const b[3] = {&points[3 * k], &points[3 * k + 1], &points[3 * k + 2]};
            struct zr_window_point ends[2];
            if (zr_intersection_of(a, b, ends)) sum += common_cells(a, b);
        }
    return sum;
}

TEST(faces_that_cut_one_another_are_counted_for_lines_of_the_mesh)
{
    static struct test_geometry geometry;
    static const struct {
        uint32_t count;
        float size;
    } CASES[] = {{50, 1.0f}, {400, 1.0f}, {100, 0.5f}, {400, 0.5f}, {400, 0.25f}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        make_crossing(CASES[i].count, CASES[i].size, &geometry);
        scene_of_triangles(&test, WIDTH, HEIGHT, crossing, CASES[i].count);
        test.picture = (struct zr_picture){.side = 1, .line_width = 1, .is_linear = true, .exposure = 1};
        test.picture.edges = (struct zr_edges){.is_on = true, .is_from_mesh = true};
        const double foretold = scene_cost(&test.scene).counts[ZR_COST_DRAWN_CROSSING],
                     done = count_crossings(CASES[i].count);
        print_message("# %u triangles of %g: %.3g foretold, %.3g done\n", CASES[i].count, (double)CASES[i].size,
                      foretold, done);
        assert_true(foretold > done / 10.0 && foretold < done * 10.0);
    }
}

RUN_TESTS(NULL, NULL)
