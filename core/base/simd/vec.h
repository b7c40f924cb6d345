/* vec.h - base: the types of base/simd/simd.h as C's own vectors (vector_size), and the operations that every
 * instruction set writes alike. narrow.h, avx2.h and avx512.h add the others.
 */
#ifndef ZR_SIMD_VEC_H
#define ZR_SIMD_VEC_H

#if defined ZR_KERNEL_NEON
#include <arm_neon.h>
#elif defined ZR_KERNEL_WASM
#include <wasm_simd128.h>
#elif !defined ZR_KERNEL_SCALAR
#include <immintrin.h>
#endif

/* ZR_EACH_LANE(AT) is AT(0), AT(1) and so on. */
#define ZR_4_LANES(AT, i) AT(i), AT((i) + 1), AT((i) + 2), AT((i) + 3)
#define ZR_8_LANES(AT, i) ZR_4_LANES(AT, i), ZR_4_LANES(AT, (i) + 4)
#if ZR_LANES == 1
#define ZR_EACH_LANE(AT) AT(0)
#elif ZR_LANES == 4
#define ZR_EACH_LANE(AT) ZR_4_LANES(AT, 0)
#elif ZR_LANES == 8
#define ZR_EACH_LANE(AT) ZR_8_LANES(AT, 0)
#endif
#define ZR_NUMBER(i) (i)
#define ZR_ALIKE(i)  a
#define ZR_BIT(i)    (1 << (i))

#if ZR_LANES == 1
typedef float zr_vf;
typedef int32_t zr_vi;
typedef uint32_t zr_vm; /* 1 or 0 */
typedef double zr_vd;
typedef float zr_half_vf;
enum { ZR_DOUBLES = 1 };
#define ZR_LANE(v, i)       ((void)(i), (v))
#define ZR_CONVERT(v, type) ((type)(v))
#else
#define ZR_VECTOR __attribute__((vector_size(4 * ZR_LANES)))
typedef float zr_vf ZR_VECTOR;
typedef int32_t zr_vi ZR_VECTOR;
#if defined ZR_HAS_MASKS
typedef __mmask16 zr_vm;
#else
typedef uint32_t zr_vm ZR_VECTOR; /* all bits of a lane, or none */
#endif
typedef double zr_vd ZR_VECTOR;
typedef float zr_half_vf __attribute__((vector_size(2 * ZR_LANES)));
enum { ZR_DOUBLES = ZR_LANES / 2 };
#define ZR_LANE(v, i)       ((v)[i])
#define ZR_CONVERT(v, type) __builtin_convertvector(v, type)
#endif
typedef int16_t zr_vp __attribute__((vector_size(4 * ZR_LANES)));

/* Operations that are one function of the compiler or of libm, which takes `native` operands. */
#define ZR_UNARY(result, name, operand, native, function)                                                              \
    static inline result name(operand a)                                                                               \
    {                                                                                                                  \
        return (result)function((native)a);                                                                            \
    }
#define ZR_BINARY(result, name, operand, native, function)                                                             \
    static inline result name(operand a, operand b)                                                                    \
    {                                                                                                                  \
        return (result)function((native)a, (native)b);                                                                 \
    }

#if !defined ZR_HAS_MASKS
/* name(a, b), and name_where(m, a, b): m and the comparison. */
#define ZR_COMPARISON(name, type, compares)                                                                            \
    static inline zr_vm name(type a, type b)                                                                           \
    {                                                                                                                  \
        return (zr_vm)(a compares b);                                                                                  \
    }                                                                                                                  \
    static inline zr_vm name##_where(zr_vm m, type a, type b)                                                          \
    {                                                                                                                  \
        return m & (zr_vm)(a compares b);                                                                              \
    }
ZR_COMPARISON(zr_vf_lt, zr_vf, <)
ZR_COMPARISON(zr_vf_le, zr_vf, <=)
ZR_COMPARISON(zr_vf_eq, zr_vf, ==)
ZR_COMPARISON(zr_vi_lt, zr_vi, <)
ZR_COMPARISON(zr_vi_eq, zr_vi, ==)

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
    return a & ~b;
}
#endif

#if ZR_LANES > 1
static inline zr_vf zr_vf_bits(zr_vi a)
{
    return (zr_vf)a;
}
static inline zr_vi zr_vi_bits_of(zr_vf a)
{
    return (zr_vi)a;
}
static inline zr_vf zr_vf_abs(zr_vf a)
{
    return (zr_vf)((zr_vi)a & INT32_MAX);
}
#endif

#if ZR_LANES == 1
static inline zr_vd zr_vd_select_zero(zr_vd v, zr_vd a, zr_vd b)
{
    return v == 0.0 ? a : b;
}
#else
static inline zr_vd zr_vd_select_zero(zr_vd v, zr_vd a, zr_vd b)
{
    typedef int64_t bits ZR_VECTOR;
    const bits zero = (bits)(v == (zr_vd){0});
    return (zr_vd)(((bits)a & zero) | ((bits)b & ~zero));
}
#endif

/* Two floats from p and two from q; neither need be aligned as uint64_t is. */
typedef float zr_four_floats __attribute__((vector_size(16)));
static inline zr_four_floats zr_load_pair(const float *p, const float *q)
{
    typedef uint64_t two_pairs __attribute__((vector_size(16)));
    uint64_t low, high;
    memcpy(&low, p, sizeof low);
    memcpy(&high, q, sizeof high);
    return (zr_four_floats)(two_pairs){low, high};
}

#endif
