/* paint_neighbors_simd.h - shade: the colours of flat triangles whose numbers are near each other, as those of a box or
 * of a room are: looked up many at once, by number, for the paint kernel. Where they are not so, a loop over those that
 * are in a block waits for each (a twentieth of the time of a cube at 256x256).
 */
#ifndef ZR_PAINT_NEIGHBORS_SIMD_H
#define ZR_PAINT_NEIGHBORS_SIMD_H

#include "raster/tile_simd.h"
#include "shade/surfaces.h"

struct zr_neighbors {
    bool given_up;  /* some of the tile's owners are no neighbours, or not flat, or of the colour `unknown` */
    uint32_t first; /* owner of lane 0; UINT32_MAX: nobody is known yet */
    zr_vi colors;   /* `unknown` where it was not looked up */
    uint32_t nothing, unknown;
};

static inline struct zr_neighbors zr_neighbors_begin(uint32_t nothing)
{
    const uint32_t unknown = nothing ^ (1u << 31); /* hardly a face's: these are opaque, and no id is so great */
    return (struct zr_neighbors){false, UINT32_MAX, zr_vi_set((int32_t)unknown), nothing, unknown};
}

/* Gives up where it is too far away from the others, or its colour would mean something else. */
static inline void zr_neighbors_add(struct zr_neighbors *n, uint32_t owner, const struct zr_surface *surface)
{
    if (n->first == UINT32_MAX) n->first = owner < ZR_LANES ? 0 : owner - ZR_LANES / 2;
    const uint32_t lane = owner - n->first;
    n->given_up = n->given_up || lane >= ZR_LANES || !surface->flat || surface->color == n->unknown;
    const zr_vm here = zr_vi_eq(zr_vi_ramp(), zr_vi_set((int32_t)lane));
    n->colors = zr_vi_select(here, zr_vi_set((int32_t)surface->color), n->colors);
}

/* Colours of ZR_LANES columns of a block, `owners` being the first of them, as far as they are known, and how many
 * pixels are owned. Returns an owner whose colour is not known, or 0. */
static inline uint32_t zr_neighbors_look_up(const struct zr_neighbors *n, const uint32_t *owners,
                                            zr_vi colors[ZR_BLOCK_HEIGHT], uint32_t *covered)
{
    const zr_vi zero = zr_vi_set(0), nothing = zr_vi_set((int32_t)n->nothing), unknown = zr_vi_set((int32_t)n->unknown);
    const zr_vi first = zr_vi_set((int32_t)n->first), in_table = zr_vi_set(ZR_LANES - 1);
    zr_vi missing = zero;
    uint32_t nobodys = 0, each[ZR_LANES];
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++) {
        const zr_vi owner = zr_vi_load(owners + row * ZR_TILE_STRIDE), lane = owner - first;
        const zr_vm nobody = zr_vi_eq(owner, zero);
        const zr_vi known = zr_vi_bits_of(zr_vf_pick(zr_vf_bits(n->colors), lane & in_table));
        const zr_vi color = zr_vi_select(zr_vi_eq(lane & ~in_table, zero), known, unknown);
        colors[row] = zr_vi_select(nobody, nothing, color);
        missing = zr_vi_select(zr_vi_eq(colors[row], unknown), owner, missing);
        nobodys += (uint32_t)__builtin_popcount(zr_vm_bits(nobody));
    }
    *covered = ZR_LANES * ZR_BLOCK_HEIGHT - nobodys;
    const uint32_t some = zr_vm_bits(zr_vi_eq(missing, zero)) ^ ZR_ALL_BITS;
    if (!some) return 0;
    zr_vi_store(each, missing);
    return each[zr_lowest_bit(some)];
}

/* The same of all of them. False where it is given up. */
static inline bool zr_neighbors_color(struct zr_neighbors *n, struct zr_surfaces *surfaces, const uint32_t *owners,
                                      zr_vi colors[ZR_BLOCK_HEIGHT], uint32_t *covered)
{
    while (!n->given_up) {
        const uint32_t owner = zr_neighbors_look_up(n, owners, colors, covered);
        if (owner == 0) return true;
        zr_neighbors_add(n, owner, zr_surfaces_of(surfaces, owner));
    }
    return false;
}

#endif
