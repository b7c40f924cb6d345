#include "support/straight.h"

#include <math.h>
#include <stdlib.h>

size_t straight_bresenham(int32_t x0, int32_t y0, int32_t x1, int32_t y1, struct straight_pixel *out, size_t room)
{
    int32_t dx = abs(x1 - x0), dy = abs(y1 - y0), step_x = x1 > x0 ? 1 : -1, step_y = y1 > y0 ? 1 : -1;
    bool x_major = dx >= dy;
    int32_t major = x_major ? dx : dy, minor = x_major ? dy : dx;
    int32_t error = 2 * minor - major; /* of the next step, times 2 major: > 0 is nearer to the next minor pixel */
    size_t count = 0;
    bool tie = false;
    for (int32_t i = 0; i <= major && count < room; i++) {
        out[count++] = (struct straight_pixel){x0, y0, tie};
        bool turns = error > 0;
        tie = error == 0;
        if (turns) error -= 2 * major;
        error += 2 * minor;
        if (x_major || turns) x0 += step_x;
        if (!x_major || turns) y0 += step_y;
    }
    return count;
}

size_t straight_dda(double x0, double y0, double x1, double y1, struct straight_pixel *out, size_t room)
{
    bool x_major = fabs(x1 - x0) >= fabs(y1 - y0);
    double m0 = x_major ? x0 : y0, m1 = x_major ? x1 : y1, n0 = x_major ? y0 : x0, n1 = x_major ? y1 : x1;
    if (m0 == m1) return 0;
    double low = m0 < m1 ? m0 : m1, high = m0 < m1 ? m1 : m0;
    size_t count = 0;
    for (int32_t i = (int32_t)ceil(low - 0.5); i + 0.5 <= high && count < room; i++) {
        double n = n0 + (i + 0.5 - m0) / (m1 - m0) * (n1 - n0);
        int32_t j = (int32_t)floor(n);
        out[count++] = (struct straight_pixel){x_major ? i : j, x_major ? j : i, n == j};
    }
    return count;
}
