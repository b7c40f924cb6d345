#include "output/png.h"

#include <png.h>
#include <setjmp.h>

enum { ROWS_A_CANCEL_CHECK = 64 };

/* Only errors leave a mark; libpng would print both. */
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
    (void)png; /* the arena gives it back */
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

/* Filter UP and run lengths at level 1: of libpng's settings the fastest by far on
 * rendered pictures, and smaller than most (make bench shows encode times). */
static void set_header(png_structp png, png_infop info, const struct zr_png *image)
{
    bool grey = image->kind == ZR_PNG_GREY16;
    int color = grey ? PNG_COLOR_TYPE_GRAY : image->kind == ZR_PNG_RGB ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_IHDR(png, info, image->width, image->height, grey ? 16 : 8, color, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, 3 /* Z_RLE */);
    if (image->text) {
        char key[] = "Comment";
        png_text text = {
            .compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = (png_charp)(uintptr_t)image->text};
        png_set_text(png, info, &text, 1);
    }
    png_write_info(png, info);
    if (image->kind == ZR_PNG_RGB) png_set_filler(png, 0, PNG_FILLER_AFTER);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    if (grey) png_set_swap(png);
#endif
}

/* False where it was cancelled. */
static bool write_rows(png_structp png, const struct zr_png *image, const struct zr_cancel *cancel)
{
    size_t stride = (size_t)image->width * (image->kind == ZR_PNG_GREY16 ? 2 : 4);
    const unsigned char *row = image->pixels;
    for (uint32_t y = 0; y < image->height; y++, row += stride) {
        if (y % ROWS_A_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        png_write_row(png, row);
    }
    return true;
}

enum zr_status zr_png_write(const struct zr_png *image, const struct zr_cancel *cancel, struct zr_buffer *out)
{
    png_structp png =
        png_create_write_struct_2(PNG_LIBPNG_VER_STRING, NULL, leave, ignore_warning, out, allocate, keep);
    if (!png) return ZR_NO_MEMORY;
    png_infop info = png_create_info_struct(png);
    /* Nothing that is set below is read after the jump; it lands here, once. */
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return zr_arena_ok(out->arena) ? ZR_INTERNAL : ZR_NO_MEMORY;
    }
    png_set_write_fn(png, out, append, flush);
    set_header(png, info, image);
    bool whole = write_rows(png, image, cancel);
    if (whole) png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return whole ? ZR_OK : ZR_CANCELLED;
}
