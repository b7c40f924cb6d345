#include "output/images/png.h"

#include <png.h>
#include <setjmp.h>

#include "base/run.h"
#include "output/images/idat.h"
#include "output/images/palette.h"

enum { ROWS_PER_CANCEL_CHECK = 64 };

/* Discards warnings, which libpng would print. */
static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void leave(png_structp png, png_const_charp message)
{
    (void)message;
    png_longjmp(png, 1);
}

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    struct zr_buffer *out = png_get_mem_ptr(png);
    return zr_arena_alloc(out->arena, size, 1);
}

static void keep(png_structp png, png_voidp pointer)
{
    (void)png; /* the arena frees it */
    (void)pointer;
}

static void append(png_structp png, png_bytep bytes, size_t size)
{
    if (!zr_buffer_add(png_get_io_ptr(png), bytes, size)) png_error(png, "out of memory");
}

static void flush(png_structp png)
{
    (void)png;
}

/* A picture and its encoding. */
struct writing {
    const struct zr_png *image;
    struct zr_palette *palette; /* NULL: none */
    const struct zr_cancel *cancel;
};

static enum zr_layout layout_of(const struct writing *w)
{
    if (w->palette) return ZR_LAYOUT_8;
    return w->image->kind == ZR_PNG_GREY16 ? ZR_LAYOUT_16
           : w->image->kind == ZR_PNG_RGB  ? ZR_LAYOUT_RGB
                                           : ZR_LAYOUT_RGBA;
}

static int color_type(enum zr_layout layout)
{
    static const int types[ZR_LAYOUT_COUNT] = {[ZR_LAYOUT_8] = PNG_COLOR_TYPE_PALETTE,
                                               [ZR_LAYOUT_16] = PNG_COLOR_TYPE_GRAY,
                                               [ZR_LAYOUT_RGB] = PNG_COLOR_TYPE_RGB,
                                               [ZR_LAYOUT_RGBA] = PNG_COLOR_TYPE_RGB_ALPHA};
    return types[layout];
}

/* Returns the bits per index: small files pack several into a byte. */
static int index_bits(const struct writing *w)
{
    uint32_t count = w->palette->count;
    if (w->image->compress != ZR_COMPRESS_SMALL || count > 16) return 8;
    return count > 4 ? 4 : count > 2 ? 2 : 1;
}

static void set_palette(png_structp png, png_infop info, const struct zr_palette *palette)
{
    png_color colors[ZR_PALETTE_MAX];
    png_byte alphas[ZR_PALETTE_MAX];
    for (uint32_t i = 0; i < palette->count; i++) {
        const uint8_t *color = palette->colors[i];
        colors[i] = (png_color){color[0], color[1], color[2]};
        alphas[i] = color[3];
    }
    png_set_PLTE(png, info, colors, (int)palette->count);
    if (palette->transparent) png_set_tRNS(png, info, alphas, (int)palette->transparent, NULL);
}

static void write_head(png_structp png, png_infop info, const struct writing *w)
{
    const struct zr_png *image = w->image;
    enum zr_layout layout = layout_of(w);
    int bits = layout == ZR_LAYOUT_16 ? 16 : w->palette ? index_bits(w) : 8;
    png_set_IHDR(png, info, image->width, image->height, bits, color_type(layout), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    if (w->palette) set_palette(png, info, w->palette);
    if (image->is_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    const png_uint_32 per_metre = (png_uint_32)((double)image->dpi / 0.0254 + 0.5);
    if (per_metre > 0) png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
    if (image->text) {
        char key[] = "Comment";
        png_text text = {
            .compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = (png_charp)(uintptr_t)image->text};
        png_set_text(png, info, &text, 1);
    }
    png_write_info(png, info);
}

static const uint8_t *pixels_of(const struct writing *w)
{
    return w->palette ? w->palette->indices : w->image->pixels;
}

/* ---- fast ---- */

static void write_part(void *png, const uint8_t *bytes, size_t size)
{
    png_write_chunk(png, (png_const_bytep) "IDAT", bytes, size);
}

static enum zr_status write_fast(png_structp png, png_infop info, const struct writing *w, struct zr_team *team)
{
    struct zr_buffer *out = png_get_io_ptr(png);
    const struct zr_idat_image image = {layout_of(w), w->image->width, w->image->height,
                                        pixels_of(w), w->image->rows,  w->image->spans};
    write_head(png, info, w);
    enum zr_status status =
        zr_idat_make(&(struct zr_run){.arena = out->arena, .team = team, .cancel = w->cancel}, &image, write_part, png);
    /* Not png_write_end, which requires that libpng wrote the pixels. */
    if (status == ZR_OK) png_write_chunk(png, (png_const_bytep) "IEND", NULL, 0);
    return status;
}

/* ---- small ---- */

/* Returns false if cancelled. */
static bool write_rows(png_structp png, const struct writing *w)
{
    const size_t stride = (size_t)w->image->width * zr_layout_memory(layout_of(w));
    const struct zr_rows *rows = &w->image->rows;
    const uint8_t *pixels = pixels_of(w);
    uint8_t *made = pixels ? NULL : png_malloc(png, stride);
    for (uint32_t y = 0; y < w->image->height; y++) {
        if (y % ROWS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(w->cancel)) return false;
        if (made) rows->make(rows->source, y, made, false);
        png_write_row(png, made ? made : pixels + y * stride);
    }
    return true;
}

/* Level 7, filter UP and zlib's maximum memory give the smallest files except for level 9, which saves 1 to 5 % in
 * three to nine times the time. Filters chosen per row give 5 to 10 % larger files. (bunny, 1920x1080: flat 334 KB and
 * 63 ms, level 9 335 and 453; smooth 504 and 189, level 9 498 and 524; depth 390 and 88, level 9 389 and 176.) */
static enum zr_status write_small(png_structp png, png_infop info, const struct writing *w)
{
    enum zr_layout layout = layout_of(w);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, 7);
    png_set_compression_mem_level(png, 9);
    png_set_compression_strategy(png, 0 /* Z_DEFAULT_STRATEGY */);
    write_head(png, info, w);
    if (layout == ZR_LAYOUT_RGB) png_set_filler(png, 0, PNG_FILLER_AFTER);
    if (layout == ZR_LAYOUT_8) png_set_packing(png);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    if (layout == ZR_LAYOUT_16) png_set_swap(png);
#endif
    if (!write_rows(png, w)) return ZR_CANCELLED;
    png_write_end(png, NULL);
    return ZR_OK;
}

/* ---- both ---- */

static enum zr_status write_file(const struct writing *w, struct zr_team *team, struct zr_buffer *out)
{
    png_structp png =
        png_create_write_struct_2(PNG_LIBPNG_VER_STRING, NULL, leave, ignore_warning, out, allocate, keep);
    if (!png) return ZR_NO_MEMORY;
    png_infop info = png_create_info_struct(png);
    /* No variable assigned below is read after the jump, which returns here at most once. */
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return zr_arena_ok(out->arena) ? ZR_INTERNAL : ZR_NO_MEMORY;
    }
    png_set_write_fn(png, out, append, flush);
    enum zr_status status =
        w->image->compress == ZR_COMPRESS_SMALL ? write_small(png, info, w) : write_fast(png, info, w, team);
    png_destroy_write_struct(&png, &info);
    return status;
}

enum zr_status zr_png_write(const struct zr_png *image, struct zr_team *team, const struct zr_cancel *cancel,
                            struct zr_buffer *out)
{
    struct zr_palette palette;
    struct writing w = {.image = image, .cancel = cancel};
    if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
    if (image->width < 1 || image->height < 1 || image->width > ZR_IDAT_WIDTH_MAX) return ZR_INTERNAL;
    if (image->kind != ZR_PNG_GREY16 && !image->has_no_palette &&
        zr_palette_make(&palette, out->arena, image->pixels, image->width, image->height, image->spans,
                        image->kind == ZR_PNG_RGB))
        w.palette = &palette;
    return zr_arena_ok(out->arena) ? write_file(&w, team, out) : ZR_NO_MEMORY;
}
