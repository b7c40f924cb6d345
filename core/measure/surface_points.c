#include "measure/surface_points.h"

enum { TRIANGLES_PER_CANCEL_CHECK = 1 << 10 };

/* Fractions of the R2 sequence: powers of the root of x^3 = x + 1. */
static const double fractions[2] = {0.75487766624669276, 0.56984029099805327};

static double fraction_of(uint64_t number, int axis)
{
    const double value = 0.5 + (double)number * fractions[axis];
    return value - (double)(uint64_t)value;
}

/* Returns a place in a triangle for two fractions. */
static struct zr_world_place place_in(const struct zr_world_place p[3], double u, double v)
{
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const struct zr_world_place a = zr_world_place_minus(p[1], p[0]), b = zr_world_place_minus(p[2], p[0]);
    return (struct zr_world_place){p[0].x + (a.x * u + b.x * v), p[0].y + (a.y * u + b.y * v),
                                   p[0].z + (a.z * u + b.z * v)};
}

uint32_t zr_surface_points_place(const struct zr_solid *solid, const struct zr_cancel *cancel, uint32_t wanted,
                                 struct zr_surface_point *out)
{
    const double share = solid->area / (double)wanted;
    double area = 0.0;
    uint32_t count = 0;
    for (uint32_t t = 0; t < solid->count && count < wanted; t++) {
        struct zr_world_place p[3];
        if (t % TRIANGLES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) break;
        zr_solid_places(solid, t, p);
        const struct zr_world_place n =
            zr_world_place_cross(zr_world_place_minus(p[1], p[0]), zr_world_place_minus(p[2], p[0]));
        area += 0.5 * sqrt(zr_world_place_dot(n, n));
        for (; count < wanted && ((double)count + 0.5) * share < area; count++)
            out[count] = (struct zr_surface_point){place_in(p, fraction_of(count, 0), fraction_of(count, 1)), t};
    }
    return count;
}
