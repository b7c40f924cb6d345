#include <math.h>

#include "input/json/json_number_rows.h"
#include "input/text/number.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

/* Random numbers that are read. NUMBERS asks for more, which .ci/run does. */
static int numbers_wanted(void)
{
    const char *text = getenv("NUMBERS");
    const int count = text ? atoi(text) : 300000;
    print_message("%d random numbers%s\n", count, text ? "" : "; NUMBERS=3000000 reads more");
    return count;
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* What is read inlined is what is read. */
static void check_next(const char *at, const char *end)
{
    double value = -12345, next = -12345;
    const char *behind = zr_number_read(at, end, &value);
    if (zr_number_next(at, end, &next) != behind || (behind && bits_of(next) != bits_of(value)))
        fail_msg("next: '%.*s': %a, not %a", (int)(end - at), at, next, value);
}

/* Where nothing is behind it, and where there is room to look far ahead. */
static void check_next_of(const char *text, size_t length)
{
    static const char behind[] = " \n\t,/#\\ex";
    char padded[256];
    for (size_t i = 0; length < sizeof padded - 40 && i < sizeof behind; i++) {
        memcpy(padded, text, length);
        memset(padded + length, behind[i], 40);
        check_next(padded, padded + length);
        check_next(padded, padded + length + 1);
        check_next(padded, padded + length + 40);
    }
}

/* Reads at a guard page. */
static const char *read_guarded(const struct guarded *guarded, double *value)
{
    const char *end = guarded->bytes + guarded->size;
    check_next(guarded->bytes, end);
    check_next_of(guarded->bytes, guarded->size);
    return zr_number_read(guarded->bytes, end, value);
}

/* The value of a text that is a number to its end. */
static double value_of(const char *text)
{
    struct guarded guarded = guarded_copy(text, strlen(text));
    double value = -12345;
    if (read_guarded(&guarded, &value) != guarded.bytes + guarded.size) fail_msg("'%s' is not read to its end", text);
    guarded_free(&guarded);
    return value;
}

/* How many bytes are taken; -1: none of it is a number. */
static long length_of(const char *text)
{
    struct guarded guarded = guarded_copy(text, strlen(text));
    double value;
    const char *behind = read_guarded(&guarded, &value);
    long length = behind ? (long)(behind - guarded.bytes) : -1;
    guarded_free(&guarded);
    return length;
}

static void check(const char *text)
{
    uint64_t got = bits_of(value_of(text)), want = bits_of(strtod(text, NULL));
    if (got != want) fail_msg("%s: %016llx, not %016llx", text, (unsigned long long)got, (unsigned long long)want);
}

TEST(every_form_has_the_value_strtod_gives)
{
    static const char *const texts[] = {
        "0",         "-0",          "1",           "+1",           "-1",
        "007",       "1.",          ".5",          "-.5",          "1.5e3",
        "1E+3",      "1e-3",        "0.1",         "0e9",          "0.000000",
        "123456789", "0.3e-5",      "9.5E022",     "1.0e00",       "0.0e-9999",
        "1e-0005",   "1e+00000005", "1e-00000005", "1.5e00000003", "1.5E-000000000000003"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        check(texts[i]);
    assert_true(signbit(value_of("-0.0")));
}

TEST(hard_roundings_have_the_value_strtod_gives)
{
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
TEST(digit_a_thousand_places_on_decides_a_tie)
{
    char text[1100] = "9007199254740993.";
    memset(text + strlen(text), '0', 1000);
    assert_true(value_of(text) == 9007199254740992.0);
    text[1010] = '1';
    assert_true(value_of(text) == 9007199254740994.0);
}

TEST(million_digits_are_read)
{
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

static struct random numbers = {{RANDOM_STATE_1}};

static size_t below(size_t count)
{
    return random_below(&numbers, (uint32_t)count);
}

static size_t put_digits(char *text, size_t count)
{
    for (size_t i = 0; i < count; i++)
        text[i] = (char)('0' + below(10));
    return count;
}

/* Any number that JSON has, of every length up to the limit: short decimals most often. */
static size_t put_random_number(char *text)
{
    size_t used = 0, kind = below(16);
    if (below(2)) text[used++] = '-';
    if (below(2))
        text[used++] = '0';
    else {
        text[used++] = (char)('1' + below(9));
        used += put_digits(text + used, below(kind < 12 ? 4 : 20));
    }
    if (below(8)) {
        text[used++] = '.';
        for (size_t zeros = below(4) ? 0 : below(13); zeros > 0; zeros--)
            text[used++] = '0';
        used += put_digits(text + used, 1 + below(kind < 12 ? 9 : 20));
    }
    if (below(4) == 0) {
        used += (size_t)sprintf(text + used, "%c%s", below(2) ? 'e' : 'E', (const char *[]){"", "+", "-"}[below(3)]);
        used += (size_t)sprintf(text + used, "%zu", below(kind < 12 ? 30 : 340));
    }
    return used;
}

/* The middle between two doubles to the last digit that fits, or a little beside it; or any double's 17 digits. */
static size_t put_hard_number(char *text)
{
    uint64_t bits = random_next(&numbers);
    double value;
    if (below(2)) bits = (bits & ~(UINT64_C(0x7FF) << 52)) | (uint64_t)(1023 - 40 + below(100)) << 52;
    memcpy(&value, &bits, sizeof value);
    if (!isfinite(value)) value = 1.5;
    if (below(3)) return (size_t)sprintf(text, "%.*e", (int)(14 + below(5)), value);
    uint64_t odd = (UINT64_C(1) << 53) + 2 * (random_next(&numbers) >> 12) + 1;
    return (size_t)sprintf(text, "%llu%s", (unsigned long long)odd, below(2) ? "" : ".000001");
}

static void check_all_ways(const char *text, size_t length)
{
    const char *end = text + length;
    double want = strtod(text, NULL), got;
    if (zr_number_read_json(text, end, &got) != end || bits_of(got) != bits_of(want)) fail_msg("%s: %a", text, got);
    const char *behind = zr_number_quick(text, end, &got);
    if (behind && (behind != end || bits_of(got) != bits_of(want))) fail_msg("quick: %s: %a", text, got);
#ifdef __SSE2__
    behind = zr_number_quicker(text, &got);
    if (behind && *behind == ',' && (behind != end || bits_of(got) != bits_of(want)))
        fail_msg("quicker: %s: %a", text, got);
#endif
}

/* The same of what readers of lines call, with a blank behind the number. */
static void check_before_blank(char *text, size_t length)
{
    const char *end = text + length;
    double want = strtod(text, NULL), got;
    text[length] = ' ';
    if (zr_number_next(text, end + 32, &got) != end || bits_of(got) != bits_of(want))
        fail_msg("next: %s: %a", text, got);
}

TEST(random_numbers_have_the_value_strtod_gives)
{
    const int count = numbers_wanted();
    char text[160];
    for (int i = 0; i < count; i++) {
        size_t length = i % 8 ? put_random_number(text) : put_hard_number(text);
        memset(text + length, ',', 32);
        text[length + 32] = '\0';
        check_all_ways(text, length);
        check_before_blank(text, length);
    }
}

/* Rows as positions have them, in all of the ways that they are written: floats of what strtod gives. */
TEST(random_numbers_in_rows_have_the_value_strtod_gives)
{
    static const char *const commas[] = {",", ",", ", ", " ,\n"};
    const double limit = 1e300;
    const int count = numbers_wanted();
    for (int i = 0; i < count / 4; i++) {
        char text[700] = "[";
        size_t length = 1, starts[4];
        for (int k = 0; k < 4; k++) {
            if (k > 0) length += (size_t)sprintf(text + length, "%s", commas[below(4)]);
            starts[k] = length;
            length += (i + k) % 8 ? put_random_number(text + length) : put_hard_number(text + length);
        }
        length += (size_t)sprintf(text + length, "],");
        const float want[] = {(float)strtod(text + starts[0], NULL), (float)strtod(text + starts[1], NULL),
                              (float)strtod(text + starts[2], NULL), (float)strtod(text + starts[3], NULL)};
        bool fits = true;
        for (int k = 0; k < 4; k++)
            fits = fits && fabs(strtod(text + starts[k], NULL)) <= limit;
        zr_vec4 got;
        const char *behind = zr_numbers_vec4(text, text + length + (i % 2 ? 100 : 0), -limit, limit, &got);
        if (behind != (fits ? text + length - 1 : NULL)) fail_msg("%s: ends at %td", text, behind ? behind - text : -1);
        if (fits && memcmp(&got, want, sizeof want) != 0) fail_msg("%s", text);
    }
}

TEST(what_json_does_not_have_is_refused)
{
    static const char *const texts[] = {"",   "-",   "+1",  "01",  "-01",  "00",    "1.",   ".5",  "-.5", "1.e5",
                                        "1e", "1e+", "1.-", "0x1", "00.5", "-00.5", "01e1", "Inf", "NaN", "--1"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char padded[64];
        size_t length = strlen(texts[i]);
        struct guarded guarded = guarded_copy(texts[i], length);
        double value;
        const char *end = guarded.bytes + length, *behind = zr_number_read_json(guarded.bytes, end, &value);
        if (behind == end && length > 0) fail_msg("'%s' is taken for a number", texts[i]);
        behind = zr_number_quick(guarded.bytes, end, &value);
        if (behind == end && length > 0) fail_msg("'%s' is quickly taken for a number", texts[i]);
        guarded_free(&guarded);
        snprintf(padded, sizeof padded, "%s,                                        ", texts[i]);
#ifdef __SSE2__
        behind = zr_number_quicker(padded, &value);
        if (behind == padded + length) fail_msg("'%s' is more quickly taken for a number", texts[i]);
#endif
    }
}

TEST(what_is_no_number_is_refused)
{
    static const char *const texts[] = {"",    "-",        "+",  ".",   "-.",   "e5",  ".e5", "inf", "nan", "-inf",
                                        "NAN", "infinity", "1e", "1e+", "1.e-", "--1", "+-1", " 1",  "x",   "-x"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (length_of(texts[i]) != -1) fail_msg("'%s' is taken for a number", texts[i]);
}

TEST(number_ends_where_something_else_begins)
{
    assert_int_equal(length_of("0x10"), 1);
    assert_int_equal(length_of("1.5.5"), 3);
    assert_int_equal(length_of("1,5"), 1);
    assert_int_equal(length_of("12 34"), 2);
    assert_int_equal(length_of("1e5e5"), 3);
}

RUN_TESTS(NULL, NULL)
