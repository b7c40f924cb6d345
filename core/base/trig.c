#include "base/trig.h"

#include <math.h>

/* Taylor series to x^17 and x^18: the next term is below 1e-18 on [-pi/4, pi/4]. */
static double sin_kernel(double x)
{
    static const double c[] = {-1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800.0,
                               -1.0 / 1307674368000.0, 1.0 / 355687428096000.0};
    double square = x * x, sum = 0.0;
    for (int i = 7; i >= 0; i--) sum = (sum + c[i]) * square;
    return x + x * sum;
}

static double cos_kernel(double x)
{
    static const double c[] = {-1.0 / 2, 1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600.0,
                               -1.0 / 87178291200.0, 1.0 / 20922789888000.0, -1.0 / 6402373705728000.0};
    double square = x * x, sum = 0.0;
    for (int i = 8; i >= 0; i--) sum = (sum + c[i]) * square;
    return 1.0 + sum;
}

/* The quarter turn nearest to x, and what is left of x. pi/2 in two parts, the
 * first with 33 bits, so that its product with the quarter is exact
 * (Cody & Waite, Software Manual for the Elementary Functions, 1980). */
static double reduce(double x, int *quarter)
{
    double n = floor(x * 0.63661977236758134308 + 0.5);
    *quarter = (int)(n - 4.0 * floor(n * 0.25));
    return (x - n * 1.57079632673412561417e+00) - n * 6.07710050650619224932e-11;
}

double zr_sin(double radians)
{
    int quarter;
    double x = reduce(radians, &quarter);
    double value = quarter & 1 ? cos_kernel(x) : sin_kernel(x);
    return quarter & 2 ? -value : value;
}

double zr_cos(double radians)
{
    int quarter;
    double x = reduce(radians, &quarter);
    double value = quarter & 1 ? sin_kernel(x) : cos_kernel(x);
    return quarter == 1 || quarter == 2 ? -value : value;
}

double zr_tan(double radians)
{
    return zr_sin(radians) / zr_cos(radians);
}
