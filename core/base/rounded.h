/* rounded.h - base: a double, rounded to a float. */
#ifndef ZR_ROUNDED_H
#define ZR_ROUNDED_H

/* gcc 12 drops both conversions of (double)(float)v where it makes a vector of several. It keeps those through memory. */
static inline double zr_rounded(double v)
{
    volatile float rounded = (float)v;
    return (double)rounded;
}

#endif
