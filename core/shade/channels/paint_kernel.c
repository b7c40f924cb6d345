#include "shade/channels/channels_simd.h"
#include "shade/channels/color_simd.h"
#include "shade/lights/gbuffer.h"
#include "shade/paint.h"
#include "shade/varyings_simd.h"

/* ---- samples of a tile, for a G-buffer (gbuffer.h) ---- */

enum { ZR_SAMPLE_VARYINGS = ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_OVER_W };

/* Returns the number of values. They are in the order of the planes behind 1/w. */
static inline int zr_sample_values(unsigned mask)
{
    return zr_plane_count(mask) - 1;
}

ZR_INLINED void zr_make_samples(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const int normal = zr_first_plane(mask, ZR_VARY_NORMAL) - 1, point = zr_first_plane(mask, ZR_VARY_POINT) - 1;
    (void)s;
    (void)context;
    for (int k = 0; k < zr_sample_values(mask); k++)
        values[k] = zr_vf_set(k < point ? 0.0f : ZR_FAR_POINT);
    if (in->count == 0) return;
    const zr_vf w = zr_varying_w(in);
    const struct zr_vec3_v n = zr_normalize_v(zr_varying3(in, 1 + normal, w));
    const zr_vf unit[3] = {n.x, n.y, n.z};
    for (int k = 0; k < zr_sample_values(mask); k++) {
        const bool is_normal = k >= normal && k < point;
        values[k] = zr_vf_select(in->seen, is_normal ? unit[k - normal] : zr_varying(in, 1 + k, w), values[k]);
    }
}

/* Returns the rows of a G-buffer, with those of base colours if it has any. */
static inline struct zr_varying_rows zr_sample_rows_of(const struct zr_gbuffer *to)
{
    struct zr_varying_rows out = {.stride = to->stride};
    int count = 0;
    for (int k = 0; k < 3 && to->base[0]; k++)
        out.of[count++] = to->base[k];
    for (int k = 0; k < 3; k++)
        out.of[count++] = to->normal[k];
    for (int k = 0; k < 3; k++)
        out.of[count++] = to->point[k];
    return out;
}

static inline __attribute__((flatten)) void zr_sample_blocks(struct zr_shader *s, const struct zr_tile *tile, int begin,
                                                             int end, const struct zr_gbuffer *to)
{
    const struct zr_varying_rows rows = zr_sample_rows_of(to);
    enum { PLAIN = ZR_SAMPLE_VARYINGS, COLORED = PLAIN | ZR_VARY_COLOR };
    if (to->base[0])
        zr_varyings_fill(s, tile, begin, end, COLORED, zr_make_samples, NULL, zr_sample_values(COLORED), &rows);
    else
        zr_varyings_fill(s, tile, begin, end, PLAIN, zr_make_samples, NULL, zr_sample_values(PLAIN), &rows);
}

static inline zr_vi zr_material_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                      zr_vi numbers)
{
    (void)geometry;
    (void)numbers;
    return zr_vi_set((int32_t)of_draw->material);
}

static void shade_parts(struct zr_shader *s, const struct zr_tile *tile, const struct zr_tile_targets *to, bool colors,
                        bool others)
{
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    for (int begin = 0, end; (colors || others) && begin < all; begin = end) {
        end = zr_find_parts(s, tile, begin, tile->has_early_color && !others);
        if (colors) zr_shade_colors(s, tile, begin, end, to);
        if (others) zr_shade_channels_of_parts(s, tile, begin, end, to);
    }
}

/* Shades a tile. With early colours, the parts of color leave out their pixels, so other channels find parts of their
 * own. */
static void shade(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                  const struct zr_tile *tile, const struct zr_tile_targets *to)
{
    struct zr_shader s;
    const bool together = !tile->has_early_color, colors = to->channels[ZR_CHANNEL_COLOR].first,
               others = zr_wants_parts(to);
    s.geometry = geometry;
    s.attributes = attributes;
    s.draw = &geometry->draws[0];
    s.model = zr_model_context_of(&attributes->lighting, attributes->eye, &attributes->fog);
    shade_parts(&s, tile, to, colors, others && together);
    if (!together) shade_parts(&s, tile, to, false, others);
    zr_shade_channels_of_words(&s, tile, to);
}

/* ---- blending ---- */

static void blend(const struct zr_tile *tile, const float *const front[4], float *const to[4])
{
    const zr_vf one = zr_vf_set(1.0f);
    for (int32_t i = 0; i < tile->height * ZR_TILE_STRIDE; i += ZR_LANES) {
        const zr_vm here = zr_vi_lt(zr_vi_set(0), zr_vi_load(tile->owner + i));
        if (!zr_vm_any(here)) continue;
        const zr_vf opacity = zr_vf_load(front[3] + i), rest = one - opacity;
        for (int k = 0; k < 4; k++) {
            const zr_vf source = k < 3 ? zr_vf_load(front[k] + i) * opacity : opacity, old = zr_vf_load(to[k] + i);
            zr_vf_store(to[k] + i, zr_vf_select(here, source + old * rest, old));
        }
    }
}

static void pack(const struct zr_tile *tile, const float *const sum[4], const uint32_t *ends, bool is_opaque,
                 uint32_t clear_value, const struct zr_pixel_rows *out)
{
    const zr_vf one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    for (int32_t y = 0; y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x += ZR_LANES) {
            const int32_t i = y * ZR_TILE_STRIDE + x, columns = tile->width - x;
            const zr_vm owned = zr_vi_lt(zr_vi_set(0), zr_vi_load(tile->owner + i));
            const zr_vi before = zr_vi_load(ends + i);
            const zr_vm uncovered = zr_vi_eq(zr_vi_load(ends + i + 1), before);
            const zr_vf r = zr_vf_load(sum[0] + i), g = zr_vf_load(sum[1] + i), b = zr_vf_load(sum[2] + i);
            zr_vi words = zr_rgba_opaque_v(r, g, b);
            if (!is_opaque) {
                const zr_vf alpha = zr_vf_load(sum[3] + i), over = zr_vf_select(zr_vf_lt(zero, alpha), alpha, one);
                words = zr_vi_select(owned, words, zr_rgba_make_v(r / over, g / over, b / over, alpha));
            }
            words = zr_vi_select(zr_vm_andnot(uncovered, owned), zr_vi_set((int32_t)clear_value), words);
            if (columns >= ZR_LANES)
                zr_vi_put(out->first + y * out->stride + x, words, out->streamed);
            else
                zr_vi_store_first(out->first + y * out->stride + x, words, (uint32_t)columns);
        }
}

/* ---- G-buffers ---- */

static void clear_samples(const struct zr_gbuffer *to, int32_t rows, int32_t columns)
{
    const struct zr_varying_rows out = zr_sample_rows_of(to);
    const int count = to->base[0] ? 9 : 6;
    for (int32_t y = 0; y < rows; y++)
        for (int32_t x = 0; x < columns; x += ZR_LANES) {
            const ptrdiff_t at = y * to->stride + x;
            for (int k = 0; k < count; k++)
                zr_vf_store(out.of[k] + at, zr_vf_set(k < count - 3 ? 0.0f : ZR_FAR_POINT));
            zr_vi_store(to->owner + at, zr_vi_set(0));
            if (to->material) zr_vi_store(to->material + at, zr_vi_set(0));
        }
}

/* Writes the owner of each sample. In whole blocks, the tile's own array may be unwritten. */
static void owner_words(const struct zr_tile *tile, const struct zr_pixel_rows *out)
{
    const struct zr_store to = {tile, false, NULL, out};
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        const uint32_t *owners = &tile->owner[zr_block_first(block)];
        if (tile->has_block_owners && tile->block_owner[block] != ZR_BLOCK_SHARED) {
            zr_store_alike(&to, block, zr_vi_set((int32_t)tile->block_owner[block]));
            continue;
        }
        for (int32_t y = 0; y < ZR_BLOCK_HEIGHT; y++, owners += ZR_TILE_STRIDE)
            for (int32_t x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES)
                zr_store_pixels(&to, zr_block_left(block) + x, zr_block_low(block) + y, zr_vi_load(owners + x));
    }
}

static void samples(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                    const struct zr_tile *tile, const struct zr_gbuffer *to)
{
    struct zr_shader s;
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    const struct zr_pixel_rows owners = {.first = to->owner, .stride = to->stride};
    const struct zr_pixel_rows materials = {.first = to->material, .stride = to->stride};
    if (tile->is_empty) {
        clear_samples(to, tile->height, tile->width);
        return;
    }
    s.geometry = geometry;
    s.attributes = attributes;
    s.draw = &geometry->draws[0];
    for (int begin = 0, end; begin < all; begin = end) {
        end = zr_find_parts(&s, tile, begin, false);
        zr_sample_blocks(&s, tile, begin, end, to);
        if (to->textures) ZR_KERNEL(zr_sample_textures)(&s, tile, begin, end, to);
    }
    if (to->material) zr_shade_words(&s, tile, zr_material_words, 0, &materials);
    owner_words(tile, &owners);
}

/* ---- arrays ---- */

/* Rows have padding, so the last vector may read one owner beyond. */
static uint64_t ends(const uint32_t *owners, int32_t width)
{
    uint64_t out = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi same = zr_vi_load(owners + x), next = zr_vi_load(owners + x + 1);
        out |= (uint64_t)(zr_vm_bits(zr_vi_eq(same, next)) ^ ZR_ALL_BITS) << x;
    }
    const uint64_t last = UINT64_C(1) << (width - 1);
    return (out & (last - 1)) | last;
}

static uint32_t count(const struct zr_tile *tile)
{
    uint32_t owned = 0;
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        if (tile->has_block_owners && tile->block_owner[block] != ZR_BLOCK_SHARED) {
            owned += tile->block_owner[block] > 0 ? ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT : 0;
            continue;
        }
        const uint32_t *owners = &tile->owner[zr_block_first(block)];
        for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, owners += ZR_TILE_STRIDE)
            for (int v = 0; v < ZR_BLOCK_PARTS; v++)
                owned +=
                    (uint32_t)__builtin_popcount(zr_vm_bits(zr_vi_lt(zr_vi_set(0), zr_vi_load(owners + v * ZR_LANES))));
    }
    return owned;
}

static void fill(const struct zr_pixel_rows *out, int32_t width, int32_t height, uint32_t value)
{
    const zr_vi values = zr_vi_set((int32_t)value);
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_put(to + x, values, out->streamed);
        if (x < width) zr_vi_store_first(to + x, values, (uint32_t)(width - x));
    }
}

static void copy(const struct zr_pixel_rows *out, int32_t width, int32_t height, const void *in)
{
    const uint32_t *from = in;
    uint32_t *to = out->first;
    for (int32_t y = 0; y < height; y++, from += ZR_TILE_STRIDE, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= width; x += ZR_LANES)
            zr_vi_put(to + x, zr_vi_load(from + x), out->streamed);
        if (x < width) zr_vi_store_first(to + x, zr_vi_load(from + x), (uint32_t)(width - x));
    }
}

static void depths(const struct zr_tile *tile, const struct zr_pixel_rows *out)
{
    if (tile->unwritten == 0) {
        copy(out, tile->width, tile->height, tile->depth);
        return;
    }
    for (uint32_t bits = zr_tile_blocks(tile); bits; bits &= bits - 1) {
        const int block = zr_lowest_bit(bits);
        struct zr_pixel_rows to = *out;
        to.first +=
            block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT * out->stride + block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
        if (tile->unwritten >> block & 1)
            zr_block_write_depths(tile, block, (float *)to.first, to.stride, to.streamed);
        else
            copy(&to, ZR_BLOCK_WIDTH, ZR_BLOCK_HEIGHT, tile->depth + zr_block_first(block));
    }
}

const struct zr_paint ZR_KERNEL(zr_paint) = {
    shade, samples, owner_words, ZR_KERNEL(zr_paint_floats), ZR_KERNEL(zr_paint_opacity), blend, pack, depths, count,
    ends,  fill,    copy};
