/* surfaces.h - effects: joins the samples of a pixel that show one surface, so that each surface is lit once.
 *
 * In:     owners of the samples of a tile, 4 x 4 a pixel. Out: the surfaces of each pixel, colours of pixels from those
 *         of surfaces, and the pixels at which surfaces end, which is where edges can be.
 * How:    samples of one primitive are one surface, with the values at their middle. The surface of the sample nearest
 *         to the middle of the pixel leads; of equally near ones, the first, by rows from the lowest. Others of the
 *         same material and base colour join it if their normals differ by at most 6 degrees, and the point of one lies
 *         within 1.5 samples of the plane of the other; the surface then has the mean of their values, by samples.
 *         The others form further surfaces in the same way.
 * Exact:  integers, + - * / in one order: every instruction set and thread count gives the same bytes. */
#ifndef ZR_SURFACES_H
#define ZR_SURFACES_H

#include "base/isa.h"
#include "base/mutant.h"
#include "effects/occlusion.h"
#include "effects/sample_pairs.h"
#include "raster/tile.h"
#include "scene/scene.h"
#include "shade/lights/gbuffer.h"
#include "shade/sample_list.h"

enum {
    ZR_SURFACES_SIDE = 4,                                           /* samples per side of a pixel */
    ZR_SURFACES_COLUMNS = ZR_TILE_SIZE / ZR_SURFACES_SIDE,          /* pixels of a row, at most */
    ZR_SURFACES_PIXELS = ZR_SURFACES_COLUMNS * ZR_SURFACES_COLUMNS, /* of a tile, at most */
    ZR_SURFACES_PER_ROW = ZR_SURFACES_SIDE * ZR_TILE_SIZE           /* of pixels, at most */
};

/* Surfaces of some rows of pixels, in the order of pixels, row by row: at first one for each primitive of a pixel. Most
 * tiles fit whole. */
struct zr_surfaces {
    int32_t columns, rows;                  /* of pixels */
    uint32_t first[ZR_SURFACES_PIXELS + 1]; /* of a pixel */
    struct zr_sample_list list;             /* their middles */
    uint32_t samples[ZR_SAMPLES_ROOM];      /* how many show it */
    uint32_t lead[ZR_SAMPLES_ROOM];         /* the first of its pixel, until they are joined */
    _Alignas(64) float floats[9][ZR_SAMPLES_ROOM];
    float occlusion[ZR_SAMPLES_ROOM], color[3][ZR_SAMPLES_ROOM];
    uint32_t material[ZR_SAMPLES_ROOM];
};

/* Place in a pixel, in samples from the lowest and leftmost. */
struct zr_surface_middle {
    float x, y;
};

/* Returns the middle of the samples of a mask, along one axis. `odd`: those at 1 and 3, `upper`: at 2 and 3. */
static inline float zr_surface_middle_along(uint32_t mask, uint32_t odd, uint32_t upper)
{
    const int steps = __builtin_popcount(mask & odd) + 2 * __builtin_popcount(mask & upper);
    const float middle = (float)steps / (float)__builtin_popcount(mask);
    return ZR_MUTANT(primitives_at_middle, middle, 1.5f);
}

/* Returns the middle of samples. Sample i, of column i % 4 and row i / 4, is bit i of the mask. */
static inline struct zr_surface_middle zr_surface_middle_of(uint32_t mask)
{
    return (struct zr_surface_middle){zr_surface_middle_along(mask, 0xAAAAu, 0xCCCCu),
                                      zr_surface_middle_along(mask, 0xF0F0u, 0xFF00u)};
}

/* Returns the sample of a mask that is nearest to the middle of the pixel; the first of several. */
static inline uint32_t zr_surface_nearest_of(uint32_t mask)
{
    const uint32_t inner = mask & 0x0660u, outer = mask & 0x6996u; /* then the four corners */
    return (uint32_t)__builtin_ctz(inner ? inner : outer ? outer : mask);
}

/* Which samples are near each other. */
struct zr_surface_rule {
    struct zr_pixel_scale scale; /* of the picture's pixels */
};

/* Finds the surfaces of the rows of pixels of a tile from row `from` on, one for each primitive of a pixel, of as many
 * rows as fit. `owners`: of the tile's samples, in rows of ZR_TILE_STRIDE. A kernel. */
typedef void zr_surfaces_find_fn(const uint32_t *owners, const struct zr_tile *tile, int32_t from,
                                 struct zr_surfaces *out);

/* Joins the surfaces of each pixel, whose values are known. A kernel. */
typedef void zr_surfaces_join_fn(const struct zr_surface_rule *rule, struct zr_surfaces *surfaces);

ZR_KERNEL_TABLE(zr_surfaces_find_fn, zr_surfaces_find)
ZR_KERNEL_TABLE(zr_surfaces_join_fn, zr_surfaces_join)

/* Returns the surfaces as a G-buffer of one row. */
struct zr_gbuffer zr_surfaces_gbuffer(struct zr_surfaces *surfaces);

/* Adds up the colours of each pixel of row `row` of the surfaces: out[0..2], and out[3], the covered share. */
void zr_surfaces_put(const struct zr_surfaces *surfaces, int32_t row, float *const out[4]);

/* ---- where surfaces end ---- */

/* The leading surface of each pixel of a tile, in rows of ZR_SURFACES_COLUMNS. */
struct zr_surface_pixels {
    int32_t columns, rows;
    uint32_t owner[ZR_SURFACES_PIXELS + 16];               /* 0: uncovered */
    bool is_split[ZR_SURFACES_PIXELS];                     /* it has several surfaces */
    _Alignas(64) float floats[6][ZR_SURFACES_PIXELS + 16]; /* normal, point */
};

/* Copies the leading surfaces of the rows from `from` on. */
void zr_surfaces_keep(const struct zr_surfaces *surfaces, int32_t from, struct zr_surface_pixels *out);

/* Writes which neighbouring samples may show different surfaces: those of pixels with several, and those at the sides
 * of pixels whose surfaces do not join. A kernel. */
typedef void zr_surfaces_ends_fn(const struct zr_surface_rule *rule, const struct zr_surface_pixels *pixels,
                                 struct zr_sample_pairs *out);

ZR_KERNEL_TABLE(zr_surfaces_ends_fn, zr_surfaces_ends)

/* Samples whose values edges are found from. */
struct zr_edge_samples {
    struct zr_sample_list list;
    uint32_t place[ZR_SAMPLES_ROOM]; /* row * ZR_TILE_STRIDE + column in the tile */
};

/* Lists the covered samples of a row that a pair has or that are at a side of the tile. `owners`: of the tile's
 * samples, in rows of ZR_TILE_STRIDE. */
void zr_surfaces_list_row(const struct zr_sample_pairs *pairs, const struct zr_tile *tile, const uint32_t *owners,
                          int32_t row, struct zr_edge_samples *out);

#endif
