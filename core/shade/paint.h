/* paint.h - shade: converts a tile's owners to colours, ids and normals. A kernel.
 *
 * Exact:  the reference's rule 9: values times 1/w are planes over the window. Each pixel divides by the plane of 1/w,
 *         and bytes are rounded to the nearest.
 * How:    rasterization keeps no planes; only visible primitives are set up again, except tiny and small triangles that
 *         are painted early. For colours and normals, the tile's owners are split into parts (shader_simd.h). ZR_LANES
 *         parts at a time get a word if flat, or planes; then each pixel evaluates its part, patch by patch. Ids are
 *         looked up per pixel (channels_simd.h).
 */
#ifndef ZR_PAINT_H
#define ZR_PAINT_H

#include "base/isa.h"
#include "base/run.h"
#include "raster/prepaint.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/lights/gbuffer.h"

/* A tile's rows in a channel of 4-byte values. */
struct zr_pixel_rows {
    uint32_t *first;  /* its lowest row */
    ptrdiff_t stride; /* words to the next row above */
    bool streamed;    /* written by non-temporal stores of whole cache lines (resolve.c); see zr_vi_stream for their
                       * visibility to other threads */
};

/* Output of the shading of a tile. */
struct zr_tile_targets {
    struct zr_pixel_rows channels[ZR_CHANNELS_MAX]; /* `first` NULL: not wanted */
    uint32_t clear_value;                           /* colour of uncovered pixels if `behind` has none */
    struct zr_pixel_rows behind;                    /* supplies uncovered pixels; `first` NULL: none */
    float normals_to_space[3][3];                   /* rows of the matrix from eye space to the channel's */
};

struct zr_paint {
    void (*shade)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                  const struct zr_tile *tile, const struct zr_tile_targets *to);

    /* Writes the G-buffer of a tile whose blocks are all written. The tile's first sample is at the first of `to`. Up
     * to 15 values beyond its width and 7 rows beyond its height may be written. */
    void (*samples)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                    const struct zr_tile *tile, const struct zr_gbuffer *to);

    /* Writes the owners of a tile's samples, as `samples` does. */
    void (*owners)(const struct zr_tile *tile, const struct zr_pixel_rows *out);

    /* Writes red, green, blue and opacity of a tile's samples, 0..1, in rows of ZR_TILE_STRIDE; uncovered samples get
     * 0. All blocks of the tile are written. */
    void (*floats)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                   const struct zr_tile *tile, float *const out[4]);

    /* Writes the opacity alone. */
    void (*opacity)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                    const struct zr_tile *tile, float *out);

    /* Blends `front` over `to` in covered samples, in rows of ZR_TILE_STRIDE. Both have an opacity; `to` is
     * premultiplied. Exact: each product and sum is rounded, as in GL's blending into floats. */
    void (*blend)(const struct zr_tile *tile, const float *const front[4], float *const to[4]);

    /* Packs the sum of `blend` to bytes, in samples that the tile covers or that have a list: its end in ends[] differs
     * from that of the list before (zr_fragments). Other samples get `clear_value`. Samples that the tile covers are
     * opaque; if is_opaque, all are. */
    void (*pack)(const struct zr_tile *tile, const float *const sum[4], const uint32_t *ends, bool is_opaque,
                 uint32_t clear_value, const struct zr_pixel_rows *out);

    /* Writes the depths of a tile. If some blocks are unwritten, all blocks are whole. */
    void (*depths)(const struct zr_tile *tile, const struct zr_pixel_rows *out);

    /* Returns the number of covered pixels. */
    uint32_t (*count)(const struct zr_tile *tile);

    /* Returns the ends of runs in a row of a tile: bit i is set if owners[i] is the last of a run within the first
     * `width`. */
    uint64_t (*ends)(const uint32_t *owners, int32_t width);

    /* Fill with one value, or copy a tile's array. */
    void (*fill)(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value);
    void (*copy)(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in);
};

/* Types of zr_paint.floats and zr_paint.opacity. */
typedef void zr_paint_floats_fn(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                const struct zr_tile *tile, float *const out[4]);
typedef void zr_paint_opacity_fn(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                 const struct zr_tile *tile, float *out);

ZR_KERNEL_TABLE(zr_paint_floats_fn, zr_paint_floats)
ZR_KERNEL_TABLE(zr_paint_opacity_fn, zr_paint_opacity)

ZR_KERNEL_TABLE(const struct zr_paint, zr_paint)

/* Returns true if the draw's triangles get early colours, in tiles that keep them (binned_scene.c). Tiny triangles get
 * theirs while they are binned, small ones when their stamps are drawn. Their corners are loaded then, next to those of
 * their neighbours in the mesh; later, each pixel loads its own (a tenth of the time of a million smooth triangles).
 * Triangles just set up would also be set up again (a quarter of the bunny's time at 512x512). Flat triangles cost the
 * same either way, and with backs drawn, half of the colours would be hidden. */
static inline bool zr_draw_is_painted_early(const struct zr_draw_attributes *of_draw)
{
    return zr_draw_is_plain(of_draw->draw) && !zr_draw_is_see_through(of_draw->draw) && zr_draw_is_smooth(of_draw) &&
           !of_draw->is_per_pixel && !of_draw->draw->material->double_sided;
}

/* Makes the zr_prepaint of each draw for raster/: early painting, the bits of backs, the first address to prefetch.
 * Also packs the colours of flat draws with few colours per pixel, which replaces three look-ups by one (0.2 ms of the
 * bunny at 1920x1080). Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_paint_prepare(const struct zr_run *run, const struct zr_geometry *geometry,
                                struct zr_scene_attributes *attributes, uint64_t pixels,
                                const struct zr_prepaint **prepaints);

/* Colours of smooth triangles, computed at rasterization while their corners are in registers
 * (zr_prepaint_fn). A kernel. */
ZR_KERNEL_TABLE(zr_prepaint_fn, zr_early)

#endif
