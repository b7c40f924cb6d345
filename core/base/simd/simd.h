/* simd.h - base: vectors of floats and integers, for kernels (*_kernel.c), which the Makefile compiles once for each
 * instruction set.
 *
 * Types:   zr_vf and zr_vi hold ZR_LANES floats or int32_t, zr_vd ZR_DOUBLES doubles (half as many, or one), zr_vp two
 *          int16_t per lane. zr_vm is a mask: true or false per lane. + - * / & | ^ << >> combine two vectors lane by
 *          lane; the count of a shift is an int.
 * Exact:   every operation is IEEE's, lane by lane, so that each instruction set gives the same bytes: no approximate
 *          reciprocal, no fused multiply-add.
 * Source:  base/simd/vec.h, then narrow.h (plain C, SSE2, NEON), avx2.h or avx512.h, then the end of this file.
 *          tests/support/simd_check.c compares each operation with plain C.
 *
 * Constants and memory; a pointer needs no alignment unless it says so:
 *   zr_vf_set(a), zr_vi_set(a)         every lane is a
 *   zr_vf_ramp(), zr_vi_ramp()         0, 1, 2 ...
 *   zr_vf_load(p), zr_vi_load(p)       ZR_LANES values from p on
 *   zr_vf_store(p, v), zr_vi_store(p, v)
 *   zr_vi_store_first(p, v, n)         lanes 0 .. n - 1 only, n <= ZR_LANES; no byte after them is written
 *   zr_vi_store_where(p, m, v)         lanes of m only; the others may be rewritten with their old value
 *   zr_vi_stream(p, v)                 non-temporal store, where there is one; p is a multiple of the vector's size;
 *                                      base/team.h says when other threads see it
 *   zr_vi_put(p, v, streamed)          zr_vi_stream if streamed, else zr_vi_store
 *   zr_vi_load_patch(p, stride)        ZR_PATCH_ROWS rows, `stride` words apart, of ZR_PATCH_COLUMNS words each; the
 *                                      first row in the first lanes
 *   zr_vi_rows_of_patches(v)           in place: ZR_PATCH_ROWS patches, side by side, become as many rows
 *
 * Comparisons and masks:
 *   zr_vf_lt le eq(a, b), zr_vi_lt eq(a, b)
 *   zr_vf_lt_where eq_where(m, a, b), zr_vi_lt_where(m, a, b)   m and the comparison: one instruction of AVX-512
 *   zr_vm_and or andnot(a, b)          andnot: a and not b
 *   zr_vm_bits(m), zr_vm_of(bits)      bit i is lane i
 *   zr_vm_first(n)                     lanes 0 .. n - 1; every lane if n > ZR_LANES
 *   zr_vm_any(m), zr_lowest_bit(bits)  bits is not 0
 *   zr_vf_select(m, a, b), zr_vi_select(m, a, b)    a in lanes of m, b in the others
 *
 * Arithmetic:
 *   zr_vf_min(a, b): a < b ? a : b     zr_vf_max(a, b): a > b ? a : b     zr_vi_min, zr_vi_max
 *   zr_vf_abs(a), zr_vf_sqrt(a)
 *   zr_vf_of(vi)                       int32_t to float
 *   zr_vi_round(vf)                    to the nearest, ties to even; |v| < 2^22
 *   zr_vi_bits_of(vf), zr_vf_bits(vi)  the same bits as the other type
 *
 * Lanes that move:
 *   zr_vf_pick(v, i)                   lane k is lane i[k] of v; 0 <= i[k] < ZR_LANES
 *   zr_vi_later(v, n)                  lane k is lane k - n of v; undefined for k < n; n is a constant, 1 .. 4
 *   zr_vi_compress(p, m, v)            stores the lanes of m, packed, and returns their count; may write ZR_LANES words
 *   zr_vi_list_bits(p, bits, first)    stores first + i for each bit i, as zr_vi_compress; bits < 2^ZR_LANES
 *   zr_transpose4(a, b, c, d, &x, &y, &z, &w)       4 x 4 floats within each 16 bytes
 *
 * Gathers, and structures of four floats x, y, z, w:
 *   zr_vi_gather(m, p, i)              the 4 bytes at p + 4 i[k]; lanes outside m are undefined, and read nothing
 *   ZR_LOAD4(x, y, z, w, AT)           lane k from the four floats at AT(k), a const float *
 *   zr_vf_store4(p, x, y, z, w), zr_vi_store4       ZR_LANES fours to p, one after the other
 *   zr_vf_load_fours(p, &x, &y, &z, &w), zr_vf_store_fours(p, x, y, z, w), zr_vf_stream_fours
 *                                      ZR_LANES fours at p, in an order of lanes that only these three share, by one
 *                                      transposition
 *   zr_vf_gather_fours(p, i, &x, &y, &z)            x, y, z of the four at p + 4 i[k]; 0 <= i[k] < 2^29; w may be read
 *
 * Pairs of int16_t: x in the lower half of the lane, y in the upper; + - & << >> work half by half:
 *   zr_vp_pack(low, high)              from int32_t x, y, x, y ... in an order of their own; saturates
 *   zr_load_corners(vertices, corners, low, high)   floats in that order: x and y at vertices + 4 corners[3 i + k] for
 *                                      lane i, in low[k] and high[k]
 *   zr_vp_min(a, b), zr_vp_max(a, b)
 *   zr_vp_cross(a, b)                  a.x b.y - a.y b.x as int32_t; undefined if a half is -32768
 *
 * Doubles:
 *   zr_vd_set(a), zr_vd_store(p, v), zr_vd_min(a, b), zr_vd_max(a, b), zr_vd_sqrt(a)       as those of floats
 *   zr_vd_select_zero(v, a, b)         a in lanes where v is 0, b in the others
 *   zr_vd_widen(p), zr_vd_narrow(p, v) ZR_DOUBLES floats from p on, to p on
 *   zr_vd_gather(p, i)                 p[i[k]]; i points to ZR_DOUBLES int32_t
 */
#ifndef ZR_SIMD_H
#define ZR_SIMD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined ZR_KERNEL_SCALAR
#define ZR_SUFFIX scalar
#define ZR_LANES  1
#elif defined ZR_KERNEL_SSE2
#define ZR_SUFFIX sse2
#define ZR_LANES  4
#elif defined ZR_KERNEL_NEON
#define ZR_SUFFIX neon
#define ZR_LANES  4
#elif defined ZR_KERNEL_WASM
#define ZR_SUFFIX wasm
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
#else
#include "base/simd/narrow.h"
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
static inline zr_vm zr_vm_of(uint32_t bits)
{
    const zr_vi own = {ZR_EACH_LANE(ZR_BIT)};
    return zr_vi_eq(zr_vi_set((int32_t)bits) & own, own);
}

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
/* The name of a kernel for the instruction set that is compiled for: name_avx2 and so on. */
#define ZR_KERNEL(name) ZR_JOIN(name, ZR_SUFFIX)

#define ZR_ALL_BITS  ((1u << (ZR_LANES - 1) << 1) - 1u)
#define ZR_ALL_LANES zr_vm_of(ZR_ALL_BITS)

static inline int zr_lowest_bit(uint32_t bits)
{
    return __builtin_ctz(bits);
}

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

#if ZR_LANES <= 4 /* zr_vf_store_fours keeps the order of lanes */
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
