#include <float.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/status.h"
#include "base/team.h"
#include "base/trig.h"
#include "base/vec.h"
#include "support/random.h"
#include "support/tests.h"

TEST(error_keeps_first_status_and_counts_what_it_drops)
{
    struct zr_error error = {.count = 0};
    assert_int_equal(zr_error_add(&error, ZR_BAD_SCENE, "/a", "one %d", 1), ZR_BAD_SCENE);
    for (int i = 0; i < 30; i++)
        zr_error_add(&error, ZR_BAD_SYNTAX, NULL, "more");
    assert_int_equal(error.status, ZR_BAD_SCENE);
    assert_int_equal(error.count, 31);
    assert_int_equal(zr_error_held(&error), ZR_ERROR_ITEMS);
    assert_string_equal(error.items[0].pointer, "/a");
    assert_string_equal(error.items[0].detail, "one 1");
}

TEST(error_text_too_long_is_cut_at_a_whole_character)
{
    char text[2 * ZR_DETAIL_SIZE + 2];
    for (int shift = 0; shift < 2; shift++) {
        size_t length = 0;
        if (shift) text[length++] = 'a';
        while (length + 2 < sizeof text) {
            text[length++] = '\xc3';
            text[length++] = '\xa9';
        }
        text[length] = '\0';
        struct zr_error error = {.count = 0};
        zr_error_add(&error, ZR_BAD_SCENE, NULL, "%s", text);
        size_t kept = strlen(error.items[0].detail);
        assert_true(kept >= ZR_DETAIL_SIZE - 4);
        assert_int_equal((unsigned char)error.items[0].detail[kept - 1], 0xa9);
    }
}

struct tally {
    atomic_uint seen[10007], strange_ranges;
};

static void tally_range(void *context, size_t begin, size_t end)
{
    struct tally *tally = context;
    if (begin % 13 != 0 || (end - begin != 13 && end != 10007)) atomic_fetch_add(&tally->strange_ranges, 1u);
    for (size_t i = begin; i < end; i++)
        atomic_fetch_add(&tally->seen[i], 1u);
}

TEST(team_ranges_visits_everything_once_with_any_number_of_threads)
{
    static struct tally tally;
    const int threads[] = {1, 2, 7};
    for (int t = 0; t < 3; t++) {
        struct zr_team *team = zr_team_create(threads[t]);
        assert_non_null(team);
        for (int round = 0; round < 50; round++) {
            memset(&tally, 0, sizeof tally);
            zr_team_ranges(team, 10007, 13, tally_range, &tally);
            assert_int_equal(tally.strange_ranges, 0);
            for (int i = 0; i < 10007; i++)
                assert_int_equal(tally.seen[i], 1);
        }
        zr_team_destroy(team);
    }
}

TEST(tangent_is_within_4_ulp_up_to_the_steepest)
{
    for (double x = 1e-9; x < 1.57; x = x < 1e-3 ? x * 1.1 : x + 0.00037)
        assert_true(fabs(zr_tan(x) - tan(x)) <= 4 * (nextafter(tan(x), HUGE_VAL) - tan(x)));
    for (double left = 0.001; left > 1e-12; left *= 0.7) {
        double x = 1.57079632679489655800 - left;
        assert_true(fabs(zr_tan(x) - tan(x)) <= 4 * (nextafter(tan(x), HUGE_VAL) - tan(x)));
    }
}

static double ulps(double got, long double want)
{
    double nearest = fabs((double)want), below = nearest - nextafter(nearest, 0);
    return fabs((double)((long double)got - want)) / below;
}

/* libm in long double is the truth: it needs more bits than a double has. */
TEST(sine_and_cosine_are_within_1_and_a_half_ulp)
{
    if (LDBL_MANT_DIG < 64) skip();
    struct random random = random_seeded(5);
    for (int i = 0; i < 100000; i++) {
        double degrees = random_range(&random, 0, 45), sine, cosine, negative;
        for (int halvings = i % 3 ? 0 : i % 40; halvings > 0; halvings--)
            degrees *= 0.5;
        long double radians = (long double)degrees * 3.14159265358979323846264338327950288L / 180;
        zr_sine_cosine(degrees, &sine, &cosine);
        assert_true(ulps(sine, sinl(radians)) <= 1.25);
        assert_true(ulps(cosine, cosl(radians)) <= 1.5);
        double again = cosine;
        zr_sine_cosine(-degrees, &negative, &cosine);
        assert_true(negative == -sine && cosine == again);
    }
}

TEST(sine_and_cosine_repeat_themselves_each_quarter_and_full_turn)
{
    for (double degrees = -45.0; degrees <= 45.0; degrees += 0.0625) { /* exact in binary, and so are all sums */
        double s, c, sine, cosine;
        zr_sine_cosine(degrees, &s, &c);
        const double sines[4] = {s, c, -s, -c};
        for (int quarter = -400003; quarter < 400003; quarter += 1 + 9973 * (quarter < -4 || quarter > 8)) {
            zr_sine_cosine(degrees + 90.0 * quarter, &sine, &cosine);
            int at = (quarter % 4 + 4) % 4;
            /* Half way between two quarters either side may do the work. */
            double slack = fabs(degrees) == 45.0 ? 2e-16 : 0.0;
            assert_true(fabs(sine - sines[at]) <= slack && fabs(cosine - sines[(at + 1) % 4]) <= slack);
        }
    }
    double sine, cosine;
    zr_sine_cosine(180.0, &sine, &cosine);
    assert_true(sine == 0.0 && !signbit(sine) && cosine == -1.0);
    zr_sine_cosine(-90.0, &sine, &cosine);
    assert_true(sine == -1.0 && cosine == 0.0 && !signbit(cosine));
}

TEST(unit_vector_is_the_same_at_every_scale)
{
    for (float scale = 1e-37f; scale < 1e37f; scale *= 10.0f) {
        zr_vec3 n = zr_vec3_normalize((zr_vec3){3 * scale, 0, 4 * scale});
        assert_true(fabsf(n.x - 0.6f) < 1e-6f && n.y == 0.0f && fabsf(n.z - 0.8f) < 1e-6f);
    }
    zr_vec3 zero = zr_vec3_normalize((zr_vec3){0, 0, 0});
    assert_true(zero.x == 0 && zero.y == 0 && zero.z == 0);
}

TEST(vector_whose_square_leaves_the_range_still_has_a_direction)
{
    const float least = 0x1p-149f, most = FLT_MAX;
    const zr_vec3 small = zr_vec3_normalize((zr_vec3){0, -least, 0}),
                  large = zr_vec3_normalize((zr_vec3){most, 0, -most}),
                  mixed = zr_vec3_normalize((zr_vec3){least, most, 1});
    assert_true(small.x == 0 && small.y == -1 && small.z == 0);
    assert_true(fabsf(large.x - sqrtf(0.5f)) < 1e-6f && large.y == 0 && large.z == -large.x);
    assert_true(mixed.x == 0 && mixed.y == 1 && mixed.z < 1e-37f);
    /* What has none stays what it is. */
    zr_vec3 endless = zr_vec3_normalize((zr_vec3){1, INFINITY, 0}),
            unknown = zr_vec3_normalize((zr_vec3){NAN, NAN, NAN});
    assert_true(endless.x == 1 && isinf(endless.y) && endless.z == 0);
    assert_true(isnan(unknown.x) && isnan(unknown.y) && isnan(unknown.z));
}

TEST(matrix_times_its_inverse_is_the_identity)
{
    zr_mat4 m = {{2, 0.5f, 0, 0, -1, 3, 0.25f, 0, 0, 1, 1.5f, 0.125f, 4, -5, 6, 1}}, inverse;
    assert_true(zr_mat4_invert(&m, &inverse));
    zr_mat4 product = zr_mat4_mul(&m, &inverse), identity = zr_mat4_identity();
    for (int i = 0; i < 16; i++)
        assert_true(fabsf(product.m[i] - identity.m[i]) < 1e-5f);
}

TEST(matrix_without_inverse_is_refused)
{
    zr_mat4 m = {{1, 2, 3, 4, 2, 4, 6, 8, 0, 0, 1, 0, 0, 0, 0, 1}}, inverse;
    assert_false(zr_mat4_invert(&m, &inverse));
}

struct three {
    double v[3];
};

static __attribute__((noinline)) void give(struct three *out)
{
    for (int k = 0; k < 3; k++)
        out->v[k] = 0.1 * (k + 1);
}

TEST(doubles_beside_one_another_are_rounded)
{
    struct three given, out;
    give(&given);
    out = (struct three){{zr_rounded(given.v[0]), zr_rounded(given.v[1]), zr_rounded(given.v[2])}};
    for (int k = 0; k < 3; k++) {
        volatile const float rounded = (float)given.v[k];
        assert_true(out.v[k] == (double)rounded && out.v[k] != given.v[k]);
    }
}

RUN_TESTS(NULL, NULL)
