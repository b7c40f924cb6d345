/* paint.h - shade: a tile's owners -> colours, ids, normals. A kernel.
 *
 * Exact:  the reference's rule 9: values times 1/w are planes over the window, each pixel divides by the plane of
 *         1/w, and bytes are rounded to the nearest.
 * How:    planes are not kept from the drawing of visibility: only what is seen is set up, but for tiny and small
 *         triangles that are painted early. For colours and normals the tile's owners are split into parts
 *         (parts_simd.h); ZR_LANES parts at a time are looked up and given a word, where they are flat, or planes;
 *         then, patch by patch, each pixel takes its part's. Ids are looked up pixel by pixel (channels_simd.h).
 */
#ifndef ZR_PAINT_H
#define ZR_PAINT_H

#include "base/isa.h"
#include "raster/prepaint.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/gbuffer.h"

/* Where a tile lies in a channel, whose values have four bytes each. */
struct zr_pixel_rows {
    uint32_t *first;  /* of its lowest row */
    ptrdiff_t stride; /* to the next row above */
    bool streamed; /* by non-temporal stores, which take whole lines of them (resolve.c). Others see what is written so
                      as zr_vi_stream says. */
};

/* Where what is shaded of a tile goes. */
struct zr_tile_targets {
    struct zr_pixel_rows channels[ZR_CHANNEL_COUNT]; /* where `first` is NULL, it is not wanted */
    uint32_t nothing;                                /* the colour where nobody is seen, but for what is */
    struct zr_pixel_rows behind;                     /* there, if that is not NULL */
    float normals_to_space[3][3];                    /* rows of what leads from eye space there */
};

struct zr_paint {
    void (*shade)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                  const struct zr_tile *tile, const struct zr_tile_targets *to);

    /* The samples of a tile, all of whose blocks are written; its first one is at the first of `to`, where up to 15
     * beyond its width may be written, and 7 rows beyond its height. */
    void (*samples)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                    const struct zr_tile *tile, const struct zr_gbuffer *to);

    /* Red, green, blue and opacity of the samples of a tile, 0..1, in rows of ZR_TILE_STRIDE; 0 where nobody is seen.
     * All of its blocks are written. */
    void (*floats)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                   const struct zr_tile *tile, float *const out[4]);

    /* The opacity alone. */
    void (*opacity)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                    const struct zr_tile *tile, float *out);

    /* Where the tile has an owner, front over what is there, in rows of ZR_TILE_STRIDE. Both have an opacity, and
     * `to` has its colours times that. Exact: each product and sum is rounded, as GL's blending into floats does. */
    void (*blend)(const struct zr_tile *tile, const float *const front[4], float *const to[4]);

    /* What `blend` made of a tile, as bytes: where the tile has an owner, or a list whose end in ends[] is not that of
     * the list before it (zr_fragments); elsewhere `nothing`. Owned samples are opaque; all are, if is_opaque, whatever
     * rounding made of their opacities. */
    void (*pack)(const struct zr_tile *tile, const float *const sum[4], const uint32_t *ends, bool is_opaque,
                 uint32_t nothing, const struct zr_pixel_rows *out);

    /* The depths of a tile. Where some are not written, none of its blocks is cut. */
    void (*depths)(const struct zr_tile *tile, const struct zr_pixel_rows *out);

    /* How many pixels belong to primitives. */
    uint32_t (*count)(const struct zr_tile *tile);

    /* Where runs end in a row of a tile: bit i, where owners[i] is the last of its own among the first `width`. */
    uint64_t (*ends)(const uint32_t *owners, int32_t width);

    /* All of one value, or those of a tile's array. */
    void (*fill)(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value);
    void (*copy)(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in);
};

/* zr_paint.floats and zr_paint.opacity. */
typedef void zr_paint_floats_fn(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                                const struct zr_tile *tile, float *const out[4]);
typedef void zr_paint_opacity_fn(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                                 const struct zr_tile *tile, float *out);

ZR_KERNEL_TABLE(zr_paint_floats_fn, zr_paint_floats)
ZR_KERNEL_TABLE(zr_paint_opacity_fn, zr_paint_opacity)

ZR_KERNEL_TABLE(const struct zr_paint, zr_paint)

/* Whether tiny triangles are painted while they are sorted, and small ones that lie in stamps when they are drawn, in
 * tiles that keep words (binned_scene.c): their corners are at hand then, and those of neighbours in the mesh stand
 * together, while later each pixel asks memory for its own (a tenth of the time of a million smooth triangles), and
 * triangles must be found again that were just set up (a quarter of the bunny's at 512x512). Flat ones ask for the same
 * either way; and where backs are drawn too, half of what would be painted is hidden. */
static inline bool zr_draw_is_painted_early(const struct zr_draw_attributes *surface)
{
    return zr_draw_is_plain(surface->draw) && !zr_draw_is_see_through(surface->draw) && zr_draw_is_smooth(surface) &&
           !surface->is_per_pixel && !surface->draw->material->double_sided;
}

/* What raster/ carries along, one a draw: which are painted early, where what is known of sides goes when they are
 * sorted, what to ask for first. And packs the colours of flat draws that have few of them for so many pixels: each is
 * then looked up in one place, and not in three (0.2 ms of the bunny at 1920x1080). ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_paint_prepare(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                struct zr_scene_attributes *surfaces, uint64_t pixels,
                                const struct zr_prepaint **payloads);

#endif
