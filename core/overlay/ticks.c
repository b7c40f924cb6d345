#include "overlay/ticks.h"

#include <math.h>
#include <string.h>

enum { FLOAT_DIGITS_MAX = 9, FLOAT_EXPONENT_MIN = -45 };

static double power_of_ten(int exponent)
{
    double power = 1.0;
    for (int i = 0; i < exponent; i++)
        power *= 10.0;
    return power;
}

/* Scales by an integer power of ten, so that small numbers are exact, too. */
static double scale(double number, int exponent)
{
    return exponent < 0 ? number / power_of_ten(-exponent) : number * power_of_ten(exponent);
}

struct zr_decimal zr_decimal_trim(struct zr_decimal number)
{
    if (number.digits == 0) return (struct zr_decimal){0, 0};
    for (; number.digits % 10 == 0; number.exponent++)
        number.digits /= 10;
    return number;
}

double zr_decimal_value(struct zr_decimal number)
{
    return scale((double)number.digits, number.exponent);
}

struct zr_decimal zr_decimal_of_float(float value)
{
    struct zr_decimal number = {0, 0};
    int first = FLOAT_EXPONENT_MIN; /* exponent of the first digit */
    if (value == 0.0f) return number;
    while (scale(1.0, first + 1) <= fabs((double)value))
        first++;
    for (int count = 1; count <= FLOAT_DIGITS_MAX; count++) {
        number.exponent = first + 1 - count;
        number.digits = (int64_t)floor(scale((double)value, -number.exponent) + 0.5);
        if ((float)zr_decimal_value(number) == value) break;
    }
    return zr_decimal_trim(number);
}

/* ---- writing ---- */

/* Writes the digits without their sign and returns their number. */
static size_t write_digits(int64_t digits, char *out)
{
    char backwards[24];
    size_t count = 0;
    uint64_t rest = digits < 0 ? 0 - (uint64_t)digits : (uint64_t)digits;
    do
        backwards[count++] = (char)('0' + rest % 10);
    while (rest /= 10);
    for (size_t i = 0; i < count; i++)
        out[i] = backwards[count - 1 - i];
    return count;
}

static char *write_zeros(char *at, int count)
{
    for (int i = 0; i < count; i++)
        *at++ = '0';
    return at;
}

/* Writes the digits with the point after the first `whole`; pads with zeros if `whole` is negative or exceeds
 * `count`. */
static char *write_plain(char *at, const char *digits, int count, int whole)
{
    if (whole <= 0) {
        *at++ = '0';
        *at++ = '.';
        at = write_zeros(at, -whole);
    }
    for (int i = 0; i < count; i++) {
        if (i > 0 && i == whole) *at++ = '.';
        *at++ = digits[i];
    }
    return write_zeros(at, whole - count);
}

size_t zr_decimal_write(struct zr_decimal number, bool scientific, char out[ZR_DECIMAL_SIZE])
{
    char digits[24];
    const int count = (int)write_digits(number.digits, digits), whole = count + number.exponent;
    char *at = out;
    if (number.digits < 0) *at++ = '-';
    if (!scientific || number.digits == 0) {
        at = write_plain(at, digits, count, whole);
    } else {
        at = write_plain(at, digits, count, 1);
        *at++ = 'e';
        if (whole - 1 < 0) *at++ = '-';
        at += write_digits(whole - 1, at);
    }
    *at = '\0';
    return (size_t)(at - out);
}

/* Longest plain label; longer ones use the shorter of both notations. */
enum { PLAIN_LENGTH_MAX = 6 };

/* Tolerance of distances: an end such as 0.8 is no exact float, and gets the step that 8 gets. */
#define SLACK 1e-6

/* 0.1 as a float is slightly more than 0.1, but a tick nevertheless: ticks may exceed the range by this share, which is
 * invisible. */
#define END_SHARE 0.005

/* Below the smallest step between two floats. */
enum { STEP_EXPONENT_MIN = -48 };

static struct zr_decimal multiple(struct zr_decimal step, int64_t times)
{
    return (struct zr_decimal){step.digits * times, step.exponent};
}

static struct zr_decimal find_step(double least)
{
    static const int64_t round[] = {1, 2, 5};
    struct zr_decimal step = {1, STEP_EXPONENT_MIN};
    while (zr_decimal_value((struct zr_decimal){1, step.exponent + 1}) <= least)
        step.exponent++;
    for (int i = 0; i < 3; i++) {
        step.digits = round[i];
        if (zr_decimal_value(step) >= least) return step;
    }
    return (struct zr_decimal){1, step.exponent + 1};
}

static void add(struct zr_ticks *ticks, struct zr_decimal tick)
{
    if (ticks->count < ZR_TICKS_MAX) ticks->at[ticks->count++] = zr_decimal_trim(tick);
}

/* Returns the length of the longest label, without its sign. */
static size_t longest(const struct zr_ticks *ticks, bool scientific)
{
    size_t most = 0;
    char text[ZR_DECIMAL_SIZE];
    for (int i = 0; i < ticks->count; i++) {
        const size_t length = zr_decimal_write(ticks->at[i], scientific, text) - (ticks->at[i].digits < 0);
        if (length > most) most = length;
    }
    return most;
}

/* Returns true if a multiple may be a tick: within the range, or equal to an end as a float. */
static bool is_within(double value, float low, float high)
{
    const double beyond = END_SHARE * ((double)high - (double)low);
    return (float)value >= low && (float)value <= high && value >= (double)low - beyond &&
           value <= (double)high + beyond;
}

static void add_multiples(struct zr_ticks *ticks, struct zr_decimal step, float low, float high)
{
    int64_t i = (int64_t)floor((double)low / zr_decimal_value(step)) - 1;
    for (double value = (double)low; value <= (double)high; i++) {
        value = zr_decimal_value(multiple(step, i));
        if (is_within(value, low, high)) add(ticks, multiple(step, i));
    }
}

/* Adds both ends, and the multiples between them that are at least `distance` from both. */
static void add_ends(struct zr_ticks *ticks, struct zr_decimal step, float low, float high, double distance)
{
    const struct zr_decimal first = zr_decimal_of_float(low), last = zr_decimal_of_float(high);
    const double least = fmax(zr_decimal_value(first), (double)low) + distance;
    const double most = fmin(zr_decimal_value(last), (double)high) - distance;
    add(ticks, first);
    for (int64_t i = (int64_t)floor(least / zr_decimal_value(step)) - 1;; i++) {
        const double value = zr_decimal_value(multiple(step, i));
        if (value > most) break;
        if (value >= least) add(ticks, multiple(step, i));
    }
    add(ticks, last);
    ticks->has_ends = true;
}

struct zr_ticks zr_ticks_make(float low, float high, double apart, bool ends)
{
    struct zr_ticks ticks = {.count = 0};
    const double distance = apart * ((double)high - (double)low) * (1.0 - SLACK);
    if (!(low < high))
        add(&ticks, zr_decimal_of_float(low));
    else if (ends)
        add_ends(&ticks, find_step(distance), low, high, distance);
    else
        add_multiples(&ticks, find_step(distance), low, high);
    ticks.is_scientific = longest(&ticks, false) > PLAIN_LENGTH_MAX && longest(&ticks, true) < longest(&ticks, false);
    return ticks;
}

/* Puts the first and the last tick exactly at the ends: in a range of a few floats, the value of their few digits may
 * be far from the end. */
double zr_tick_share(const struct zr_ticks *ticks, int i, float low, float high)
{
    if (!(low < high)) return 0.5;
    if (ticks->has_ends && i == 0) return 0.0;
    if (ticks->has_ends && i == ticks->count - 1) return 1.0;
    const double share = (zr_decimal_value(ticks->at[i]) - (double)low) / ((double)high - (double)low);
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}
