#include "base/srgb.h"

#include "base/simd/srgb_simd.h"

void ZR_KERNEL(zr_srgb_ramp)(size_t last, float *out)
{
    const zr_vf scale = zr_vf_set(1.0f / (float)last);
    for (size_t i = 0; i <= last; i += ZR_LANES)
        zr_vf_store(out + i, zr_srgb_decode_v(zr_vf_of(zr_vi_set((int32_t)i) + zr_vi_ramp()) * scale));
}

/* 1 is encoded as exactly 1. */
void ZR_KERNEL(zr_srgb_encode)(const float *linear, size_t count, float *encoded)
{
    const zr_vf one = zr_vf_set(1.0f);
    for (size_t i = 0; i < count; i += ZR_LANES) {
        const zr_vf light = zr_vf_load(linear + i);
        zr_vf_store(encoded + i, zr_vf_select(zr_vf_le(one, light), one, zr_srgb_encode_v(light)));
    }
}
