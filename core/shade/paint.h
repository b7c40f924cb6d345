/* paint.h - shade: a tile's owners -> colours, ids and normals. A kernel.
 *
 * Exact:  the reference's rule 9: colours times 1/w are planes over the window, each pixel divides by the plane of
 *         1/w, and bytes are rounded to the nearest.
 * How:    planes are not kept from the drawing of visibility: only what is seen is set up, but for tiny and small
 *         triangles that are painted early. The tile's owners are split into parts (parts_simd.h); ZR_LANES parts at a
 *         time are looked up and given a word, where they are flat, or planes; then, patch by patch, each pixel takes
 *         its part's.
 */
#ifndef ZR_PAINT_H
#define ZR_PAINT_H

#include "base/isa.h"
#include "geometry/colors.h"
#include "geometry/geometry.h"
#include "geometry/record.h"
#include "raster/plane.h"
#include "raster/tile.h"

/* Values that vary over a surface: a colour; and of what is shaded late, a normal and the way from the eye to it. */
enum { ZR_VALUES_FEW = 3, ZR_VALUES_MOST = 9 };

/* What the pixels of one record are painted with. */
struct zr_surface {
    bool flat;
    uint32_t color; /* flat: four bytes */
    /* Else planes of 1/w, and of values times that: a colour, and, where `material` says that it is shaded late, a
     * normal of the side that is seen, and the way from the eye, both in eye space. */
    struct zr_plane planes[1 + ZR_VALUES_MOST];
    const struct zr_material *material; /* NULL: what the colour's planes show is what is seen */
};

/* Of the normals alone; flat ones have planes that are the same all over, over a w of 1. */
struct zr_surface zr_surface_normals(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number);

/* Of a record of the batch, line or triangle. */
struct zr_surface zr_surface_make(const struct zr_geometry *geometry, const struct zr_batch *batch, uint32_t number);

/* Four words a colour: their numbers, fronts and backs one behind the other, fit 31 bits. */
enum { ZR_GATHERED_MOST = 1 << 28 };

/* Whether what triangles show can be looked up many at once, by their numbers. */
static inline bool zr_batch_is_gathered(const struct zr_batch *batch)
{
    return !batch->written && batch->count > 0 && batch->count <= ZR_GATHERED_MOST &&
           batch->mesh->face_offsets[batch->mesh->face_count] <= ZR_GATHERED_MOST &&
           batch->mesh->position_count <= ZR_GATHERED_MOST;
}

/* Whether tiny triangles are painted while they are sorted, and small ones that lie in stamps when they are drawn, in
 * tiles that keep colours (visibility.c): their corners are at hand then, and those of neighbours in the mesh stand
 * together, while later each pixel asks memory for its own (a tenth of the time of a million smooth triangles), and
 * triangles must be found again that were just set up (a quarter of the bunny's at 512x512). Flat ones ask for the same
 * either way; and where backs are drawn too, half of what would be painted is hidden. */
static inline bool zr_batch_is_painted_early(const struct zr_batch *batch)
{
    return zr_batch_is_gathered(batch) && zr_batch_is_smooth(batch) && !batch->double_sided &&
           !zr_material_is_shaded_late(batch->material);
}

/* Where a tile lies in a channel, whose values have four bytes each. */
struct zr_pixel_rows {
    uint32_t *first;  /* of its lowest row */
    ptrdiff_t stride; /* to the next row above */
    bool streamed;    /* past the caches, which takes whole lines of them (resolve.c). Others see what is written so
                         as zr_vi_stream says. */
};

/* Where what is shaded of a tile goes: where `first` is NULL, it is not wanted. */
struct zr_shaded {
    struct zr_pixel_rows colors;           /* RGBA of four bytes */
    uint32_t nothing;                      /* the colour where nobody is seen, but for what is */
    struct zr_pixel_rows behind;           /* there, if that is not NULL */
    struct zr_pixel_rows faces, instances; /* ids of faces and of instances; 0 where nobody is seen */
    struct zr_pixel_rows normals;          /* three floats: of the side that is seen, 0 where nobody or a line is */
    float normals_to_space[3][3];          /* rows of what leads from eye space there */
    zr_vec4 eye;                           /* zr_camera_eye */
    bool is_shaded_late;                   /* some surfaces are (zr_material_is_shaded_late) */
};

struct zr_paint {
    void (*shade)(const struct zr_geometry *geometry, const struct zr_tile *tile, const struct zr_shaded *to);

    /* The depths of a tile. Where some are not written, none of its blocks is cut. */
    void (*depths)(const struct zr_tile *tile, const struct zr_pixel_rows *out);

    /* How many pixels belong to records. */
    uint32_t (*count)(const struct zr_tile *tile);

    /* Where runs end in a row of a tile: bit i, where owners[i] is the last of its own among the first `width`. */
    uint64_t (*ends)(const uint32_t *owners, int32_t width);

    /* All of one value, or those of a tile's array. */
    void (*fill)(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value);
    void (*copy)(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in);
};

extern const struct zr_paint zr_paint_scalar, zr_paint_sse2, zr_paint_avx2, zr_paint_avx512, zr_paint_neon;

const struct zr_paint *zr_paint_of(enum zr_isa isa);

/* Before the geometry is sorted, as sorting asks for what this says in its batches: which are painted early, where what
 * is known of sides goes when they are sorted. And packs the colours of other flat batches that have few of them for so
 * many pixels: each is then looked up in one place, and not in three (0.2 ms of the bunny at 1920x1080). ZR_OK or
 * ZR_NO_MEMORY. */
enum zr_status zr_paint_prepare(struct zr_arena *arena, struct zr_team *team, struct zr_geometry *geometry,
                                uint64_t pixels);

#endif
