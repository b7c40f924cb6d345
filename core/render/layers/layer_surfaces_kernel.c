#include "render/layers/layer_surfaces.h"

#include "base/simd/simd.h"

enum { SIDE = ZR_SURFACES_SIDE, SAMPLES = SIDE * SIDE, COLUMNS = ZR_SURFACES_COLUMNS };

void ZR_KERNEL(zr_layer_surfaces_list)(const struct zr_layer_surface *at, uint32_t count, const struct zr_tile *tile,
                                       struct zr_sample_list *list)
{
    list->count = count;
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_surface_middle middle = zr_surface_middle_of(at[i].mask);
        list->x[i] = (float)(tile->x + at[i].pixel % COLUMNS * SIDE) + middle.x;
        list->y[i] = (float)(tile->y + at[i].pixel / COLUMNS * SIDE) + middle.y;
        list->owner[i] = at[i].owner;
    }
}

/* Lays the surfaces of a pixel over samples first .. first + ZR_LANES - 1 of it, from the farthest on. */
static inline void blend_lanes(const struct zr_layer_surfaces *s, uint32_t pixel, uint32_t first, zr_vf sum[4])
{
    const zr_vf one = zr_vf_set(1.0f);
    for (uint32_t i = s->first[pixel + 1]; i-- > s->first[pixel];) {
        const struct zr_layer_surface *at = &s->at[(uint32_t)s->order[i]];
        const zr_vm here = zr_vm_of((uint32_t)at->mask >> first & ZR_ALL_BITS);
        const zr_vf opacity = zr_vf_set(at->color[3]), rest = one - opacity;
        for (int k = 0; k < 4; k++) {
            const zr_vf source = k < 3 ? zr_vf_set(at->color[k]) * opacity : opacity;
            sum[k] = zr_vf_select(here, source + sum[k] * rest, sum[k]);
        }
    }
}

/* Loads the colours that the samples show without surfaces. */
static inline void load_colors(const float *const color[3], size_t at, zr_vf sum[4])
{
    for (int k = 0; k < 3; k++)
        sum[k] = zr_vf_bits(zr_vi_load_patch((const uint32_t *)(const void *)(color[k] + at), ZR_TILE_STRIDE));
}

static inline uint32_t masks_of(const struct zr_layer_surfaces *s, uint32_t pixel)
{
    uint32_t mask = 0;
    for (uint32_t i = s->first[pixel]; i < s->first[pixel + 1]; i++)
        mask |= s->at[(uint32_t)s->order[i]].mask;
    return mask;
}

static inline float mean_of(const float samples[SAMPLES])
{
    float total = 0.0f;
    for (int i = 0; i < SAMPLES; i++)
        total += samples[i];
    return total * (1.0f / SAMPLES);
}

uint32_t ZR_KERNEL(zr_layer_surfaces_blend)(const struct zr_layer_surfaces *surfaces, const struct zr_tile *tile,
                                            uint32_t pixel, const float *const color[3], float out[4])
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const size_t first = (size_t)(pixel / COLUMNS * SIDE) * ZR_TILE_STRIDE + pixel % COLUMNS * SIDE;
    uint32_t free = 0;
    float samples[4][SAMPLES];
    for (uint32_t i = 0; i < SAMPLES; i += ZR_LANES) {
        const size_t at = first + i / SIDE * ZR_TILE_STRIDE + i % SIDE;
        const zr_vm is_free = zr_vi_eq(zr_vi_load_patch(tile->owner + at, ZR_TILE_STRIDE), zr_vi_set(0));
        zr_vf sum[4] = {zero, zero, zero, zr_vf_select(is_free, zero, one)};
        free |= zr_vm_bits(is_free) << i;
        if (color) load_colors(color, at, sum);
        blend_lanes(surfaces, pixel, i, sum);
        for (int k = 0; k < 4; k++)
            zr_vf_store(samples[k] + i, sum[k]);
    }
    for (int k = 0; k < 4; k++)
        out[k] = mean_of(samples[k]);
    return (uint32_t)__builtin_popcount(free & masks_of(surfaces, pixel));
}
