#include "base/srgb.h"

#include "base/srgb_simd.h"

void ZR_KERNEL(zr_srgb_ramp)(size_t last, float *out)
{
    const zr_vf scale = zr_vf_set(1.0f / (float)last);
    for (size_t i = 0; i <= last; i += ZR_LANES)
        zr_vf_store(out + i, zr_srgb_decode_v(zr_vf_of(zr_vi_set((int32_t)i) + zr_vi_ramp()) * scale));
}
