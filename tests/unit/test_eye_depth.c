/* Depths of many triangles and samples at once are those of one after the other, to the last bit. */
#include "shade/eye_depth.h"

#include <math.h>
#include <string.h>

#include "support/cmocka_all.h"
#include "support/isas.h"
#include "support/random.h"

enum { TRIANGLES = 70, WIDTH = 640, HEIGHT = 480 };

static zr_vec4 positions[3 * TRIANGLES];
static const zr_vec4 *corners[TRIANGLES + ZR_EYE_ROOM][3];
static const struct zr_mesh mesh = {.position_count = 3 * TRIANGLES, .positions = positions};

static struct zr_source_instance make_instance(struct random *random)
{
    struct zr_camera camera = {.world_to_eye = zr_mat4_identity()};
    zr_mat4 object_to_world = zr_mat4_identity();
    for (int i = 0; i < 12; i++)
        object_to_world.m[i] += (float)random_range(random, -0.2, 0.2);
    object_to_world.m[3] = object_to_world.m[7] = object_to_world.m[11] = 0;
    camera.world_to_eye.m[14] = -4;
    camera.projection = (zr_mat4){{1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.1f, -1, 0, 0, -0.21f, 0}};
    return zr_source_instance_make(&camera, &object_to_world, &mesh, 0);
}

/* Small and large ones, a few of them partly behind the eye, some with corners side by side. */
static void make_triangles(struct random *random)
{
    for (int t = 0; t < TRIANGLES; t++) {
        const double size = random_below(random, 2) ? 0.01 : 1.5;
        const zr_vec4 at = {(float)random_range(random, -1, 1), (float)random_range(random, -1, 1),
                            (float)random_range(random, -2, 2), 1};
        for (int k = 0; k < 3; k++) {
            zr_vec4 *p = &positions[3 * t + k];
            *p = at;
            if (random_below(random, 4) > 0) p->x += (float)random_range(random, -size, size);
            if (random_below(random, 4) > 0) p->y += (float)random_range(random, -size, size);
            p->z += (float)random_range(random, -size, size) + (random_below(random, 20) == 0 ? 6.0f : 0.0f);
            corners[t][k] = p;
        }
    }
}

/* In front of the eye, and of the plane through it: rows w of clip space and of eye space. */
static bool is_in_front(const struct zr_source_instance *instance, const zr_vec4 *p)
{
    const double(*m)[ZR_SOURCE_ROWS] = instance->columns;
    const int rows[2] = {ZR_SOURCE_W, ZR_SOURCE_EYE_W};
    for (int i = 0; i < 2; i++) {
        const int r = rows[i];
        if (!((double)p->x * m[0][r] + (double)p->y * m[1][r] + (double)p->z * m[2][r] + (double)p->w * m[3][r] > 0.0))
            return false;
    }
    return true;
}

/* What they are is test_depth's to say, by rays. */
static void triangles_are_made_together_as_one_by_one(void **state)
{
    const struct zr_eye_depths *kernel = zr_eye_depths_of(isa_under_test(state));
    struct random random = random_seeded(3);
    uint32_t all_behind = 0;
    for (int round = 0; round < 200; round++) {
        const struct zr_source_instance instance = make_instance(&random);
        const uint32_t count = 1 + random_below(&random, TRIANGLES);
        struct zr_eye_depth got[TRIANGLES + 1], want;
        uint32_t behind = 0;
        make_triangles(&random);
        memset(got, 0x55, sizeof got);
        const struct zr_eye_depth untouched = got[count];
        const uint32_t told = kernel->make(&instance, corners, count, WIDTH, HEIGHT, got);
        for (uint32_t t = 0; t < count; t++) {
            const zr_vec4 *one[1 + ZR_EYE_ROOM][3] = {{corners[t][0], corners[t][1], corners[t][2]}};
            const bool in_front = is_in_front(&instance, one[0][0]) && is_in_front(&instance, one[0][1]) &&
                                  is_in_front(&instance, one[0][2]);
            assert_int_equal(zr_eye_depths_scalar.make(&instance, one, 1, WIDTH, HEIGHT, &want), !in_front);
            assert_memory_equal(&got[t], &want, sizeof want);
            behind += !in_front;
        }
        assert_int_equal(told, behind);
        assert_memory_equal(&got[count], &untouched, sizeof untouched);
        all_behind += behind;
    }
    assert_true(all_behind > 100);
}

/* Up to a row's end, or not as far. */
static void make_runs(struct random *random, struct zr_eye_runs *runs)
{
    int32_t end = 0, count = 0;
    runs->ends = 0;
    while (end < ZR_TILE_SIZE && random_below(random, 30) > 0) {
        end += 1 + (int32_t)random_below(random, random_below(random, 2) ? 3 : 40);
        if (end > ZR_TILE_SIZE) end = ZR_TILE_SIZE;
        runs->ends |= UINT64_C(1) << (end - 1);
        runs->numbers[count++] = (int32_t)random_below(random, TRIANGLES + 1);
    }
}

/* Which depths a pixel has. */
static int32_t number_at(const struct zr_eye_runs *runs, int32_t x)
{
    const uint64_t before = x > 0 ? runs->ends & (UINT64_MAX >> (64 - x)) : 0;
    return runs->ends >> x ? runs->numbers[__builtin_popcountll(before)] : 0;
}

static float depth_at(const struct zr_eye_depth *depth, int32_t x, int32_t y)
{
    const struct zr_eye_plane d = depth->depth, one = depth->one;
    const double above = (d.a0 + d.dady * (double)y) + d.dadx * (double)x;
    const double below = (one.a0 + one.dady * (double)y) + one.dadx * (double)x;
    return (float)fmin(fmax(above / below, depth->min), depth->max); /* NaN: the least */
}

static void samples_are_filled_as_one_by_one(void **state)
{
    const struct zr_eye_depths *kernel = zr_eye_depths_of(isa_under_test(state));
    struct random random = random_seeded(7);
    static struct zr_eye_depth depths[TRIANGLES + 1];
    static float out[(ZR_EYE_BAND + 1) * ZR_TILE_STRIDE];
    for (int round = 0; round < 300; round++) {
        const struct zr_source_instance instance = make_instance(&random);
        const int32_t rows = 1 + (int32_t)random_below(&random, ZR_EYE_BAND);
        const int32_t x = (int32_t)random_below(&random, WIDTH), y = (int32_t)random_below(&random, HEIGHT);
        struct zr_eye_runs runs[ZR_EYE_BAND];
        float deepest = 0.0f;
        make_triangles(&random);
        depths[0] = zr_eye_depth_nothing();
        kernel->make(&instance, corners, TRIANGLES, WIDTH, HEIGHT, depths + 1);
        for (int32_t row = 0; row < rows; row++)
            make_runs(&random, &runs[row]);
        memset(out, 0x55, sizeof out);
        const float untouched = out[0];
        const float got = kernel->fill(depths, runs, rows, x, y, out);
        for (int32_t row = 0; row < rows; row++)
            for (int32_t i = 0; i < ZR_TILE_SIZE; i++) {
                const float want = depth_at(&depths[number_at(&runs[row], i)], x + i, y + row);
                assert_memory_equal(&out[row * ZR_TILE_STRIDE + i], &want, sizeof want);
                if (want < INFINITY && want > deepest) deepest = want;
            }
        assert_memory_equal(&got, &deepest, sizeof got);
        assert_memory_equal(&out[rows * ZR_TILE_STRIDE], &untouched, sizeof untouched);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(triangles_are_made_together_as_one_by_one),
        TEST_EACH_ISA(samples_are_filled_as_one_by_one),
    };
    return cmocka_run_group_tests_name("eye_depth", tests, NULL, NULL);
}
