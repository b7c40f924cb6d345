#include "base/simd/simd.h"
#include "scene/camera/camera_parts.h"

/* Returns the next first point of a vector. The last vector ends at the last point: its overlap with the one before
 * does not change a maximum. */
static inline uint32_t next_of(uint32_t i, uint32_t count)
{
    return i + 2 * ZR_LANES <= count || i + ZR_LANES == count ? i + ZR_LANES : count - ZR_LANES;
}

static inline zr_vm is_finite(zr_vf v)
{
    return zr_vf_eq(v - v, zr_vf_set(0.0f));
}

struct lanes {
    zr_vf x, y, z;
};

/* Loads ZR_LANES points, and clears the lanes of `plain` whose points are not finite or have w other than 1. */
static inline struct lanes load_lanes(const zr_vec4 *points, zr_vm *plain)
{
    struct lanes p;
    zr_vf w;
    zr_vf_load_fours(&points->x, &p.x, &p.y, &p.z, &w);
    *plain = zr_vm_and(*plain, zr_vf_eq(w, zr_vf_set(1.0f)));
    *plain = zr_vm_and(*plain, zr_vm_and(zr_vm_and(is_finite(p.x), is_finite(p.y)), is_finite(p.z)));
    return p;
}

/* ---- extents ---- */

static double most_of(zr_vf v, bool negated)
{
    float lanes[ZR_LANES];
    double most = -HUGE_VAL;
    zr_vf_store(lanes, v);
    for (int i = 0; i < ZR_LANES; i++)
        zr_raise(&most, negated ? -(double)lanes[i] : (double)lanes[i]);
    return most;
}

/* Compares floats: their maximum, widened, is the maximum of the widened values. */
bool ZR_KERNEL(zr_fit_extent)(const zr_vec4 *points, uint32_t count, double most[ZR_MEASURES])
{
    if (count < ZR_LANES) return false;
    zr_vm plain = ZR_ALL_LANES;
    struct lanes low = load_lanes(points, &plain), high = low;
    for (uint32_t i = 0; i < count; i = next_of(i, count)) {
        const struct lanes p = load_lanes(points + i, &plain);
        low = (struct lanes){zr_vf_min(p.x, low.x), zr_vf_min(p.y, low.y), zr_vf_min(p.z, low.z)};
        high = (struct lanes){zr_vf_max(p.x, high.x), zr_vf_max(p.y, high.y), zr_vf_max(p.z, high.z)};
    }
    if (zr_vm_bits(plain) != ZR_ALL_BITS) return false;
    const zr_vf ends[ZR_MEASURES] = {high.x, high.y, high.z, low.x, low.y, low.z};
    for (int k = 0; k < ZR_MEASURES; k++)
        zr_raise(&most[k], most_of(ends[k], k >= 3));
    return true;
}

/* ---- slopes ---- */

enum { SLOPES = ZR_SLOPE_NEAR + 1 };

struct doubles {
    zr_vd x, y, z;
};

static inline struct doubles spread(zr_dvec3 v)
{
    return (struct doubles){zr_vd_set(v.x), zr_vd_set(v.y), zr_vd_set(v.z)};
}

/* zr_dvec3_dot of lanes, in the same order. */
static inline zr_vd dot(struct doubles a, zr_dvec3 axis)
{
    const struct doubles b = spread(axis);
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

static inline void raise_slopes(const struct zr_axes *axes, const struct zr_opening *opening, struct doubles p,
                                zr_vd most[SLOPES])
{
    const struct doubles eye = spread(axes->eye), q = {p.x - eye.x, p.y - eye.y, p.z - eye.z};
    const zr_vd y = dot(q, axes->up), z = dot(q, axes->back);
    const zr_vd x = dot(q, axes->right) - zr_vd_set(opening->shear) * y, zero = zr_vd_set(0.0);
    const zr_vd values[SLOPES] = {
        [ZR_SLOPE_RIGHT] = x + zr_vd_set(opening->right) * z,
        [ZR_SLOPE_LEFT] = zero - (x + zr_vd_set(opening->left) * z),
        [ZR_SLOPE_TOP] = y + zr_vd_set(opening->top) * z,
        [ZR_SLOPE_BOTTOM] = zero - (y + zr_vd_set(opening->bottom) * z),
        [ZR_SLOPE_NEAR] = z,
    };
    for (int k = 0; k < SLOPES; k++)
        most[k] = zr_vd_max(values[k], most[k]);
}

bool ZR_KERNEL(zr_fit_slopes)(const struct zr_axes *axes, const struct zr_opening *opening, const zr_vec4 *points,
                              uint32_t count, double most[ZR_MEASURES])
{
    if (count < ZR_LANES) return false;
    zr_vm plain = ZR_ALL_LANES;
    zr_vd found[SLOPES];
    for (int k = 0; k < SLOPES; k++)
        found[k] = zr_vd_set(-HUGE_VAL);
    for (uint32_t i = 0; i < count; i = next_of(i, count)) {
        const struct lanes p = load_lanes(points + i, &plain);
        float x[ZR_LANES], y[ZR_LANES], z[ZR_LANES];
        zr_vf_store(x, p.x);
        zr_vf_store(y, p.y);
        zr_vf_store(z, p.z);
        for (int k = 0; k < ZR_LANES; k += ZR_DOUBLES)
            raise_slopes(axes, opening, (struct doubles){zr_vd_widen(x + k), zr_vd_widen(y + k), zr_vd_widen(z + k)},
                         found);
    }
    if (zr_vm_bits(plain) != ZR_ALL_BITS) return false;
    for (int k = 0; k < SLOPES; k++) {
        double lanes[ZR_DOUBLES];
        zr_vd_store(lanes, found[k]);
        for (int i = 0; i < ZR_DOUBLES; i++)
            zr_raise(&most[k], lanes[i]);
    }
    return true;
}
