/* Edges of whole pictures: where shading normals are not those of faces, and where they are. A blueprint has one colour
 * but for its ink, which is brighter. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "shade/frame.h"
#include "support/cmocka_all.h"
#include "zraster.h"

enum { SIDE = 300 };

struct text {
    char bytes[1 << 16];
    size_t size;
};

__attribute__((format(printf, 2, 3))) static void put(struct text *text, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    text->size += (size_t)vsnprintf(text->bytes + text->size, sizeof text->bytes - text->size, format, list);
    va_end(list);
    assert_true(text->size < sizeof text->bytes);
}

enum { SIDES = 12, RINGS = 8, BALL_POINTS = SIDES * (RINGS + 1) };

/* A coarse ball with the normals of a round one, so that no face has a crease. `number`: how many are there already. */
static void put_ball(struct text *text, int number, double x, double y, double z)
{
    const double pi = 3.14159265358979;
    for (int i = 0; i <= RINGS; i++)
        for (int k = 0; k < SIDES; k++) {
            const double a = pi * i / RINGS, b = 2 * pi * k / SIDES, n[3] = {sin(a) * cos(b), -cos(a), sin(a) * sin(b)};
            put(text, "v %.9f %.9f %.9f\nvn %.9f %.9f %.9f\n", x + n[0], y + n[1], z + n[2], n[0], n[1], n[2]);
        }
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SIDES; k++) {
            const int a = number * BALL_POINTS + i * SIDES + k + 1, b = a - k + (k + 1) % SIDES;
            const int corners[4] = {a, a + SIDES, b + SIDES, b};
            put(text, "f");
            for (int c = 0; c < 4; c++)
                if ((i > 0 || c != 3) && (i + 1 < RINGS || c != 2)) put(text, " %d//%d", corners[c], corners[c]);
            put(text, "\n");
        }
}

/* How often a line of pixels meets ink. */
static int runs_of(const uint8_t *row)
{
    int runs = 0;
    for (int x = 0; x < SIDE; x++)
        runs += row[4 * x] > 90 && (x == 0 || row[4 * (x - 1)] <= 90);
    return runs;
}

/* The most runs of any row; `crowded`: of how many rows there are more than two. */
static int most_runs(const struct text *obj, int *crowded)
{
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_OBJ,
                                       .bytes = obj->bytes,
                                       .size = obj->size,
                                       .look = "blueprint",
                                       .width = "300",
                                       .height = "300"};
    int most = 0;
    *crowded = 0;
    zr_arena_init(&arena, (size_t)1 << 28);
    assert_int_equal(zr_scene_read(&arena, NULL, &request, &limits, &scene, &error), ZR_OK);
    assert_int_equal(zr_render(&arena, NULL, scene, NULL, NULL, &frame, &error), ZR_OK);
    for (int y = 0; y < SIDE; y++) {
        const int runs = runs_of(frame->color + (size_t)y * SIDE * 4);
        *crowded += runs > 2;
        if (runs > most) most = runs;
    }
    zr_arena_free(&arena);
    return most;
}

static void a_coarse_ball_with_smooth_normals_has_its_outline_only(void **state)
{
    static struct text obj;
    int crowded;
    (void)state;
    obj.size = 0;
    put_ball(&obj, 0, 0, 0, 0);
    assert_int_equal(most_runs(&obj, &crowded), 2);
}

static void a_ball_before_another_is_outlined_on_it(void **state)
{
    static struct text obj;
    int crowded;
    (void)state;
    obj.size = 0;
    put_ball(&obj, 0, 0, 0, 0);
    put_ball(&obj, 1, 2.0, 1.0, 0.6);
    assert_int_equal(most_runs(&obj, &crowded), 4); /* one above the other's shoulder */
    assert_true(crowded > SIDE / 5);
}

/* They have a corner in common, a step between them, and normals 22 degrees apart: no crease. */
static void a_triangle_before_another_is_outlined_on_it(void **state)
{
    static struct text obj;
    int crowded;
    (void)state;
    obj.size = 0;
    put(&obj, "v 0 0 0\nv 2 2 -4\nv -4 2 2\nv 0.286 1.285 -0.704\nv -0.704 1.285 0.286\nf 1 2 3\nf 1 4 5\n");
    assert_int_equal(most_runs(&obj, &crowded), 4);
    assert_true(crowded > SIDE / 12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_coarse_ball_with_smooth_normals_has_its_outline_only),
        cmocka_unit_test(a_ball_before_another_is_outlined_on_it),
        cmocka_unit_test(a_triangle_before_another_is_outlined_on_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
