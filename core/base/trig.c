#include "base/trig.h"

#include <math.h>

/* Taylor series to x^17 and x^18: the next term is below 1e-18 on [-pi/4, pi/4]. */
static double sin_kernel(double x)
{
    static const double c[] = {-1.0 / 6,
                               1.0 / 120,
                               -1.0 / 5040,
                               1.0 / 362880,
                               -1.0 / 39916800,
                               1.0 / 6227020800.0,
                               -1.0 / 1307674368000.0,
                               1.0 / 355687428096000.0};
    double square = x * x, sum = 0.0;
    for (int i = 7; i >= 0; i--)
        sum = (sum + c[i]) * square;
    return x + x * sum;
}

static double cos_kernel(double x)
{
    static const double c[] = {-1.0 / 2,
                               1.0 / 24,
                               -1.0 / 720,
                               1.0 / 40320,
                               -1.0 / 3628800,
                               1.0 / 479001600.0,
                               -1.0 / 87178291200.0,
                               1.0 / 20922789888000.0,
                               -1.0 / 6402373705728000.0};
    double square = x * x, sum = 0.0;
    for (int i = 8; i >= 0; i--)
        sum = (sum + c[i]) * square;
    return 1.0 + sum;
}

static double tan_kernel(double x)
{
    return sin_kernel(x) / cos_kernel(x);
}

/* Uses the complement beyond pi/4. pi/2 is split in two parts; the subtraction of the first is exact (Sterbenz), so
 * that the result is precise near pi/2, the pole of the tangent. */
double zr_tan(double radians)
{
    if (radians <= 0.78539816339744830962) return tan_kernel(radians);
    return 1.0 / tan_kernel((1.57079632679489655800 - radians) + 6.12323399573676603587e-17);
}

/* Reduces the angle in degrees, which is exact, to 45 at most. The rounding error of the product with pi/180 is added
 * to the sine; the cosine is too flat to be affected. fma is exact by definition and therefore the same everywhere. */
void zr_sine_cosine(double degrees, double *sine, double *cosine)
{
    static const double unit = 0.017453292519943295;
    double turn = fmod(degrees, 360.0), quarters = rint(turn / 90.0), rest = turn - 90.0 * quarters;
    double x = rest * unit, beyond = fma(rest, unit, -x);
    double c = cos_kernel(x), s = sin_kernel(x) + beyond * c;
    double sines[4] = {s, c, 0.0 - s, 0.0 - c};
    int quarter = ((int)quarters + 4) % 4;
    *sine = sines[quarter];
    *cosine = sines[(quarter + 1) % 4];
}
