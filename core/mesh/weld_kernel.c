#include "base/simd/simd.h"
#include "mesh/weld.h"

/* Returns the nearest cell; sets the lanes of *near that are near a border. NaN is in the first cell. */
static inline zr_vi cell_along(zr_vf place, float low, float cells_per_unit, zr_vm *near)
{
    const zr_vf in_cells = (place - zr_vf_set(low)) * zr_vf_set(cells_per_unit);
    const zr_vf within = zr_vf_min(zr_vf_max(in_cells, zr_vf_set(0.0f)), zr_vf_set((float)ZR_WELD_CELLS_MOST));
    const zr_vi cell = zr_vi_round(within);
    *near = zr_vm_or(*near, zr_vf_lt(zr_vf_set(ZR_WELD_INNER), zr_vf_abs(within - zr_vf_of(cell))));
    return cell;
}

static inline zr_vi mix(zr_vi h, int bits, uint32_t factor)
{
    const zr_vi high = h >> bits & zr_vi_set((int32_t)(UINT32_MAX >> bits));
    return (h ^ high) * zr_vi_set((int32_t)factor);
}

static inline zr_vi cells_of(const zr_vec4 *positions, const struct zr_weld_grid *grid)
{
    zr_vf x, y, z, w;
#define PLACE(i) (&positions[i].x)
    ZR_LOAD4(x, y, z, w, PLACE);
#undef PLACE
    (void)w;
    zr_vm near = zr_vm_of(0);
    zr_vi h = cell_along(x, grid->low.x, grid->cells_per_unit, &near) * zr_vi_set((int32_t)0x9e3779b1u);
    h = h + cell_along(y, grid->low.y, grid->cells_per_unit, &near) * zr_vi_set((int32_t)0x85ebca77u);
    h = h + cell_along(z, grid->low.z, grid->cells_per_unit, &near) * zr_vi_set((int32_t)0xc2b2ae3du);
    h = mix(mix(h, 16, 0x7feb352du), 15, 0x846ca68bu);
    h = mix(h, 16, 1) & zr_vi_set(~1);
    return h + zr_vi_select(near, zr_vi_set(1), zr_vi_set(0));
}

void ZR_KERNEL(zr_weld_cells)(const zr_vec4 *positions, size_t count, const struct zr_weld_grid *grid, uint32_t *cells)
{
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES)
        zr_vi_store(cells + i, cells_of(positions + i, grid));
    if (i == count) return;
    /* The remaining positions, fewer than a group. */
    zr_vec4 last[ZR_LANES] = {{0, 0, 0, 0}};
    memcpy(last, positions + i, (count - i) * sizeof *last);
    zr_vi_store_first(cells + i, cells_of(last, grid), (uint32_t)(count - i));
}
