#include "input/number.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/number_round.h"

enum {
    EXPONENT_MAX = 1000000, /* clamps exponents: far beyond any double, far within an int */
    /* The midpoint of two doubles has at most 767 significant digits. Later digits affect the rounding only by whether
     * all of them are zero. */
    DIGITS_KEPT = 770,
    FAST_DIGITS = 19 /* as many as fit 64 bits */
};

struct decimal {
    bool negative;
    const char *first, *last; /* significant digits, possibly with a point among them; last is one past */
    int digits;               /* their count, at most EXPONENT_MAX */
    uint64_t mantissa;        /* valid while digits <= FAST_DIGITS */
    int64_t exponent;         /* of the last digit */
};

static bool is_digit(const char *at, const char *end)
{
    return at < end && (unsigned char)(*at - '0') < 10;
}

/* Accumulates digits into the mantissa while they fit, and counts all of them. */
static const char *read_digits(const char *at, const char *end, struct decimal *decimal)
{
    uint64_t mantissa = decimal->mantissa;
    int digits = decimal->digits;
    for (; is_digit(at, end); at++) {
        if (digits == 0) {
            if (*at == '0') continue;
            decimal->first = at;
        }
        if (digits < FAST_DIGITS) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
        if (digits < EXPONENT_MAX) digits++;
    }
    decimal->mantissa = mantissa;
    decimal->digits = digits;
    return at;
}

static const char *read_exponent(const char *at, const char *end, int64_t *exponent)
{
    const char *digit = at + 1;
    bool negative = digit < end && *digit == '-';
    if (digit < end && (*digit == '-' || *digit == '+')) digit++;
    if (!is_digit(digit, end)) return NULL;
    int64_t value = 0;
    for (; is_digit(digit, end); digit++)
        if (value < EXPONENT_MAX) value = value * 10 + (*digit - '0');
    *exponent += negative ? -value : value;
    return digit;
}

/* Converts by strtod, on a copy without a point, so that the locale does not matter. */
static double convert_exactly(const struct decimal *decimal)
{
    char text[DIGITS_KEPT + 32];
    size_t used = 0;
    int64_t exponent = decimal->exponent;
    bool rest = false;
    for (const char *at = decimal->first; at < decimal->last; at++) {
        if (*at == '.') continue;
        if (used < DIGITS_KEPT) {
            text[used++] = *at;
        } else {
            rest = rest || *at != '0';
            exponent++;
        }
    }
    if (rest) {
        text[used++] = '1';
        exponent--;
    }
    if (exponent > EXPONENT_MAX) exponent = EXPONENT_MAX;
    if (exponent < -EXPONENT_MAX) exponent = -EXPONENT_MAX;
    snprintf(text + used, sizeof text - used, "e%d", (int)exponent);
    return strtod(text, NULL);
}

static double convert(const struct decimal *decimal)
{
    if (decimal->digits == 0) return 0.0;
    double value;
    if (decimal->digits <= FAST_DIGITS && decimal->exponent >= -EXPONENT_MAX && decimal->exponent <= EXPONENT_MAX &&
        zr_number_round(decimal->mantissa, (int)decimal->exponent, &value))
        return value;
    return convert_exactly(decimal);
}

const char *zr_number_read(const char *at, const char *end, double *value)
{
    struct decimal decimal = {.negative = at < end && *at == '-'};
    if (at < end && (*at == '-' || *at == '+')) at++;
    const char *whole = at;
    at = read_digits(at, end, &decimal);
    size_t written = (size_t)(at - whole);
    decimal.last = at;
    if (at < end && *at == '.') {
        const char *fraction = at + 1;
        at = read_digits(fraction, end, &decimal);
        written += (size_t)(at - fraction);
        decimal.exponent = -(int64_t)(at - fraction);
        decimal.last = at;
    }
    if (written == 0) return NULL;
    if (at < end && (*at == 'e' || *at == 'E')) {
        at = read_exponent(at, end, &decimal.exponent);
        if (!at) return NULL;
    }
    double magnitude = convert(&decimal);
    *value = decimal.negative ? -magnitude : magnitude;
    return at;
}

const char *zr_number_read_json(const char *at, const char *end, double *value)
{
    const char *behind = zr_number_read(at, end, value), *digit = at;
    if (!behind) return NULL;
    if (*digit == '-') digit++;
    if (!is_digit(digit, behind) || (*digit == '0' && is_digit(digit + 1, behind))) return NULL;
    const char *point = memchr(digit, '.', (size_t)(behind - digit));
    return point && !is_digit(point + 1, behind) ? NULL : behind;
}
