#include "mesh/features/angles.h"

#include <math.h>

/* Returns the arctangent in degrees, for 0 <= t <= 1: of twice halved angles, by the series to t^19. */
static double arctangent(double t)
{
    for (int i = 0; i < 2; i++)
        t = t / (1.0 + sqrt(1.0 + t * t));
    const double square = t * t;
    double sum = 0.0;
    for (int n = 19; n >= 1; n -= 2)
        sum = sum * square + (n % 4 == 1 ? 1.0 : -1.0) / n;
    return 4.0 * t * sum * 57.295779513082320877;
}

double zr_angle_of(double x, double y)
{
    const double a = fabs(x), b = fabs(y);
    if (a == 0.0 && b == 0.0) return 0.0;
    double angle = b <= a ? arctangent(b / a) : 90.0 - arctangent(a / b);
    if (x < 0.0) angle = 180.0 - angle;
    if (y < 0.0) angle = 360.0 - angle;
    return angle < 360.0 ? angle : 0.0;
}

static int step_of(double angle)
{
    const int step = (int)(angle * (ZR_ANGLE_STEPS / 360.0) + 0.5);
    return step < ZR_ANGLE_STEPS ? step : 0;
}

static bool has(const struct zr_angle_set *set, int step)
{
    return set->words[step / 64] >> step % 64 & 1u;
}

void zr_angle_set_add(struct zr_angle_set *set, double from, double to)
{
    const int end = step_of(to);
    for (int step = step_of(from); step != end; step = (step + 1) % ZR_ANGLE_STEPS)
        set->words[step / 64] |= (uint64_t)1 << step % 64;
}

double zr_angle_set_degrees(const struct zr_angle_set *set)
{
    int count = 0;
    for (int word = 0; word < ZR_ANGLE_WORDS; word++)
        count += __builtin_popcountll(set->words[word]);
    return count * (360.0 / ZR_ANGLE_STEPS);
}

uint32_t zr_angle_set_arcs(const struct zr_angle_set *set)
{
    int begins = 0;
    uint64_t before = has(set, ZR_ANGLE_STEPS - 1);
    for (int word = 0; word < ZR_ANGLE_WORDS; word++) {
        begins += __builtin_popcountll(set->words[word] & ~(set->words[word] << 1 | before));
        before = set->words[word] >> 63;
    }
    return begins > 0 || !has(set, 0) ? (uint32_t)begins : 1;
}
