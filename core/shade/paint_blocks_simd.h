/* paint_blocks_simd.h - shade: blocks of which it is known that a few large triangles own them (tile.h), for the paint
 * kernel. Worth a quarter of the time of a cube at 256x256, a seventh of that of large triangles at 1920x1080.
 */
#ifndef ZR_PAINT_BLOCKS_SIMD_H
#define ZR_PAINT_BLOCKS_SIMD_H

#include "shade/paint_smooth_simd.h"
#include "shade/surfaces.h"

/* What a record paints in ZR_LANES columns. */
struct zr_hue {
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

static inline void zr_rows_put(const struct zr_rows *rows, uint32_t *to, zr_vi values)
{
    if (rows->streamed)
        zr_vi_stream(to, values);
    else
        zr_vi_store(to, values);
}

/* ZR_LANES columns of a block. */
struct zr_block_part {
    zr_vf x; /* in the window */
    float y; /* of the lowest row */
    zr_vi nothing;
    struct zr_rows out; /* from its first pixel on */
};

/* All of them are the owner's, or nobody's where that is 0. */
static inline void zr_paint_own(struct zr_surfaces *surfaces, uint32_t owner, const struct zr_block_part *part)
{
    struct zr_hue hue;
    uint32_t *to = part->out.first;
    float y = part->y;
    hue.flat = true;
    hue.color = part->nothing;
    if (owner > 0) zr_hue_take(surfaces, owner, part->x, &hue);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, to += part->out.stride, y += 1.0f)
        zr_rows_put(&part->out, to, zr_hue_at(&hue, y));
}

/* One of owners that are not all 0. */
static inline uint32_t zr_owner_among(const zr_vi rows[ZR_BLOCK_HEIGHT])
{
    _Alignas(64) uint32_t each[ZR_LANES];
    zr_vi most = rows[0];
    for (int row = 1; row < ZR_BLOCK_HEIGHT; row++)
        most = zr_vi_max(most, rows[row]);
    const uint32_t nobodys = zr_vm_bits(zr_vi_eq(most, zr_vi_set(0)));
    zr_vi_store(each, most);
    return nobodys == ZR_ALL_BITS ? 0 : each[zr_lowest_bit(nobodys ^ ZR_ALL_BITS)];
}

/* They are those of several, and `owners` the first of them. Returns how many pixels are owned. */
static inline uint32_t zr_paint_shared(struct zr_surfaces *surfaces, const uint32_t *owners,
                                       const struct zr_block_part *part)
{
    zr_vi left[ZR_BLOCK_HEIGHT], colors[ZR_BLOCK_HEIGHT];
    uint32_t *to = part->out.first, owner, covered = 0;
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++) {
        left[row] = zr_vi_load(owners + row * ZR_TILE_STRIDE);
        colors[row] = part->nothing;
        covered += ZR_LANES - (uint32_t)__builtin_popcount(zr_vm_bits(zr_vi_eq(left[row], zr_vi_set(0))));
    }
    while ((owner = zr_owner_among(left)) > 0) {
        struct zr_hue hue;
        float y = part->y;
        zr_hue_take(surfaces, owner, part->x, &hue);
        for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, y += 1.0f) {
            const zr_vm here = zr_vi_eq(left[row], zr_vi_set((int32_t)owner));
            if (!hue.flat && !zr_vm_any(here)) continue;
            colors[row] = zr_vi_select(here, zr_hue_at(&hue, y), colors[row]);
            left[row] = zr_vi_select(here, zr_vi_set(0), left[row]);
        }
    }
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, to += part->out.stride)
        zr_rows_put(&part->out, to, colors[row]);
    return covered;
}

/* Returns how many pixels are owned. */
static inline uint32_t zr_paint_block(struct zr_surfaces *surfaces, const struct zr_tile *tile, int block,
                                      zr_vi nothing, const struct zr_rows *out)
{
    const int32_t column = block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, row = block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    const uint32_t owner = tile->block_owner[block];
    uint32_t covered = owner > 0 && owner != ZR_BLOCK_SHARED ? ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT : 0;
    struct zr_block_part part = {.y = (float)(tile->y + row), .nothing = nothing, .out = *out};
    part.out.first += row * out->stride + column;
    for (int v = 0; v < ZR_BLOCK_WIDTH; v += ZR_LANES, part.out.first += ZR_LANES) {
        part.x = zr_vf_of(zr_vi_set(tile->x + column + v) + zr_vi_ramp());
        if (owner == ZR_BLOCK_SHARED)
            covered += zr_paint_shared(surfaces, tile->owner + row * ZR_TILE_STRIDE + column + v, &part);
        else
            zr_paint_own(surfaces, owner, &part);
    }
    return covered;
}

#endif
