#include "overlay/annotate/length_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "overlay/ticks.h"

enum { DIGITS = 4, DECIMALS = 3, PLAIN_MAX = 9, EXPONENT_MAX = 45 };

/* Returns the exponent of the first digit: 0 for 1 to 9.99; 0 for 0. */
static int exponent_of(double value)
{
    int exponent = 0;
    for (; value >= 10.0 && exponent < EXPONENT_MAX; exponent++)
        value /= 10.0;
    for (; value > 0.0 && value < 1.0 && exponent > -EXPONENT_MAX; exponent--)
        value *= 10.0;
    return exponent;
}

static double power_of_ten(int exponent)
{
    double power = 1.0;
    for (int i = 0; i < (exponent < 0 ? -exponent : exponent); i++)
        power *= 10.0;
    return power;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

void zr_length_write(double length, double largest, const char *unit, char out[ZR_LENGTH_SIZE])
{
    const int first = exponent_of(length), most = larger(DECIMALS, DIGITS - 1 - exponent_of(largest));
    int decimals = DIGITS - 1 - first;
    char number[ZR_DECIMAL_SIZE];
    if (decimals > most) decimals = most;
    if (decimals < 0 && first <= PLAIN_MAX) decimals = 0;
    const double scale = power_of_ten(decimals), scaled = decimals < 0 ? length / scale : length * scale;
    const bool is_scientific = first > PLAIN_MAX || first < -PLAIN_MAX;
    const struct zr_decimal rounded = {(int64_t)floor(scaled + 0.5), -decimals};
    zr_decimal_write(zr_decimal_trim(rounded), is_scientific, number);
    snprintf(out, ZR_LENGTH_SIZE, "%s%s%s", number, *unit ? " " : "", unit);
}

static const struct {
    const char *name, *sign;
    double millimetres;
} units[] = {{"millimetre", "mm", 1.0},        {"centimetre", "cm", 10.0}, {"metre", "m", 1000.0},
             {"micron", "\xc2\xb5m", 1e-3}, {"inch", "in", 25.4},       {"foot", "ft", 304.8}};
enum { UNITS = sizeof units / sizeof *units };

/* Returns the number of a unit, or UNITS. */
static size_t unit_of(const char *name)
{
    size_t i = 0;
    while (i < UNITS && !(name && strcmp(name, units[i].name) == 0))
        i++;
    return i;
}

const char *zr_unit_sign(const char *unit)
{
    const size_t i = unit_of(unit);
    return i < UNITS ? units[i].sign : "";
}

double zr_unit_millimetres(const char *unit)
{
    const size_t i = unit_of(unit);
    return i < UNITS ? units[i].millimetres : 0.0;
}

double zr_length_round(double most, int *digit)
{
    const int exponent = exponent_of(most);
    const double power = power_of_ten(exponent), one = exponent < 0 ? 1.0 / power : power;
    *digit = most >= 5.0 * one ? 5 : most >= 2.0 * one ? 2 : 1;
    return (double)*digit * one;
}
