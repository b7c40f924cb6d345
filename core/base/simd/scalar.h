/* scalar.h - base: base/simd.h in plain C, one lane. */
#ifndef ZR_SIMD_SCALAR_H
#define ZR_SIMD_SCALAR_H

#include <math.h>
#include <stddef.h>

#define ZR_SUFFIX scalar
enum { ZR_LANES = 1 };

typedef float zr_vf;
typedef int32_t zr_vi;
typedef int16_t zr_vp __attribute__((vector_size(4)));
typedef uint32_t zr_vm;

static inline zr_vf zr_vf_set(float a)
{
    return a;
}
static inline zr_vi zr_vi_set(int32_t a)
{
    return a;
}
static inline zr_vi zr_vi_ramp(void)
{
    return 0;
}
static inline zr_vf zr_vf_ramp(void)
{
    return 0.0f;
}
static inline zr_vf zr_vf_load(const float *p)
{
    return *p;
}
static inline zr_vi zr_vi_load(const void *p)
{
    zr_vi v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    *p = v;
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    memcpy(p, &v, sizeof v);
}
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    if (n > 0) memcpy(p, &v, sizeof v);
}
static inline zr_vi zr_vi_later(zr_vi v, int n)
{
    (void)n;
    return v;
}
static inline void zr_vi_store_where(void *p, zr_vm m, zr_vi v)
{
    if (m) zr_vi_store(p, v);
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    zr_vi_store(p, v);
}
static inline zr_vm zr_vf_lt(zr_vf a, zr_vf b)
{
    return a < b;
}
static inline zr_vm zr_vf_le(zr_vf a, zr_vf b)
{
    return a <= b;
}
static inline zr_vm zr_vf_eq(zr_vf a, zr_vf b)
{
    return a == b;
}
static inline zr_vm zr_vi_lt(zr_vi a, zr_vi b)
{
    return a < b;
}
static inline zr_vm zr_vi_eq(zr_vi a, zr_vi b)
{
    return a == b;
}
static inline zr_vm zr_vf_lt_where(zr_vm m, zr_vf a, zr_vf b)
{
    return m && a < b;
}
static inline zr_vm zr_vf_eq_where(zr_vm m, zr_vf a, zr_vf b)
{
    return m && a == b;
}
static inline zr_vm zr_vi_lt_where(zr_vm m, zr_vi a, zr_vi b)
{
    return m && a < b;
}
static inline zr_vm zr_vm_and(zr_vm a, zr_vm b)
{
    return a & b;
}
static inline zr_vm zr_vm_or(zr_vm a, zr_vm b)
{
    return a | b;
}
static inline zr_vm zr_vm_andnot(zr_vm a, zr_vm b)
{
    return a & ~b & 1u;
}
static inline uint32_t zr_vm_bits(zr_vm m)
{
    return m;
}
static inline zr_vm zr_vm_of(uint32_t bits)
{
    return bits & 1u;
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return m ? a : b;
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return m ? a : b;
}
static inline zr_vf zr_vf_min(zr_vf a, zr_vf b)
{
    return a < b ? a : b;
}
static inline zr_vf zr_vf_max(zr_vf a, zr_vf b)
{
    return a > b ? a : b;
}
static inline zr_vi zr_vi_min(zr_vi a, zr_vi b)
{
    return a < b ? a : b;
}
static inline zr_vi zr_vi_max(zr_vi a, zr_vi b)
{
    return a > b ? a : b;
}
static inline zr_vf zr_vf_abs(zr_vf a)
{
    return fabsf(a);
}
static inline zr_vf zr_vf_sqrt(zr_vf a)
{
    return sqrtf(a);
}
static inline zr_vf zr_vf_of(zr_vi a)
{
    return (float)a;
}
/* Out of range gives what the vectors of x86 give, though no kernel reads it. */
static inline zr_vi zr_vi_round(zr_vf a)
{
    return fabsf(a) < 0x1p31f ? (int32_t)rintf(a) : INT32_MIN;
}
static inline zr_vf zr_vf_bits(zr_vi a)
{
    zr_vf value;
    memcpy(&value, &a, sizeof value);
    return value;
}
static inline zr_vi zr_vi_bits_of(zr_vf a)
{
    zr_vi bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    do {                                                                                                               \
        const float *const at = AT(0);                                                                                 \
        (x) = at[0], (y) = at[1], (z) = at[2], (w) = at[3];                                                            \
    } while (0)

static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    *x = a0, *y = a1, *z = a2, *w = a3;
}

typedef double zr_vd;
enum { ZR_DOUBLES = 1 };

static inline zr_vd zr_vd_set(double a)
{
    return a;
}
static inline void zr_vd_store(double *p, zr_vd v)
{
    *p = v;
}
static inline zr_vd zr_vd_widen(const float *p)
{
    return (double)*p;
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    *p = (float)v;
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return a < b ? a : b;
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return a > b ? a : b;
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return p[*i];
}

static inline zr_vf zr_vf_pick(zr_vf v, zr_vi i)
{
    (void)i;
    return v;
}
static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    zr_vi v = 0;
    if (m) memcpy(&v, (const char *)p + 4 * (ptrdiff_t)i, sizeof v);
    return v;
}

static inline void zr_load_corners(const float *vertices, const uint32_t *corners, zr_vf low[3], zr_vf high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = vertices[4 * (size_t)corners[k]];
        high[k] = vertices[4 * (size_t)corners[k] + 1];
    }
}

static inline zr_vp zr_vp_pack(zr_vi low, zr_vi high)
{
    const zr_vi least = INT16_MIN, most = INT16_MAX;
    const zr_vi x = zr_vi_max(least, zr_vi_min(low, most)), y = zr_vi_max(least, zr_vi_min(high, most));
    return (zr_vp)(y << 16 | (x & 0xffff));
}
static inline zr_vp zr_vp_min(zr_vp a, zr_vp b)
{
    return (zr_vp){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}
static inline zr_vp zr_vp_max(zr_vp a, zr_vp b)
{
    return (zr_vp){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}

static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    if (m) memcpy(p, &v, sizeof v);
    return m;
}

static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    p[0] = x, p[1] = y, p[2] = z, p[3] = w;
}

#endif
