#include "raster/small.h"

#include "raster/tile_simd.h"
#include "raster/triangle_simd.h"

/* ---- many triangles ---- */

/* ZR_LANES of them, set up. */
struct group {
    int32_t at[3][ZR_LANES], right[3][ZR_LANES], up[3][ZR_LANES]; /* of edges, at x0, y0 */
    float a0[ZR_LANES], dadx[ZR_LANES], dady[ZR_LANES];
    int32_t x0[ZR_LANES], y0[ZR_LANES], x1[ZR_LANES], y1[ZR_LANES];
    uint32_t clamped; /* bit i: its depth may leave 0..1 at some sample of its box */
};

/* Where the corners of records stand. */
struct corners {
    const float *at[3][ZR_LANES];
};

static inline void set_up(const struct zr_tile *tile, const struct corners *corners, struct group *out)
{
    struct zr_corner_v c[3];
    struct zr_grid_v g[3];
#define CORNER_0(i) corners->at[0][i]
#define CORNER_1(i) corners->at[1][i]
#define CORNER_2(i) corners->at[2][i]
    ZR_LOAD4(c[0].x, c[0].y, c[0].z, c[0].oow, CORNER_0);
    ZR_LOAD4(c[1].x, c[1].y, c[1].z, c[1].oow, CORNER_1);
    ZR_LOAD4(c[2].x, c[2].y, c[2].z, c[2].oow, CORNER_2);
    zr_corners_orient_v(c, g);

    const zr_vi last_x = zr_vi_set(tile->x + tile->width - 1), last_y = zr_vi_set(tile->y + tile->height - 1);
    const zr_vi x0 = zr_vi_max(zr_centre_behind_v(zr_least_v(g[0].x, g[1].x, g[2].x)), zr_vi_set(tile->x));
    const zr_vi y0 = zr_vi_max(zr_centre_behind_v(zr_least_v(g[0].y, g[1].y, g[2].y)), zr_vi_set(tile->y));
    const zr_vi x1 = zr_vi_min(zr_most_v(g[0].x, g[1].x, g[2].x) >> ZR_SUBPIXEL_BITS, last_x);
    const zr_vi y1 = zr_vi_min(zr_most_v(g[0].y, g[1].y, g[2].y) >> ZR_SUBPIXEL_BITS, last_y);
    zr_vi_store(out->x0, x0);
    zr_vi_store(out->y0, y0);
    zr_vi_store(out->x1, x1);
    zr_vi_store(out->y1, y1);
    for (int k = 0; k < 3; k++) {
        g[k].x -= x0 * zr_vi_set(ZR_SUBPIXELS);
        g[k].y -= y0 * zr_vi_set(ZR_SUBPIXELS);
    }
    for (int k = 0; k < 3; k++) {
        const struct zr_edge_v e = zr_edge_make_v(g[k], g[(k + 1) % 3]);
        zr_vi_store(out->at[k], e.at);
        zr_vi_store(out->right[k], e.right);
        zr_vi_store(out->up[k], e.up);
    }
    const struct zr_basis_v basis = zr_basis_make_v(c);
    const struct zr_plane_v plane = zr_plane_make_v(&basis, c[0].z, c[1].z, c[2].z);
    zr_vf_store(out->a0, plane.a0);
    zr_vf_store(out->dadx, plane.dadx);
    zr_vf_store(out->dady, plane.dady);
    const struct zr_range_v range = zr_plane_range_v(&plane, zr_vf_of(x0), zr_vf_of(y0), zr_vf_of(x1), zr_vf_of(y1));
    const zr_vm within = zr_vm_and(zr_vf_le(zr_vf_set(0.0f), range.near), zr_vf_le(range.far, zr_vf_set(1.0f)));
    out->clamped = ZR_ALL_BITS ^ zr_vm_bits(within);
}

/* Up to ZR_LANES numbers -> corners; what is missing has those of the first. */
static inline const struct zr_batch *find_corners(const struct zr_geometry *geometry, const struct zr_batch *batch,
                                                  const uint32_t *numbers, uint32_t count, struct corners *out)
{
    const float *vertices = &geometry->vertices[0].x;
    for (uint32_t i = 0; i < ZR_LANES; i++) {
        uint32_t number = numbers[i < count ? i : 0];
        batch = zr_batch_next(geometry, batch, number);
        uint32_t t = number - batch->first, first = 0;
        const uint32_t *v;
        if (batch->written) {
            v = geometry->triangles[batch->first_record + t].v;
        } else {
            v = batch->corners + 3 * (size_t)t;
            first = batch->first_vertex;
        }
        for (int k = 0; k < 3; k++)
            out->at[k][i] = vertices + 4 * (size_t)(first + v[k]);
    }
    return batch;
}

/* ---- one triangle ---- */

/* Triangle i, in ZR_LANES columns from x on, which is a multiple of ZR_LANES: its edges keep out what is not its own,
 * and columns beyond the window, since it lies inside of the view volume.
 * All that it is made of is spread over the lanes as it is loaded (a tenth of the time). Not `clamped`: its depth is
 * known to be within 0..1. */
static inline void draw_columns(struct zr_tile *tile, const struct group *g, uint32_t i, int32_t x, zr_vi owner,
                                bool clamped)
{
    const zr_vi below_zero = zr_vi_set(-1), ramp = zr_vi_ramp(), skip = zr_vi_set(x - g->x0[i]) + ramp;
    zr_vi e0 = zr_vi_set(g->at[0][i]) + zr_vi_set(g->right[0][i]) * skip;
    zr_vi e1 = zr_vi_set(g->at[1][i]) + zr_vi_set(g->right[1][i]) * skip;
    zr_vi e2 = zr_vi_set(g->at[2][i]) + zr_vi_set(g->right[2][i]) * skip;
    const zr_vi up0 = zr_vi_set(g->up[0][i]), up1 = zr_vi_set(g->up[1][i]), up2 = zr_vi_set(g->up[2][i]);
    const zr_vf column = zr_vf_set(g->a0[i]) + zr_vf_set(g->dadx[i]) * zr_vf_of(zr_vi_set(x) + ramp);
    const zr_vf dady = zr_vf_set(g->dady[i]);
    zr_vf fy = zr_vf_set((float)g->y0[i]);
    size_t at = (size_t)(g->y0[i] - tile->y) * ZR_TILE_STRIDE + (size_t)(x - tile->x);
    for (int32_t y = g->y0[i]; y <= g->y1[i]; y++, at += ZR_TILE_STRIDE, fy = fy + zr_vf_set(1.0f)) {
        const zr_vm inside = zr_vi_lt(below_zero, e0 | e1 | e2);
        zr_vf z = column + dady * fy;
        if (clamped) z = zr_depth_clamp_v(z);
        zr_tile_put_v(&tile->depth[at], &tile->owner[at], inside, z, owner);
        e0 += up0;
        e1 += up1;
        e2 += up2;
    }
}

static void draw_group(struct zr_tile *tile, const struct group *g, const uint32_t *numbers, uint32_t count)
{
    const uint32_t clamped = g->clamped;
    for (uint32_t i = 0; i < count; i++) {
        const zr_vi owner = zr_vi_set((int32_t)(numbers[i] + 1));
        if (clamped >> i & 1u)
            for (int32_t x = g->x0[i] & ~(ZR_LANES - 1); x <= g->x1[i]; x += ZR_LANES)
                draw_columns(tile, g, i, x, owner, true);
        else
            for (int32_t x = g->x0[i] & ~(ZR_LANES - 1); x <= g->x1[i]; x += ZR_LANES)
                draw_columns(tile, g, i, x, owner, false);
    }
}

void ZR_KERNEL(zr_small)(struct zr_tile *tile, const struct zr_geometry *geometry, const uint32_t *numbers,
                         uint32_t count)
{
    const struct zr_batch *batch = &geometry->batches[0];
    for (uint32_t done = 0; done < count; done += ZR_LANES) {
        const uint32_t some = count - done < ZR_LANES ? count - done : ZR_LANES, *here = numbers + done;
        struct corners corners;
        struct group group;
        batch = find_corners(geometry, batch, here, some, &corners);
        set_up(tile, &corners, &group);
        draw_group(tile, &group, here, some);
    }
}
