#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "guarded.h"
#include "input/number.h"

/* The value of a text that is a number to its end; at a guard page. */
static double value_of(const char *text)
{
    struct guarded guarded = guarded_copy(text, strlen(text));
    const char *end = guarded.bytes + guarded.size;
    double value = -12345;
    if (zr_number_read(guarded.bytes, end, &value) != end) fail_msg("'%s' is not read to its end", text);
    guarded_free(&guarded);
    return value;
}

/* How many bytes are taken; -1: none of it is a number. */
static long length_of(const char *text)
{
    struct guarded guarded = guarded_copy(text, strlen(text));
    double value;
    const char *behind = zr_number_read(guarded.bytes, guarded.bytes + guarded.size, &value);
    long length = behind ? (long)(behind - guarded.bytes) : -1;
    guarded_free(&guarded);
    return length;
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void check(const char *text)
{
    uint64_t got = bits_of(value_of(text)), want = bits_of(strtod(text, NULL));
    if (got != want) fail_msg("%s: %016llx, not %016llx", text, (unsigned long long)got, (unsigned long long)want);
}

static void every_form_has_the_value_strtod_gives(void **state)
{
    (void)state;
    static const char *const texts[] = {"0",        "-0",        "1",      "+1",      "-1",     "007",      "1.",
                                        ".5",       "-.5",       "1.5e3",  "1E+3",    "1e-3",   "0.1",      "0e9",
                                        "0.000000", "123456789", "0.3e-5", "9.5E022", "1.0e00", "0.0e-9999"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        check(texts[i]);
    assert_true(signbit(value_of("-0.0")));
}

static void hard_roundings_have_the_value_strtod_gives(void **state)
{
    (void)state;
    static const char *const texts[] = {"9007199254740992",
                                        "9007199254740993",
                                        "9007199254740993.00000000000000000000000000000000000001",
                                        "1e22",
                                        "1e23",
                                        "8.41e21",
                                        "9.5e-23",
                                        "1.7976931348623157e308",
                                        "1.7976931348623159e308",
                                        "2.2250738585072011e-308",
                                        "4.9e-324",
                                        "2.4703282292062327e-324",
                                        "2.4703282292062328e-324",
                                        "179769313486231580793728971405301e276",
                                        "18446744073709551616",
                                        "9999999999999999999",
                                        "99999999999999999999",
                                        "6.02214076e23",
                                        "0.1000000000000000055511151231257827021181583404541015625",
                                        "1e400",
                                        "1e-400",
                                        "1e99999999999999999999",
                                        "1e-99999999999999999999"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        check(texts[i]);
}

/* Halfway between two doubles up to digit 1000, and just above it. */
static void digit_a_thousand_places_on_decides_a_tie(void **state)
{
    (void)state;
    char text[1100] = "9007199254740993.";
    memset(text + strlen(text), '0', 1000);
    assert_true(value_of(text) == 9007199254740992.0);
    text[1010] = '1';
    assert_true(value_of(text) == 9007199254740994.0);
}

static void million_digits_are_read(void **state)
{
    (void)state;
    size_t size = 1000000;
    char *text = malloc(size + 1);
    assert_non_null(text);
    memset(text, '0', size);
    text[1] = '.';
    text[size - 1] = '7';
    text[size] = '\0';
    assert_true(value_of(text) == 0.0);
    memset(text, '9', size);
    assert_true(isinf(value_of(text)));
    memcpy(text + size - 8, "e-999992", 8);
    assert_true(fabs(value_of(text) - 1.0) < 1e-12);
    free(text);
}

static void random_decimals_have_the_value_strtod_gives(void **state)
{
    (void)state;
    uint64_t seed = 88172645463325252u;
    char text[64];
    for (int i = 0; i < 200000; i++) {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        int decimals = (int)(seed >> 59), exponent = (int)(seed >> 40 & 63) - 32;
        if (i % 2)
            snprintf(text, sizeof text, "%.*f", decimals % 12, (double)(int64_t)seed / 1e15);
        else
            snprintf(text, sizeof text, "%lld.%llue%d", (long long)seed >> 20, (unsigned long long)seed >> 44,
                     exponent);
        check(text);
    }
}

static void what_is_no_number_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {"",    "-",        "+",  ".",   "-.",   "e5",  ".e5", "inf", "nan", "-inf",
                                        "NAN", "infinity", "1e", "1e+", "1.e-", "--1", "+-1", " 1",  "x",   "-x"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (length_of(texts[i]) != -1) fail_msg("'%s' is taken for a number", texts[i]);
}

static void number_ends_where_something_else_begins(void **state)
{
    (void)state;
    assert_int_equal(length_of("0x10"), 1);
    assert_int_equal(length_of("1.5.5"), 3);
    assert_int_equal(length_of("1,5"), 1);
    assert_int_equal(length_of("12 34"), 2);
    assert_int_equal(length_of("1e5e5"), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_has_the_value_strtod_gives),
        cmocka_unit_test(hard_roundings_have_the_value_strtod_gives),
        cmocka_unit_test(digit_a_thousand_places_on_decides_a_tie),
        cmocka_unit_test(million_digits_are_read),
        cmocka_unit_test(random_decimals_have_the_value_strtod_gives),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(number_ends_where_something_else_begins),
    };
    return cmocka_run_group_tests_name("number", tests, NULL, NULL);
}
