#include "support/pictures/look_kernel.h"

#include "base/srgb_color_simd.h"
#include "shade/lights/tone_simd.h"

static struct zr_vec3_v load3(const float *const from[3], size_t at)
{
    return (struct zr_vec3_v){zr_vf_load(from[0] + at), zr_vf_load(from[1] + at), zr_vf_load(from[2] + at)};
}

static void store3(float *const to[3], size_t at, struct zr_vec3_v v)
{
    zr_vf_store(to[0] + at, v.x);
    zr_vf_store(to[1] + at, v.y);
    zr_vf_store(to[2] + at, v.z);
}

static void decode(const float *encoded, size_t count, float *linear)
{
    for (size_t i = 0; i < count; i += ZR_LANES)
        zr_vf_store(linear + i, zr_srgb_decode_v(zr_vf_load(encoded + i)));
}

static void encode(const float *linear, size_t count, float *encoded)
{
    for (size_t i = 0; i < count; i += ZR_LANES)
        zr_vf_store(encoded + i, zr_srgb_encode_v(zr_vf_load(linear + i)));
}

static void tone_map(enum zr_tone tone, const float *const in[3], size_t count, float *const out[3])
{
    for (size_t i = 0; i < count; i += ZR_LANES)
        store3(out, i, zr_tone_v(load3(in, i), tone));
}

const struct look_parts ZR_KERNEL(look_parts) = {decode, encode, tone_map};
