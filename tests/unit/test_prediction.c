/* server/prediction.c: what work will take, learned from what work took. */
#include <math.h>

#include "prediction.h"
#include "support/cmocka_all.h"

static const struct zr_cost picture = {
    .triangles = 50000, .fragments = 500000, .pixels = 2000000, .png_pixels = 2000000};

/* What the two steps would take if each kind took `factor` times what is first thought. */
static void learn_times(struct prediction *prediction, const struct zr_cost *cost, double factor, int times)
{
    struct prediction fresh;
    prediction_init(&fresh);
    struct zr_cost render = *cost, encode = {.png_pixels = cost->png_pixels};
    render.png_pixels = 0;
    double render_ms = prediction_ms(&fresh, &render) * factor;
    double encode_ms = prediction_ms(&fresh, &encode) * factor;
    for (int i = 0; i < times; i++)
        prediction_learn(prediction, cost, render_ms, encode_ms);
    prediction_free(&fresh);
}

/* What is predicted now over what was predicted at first. */
static double drift(struct prediction *prediction, const struct zr_cost *cost)
{
    struct prediction fresh;
    prediction_init(&fresh);
    double ratio = prediction_ms(prediction, cost) / prediction_ms(&fresh, cost);
    prediction_free(&fresh);
    return ratio;
}

static void few_requests_teach_what_the_machine_takes(void **state)
{
    static const double factors[] = {0.05, 0.5, 1.0, 4.0};
    (void)state;
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        struct prediction prediction;
        prediction_init(&prediction);
        learn_times(&prediction, &picture, factors[i], 6);
        double ratio = drift(&prediction, &picture) / factors[i];
        assert_true(ratio > 0.67 && ratio < 1.5);
        prediction_free(&prediction);
    }
}

static void kind_that_is_not_in_a_request_is_left_alone(void **state)
{
    (void)state;
    static const struct zr_cost png = {.png_pixels = 2000000}, triangles = {.triangles = 100000};
    struct prediction prediction;
    prediction_init(&prediction);
    learn_times(&prediction, &png, 3.0, 10);
    assert_true(fabs(drift(&prediction, &png) - 3.0) < 0.3);
    assert_true(drift(&prediction, &triangles) == 1.0);
    prediction_free(&prediction);
}

/* Meshes are drawn many triangles at once; shapes are not. */
static void meshes_teach_nothing_about_shapes(void **state)
{
    (void)state;
    static const struct zr_cost mesh = {.triangles = 50000, .fragments = 500000},
                                shapes = {.shape_triangles = 50000, .shape_fragments = 500000};
    struct prediction prediction;
    prediction_init(&prediction);
    const double before = prediction_ms(&prediction, &shapes), slow = prediction_ms(&prediction, &mesh);
    for (int i = 0; i < 50; i++)
        prediction_learn(&prediction, &mesh, slow / 20, -1.0);
    assert_true(prediction_ms(&prediction, &mesh) < slow / 10);
    assert_true(fabs(prediction_ms(&prediction, &shapes) - before) < 1e-9);
    prediction_free(&prediction);
}

/* Pictures by the textbook have no samples that are lit apart, and say nothing about them. */
static void textbook_teaches_nothing_about_samples(void **state)
{
    (void)state;
    static const struct zr_cost textbook = {.triangles = 50000, .fragments = 500000}, look = {.samples = 10000000};
    struct prediction prediction;
    prediction_init(&prediction);
    const double before = prediction_ms(&prediction, &look), slow = prediction_ms(&prediction, &textbook);
    assert_true(before > 10 && before < 1000); /* ten million of them */
    for (int i = 0; i < 50; i++)
        prediction_learn(&prediction, &textbook, slow / 20, -1.0);
    assert_true(fabs(prediction_ms(&prediction, &look) - before) < 1e-9);
    for (int i = 0; i < 50; i++)
        prediction_learn(&prediction, &look, before / 4, -1.0);
    assert_true(fabs(prediction_ms(&prediction, &look) / before - 0.25) < 0.05);
    prediction_free(&prediction);
}

static void one_strange_request_moves_what_is_known_by_little(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    learn_times(&prediction, &picture, 1.0, 20);
    learn_times(&prediction, &picture, 1000.0, 1);
    double ratio = drift(&prediction, &picture);
    assert_true(ratio > 1.0 && ratio < 1.5);
    prediction_free(&prediction);
}

/* Of a machine that is known, within a factor of two, however many there are; and at once right again for honest ones.
 */
static void what_only_looks_slow_raises_what_is_known_to_twice_at_most(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    for (int i = 0; i < 3; i++) {
        const double known = i == 0 ? 0.1 : 1.0 / 30;
        learn_times(&prediction, &picture, known, 40);
        const double before = drift(&prediction, &picture);
        learn_times(&prediction, &picture, 1e6, 1000);
        assert_true(drift(&prediction, &picture) <= 2.0 * before * 1.01);
    }
    prediction_free(&prediction);
}

static void algorithms_teach_one_another_nothing(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    struct zr_cost other = picture, render = picture;
    other.algorithm = 4;
    render.png_pixels = 0;
    other.png_pixels = 0;
    learn_times(&prediction, &other, 1000.0, 100);
    assert_true(drift(&prediction, &other) > 2.0);
    assert_true(drift(&prediction, &render) == 1.0);
    prediction_free(&prediction);
}

static void what_is_refused_comes_back_within_reach(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    learn_times(&prediction, &picture, 1e6, 1000); /* before anything honest was seen */
    assert_true(drift(&prediction, &picture) > 2.0);
    for (int i = 0; i < 40; i++)
        prediction_refused(&prediction, &picture);
    assert_true(drift(&prediction, &picture) < 1.1);
    prediction_free(&prediction);
}

static void strange_requests_without_end_stay_within_bounds(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    learn_times(&prediction, &picture, 1e6, 1000);
    assert_true(drift(&prediction, &picture) <= 8.0);
    learn_times(&prediction, &picture, 1e-2, 1000); /* still long enough to teach */
    assert_true(drift(&prediction, &picture) >= 1.0 / 65.0);
    prediction_free(&prediction);
}

static void what_is_unknown_or_too_short_teaches_nothing(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    prediction_learn(&prediction, &picture, -1.0, -1.0);
    prediction_learn(&prediction, &picture, 0.1, 0.1);
    prediction_learn(&prediction, &(struct zr_cost){.pixels = 0}, 1000.0, 1000.0);
    assert_true(drift(&prediction, &picture) == 1.0);
    prediction_free(&prediction);
}

static void lap_of_a_request_that_others_overlap_is_unknown(void **state)
{
    (void)state;
    struct prediction prediction;
    prediction_init(&prediction);
    prediction_begin(&prediction);
    struct prediction_lap lap = prediction_start_lap(&prediction);
    assert_true(prediction_end_lap(&prediction, &lap) >= 0.0);
    prediction_begin(&prediction); /* another, and it is over before the lap is */
    prediction_end(&prediction);
    assert_true(prediction_end_lap(&prediction, &lap) == -1.0);
    assert_true(prediction_end_lap(&prediction, &lap) >= 0.0);
    prediction_begin(&prediction); /* another, and it goes on */
    assert_true(prediction_end_lap(&prediction, &lap) == -1.0);
    assert_true(prediction_end_lap(&prediction, &lap) == -1.0);
    prediction_end(&prediction);
    prediction_end(&prediction);
    prediction_free(&prediction);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_requests_teach_what_the_machine_takes),
        cmocka_unit_test(kind_that_is_not_in_a_request_is_left_alone),
        cmocka_unit_test(meshes_teach_nothing_about_shapes),
        cmocka_unit_test(textbook_teaches_nothing_about_samples),
        cmocka_unit_test(one_strange_request_moves_what_is_known_by_little),
        cmocka_unit_test(what_only_looks_slow_raises_what_is_known_to_twice_at_most),
        cmocka_unit_test(algorithms_teach_one_another_nothing),
        cmocka_unit_test(what_is_refused_comes_back_within_reach),
        cmocka_unit_test(strange_requests_without_end_stay_within_bounds),
        cmocka_unit_test(what_is_unknown_or_too_short_teaches_nothing),
        cmocka_unit_test(lap_of_a_request_that_others_overlap_is_unknown),
    };
    return cmocka_run_group_tests_name("prediction", tests, NULL, NULL);
}
