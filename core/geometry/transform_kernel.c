#include "geometry/transform.h"

#include "geometry/mat4_simd.h"
#include "base/mutant.h"
#include "base/prefetch.h"
#include "base/simd/simd.h"

_Static_assert(sizeof(zr_vec4) == 4 * sizeof(float) && sizeof(struct zr_window_vertex) == 4 * sizeof(float),
               "both are loaded and stored as four floats");

/* Matrix and viewport, broadcast to all lanes. */
struct mapping {
    struct zr_mat4_v m;
    zr_vf scale_x, scale_y, trans_x, trans_y;
};

static inline struct mapping mapping_make(const zr_mat4 *m, const struct zr_viewport *viewport)
{
    struct mapping c = {.m = zr_spread_mat4_v(m)};
    c.scale_x = zr_vf_set(viewport->scale_x);
    c.scale_y = zr_vf_set(viewport->scale_y);
    c.trans_x = zr_vf_set(viewport->trans_x);
    c.trans_y = zr_vf_set(viewport->trans_y);
    return c;
}

static inline zr_vi bit_where_not(zr_vm inside, int bit)
{
    return zr_vi_select(inside, zr_vi_set(0), zr_vi_set(1 << bit));
}

/* Equals zr_clip_outcode: NaN is outside of all planes. */
static inline zr_vi outcode_of(zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    const zr_vf zero = zr_vf_set(0.0f), bound = ZR_MUTANT(guard_band, w, w + w);
    return bit_where_not(zr_vf_le(x, bound), 0) | bit_where_not(zr_vf_le(zero, x + w), 1) |
           bit_where_not(zr_vf_le(y, bound), 2) | bit_where_not(zr_vf_le(zero, y + w), 3) |
           bit_where_not(zr_vf_le(zero, z + w), 4) | bit_where_not(zr_vf_le(z, w), 5);
}

/* Equals zr_viewport_snap. */
static inline zr_vf snap(zr_vf window)
{
    const zr_vf no_fraction = zr_vf_set(12582912.0f);
    return ((window - zr_vf_set(0.5f)) * zr_vf_set((float)ZR_SUBPIXELS) + no_fraction) - no_fraction;
}

/* Stores the outcodes in the order of positions: the lanes are in the order of zr_vf_load_fours, which storing
 * reverts. */
static inline unsigned store_outcodes(zr_vi codes, uint8_t *out)
{
    float fours[4 * ZR_LANES];
    unsigned any = 0;
    const zr_vf each = zr_vf_bits(codes);
    zr_vf_store_fours(fours, each, each, each, each);
    for (size_t i = 0; i < ZR_LANES; i++) {
        uint32_t code;
        memcpy(&code, &fours[4 * i], sizeof code);
        out[i] = (uint8_t)code;
        any |= code;
    }
    return any;
}

struct clip_v {
    zr_vf x, y, z, w;
};

/* Returns true only if all lanes are inside and have a window position. May return false for such lanes in the far
 * corner of a window of 8192x8192. Takes few comparisons and no outcodes (a third of the time of the bunny's vertices,
 * including their reordering). */
static inline bool are_plain(const struct clip_v *clip, zr_vf wx, zr_vf wy, zr_vf wz)
{
    const zr_vf most = zr_vf_set((float)(ZR_SNAP_MAX / ZR_SUBPIXELS - 1));
    const zr_vm inside =
        zr_vm_and(zr_vm_and(zr_vf_le(zr_vf_abs(clip->x), clip->w), zr_vf_le(zr_vf_abs(clip->y), clip->w)),
                  zr_vf_le(zr_vf_abs(clip->z), clip->w));
    const zr_vm near = zr_vf_lt(zr_vf_abs(wx) + zr_vf_abs(wy) + zr_vf_abs(wz), most);
    return zr_vm_bits(zr_vm_and(inside, near)) == ZR_ALL_BITS;
}

/* Equals over_w of viewport.c. */
static inline zr_vf over_w(zr_vf value, zr_vf w, zr_vf oow)
{
    return ZR_MUTANT(divided_by_w, value * oow, value / w);
}

/* Returns the coordinate unchanged: corners are snapped later (zr_viewport_snap). A mutant has a coarser grid. */
static inline zr_vf on_grid(zr_vf window)
{
    return ZR_MUTANT(coarse_grid, window, zr_vf_of(zr_vi_round(window * zr_vf_set(16.0f))) * zr_vf_set(1.0f / 16.0f));
}

/* Transforms ZR_LANES positions. */
static inline unsigned transform_group(const struct mapping *c, const zr_vec4 *positions, struct zr_window_vertex *out,
                                       uint8_t *outcodes, bool streamed)
{
    zr_vf x, y, z, w;
    zr_vf_load_fours((const float *)positions, &x, &y, &z, &w);
    const struct clip_v clip = {zr_mat4_row_v(&c->m, 0, x, y, z, w), zr_mat4_row_v(&c->m, 1, x, y, z, w),
                                zr_mat4_row_v(&c->m, 2, x, y, z, w), zr_mat4_row_v(&c->m, 3, x, y, z, w)};
    const zr_vf oow = zr_vf_set(1.0f) / clip.w, half = zr_vf_set(0.5f);
    const zr_vf wx = on_grid(over_w(clip.x, clip.w, oow) * c->scale_x + c->trans_x);
    const zr_vf wy = on_grid(over_w(clip.y, clip.w, oow) * c->scale_y + c->trans_y);
    const zr_vf wz = over_w(clip.z, clip.w, oow) * half + half;
    if (streamed)
        zr_vf_stream_fours((float *)out, wx, wy, wz, oow);
    else
        zr_vf_store_fours((float *)out, wx, wy, wz, oow);
    if (__builtin_expect(are_plain(&clip, wx, wy, wz), 1)) {
        memset(outcodes, 0, ZR_LANES);
        return 0;
    }
    const zr_vf most = zr_vf_set((float)ZR_SNAP_MAX);
    const zr_vm placed = zr_vm_and(zr_vf_lt(zr_vf_abs(snap(wx)), most), zr_vf_lt(zr_vf_abs(snap(wy)), most));
    const zr_vi codes = outcode_of(clip.x, clip.y, clip.z, clip.w);
    const zr_vm lost = zr_vm_andnot(zr_vi_eq(codes, zr_vi_set(0)), placed);
    return store_outcodes(codes | zr_vi_select(lost, zr_vi_set(ZR_OUTCODE_UNPLACED), zr_vi_set(0)), outcodes);
}

unsigned ZR_KERNEL(zr_transform)(const zr_mat4 *object_to_clip, const struct zr_viewport *viewport,
                                 const zr_vec4 *positions, size_t count, struct zr_window_vertex *out,
                                 uint8_t *outcodes, bool streamed)
{
    const struct mapping mapping = mapping_make(object_to_clip, viewport);
    unsigned any = 0;
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES) {
        /* The prefetch saves a quarter of the time of many vertices. */
        zr_prefetch(positions + i, ZR_PAGE, ZR_LANES * sizeof *positions);
        if (!streamed) zr_prefetch_written(out + i, ZR_PAGE, ZR_LANES * sizeof *out);
        any |= transform_group(&mapping, positions + i, out + i, outcodes + i, streamed);
    }
    if (i == count) return any;
    /* The remaining positions, fewer than a group. */
    zr_vec4 in[ZR_LANES] = {{0, 0, 0, 1}};
    struct zr_window_vertex last[ZR_LANES];
    uint8_t codes[ZR_LANES];
    memcpy(in, positions + i, (count - i) * sizeof *in);
    transform_group(&mapping, in, last, codes, false);
    memcpy(out + i, last, (count - i) * sizeof *out);
    memcpy(outcodes + i, codes, count - i);
    for (; i < count; i++)
        any |= outcodes[i];
    return any;
}
