/* paint_patches_simd.h - shade: triangles whose colours vary, in patches of the tile, for the paint kernel.
 *
 * A patch is as many pixels as there are lanes: 4x4 of them with 16. Where triangles are larger than pixels, the few
 * that are seen in a patch are found, each is set up once a tile, and their planes are put together lane by lane,
 * so that all pixels are computed at once (1.0 of 2.5 ms of the bunny at 1920x1080). Where nearly each pixel has its
 * own triangle, each lane is set up for itself. Which way is taken changes nothing in the bytes.
 */
#ifndef ZR_PAINT_PATCHES_SIMD_H
#define ZR_PAINT_PATCHES_SIMD_H

#include "shade/paint_smooth_simd.h"

enum {
    ZR_PATCH_KEYS = 1024,           /* by which surfaces are found again */
    ZR_PATCH_PARTS = 1024,          /* what one triangle shows in one patch */
    ZR_PATCHES = 256,               /* that wait to be painted */
    ZR_PATCH_PIXELS = 16 * ZR_LANES /* that wait to be set up for themselves */
};

/* From so many parts on, each pixel of a patch is set up for itself: measured, 10 and 14 of 16 are slower. */
enum { ZR_PATCH_APART = 3 * ZR_LANES / 4 };

struct zr_patch {
    int32_t at;     /* first pixel, in the tile's arrays */
    uint16_t owned; /* lanes that show any */
    uint16_t parts; /* how many */
};

struct zr_patches {
    const struct zr_batch *batch; /* of all that waits */

    /* Patches, and the surfaces of what is seen in them. */
    uint32_t surface_count, ready; /* ready: how many of them are set up */
    uint32_t part_count, patch_count;
    uint32_t owners[ZR_PATCH_PARTS + ZR_LANES]; /* of parts, */
    uint16_t parts[ZR_PATCH_PARTS];             /* and their surfaces */
    struct zr_patch patches[ZR_PATCHES];
    uint32_t keys[ZR_PATCH_KEYS]; /* owners, whose surfaces are */
    uint16_t surfaces[ZR_PATCH_KEYS];
    int32_t numbers[ZR_SMOOTH_ROOM]; /* of the triangles, in the batch */
    float planes[12][ZR_SMOOTH_ROOM];
    struct zr_smooth_corners corners;

    /* Patches whose pixels are set up for themselves. */
    uint32_t pixel_count;
    struct zr_patch pixel_patches[ZR_PATCH_PIXELS / ZR_LANES];
    int32_t pixel_numbers[ZR_PATCH_PIXELS]; /* of the triangles, in the batch */
    struct zr_smooth_corners pixel_corners;
};

static inline void zr_patches_begin(struct zr_patches *p)
{
    p->batch = NULL;
    p->surface_count = p->ready = p->part_count = p->patch_count = p->pixel_count = 0;
}

/* ---- painting ---- */

/* Where a patch's pixels are in the window. */
struct zr_patch_place {
    zr_vf x, y;
};

static inline struct zr_patch_place zr_patch_place(const struct zr_canvas *canvas, int32_t at)
{
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    const zr_vi row = (lane - column) >> (ZR_PATCH_COLUMNS == 4 ? 2 : 0);
    return (struct zr_patch_place){zr_vf_of(zr_vi_set(canvas->x + at % ZR_TILE_STRIDE) + column),
                                   zr_vf_of(zr_vi_set(canvas->y + at / ZR_TILE_STRIDE) + row)};
}
_Static_assert(ZR_PATCH_COLUMNS == 4 || ZR_LANES == 1, "rows are a shift");

/* Lanes that are not owned keep the backdrop, which is there already. */
static inline void zr_patch_store(const struct zr_canvas *canvas, const struct zr_patch *patch, zr_vi colors,
                                  zr_vi back)
{
    if (patch->owned != ZR_ALL_BITS) colors = zr_vi_select(zr_vm_of(patch->owned), colors, back);
    zr_vi_store_patch(canvas->colors + patch->at, ZR_TILE_STRIDE, colors);
}

/* Parts `first` and so on. */
static inline void zr_patch_paint(const struct zr_patches *p, const struct zr_canvas *canvas,
                                  const struct zr_patch *patch, uint32_t first)
{
    const struct zr_patch_place place = zr_patch_place(canvas, patch->at);
    const zr_vi owner = zr_vi_load_patch(canvas->colors + patch->at, ZR_TILE_STRIDE);
    zr_vf c[12];
    for (int k = 0; k < 12; k++)
        c[k] = zr_vf_set(p->planes[k][p->parts[first]]);
    for (uint32_t i = first + 1; i < first + patch->parts; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)p->owners[i]));
        for (int k = 0; k < 12; k++)
            c[k] = zr_vf_select(here, zr_vf_set(p->planes[k][p->parts[i]]), c[k]);
    }
    const struct zr_color_planes planes = {
        {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}, {c[9], c[10], c[11]}};
    zr_patch_store(canvas, patch, zr_color_at(&planes, place.x, place.y), owner);
}

static inline void zr_plane_keep(float (*out)[ZR_SMOOTH_ROOM], uint32_t at, const struct zr_plane_v *plane)
{
    zr_vf_store(&out[0][at], plane->a0);
    zr_vf_store(&out[1][at], plane->dadx);
    zr_vf_store(&out[2][at], plane->dady);
}

/* All that waits. Surfaces stay. */
static inline void zr_patches_paint(struct zr_patches *p, const struct zr_canvas *canvas)
{
    const struct zr_window_vertex *vertices = canvas->geometry->vertices;
    for (uint32_t i = p->surface_count; i > 0 && i < p->surface_count + ZR_LANES; i++)
        p->numbers[i] = p->numbers[i - 1];
    for (uint32_t i = p->ready; i < p->surface_count; i += ZR_LANES)
        zr_smooth_look_up(&p->corners, vertices, p->batch, zr_vi_load(p->numbers + i), i);
    for (; p->ready < p->surface_count; p->ready += ZR_LANES) {
        const struct zr_color_planes planes = zr_color_planes_make(&p->corners, vertices, p->ready);
        zr_plane_keep(p->planes, p->ready, &planes.oow);
        zr_plane_keep(p->planes + 3, p->ready, &planes.red);
        zr_plane_keep(p->planes + 6, p->ready, &planes.green);
        zr_plane_keep(p->planes + 9, p->ready, &planes.blue);
    }
    p->ready = p->surface_count;
    for (uint32_t i = 0, part = 0; i < p->patch_count; part += p->patches[i++].parts)
        zr_patch_paint(p, canvas, &p->patches[i], part);
    p->patch_count = p->part_count = 0;
}

static inline void zr_patch_pixels_paint(struct zr_patches *p, const struct zr_canvas *canvas)
{
    const struct zr_window_vertex *vertices = canvas->geometry->vertices;
    for (uint32_t i = 0; i < p->pixel_count; i += ZR_LANES)
        zr_smooth_look_up(&p->pixel_corners, vertices, p->batch, zr_vi_load(p->pixel_numbers + i), i);
    for (uint32_t i = 0; i < p->pixel_count; i += ZR_LANES) {
        const struct zr_patch *patch = &p->pixel_patches[i / ZR_LANES];
        const struct zr_patch_place place = zr_patch_place(canvas, patch->at);
        const struct zr_color_planes planes = zr_color_planes_make(&p->pixel_corners, vertices, i);
        const zr_vi back = zr_vi_load_patch(canvas->colors + patch->at, ZR_TILE_STRIDE);
        zr_patch_store(canvas, patch, zr_color_at(&planes, place.x, place.y), back);
    }
    p->pixel_count = 0;
}

static inline void zr_patches_end(struct zr_patches *p, const struct zr_canvas *canvas)
{
    zr_patches_paint(p, canvas);
    zr_patch_pixels_paint(p, canvas);
}

/* ---- finding ---- */

/* Which surface each part has from `begin` on; a new one, where it is not remembered. */
static inline void zr_patch_find_surfaces(struct zr_patches *p, uint32_t begin)
{
    const uint32_t first = p->batch->first + 1;
    for (uint32_t i = begin; i < p->part_count; i++) {
        const uint32_t owner = p->owners[i], key = owner % ZR_PATCH_KEYS;
        const bool known = p->keys[key] == owner;
        const uint32_t surface = known ? p->surfaces[key] : p->surface_count;
        p->keys[key] = owner;
        p->surfaces[key] = (uint16_t)surface;
        p->numbers[p->surface_count] = (int32_t)(owner - first);
        __builtin_prefetch(p->batch->corners + 3 * (size_t)(owner - first));
        p->surface_count += !known;
        p->parts[i] = (uint16_t)surface;
    }
}

/* Lanes whose owner is that of the lane n before, which `later` has. */
static inline uint32_t zr_patch_again(zr_vi owner, zr_vi later, int n)
{
    return zr_vm_bits(zr_vi_eq(owner, later)) & ~0u << n;
}

/* Lanes whose owner is not that of the lane before, of the one above or of the one next to that: a triangle has one
 * such lane in the patch, seldom more, and its first lane is always one. What is not owned must be 0. */
static inline uint32_t zr_patch_firsts(zr_vi owner)
{
    uint32_t again = zr_patch_again(owner, zr_vi_later(owner, 1), 1);
    if (ZR_PATCH_ROWS > 1)
        again |= zr_patch_again(owner, zr_vi_later(owner, 3), 3) | zr_patch_again(owner, zr_vi_later(owner, 4), 4);
    return ~again;
}

static inline void zr_patch_add_parts(struct zr_patches *p, int32_t at, zr_vi owner, uint32_t owned, uint32_t firsts)
{
    const uint32_t parts = zr_vi_compress(p->owners + p->part_count, zr_vm_of(firsts & owned), owner);
    p->part_count += parts;
    p->patches[p->patch_count++] = (struct zr_patch){at, (uint16_t)owned, (uint16_t)parts};
}

/* They are looked up when they are painted: by then the numbers of their corners have come from memory (a twentieth of
 * a million triangles' time). */
static inline void zr_patch_add_pixels(struct zr_patches *p, const struct zr_canvas *canvas, int32_t at, zr_vi owner,
                                       uint32_t owned)
{
    uint32_t owners[ZR_LANES];
    if (p->pixel_count == ZR_PATCH_PIXELS) zr_patch_pixels_paint(p, canvas);
    zr_vi_store(owners, owner);
    const zr_vi some = zr_vi_set((int32_t)owners[zr_lowest_bit(owned)]);
    const zr_vi all = zr_vi_select(zr_vm_of(owned), owner, some);
    zr_vi_store(p->pixel_numbers + p->pixel_count, all - zr_vi_set((int32_t)(p->batch->first + 1)));
    for (uint32_t i = p->pixel_count; i < p->pixel_count + ZR_LANES; i++)
        __builtin_prefetch(p->batch->corners + 3 * (size_t)p->pixel_numbers[i]);
    p->pixel_patches[p->pixel_count / ZR_LANES] = (struct zr_patch){at, (uint16_t)owned, 0};
    p->pixel_count += ZR_LANES;
}

/* Room for what a row of patches can have. */
static inline void zr_patches_make_room(struct zr_patches *p, const struct zr_canvas *canvas)
{
    enum { ACROSS = ZR_TILE_SIZE / ZR_PATCH_COLUMNS, PARTS = ACROSS * ZR_PATCH_APART + ZR_LANES };
    const bool is_full = p->surface_count + PARTS > ZR_SMOOTH_MOST;
    if (is_full || p->part_count + PARTS > ZR_PATCH_PARTS || p->patch_count + ACROSS > ZR_PATCHES)
        zr_patches_paint(p, canvas);
    if (is_full) p->surface_count = p->ready = 0;
    if (p->surface_count == 0) memset(p->keys, 0, sizeof p->keys);
}

/* Lanes of the patch, x columns behind the backdrop's first, that nobody owns show what is behind it. */
static inline void zr_patch_back(uint32_t *to, zr_vi owner, zr_vm owned, zr_vm within, int32_t x,
                                 const struct zr_backdrop *backdrop)
{
    if (!backdrop->row) {
        zr_vi_store_patch(to, ZR_TILE_STRIDE, zr_vi_select(owned, owner, backdrop->nothing));
        return;
    }
    for (uint32_t bits = zr_vm_bits(zr_vm_andnot(within, owned)); bits; bits &= bits - 1) {
        const int32_t lane = zr_lowest_bit(bits), row = lane / ZR_PATCH_COLUMNS, column = lane % ZR_PATCH_COLUMNS;
        to[row * ZR_TILE_STRIDE + column] = backdrop->row[row * backdrop->stride + x + column];
    }
}

/* `rows` rows, no more than a patch has, of a batch; `first` is the first pixel of the lowest one. What shows none
 * becomes what is behind. Returns how many pixels are owned. */
static inline uint32_t zr_patches_add_rows(struct zr_patches *p, const struct zr_canvas *canvas,
                                           const struct zr_batch *batch, int32_t first, int32_t width, int32_t rows,
                                           const struct zr_backdrop *backdrop)
{
    uint32_t covered = 0;
    if (p->batch != batch) zr_patches_end(p, canvas);
    p->batch = batch;
    zr_patches_make_room(p, canvas);
    const uint32_t parts_before = p->part_count;
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    const zr_vm low = zr_vi_lt(lane, zr_vi_set(rows * ZR_PATCH_COLUMNS));
    for (int32_t x = 0; x < width; x += ZR_PATCH_COLUMNS) {
        const int32_t at = first + x;
        uint32_t *here = canvas->colors + at;
        const zr_vi owner = zr_vi_load_patch(here, ZR_TILE_STRIDE);
        const zr_vm within = zr_vi_lt_where(low, column, zr_vi_set(width - x));
        const zr_vm seen = zr_vi_lt_where(within, zr_vi_set(0), owner);
        const uint32_t owned = zr_vm_bits(seen);
        if (owned != ZR_ALL_BITS) zr_patch_back(here, owner, seen, within, x, backdrop);
        if (!owned) continue;
        covered += (uint32_t)__builtin_popcount(owned);
        const uint32_t firsts = zr_patch_firsts(zr_vi_select(seen, owner, zr_vi_set(0)));
        if (__builtin_popcount(owned & firsts) >= ZR_PATCH_APART)
            zr_patch_add_pixels(p, canvas, at, owner, owned);
        else
            zr_patch_add_parts(p, at, owner, owned, firsts);
    }
    zr_patch_find_surfaces(p, parts_before);
    return covered;
}

#endif
