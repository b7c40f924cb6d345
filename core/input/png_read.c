#include "input/png_read.h"

#include <inttypes.h>
#include <png.h>
#include <setjmp.h>
#include <stdbool.h>
#include <string.h>

/* The signature, then IHDR: its length and name, width, height and bits a channel. */
enum { SIGNATURE = 8, IHDR_NAME = 12, WIDTH = 16, HEIGHT = 20, BITS = 24, HEAD = 33 };

/* More than any chunk that is kept: a palette and its alpha. */
enum { CHUNK_BYTES_MAX = 4096 };

struct source {
    struct zr_arena *arena;
    struct zr_reason *reason;
    const unsigned char *at;
    size_t left;
};

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void leave(png_structp png, png_const_charp message)
{
    struct source *source = png_get_error_ptr(png);
    zr_reason_give(source->reason, "a broken PNG: %s", message);
    png_longjmp(png, 1);
}

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    struct source *source = png_get_mem_ptr(png);
    return zr_arena_alloc(source->arena, size, 1);
}

static void keep(png_structp png, png_voidp pointer)
{
    (void)png; /* the arena gives it back */
    (void)pointer;
}

static void give(png_structp png, png_bytep out, size_t size)
{
    struct source *source = png_get_io_ptr(png);
    if (size > source->left) png_error(png, "it ends too early");
    memcpy(out, source->at, size);
    source->at += size;
    source->left -= size;
}

static uint32_t big_endian(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Before libpng sees the file, so that a picture of the wrong size costs nothing. */
static bool check_head(const unsigned char *bytes, size_t size, uint32_t width, uint32_t height,
                       struct zr_reason *reason)
{
    if (size < HEAD || png_sig_cmp(bytes, 0, SIGNATURE) != 0 || memcmp(bytes + IHDR_NAME, "IHDR", 4) != 0) {
        zr_reason_give(reason, "not a PNG");
        return false;
    }
    uint32_t has_width = big_endian(bytes + WIDTH), has_height = big_endian(bytes + HEIGHT);
    if (has_width != width || has_height != height)
        zr_reason_give(reason, "%" PRIu32 " x %" PRIu32 " pixels, not the window's %" PRIu32 " x %" PRIu32, has_width,
                       has_height, width, height);
    else if (bytes[BITS] > 8)
        zr_reason_give(reason, "%u bits a channel; 8 are needed, as pictures here have", bytes[BITS]);
    else
        return true;
    return false;
}

/* To RGBA of 8 bits. Returns how often the rows must be gone through: an interlaced picture
 * comes in several passes. */
static int set_transforms(png_structp png, png_infop info)
{
    int color = png_get_color_type(png, info);
    bool has_key = png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (color == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
    if (!(color & PNG_COLOR_MASK_COLOR)) png_set_gray_to_rgb(png);
    if (has_key)
        png_set_tRNS_to_alpha(png);
    else if (!(color & PNG_COLOR_MASK_ALPHA))
        png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return passes;
}

static void read_rows(png_structp png, png_infop info, uint32_t width, uint32_t height, uint8_t *rgba)
{
    int passes = set_transforms(png, info);
    if (png_get_rowbytes(png, info) != (size_t)width * 4) png_error(png, "its rows are not RGBA");
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < height; y++)
            png_read_row(png, rgba + (size_t)y * width * 4, NULL);
    png_read_end(png, NULL);
}

/* Chunks beside the picture are passed over unread: text and profiles may be packed. */
static void set_bounds(png_structp png, uint32_t width, uint32_t height)
{
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_user_limits(png, width, height);
    png_set_chunk_malloc_max(png, CHUNK_BYTES_MAX);
    png_set_chunk_cache_max(png, 1); /* 0 would be no limit; 1 leaves room for none */
}

enum zr_status zr_png_read(struct zr_arena *arena, const void *bytes, size_t size, uint32_t width, uint32_t height,
                           uint8_t **rgba, struct zr_reason *reason)
{
    if (!check_head(bytes, size, width, height, reason)) return ZR_BAD_SCENE;
    struct source source = {arena, reason, bytes, size};
    *rgba = zr_arena_alloc(arena, (size_t)width * height, 4);
    if (!*rgba) return ZR_NO_MEMORY;
    png_structp png =
        png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &source, leave, ignore_warning, &source, allocate, keep);
    if (!png) return ZR_NO_MEMORY;
    png_infop info = png_create_info_struct(png);
    /* Nothing that is set below is read after the jump; it lands here, once. */
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        return zr_arena_ok(arena) ? ZR_BAD_SCENE : ZR_NO_MEMORY;
    }
    png_set_read_fn(png, &source, give);
    set_bounds(png, width, height);
    png_read_info(png, info);
    read_rows(png, info, width, height, *rgba);
    png_destroy_read_struct(&png, &info, NULL);
    return ZR_OK;
}
