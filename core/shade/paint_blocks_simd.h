/* paint_blocks_simd.h - shade: blocks of which it is known that a few large triangles own them (tile.h), for the paint
 * kernel. Worth a quarter of the time of a cube at 256x256, a seventh of that of large triangles at 1920x1080.
 */
#ifndef ZR_PAINT_BLOCKS_SIMD_H
#define ZR_PAINT_BLOCKS_SIMD_H

#include "raster/tile_simd.h"
#include "shade/paint_neighbors_simd.h"
#include "shade/paint_smooth_simd.h"
#include "shade/surfaces.h"

/* What a record paints in ZR_LANES columns. */
struct zr_hue {
    bool flat;
    zr_vi color;     /* flat */
    zr_vf across[4]; /* else: planes of 1/w and of colours times that, at y = 0 */
    float up[4];     /* and by how much they grow with y */
};

static inline void zr_hue_add_plane(struct zr_hue *hue, int k, const struct zr_plane *plane, zr_vf x)
{
    hue->across[k] = zr_vf_set(plane->a0) + zr_vf_set(plane->dadx) * x;
    hue->up[k] = plane->dady;
}

static inline void zr_hue_add_planes(struct zr_hue *hue, const struct zr_surface *surface, zr_vf x)
{
    zr_hue_add_plane(hue, 0, &surface->oow, x);
    zr_hue_add_plane(hue, 1, &surface->red, x);
    zr_hue_add_plane(hue, 2, &surface->green, x);
    zr_hue_add_plane(hue, 3, &surface->blue, x);
}

static inline void zr_hue_take(struct zr_surfaces *surfaces, uint32_t owner, zr_vf x, struct zr_hue *hue)
{
    const struct zr_surface *surface = zr_surfaces_of(surfaces, owner);
    hue->flat = surface->flat;
    if (surface->flat)
        hue->color = zr_vi_set((int32_t)surface->color);
    else
        zr_hue_add_planes(hue, surface, x);
}

static inline zr_vi zr_hue_at(const struct zr_hue *hue, float y)
{
    if (hue->flat) return hue->color;
    return zr_color_over_w(hue->across[0] + zr_vf_set(hue->up[0] * y), hue->across[1] + zr_vf_set(hue->up[1] * y),
                           hue->across[2] + zr_vf_set(hue->up[2] * y), hue->across[3] + zr_vf_set(hue->up[3] * y));
}

/* From a tile's first pixel on -> from a block's. */
static inline struct zr_pixel_rows zr_pixel_rows_of_block(const struct zr_pixel_rows *out, int block)
{
    struct zr_pixel_rows rows = *out;
    rows.first += block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT * out->stride + block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
    return rows;
}

/* ---- blocks of one colour ---- */

static inline void zr_paint_alike(const struct zr_pixel_rows *out, zr_vi color)
{
    uint32_t *to = out->first;
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, to += out->stride)
        for (int v = 0; v < ZR_BLOCK_PARTS; v++)
            zr_vi_put(to + v * ZR_LANES, color, out->streamed);
}

/* Blocks `first` and so on: a bit for each that is all nobody's or a flat owner's, and what colour it has. */
static inline uint32_t zr_blocks_alike(struct zr_surfaces *surfaces, struct zr_neighbors *neighbors,
                                       const struct zr_tile *tile, int first, uint32_t colors[ZR_LANES])
{
    const zr_vi owners = zr_vi_load(tile->block_owner + first);
    const uint32_t nobodys = zr_vm_bits(zr_vi_eq(owners, zr_vi_set(0)));
    const uint32_t shared = zr_vm_bits(zr_vi_eq(owners, zr_vi_set(ZR_BLOCK_SHARED)));
    uint32_t alike = nobodys, left = ZR_ALL_BITS & ~(nobodys | shared);
    zr_vi color = zr_vi_set((int32_t)neighbors->nothing);
    while (left) {
        const uint32_t owner = tile->block_owner[first + zr_lowest_bit(left)];
        const zr_vm here = zr_vi_eq(owners, zr_vi_set((int32_t)owner));
        const struct zr_surface *surface = zr_surfaces_of(surfaces, owner);
        left &= ~zr_vm_bits(here);
        zr_neighbors_add(neighbors, owner, surface);
        if (!surface->flat) continue;
        color = zr_vi_select(here, zr_vi_set((int32_t)surface->color), color);
        alike |= zr_vm_bits(here);
    }
    zr_vi_store(colors, color);
    return alike;
}

/* ---- the others ---- */

/* A block under work. */
struct zr_block {
    zr_vf x[ZR_BLOCK_PARTS]; /* of its columns, in the window */
    float y;                 /* of its lowest row */
    zr_vi nothing;
    struct zr_pixel_rows out; /* from its first pixel on */
};

/* A block that is all the owner's, who is not flat. */
static inline void zr_paint_own(struct zr_surfaces *surfaces, uint32_t owner, const struct zr_block *block)
{
    const struct zr_surface *surface = zr_surfaces_of(surfaces, owner);
    struct zr_hue hues[ZR_BLOCK_PARTS];
    uint32_t *to = block->out.first;
    float y = block->y;
    for (int v = 0; v < ZR_BLOCK_PARTS; v++) {
        hues[v].flat = false;
        zr_hue_add_planes(&hues[v], surface, block->x[v]);
    }
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, to += block->out.stride, y += 1.0f)
        for (int v = 0; v < ZR_BLOCK_PARTS; v++)
            zr_vi_put(to + v * ZR_LANES, zr_hue_at(&hues[v], y), block->out.streamed);
}

/* One of owners that are not all 0. */
static inline uint32_t zr_owner_among(const zr_vi rows[ZR_BLOCK_HEIGHT])
{
    uint32_t each[ZR_LANES];
    zr_vi most = rows[0];
    for (int row = 1; row < ZR_BLOCK_HEIGHT; row++)
        most = zr_vi_max(most, rows[row]);
    const uint32_t nobodys = zr_vm_bits(zr_vi_eq(most, zr_vi_set(0)));
    zr_vi_store(each, most);
    return nobodys == ZR_ALL_BITS ? 0 : each[zr_lowest_bit(nobodys ^ ZR_ALL_BITS)];
}

/* Columns of several owners, `owners` being the first of them. Returns how many pixels are owned. */
static inline uint32_t zr_color_columns(struct zr_surfaces *surfaces, const uint32_t *owners, zr_vf x, float first_y,
                                        zr_vi nothing, zr_vi colors[ZR_BLOCK_HEIGHT])
{
    zr_vi left[ZR_BLOCK_HEIGHT];
    uint32_t owner, covered = 0;
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++) {
        left[row] = zr_vi_load(owners + row * ZR_TILE_STRIDE);
        colors[row] = nothing;
        covered += ZR_LANES - (uint32_t)__builtin_popcount(zr_vm_bits(zr_vi_eq(left[row], zr_vi_set(0))));
    }
    while ((owner = zr_owner_among(left)) > 0) {
        struct zr_hue hue;
        float y = first_y;
        zr_hue_take(surfaces, owner, x, &hue);
        for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, y += 1.0f) {
            const zr_vm here = zr_vi_eq(left[row], zr_vi_set((int32_t)owner));
            if (!hue.flat && !zr_vm_any(here)) continue;
            colors[row] = zr_vi_select(here, zr_hue_at(&hue, y), colors[row]);
            left[row] = zr_vi_select(here, zr_vi_set(0), left[row]);
        }
    }
    return covered;
}

/* Columns of several owners, or of one and nobody, `owners` being the first of them. Returns how many pixels are owned.
 */
static inline uint32_t zr_color_shared(struct zr_surfaces *surfaces, struct zr_neighbors *neighbors,
                                       const uint32_t *owners, zr_vf x, const struct zr_block *block,
                                       zr_vi colors[ZR_BLOCK_HEIGHT])
{
    uint32_t covered;
    if (zr_neighbors_color(neighbors, surfaces, owners, colors, &covered)) return covered;
    return zr_color_columns(surfaces, owners, x, block->y, block->nothing, colors);
}

/* A block that is shared, or all of an owner who is not flat. Returns how many pixels are owned. */
static inline uint32_t zr_paint_block(struct zr_surfaces *surfaces, struct zr_neighbors *neighbors,
                                      const struct zr_tile *tile, int number, const struct zr_pixel_rows *out)
{
    const int32_t column = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH,
                  row = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    const uint32_t owner = tile->block_owner[number], *owners = &tile->owner[zr_block_first(number)];
    struct zr_block block = {
        .y = (float)(tile->y + row), .nothing = zr_vi_set((int32_t)neighbors->nothing), .out = *out};
    zr_vi colors[ZR_BLOCK_PARTS][ZR_BLOCK_HEIGHT];
    uint32_t *to = out->first, covered = 0;
    for (int v = 0; v < ZR_BLOCK_PARTS; v++)
        block.x[v] = zr_vf_of(zr_vi_set(tile->x + column + v * ZR_LANES) + zr_vi_ramp());
    if (owner != ZR_BLOCK_SHARED) {
        zr_paint_own(surfaces, owner, &block);
        return ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT;
    }
    for (int v = 0; v < ZR_BLOCK_PARTS; v++)
        covered += zr_color_shared(surfaces, neighbors, owners + v * ZR_LANES, block.x[v], &block, colors[v]);
    for (int line = 0; line < ZR_BLOCK_HEIGHT; line++, to += out->stride)
        for (int v = 0; v < ZR_BLOCK_PARTS; v++)
            zr_vi_put(to + v * ZR_LANES, colors[v][line], out->streamed);
    return covered;
}

#endif
