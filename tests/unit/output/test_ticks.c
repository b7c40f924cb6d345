/* overlay/ticks.c: round numbers along a range, and how they are written. */
#include "overlay/ticks.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/random.h"
#include "support/tests.h"

/* ---- decimals ---- */

TEST(numbers_are_written_with_as_few_digits_as_they_have)
{
    static const struct {
        struct zr_decimal number;
        const char *plain, *scientific;
    } cases[] = {{{0, 0}, "0", "0"},
                 {{7, 0}, "7", "7e0"},
                 {{-7, 0}, "-7", "-7e0"},
                 {{5, -1}, "0.5", "5e-1"},
                 {{-25, -2}, "-0.25", "-2.5e-1"},
                 {{125, -1}, "12.5", "1.25e1"},
                 {{12, 3}, "12000", "1.2e4"},
                 {{1, -7}, "0.0000001", "1e-7"},
                 {{1, 30}, "1000000000000000000000000000000", "1e30"},
                 {{100000002, 22}, "1000000020000000000000000000000", "1.00000002e30"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[ZR_DECIMAL_SIZE];
        assert_int_equal(zr_decimal_write(cases[i].number, false, text), strlen(cases[i].plain));
        assert_string_equal(text, cases[i].plain);
        assert_int_equal(zr_decimal_write(cases[i].number, true, text), strlen(cases[i].scientific));
        assert_string_equal(text, cases[i].scientific);
    }
}

/* In the C locale, which tests have. */
static void assert_reads_back(float value)
{
    const struct zr_decimal number = zr_decimal_of_float(value);
    char text[ZR_DECIMAL_SIZE], shorter[32];
    for (int scientific = 0; scientific < 2; scientific++) {
        zr_decimal_write(number, scientific, text);
        if (strtof(text, NULL) != value) fail_msg("%.9g is written as %s", (double)value, text);
    }
    int digits = 0;
    for (int64_t rest = number.digits; rest != 0; rest /= 10)
        digits++;
    assert_true(digits <= 9 && (digits == 0 || number.digits % 10 != 0));
    if (digits < 2) return;
    snprintf(shorter, sizeof shorter, "%.*e", digits - 2, (double)value);
    if (strtof(shorter, NULL) == value) fail_msg("%s says it, too: %s", shorter, text);
}

TEST(floats_have_the_fewest_digits_that_tell_them)
{
    static const float odd[] = {0.0f,    -0.0f,   0.1f,        0.3f,         37.0f,  2.37f,      1e30f,
                                FLT_MAX, FLT_MIN, FLT_EPSILON, FLT_TRUE_MIN, 1e-40f, 16777216.0f};
    struct random random = random_seeded(7);
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        assert_reads_back(odd[i]);
        assert_reads_back(-odd[i]);
    }
    for (int i = 0; i < 20000; i++) {
        const uint32_t bits = random_below(&random, UINT32_MAX);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) assert_reads_back(value);
    }
}

/* ---- ticks ---- */

static const char *labels(const struct zr_ticks *ticks)
{
    static char all[ZR_TICKS_MAX * (ZR_DECIMAL_SIZE + 1)];
    char *end = all;
    *end = '\0';
    for (int i = 0; i < ticks->count; i++) {
        if (i > 0) *end++ = ' ';
        end += zr_decimal_write(ticks->at[i], ticks->is_scientific, end);
    }
    return all;
}

TEST(ticks_are_round_numbers)
{
    static const struct {
        float low, high;
        double apart;
        bool ends;
        const char *want;
    } cases[] = {
        {0, 1, 0.2, false, "0 0.2 0.4 0.6 0.8 1"},
        {0, 1, 0.125, false, "0 0.2 0.4 0.6 0.8 1"},
        {0, 8, 0.125, false, "0 1 2 3 4 5 6 7 8"},
        {0, 0.8f, 0.125, false, "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8"}, /* 0.8 is no exact float */
        {0.1f, 0.3f, 0.2, false, "0.1 0.15 0.2 0.25 0.3"},
        {-1.7f, 1.97f, 0.125, false, "-1.5 -1 -0.5 0 0.5 1 1.5"},
        {-300, -100, 0.2, false, "-300 -250 -200 -150 -100"},
        {0.0137f, 98.2f, 0.2, false, "20 40 60 80"},
        {0, 37, 0.125, true, "0 5 10 15 20 25 30 37"}, /* 35 is too near */
        {0, 40, 0.125, true, "0 5 10 15 20 25 30 35 40"},
        {-1.5f, 2.37f, 0.125, true, "-1.5 -1 -0.5 0 0.5 1 1.5 2.37"},
        {0, 100000, 0.2, false, "0 20000 40000 60000 80000 100000"},
        {0, 1e6f, 0.2, false, "0 2e5 4e5 6e5 8e5 1e6"},
        {1e6f, 1000008, 0.2, false, "1000000 1000002 1000004 1000006 1000008"},
        {0, 1e-4f, 0.2, false, "0 2e-5 4e-5 6e-5 8e-5 1e-4"},
        {-1e30f, 1e30f, 0.2, false, "-1e30 -5e29 0 5e29 1e30"},
        {-FLT_MAX, FLT_MAX, 0.2, false, "-2e38 0 2e38"},
        {-FLT_MAX, FLT_MAX, 0.2, true, "-3.4028235e38 -2e38 0 2e38 3.4028235e38"},
        {7, 7, 0.2, false, "7"},
        {7, 7, 0.2, true, "7"},
        {-2.5e-8f, -2.5e-8f, 0.2, false, "-2.5e-8"},
        {0, FLT_TRUE_MIN, 0.2, true, "0 5e-46 1e-45"},
        {-0.0f, 0, 0.2, true, "0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct zr_ticks ticks = zr_ticks_make(cases[i].low, cases[i].high, cases[i].apart, cases[i].ends);
        if (strcmp(labels(&ticks), cases[i].want) != 0)
            fail_msg("%.9g to %.9g: %s, not %s", (double)cases[i].low, (double)cases[i].high, labels(&ticks),
                     cases[i].want);
    }
}

static float random_float(struct random *random)
{
    const double exponent = random_range(random, -44, 38);
    const double size = random_range(random, 0.1, 3) * pow(10, exponent);
    return (float)(random_below(random, 2) ? size : -size);
}

static void check_ticks(float low, float high, double apart, bool ends)
{
    const struct zr_ticks ticks = zr_ticks_make(low, high, apart, ends);
    assert_in_range(ticks.count, 2, (int)(1 / apart) + 3);
    for (int i = 0; i < ticks.count; i++) {
        const float value = (float)zr_decimal_value(ticks.at[i]);
        const double share = zr_tick_share(&ticks, i, low, high);
        if (!(value >= low && value <= high) || !(share >= 0 && share <= 1))
            fail_msg("%.9g to %.9g: %s", (double)low, (double)high, labels(&ticks));
        if (i == 0) continue;
        const double step = share - zr_tick_share(&ticks, i - 1, low, high);
        if (!(step >= apart * 0.999 - 0.005)) /* the first may be a little below, and stands at the end */
            fail_msg("%.9g to %.9g: %s", (double)low, (double)high, labels(&ticks));
        char before[ZR_DECIMAL_SIZE], now[ZR_DECIMAL_SIZE];
        zr_decimal_write(ticks.at[i - 1], ticks.is_scientific, before);
        zr_decimal_write(ticks.at[i], ticks.is_scientific, now);
        assert_string_not_equal(before, now);
    }
    if (!ends) return;
    assert_true((float)zr_decimal_value(ticks.at[0]) == low);
    assert_true((float)zr_decimal_value(ticks.at[ticks.count - 1]) == high);
}

TEST(random_ranges_have_ticks_that_rise_within_them)
{
    struct random random = random_seeded(11);
    for (int i = 0; i < 50000; i++) {
        const float a = random_float(&random);
        float b = random_float(&random);
        if (random_below(&random, 2)) b = a * (1 + (float)random_range(&random, 1e-6, 1));
        if (random_below(&random, 20) == 0) b = nextafterf(a, INFINITY);
        if (!isfinite(b) || a == b) continue;
        const double apart = random_range(&random, 0.1, 0.2); /* in this order with every compiler */
        check_ticks(a < b ? a : b, a < b ? b : a, apart, random_below(&random, 2) != 0);
    }
}

RUN_TESTS(NULL, NULL)
