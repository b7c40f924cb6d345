/* paint_blocks_simd.h - shade: blocks of which it is known that a few large triangles own them (tile.h), for the paint
 * kernel. Worth a quarter of the time of a cube at 256x256, a seventh of that of large triangles at 1920x1080.
 */
#ifndef ZR_PAINT_BLOCKS_SIMD_H
#define ZR_PAINT_BLOCKS_SIMD_H

#include "shade/paint_smooth_simd.h"
#include "shade/surfaces.h"

/* What a record paints in ZR_LANES columns. */
struct zr_hue {
    uint32_t owner;
    bool flat;
    zr_vi color;     /* flat */
    zr_vf across[4]; /* else: planes of 1/w and of colours times that, but for what grows with y, */
    float up[4];     /* a pixel */
};

static inline void zr_hue_add_plane(struct zr_hue *hue, int k, const struct zr_plane *plane, zr_vf x)
{
    hue->across[k] = zr_vf_set(plane->a0) + zr_vf_set(plane->dadx) * x;
    hue->up[k] = plane->dady;
}

static inline void zr_hue_take(struct zr_surfaces *surfaces, uint32_t owner, zr_vf x, struct zr_hue *hue)
{
    const struct zr_surface *surface = zr_surfaces_of(surfaces, owner);
    hue->owner = owner;
    hue->flat = surface->flat;
    if (surface->flat) {
        hue->color = zr_vi_set((int32_t)surface->color);
        return;
    }
    zr_hue_add_plane(hue, 0, &surface->oow, x);
    zr_hue_add_plane(hue, 1, &surface->red, x);
    zr_hue_add_plane(hue, 2, &surface->green, x);
    zr_hue_add_plane(hue, 3, &surface->blue, x);
}

static inline zr_vi zr_hue_at(const struct zr_hue *hue, float y)
{
    if (hue->flat) return hue->color;
    return zr_color_over_w(hue->across[0] + zr_vf_set(hue->up[0] * y), hue->across[1] + zr_vf_set(hue->up[1] * y),
                           hue->across[2] + zr_vf_set(hue->up[2] * y), hue->across[3] + zr_vf_set(hue->up[3] * y));
}

/* ZR_LANES columns of a block, from x on. `pixels` is the first of the lowest row, which is at y in the window. All of
 * them are the owner's, or nobody's where that is 0. */
static inline void zr_paint_own(struct zr_surfaces *surfaces, uint32_t owner, zr_vf x, float y, uint32_t *pixels,
                                zr_vi nothing)
{
    struct zr_hue hue;
    hue.flat = true;
    hue.color = nothing;
    if (owner > 0) zr_hue_take(surfaces, owner, x, &hue);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, pixels += ZR_TILE_STRIDE, y += 1.0f)
        zr_vi_store(pixels, zr_hue_at(&hue, y));
}

/* Those of several owners. Returns how many pixels are owned. */
static inline uint32_t zr_paint_shared(struct zr_surfaces *surfaces, zr_vf x, float y, uint32_t *pixels, zr_vi nothing)
{
    struct zr_hue hues[2]; /* of a row's first owner, and of its last: most often it has two, and the next row, too */
    uint32_t covered = 0;
    hues[0].owner = hues[1].owner = 0;
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, pixels += ZR_TILE_STRIDE, y += 1.0f) {
        const zr_vi owners = zr_vi_load(pixels);
        uint32_t left = ZR_ALL_BITS ^ zr_vm_bits(zr_vi_eq(owners, zr_vi_set(0)));
        struct zr_hue *hue = &hues[0];
        zr_vi colors = nothing;
        covered += (uint32_t)__builtin_popcount(left);
        for (; left; hue = &hues[1]) {
            const uint32_t owner = pixels[zr_lowest_bit(left)];
            const zr_vm here = zr_vi_eq(owners, zr_vi_set((int32_t)owner));
            if (hue->owner != owner) zr_hue_take(surfaces, owner, x, hue);
            colors = zr_vi_select(here, zr_hue_at(hue, y), colors);
            left &= ~zr_vm_bits(here);
        }
        zr_vi_store(pixels, colors);
    }
    return covered;
}

/* `owner`: what the tile knows of the block's. Returns how many pixels are owned. */
static inline uint32_t zr_paint_block(struct zr_surfaces *surfaces, const struct zr_canvas *canvas, int block,
                                      uint32_t owner, zr_vi nothing)
{
    const int32_t row = block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    const float y = (float)(canvas->y + row);
    uint32_t covered = 0;
    for (int v = 0; v < ZR_BLOCK_WIDTH / ZR_LANES; v++) {
        const int32_t column = block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH + v * ZR_LANES;
        const zr_vf x = zr_vf_of(zr_vi_set(canvas->x + column) + zr_vi_ramp());
        uint32_t *pixels = canvas->colors + row * ZR_TILE_STRIDE + column;
        if (owner == ZR_BLOCK_SHARED) {
            covered += zr_paint_shared(surfaces, x, y, pixels, nothing);
        } else {
            zr_paint_own(surfaces, owner, x, y, pixels, nothing);
            covered += owner > 0 ? ZR_LANES * ZR_BLOCK_HEIGHT : 0;
        }
    }
    return covered;
}

#endif
