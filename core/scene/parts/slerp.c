#include "scene/parts/slerp.h"

#include <math.h>
#include <string.h>

/* Normalises a quaternion. A zero quaternion is kept. */
static void normalize(double q[4])
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4 && length > 0.0; k++)
        q[k] /= length;
}

/* Halves the arc until linear interpolation is exact enough. This avoids sines, whose last bits differ between
 * systems. */
void zr_slerp_exact(const double a[4], const double b[4], double share, double out[4])
{
    enum { HALVINGS = 20 };
    double low[4] = {a[0], a[1], a[2], a[3]}, high[4] = {b[0], b[1], b[2], b[3]}, middle[4], dot = 0;
    normalize(low);
    normalize(high);
    for (int k = 0; k < 4; k++)
        dot += low[k] * high[k];
    for (int k = 0; k < 4 && dot < 0.0; k++)
        high[k] = -high[k];
    for (int i = 0; i < HALVINGS; i++) {
        for (int k = 0; k < 4; k++)
            middle[k] = low[k] + high[k];
        normalize(middle);
        share *= 2;
        memcpy(share < 1.0 ? high : low, middle, sizeof middle);
        if (share >= 1.0) share -= 1;
    }
    for (int k = 0; k < 4; k++)
        middle[k] = low[k] + share * (high[k] - low[k]);
    normalize(middle);
    memcpy(out, middle, sizeof middle);
}

void zr_slerp(const float a[4], const float b[4], double share, float out[4])
{
    const double from[4] = {(double)a[0], (double)a[1], (double)a[2], (double)a[3]},
                 to[4] = {(double)b[0], (double)b[1], (double)b[2], (double)b[3]};
    double q[4];
    zr_slerp_exact(from, to, share, q);
    for (int k = 0; k < 4; k++)
        out[k] = (float)q[k];
}
