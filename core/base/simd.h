/* simd.h - base: vectors of floats and integers, for kernels (*_kernel.c), which are compiled once for
 * each instruction set.
 *
 * Types:   zr_vf, zr_vi hold ZR_LANES floats or int32_t, zr_vm one truth a lane. + - * / & | ^ << >>
 *          work on them as on numbers, both operands being vectors (a shift's count is an int).
 * Exact:   every operation here is IEEE's, lane by lane, so that each instruction set gives the
 *          same bytes: no approximate reciprocal, no fused multiply-add.
 * Each instruction set has a header in base/simd/, which defines all of:
 *
 *   zr_vf_set(a) zr_vi_set(a)          all lanes alike           zr_vf_ramp() zr_vi_ramp()   0, 1, 2 ...
 *   zr_vf_load(p) zr_vi_load(p)        ZR_LANES from anywhere    zr_vf_store(p, v) zr_vi_store(p, v)
 *   zr_vi_store_first(p, v, n): lanes 0 .. n - 1, n at most ZR_LANES, and nothing else is touched
 *   zr_vi_store_where(p, m, v): the lanes of m; others may be written as they were
 *   zr_vi_load_patch(p, stride): ZR_PATCH_ROWS rows of ZR_PATCH_COLUMNS words each, `stride` words apart, lane 0 and
 *     those that follow being the first row
 *   zr_vi_rows_of_patches(v): ZR_PATCH_ROWS patches side by side become as many rows of ZR_LANES words
 *   zr_vi_later(v, n): lane i is lane i - n of v, or anything where there is none; n is a constant, 1 .. 4
 *   zr_vi_stream(p, v): a non-temporal store where the machine has one, p being a multiple of the vector's size; others
 * see it as team.h says zr_vi_put(p, v, streamed): zr_vi_stream, or zr_vi_store zr_vf_lt le eq(a, b), zr_vi_lt eq(a,
 * b), zr_vm_and or andnot(a, b: a and not b), zr_vm_bits(m), zr_vm_of(bits) zr_vm_first(n): the first n lanes, or all
 * where there are no more; zr_vm_any(m); zr_lowest_bit(bits), bits not 0 zr_vf_lt_where eq_where(m, a, b),
 * zr_vi_lt_where(m, a, b): m and the comparison, which AVX-512 does in one zr_vf_select(m, a, b), zr_vi_select: a where
 * m, else b zr_vf_min(a, b): a < b ? a : b     zr_vf_max(a, b): a > b ? a : b     zr_vi_min, zr_vi_max zr_vf_abs(a)
 * zr_vf_sqrt(a) zr_vf_of(vi): int to float         zr_vi_round(vf): to the nearest, ties to even, where |v| < 2^22
 *   zr_vi_bits_of(vf), zr_vf_bits(vi)  the same bits as integers, as floats
 *   ZR_LOAD4(x, y, z, w, AT): lane i of x, y, z, w are the four floats at AT(i), a const float *
 *   zr_vf_store4(p, x, y, z, w), zr_vi_store4: the other way round, all to one place
 *   zr_vf_load_fours(p, &x, &y, &z, &w), zr_vf_store_fours(p, x, y, z, w): ZR_LANES fours from p on, to p on, in an
 *     order of lanes of their own, which is one transposition; zr_vf_stream_fours: as zr_vi_stream
 *   zr_transpose4(a, b, c, d, &x, &y, &z, &w): 4 by 4 floats, in each 16 bytes by themselves
 *   zr_vf_pick(v, i): lane k is lane i[k] of v, i being 0 .. ZR_LANES - 1
 *   zr_vi_gather(m, p, i): p[i] of four bytes, lane by lane; anything in lanes that are not m's
 *   zr_vf_gather_fours(p, i, &x, &y, &z): p[4 i], p[4 i + 1] and p[4 i + 2], all lanes, where i < 2^29; p[4 i + 3] may
 *     be read
 *   zr_vi_compress(p, m, v): the lanes of m, one after the other, and their count; ZR_LANES words may be written
 *   zr_vi_list_bits(p, bits, first): first + i of each bit i, likewise; bits from ZR_LANES on are 0
 *
 * zr_vp holds two int16_t a lane, x in the lower half of its word and y in the upper; + - & << >> work half by half:
 *   zr_vp_pack(low, high): of int32_t x, y, x, y ..., half of the lanes in either vector; the nearest that fits
 *   zr_load_corners(vertices, corners, low, high): the same of floats; of lane i those at vertices + 4 corners[3 i + k]
 *   ZR_LOAD_PAIRS(AT, i), from which that follows, where it is defined: pairs of floats at AT(i), AT(i + 1), and in
 *     wider vectors at AT(i + 4), AT(i + 5) and so on, AT being a const float *
 *   zr_vp_min(a, b), zr_vp_max
 *   zr_vp_cross(a, b): a.x b.y - a.y b.x; some number where a half is -32768
 *
 * zr_vd holds ZR_DOUBLES doubles, half as many or one, and + - * / work on them, too:
 *   zr_vd_set(a)  zr_vd_store(p, v)    as of floats              zr_vd_min, zr_vd_max
 *   zr_vd_widen(p)  zr_vd_narrow(p, v) from floats, to floats    zr_vd_gather(p, i): p[i[k]], all lanes, of int32_t i[]
 */
#ifndef ZR_SIMD_H
#define ZR_SIMD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Macros, not constants: vec.h asks for them by #if. */
#if defined ZR_KERNEL_SCALAR
#define ZR_SUFFIX scalar
#define ZR_LANES  1
#elif defined ZR_KERNEL_SSE2
#define ZR_SUFFIX sse2
#define ZR_LANES  4
#elif defined ZR_KERNEL_NEON
#define ZR_SUFFIX neon
#define ZR_LANES  4
#elif defined ZR_KERNEL_AVX2
#define ZR_SUFFIX avx2
#define ZR_LANES  8
#elif defined ZR_KERNEL_AVX512
#define ZR_SUFFIX    avx512
#define ZR_LANES     16
#define ZR_HAS_MASKS /* registers of their own */
#else
#error "kernels are compiled once for each instruction set, with one of ZR_KERNEL_*"
#endif

#include "base/simd/vec.h"
#if defined ZR_KERNEL_AVX2
#include "base/simd/avx2.h"
#elif defined ZR_KERNEL_AVX512
#include "base/simd/avx512.h"
#endif

#ifndef ZR_PATCH_ROWS
#define ZR_PATCH_ROWS 1
static inline zr_vi zr_vi_load_patch(const uint32_t *p, size_t stride)
{
    (void)stride;
    return zr_vi_load(p);
}

static inline void zr_vi_rows_of_patches(zr_vi v[ZR_PATCH_ROWS])
{
    (void)v;
}
#endif

#ifndef ZR_HAS_MASKS
static inline void zr_vi_store_where(void *p, zr_vm m, zr_vi v)
{
    zr_vi_store(p, zr_vi_select(m, v, zr_vi_load(p)));
}
#endif

#ifdef ZR_LOAD_PAIRS
static inline void zr_load_corners(const float *vertices, const uint32_t *corners, zr_vf low[3], zr_vf high[3])
{
#define ZR_CORNER(i) (vertices + 4 * (size_t)corners[3 * (i) + k])
    for (int k = 0; k < 3; k++) {
        low[k] = (zr_vf)ZR_LOAD_PAIRS(ZR_CORNER, 0);
        high[k] = (zr_vf)ZR_LOAD_PAIRS(ZR_CORNER, 2);
    }
#undef ZR_CORNER
}
#endif

#ifndef ZR_HAS_LIST_BITS
static inline uint32_t zr_vi_list_bits(void *p, uint32_t bits, int32_t first)
{
    return zr_vi_compress(p, zr_vm_of(bits), zr_vi_set(first) + zr_vi_ramp());
}
#endif

#ifndef ZR_HAS_GATHER_FOURS
static inline void zr_vf_gather_fours(const float *p, zr_vi i, zr_vf *x, zr_vf *y, zr_vf *z)
{
    int32_t places[ZR_LANES];
    zr_vf w;
    zr_vi_store(places, i);
#define ZR_PLACE(k) (p + 4 * (size_t)places[k])
    ZR_LOAD4(*x, *y, *z, w, ZR_PLACE);
#undef ZR_PLACE
    (void)w;
}
#endif

enum { ZR_PATCH_COLUMNS = ZR_LANES / ZR_PATCH_ROWS };

#define ZR_JOIN_(name, suffix) name##_##suffix
#define ZR_JOIN(name, suffix)  ZR_JOIN_(name, suffix)
/* The name of a kernel, for the instruction set that is compiled for. */
#define ZR_KERNEL(name) ZR_JOIN(name, ZR_SUFFIX)

#define ZR_ALL_BITS  ((1u << (ZR_LANES - 1) << 1) - 1u)
#define ZR_ALL_LANES zr_vm_of(ZR_ALL_BITS)

static inline int zr_lowest_bit(uint32_t bits)
{
    return __builtin_ctz(bits);
}

/* The first `count` lanes, or all where there are no more than that. */
static inline zr_vm zr_vm_first(uint32_t count)
{
    return zr_vm_of(count < ZR_LANES ? (1u << count) - 1u : ZR_ALL_BITS);
}

static inline void zr_vi_put(void *p, zr_vi v, bool streamed)
{
    if (streamed)
        zr_vi_stream(p, v);
    else
        zr_vi_store(p, v);
}

static inline void zr_vf_load_fours(const float *p, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    zr_transpose4(zr_vf_load(p), zr_vf_load(p + ZR_LANES), zr_vf_load(p + 2 * ZR_LANES), zr_vf_load(p + 3 * ZR_LANES),
                  x, y, z, w);
}

static inline void zr_vf_store_fours(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    zr_vf v[4];
    zr_transpose4(x, y, z, w, &v[0], &v[1], &v[2], &v[3]);
    for (int i = 0; i < 4; i++)
        zr_vf_store(p + i * ZR_LANES, v[i]);
}

#if ZR_LANES <= 4 /* whose order of lanes is the order of fours */
static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    zr_vf_store_fours(p, x, y, z, w);
}
#endif

static inline void zr_vi_store4(void *p, zr_vi x, zr_vi y, zr_vi z, zr_vi w)
{
    zr_vf_store4(p, zr_vf_bits(x), zr_vf_bits(y), zr_vf_bits(z), zr_vf_bits(w));
}

static inline void zr_vf_stream_fours(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    zr_vf v[4];
    zr_transpose4(x, y, z, w, &v[0], &v[1], &v[2], &v[3]);
    for (int i = 0; i < 4; i++)
        zr_vi_stream(p + i * ZR_LANES, zr_vi_bits_of(v[i]));
}

static inline int zr_vm_any(zr_vm m)
{
    return zr_vm_bits(m) != 0;
}

#endif
