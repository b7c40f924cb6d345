#include "base/inlined.h"
#include "raster/cloud_bins.h"
#include "raster/tile_simd.h"

/* zr_tile_put for `count` samples of a row. Most points are hidden: their rows are loaded and compared only. */
ZR_INLINED void put_row(float *depths, uint32_t *owners, int32_t count, zr_vf z, zr_vi owner)
{
    for (int32_t i = 0; i < count; i += (int32_t)ZR_LANES) {
        const zr_vm inside = zr_vm_first((uint32_t)(count - i));
        if (zr_vm_any(zr_vm_and(inside, zr_vf_le(z, zr_vf_load(depths + i)))))
            zr_tile_put_v(depths + i, owners + i, inside, z, owner);
    }
}

uint32_t ZR_KERNEL(zr_cloud_draw)(const struct zr_cloud_block *block, int32_t x, int32_t y, struct zr_tile *tile)
{
    const int32_t width = block->width, cut = block->cut;
    uint32_t pixels = 0;
    for (uint32_t i = 0; i < block->used; i++) {
        const struct zr_cloud_record *r = &block->records[i];
        const int32_t left = x + r->x - tile->x, low = y + r->y - tile->y;
        const int32_t y0 = low > 0 ? low : 0, y1 = low + width < tile->height ? low + width : tile->height;
        const zr_vf z = zr_vf_set(r->depth);
        const zr_vi owner = zr_vi_set((int32_t)r->owner);
        for (int32_t row = y0; row < y1; row++) {
            const int32_t from_end = row - low < low + width - 1 - row ? row - low : low + width - 1 - row;
            const int32_t lacks = from_end < cut ? cut - from_end : 0, first = left + lacks;
            const int32_t end = left + width - lacks < tile->width ? left + width - lacks : tile->width;
            const int32_t x0 = first > 0 ? first : 0, at = row * ZR_TILE_STRIDE + x0;
            if (x0 >= end) continue;
            put_row(tile->depth + at, tile->owner + at, end - x0, z, owner);
            pixels += (uint32_t)(end - x0);
        }
    }
    return pixels;
}
