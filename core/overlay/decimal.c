#include "overlay/decimal.h"

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
