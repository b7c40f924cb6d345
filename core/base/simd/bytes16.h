/* bytes16.h - base: what the instruction sets of 16-byte vectors share. */
#ifndef ZR_SIMD_BYTES16_H
#define ZR_SIMD_BYTES16_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { ZR_LANES = 4 };

typedef float zr_vf __attribute__((vector_size(16)));
typedef int32_t zr_vi __attribute__((vector_size(16)));
typedef int16_t zr_vp __attribute__((vector_size(16)));
typedef uint32_t zr_vm __attribute__((vector_size(16))); /* all bits of a lane, or none */

static inline zr_vf zr_vf_set(float a)
{
    return (zr_vf){a, a, a, a};
}
static inline zr_vi zr_vi_set(int32_t a)
{
    return (zr_vi){a, a, a, a};
}
static inline zr_vi zr_vi_ramp(void)
{
    return (zr_vi){0, 1, 2, 3};
}
static inline zr_vf zr_vf_ramp(void)
{
    return (zr_vf){0, 1, 2, 3};
}

static inline zr_vi zr_vi_later(zr_vi v, int n)
{
    return n == 1   ? (zr_vi){v[0], v[0], v[1], v[2]}
           : n == 2 ? (zr_vi){v[0], v[1], v[0], v[1]}
                    : (zr_vi){v[0], v[1], v[2], v[0]};
}

#include "base/simd/vector_compare.h"

static inline uint32_t zr_vm_bits(zr_vm m);
typedef double zr_vd __attribute__((vector_size(16)));
enum { ZR_DOUBLES = 2 };

static inline zr_vd zr_vd_set(double a)
{
    return (zr_vd){a, a};
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return (zr_vd){p[i[0]], p[i[1]]};
}

static inline zr_vf zr_vf_pick(zr_vf v, zr_vi i)
{
    return (zr_vf){v[i[0]], v[i[1]], v[i[2]], v[i[3]]};
}

static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    int32_t lanes[ZR_LANES] = {0};
    for (uint32_t bits = zr_vm_bits(m), k = 0; k < ZR_LANES; k++)
        if (bits >> k & 1u) memcpy(&lanes[k], (const char *)p + 4 * (ptrdiff_t)i[k], sizeof lanes[k]);
    return (zr_vi){lanes[0], lanes[1], lanes[2], lanes[3]};
}

#endif
