#include "overlay/ticks.h"

#include <math.h>

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
