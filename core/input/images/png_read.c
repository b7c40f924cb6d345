#include "input/images/image_file.h"

#include <inttypes.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

#include "base/cancel.h"

/* Offsets: behind the signature comes IHDR with its length, name, width, height and bits per channel. */
enum { SIGNATURE = 8, IHDR_NAME = 12, WIDTH = 16, HEIGHT = 20, BITS = 24, HEAD = 33 };

/* Larger than all chunks that are read: a palette and its alpha. */
enum { CHUNK_BYTES_MAX = 4096, PUSHED = 4096 };

/* Context of libpng's callbacks. The file is pushed through libpng, so that reading stops at the last row. Its pull
 * interface would inflate all data after it. */
struct reading {
    struct zr_arena *arena; /* for libpng's memory */
    struct zr_reason *reason;
    uint32_t width, height;
    size_t row_bytes;
    uint8_t *rgba;
    bool is_strict; /* reads to the end of the file, and treats a warning as an error */
    int passes;
    bool has_rows, done;
};

static void leave(png_structp png, png_const_charp message)
{
    struct reading *reading = png_get_error_ptr(png);
    zr_reason_give(reading->reason, "a broken PNG: %s", message);
    png_longjmp(png, 1);
}

/* Warnings concern broken files only: chunks beside the picture are not pushed. */
static void take_warning(png_structp png, png_const_charp message)
{
    const struct reading *reading = png_get_error_ptr(png);
    if (reading->is_strict) png_error(png, message);
}

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    struct reading *reading = png_get_mem_ptr(png);
    return zr_arena_alloc(reading->arena, size, 1);
}

static void keep(png_structp png, png_voidp pointer)
{
    (void)png; /* the arena frees it */
    (void)pointer;
}

static uint32_t big_endian(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

bool zr_png_head_read(const void *bytes, size_t size, struct zr_png_head *head)
{
    const unsigned char *at = bytes;
    if (size < HEAD || png_sig_cmp(at, 0, SIGNATURE) != 0 || memcmp(at + IHDR_NAME, "IHDR", 4) != 0) return false;
    *head = (struct zr_png_head){big_endian(at + WIDTH), big_endian(at + HEIGHT), at[BITS]};
    return true;
}

/* Checks the header before libpng reads the file, so that a picture of the wrong size costs no time. */
static bool check_head(const struct zr_parsed_bytes *file, const struct zr_png_head *wanted, struct zr_reason *reason)
{
    struct zr_png_head head;
    if (!zr_png_head_read(file->bytes, file->size, &head))
        zr_reason_give(reason, "not a PNG");
    else if (head.width != wanted->width || head.height != wanted->height)
        zr_reason_give(reason, "%" PRIu32 " x %" PRIu32 " pixels, not the window's %" PRIu32 " x %" PRIu32, head.width,
                       head.height, wanted->width, wanted->height);
    else if (head.bits > wanted->bits)
        zr_reason_give(reason, "%" PRIu32 " bits per channel; %" PRIu32 " are needed", head.bits, wanted->bits);
    else
        return true;
    return false;
}

/* Converts to RGBA of 8 or 16 bits per channel. Returns the number of passes; an interlaced picture has several. */
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
        png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER); /* with 8 bits, libpng uses the lower byte */
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    if (png_get_bit_depth(png, info) == 16) png_set_swap(png);
#endif
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return passes;
}

static void begin_rows(png_structp png, png_infop info)
{
    struct reading *reading = png_get_progressive_ptr(png);
    reading->passes = set_transforms(png, info);
    if (png_get_rowbytes(png, info) != reading->row_bytes) png_error(png, "its rows are not RGBA");
}

static void take_row(png_structp png, png_bytep row, png_uint_32 number, int pass)
{
    struct reading *reading = png_get_progressive_ptr(png);
    if (zr_is_cancelled(reading->arena->cancel))
        png_error(png, "reading was stopped"); /* a few bytes may decode to many rows */
    if (number < reading->height) png_progressive_combine_row(png, reading->rgba + number * reading->row_bytes, row);
    reading->has_rows = pass + 1 >= reading->passes && number + 1 >= reading->height;
    reading->done = reading->has_rows && !reading->is_strict;
}

static void take_end(png_structp png, png_infop info)
{
    struct reading *reading = png_get_progressive_ptr(png);
    (void)info;
    if (!reading->has_rows) png_error(png, "it lacks rows");
    reading->done = true;
}

/* Pushes blocks of bytes until the last row is complete; the bytes after it are neither read nor inflated. */
static void push(png_structp png, png_infop info, const unsigned char *bytes, size_t size,
                 const struct reading *reading)
{
    unsigned char part[PUSHED];
    for (size_t at = 0; at < size && !reading->done; at += PUSHED) {
        size_t count = size - at < PUSHED ? size - at : PUSHED;
        if (zr_is_cancelled(reading->arena->cancel)) png_error(png, "reading was stopped");
        memcpy(part, bytes + at, count); /* libpng takes bytes that are not const */
        png_process_data(png, info, part, count);
    }
}

static bool is_wanted(const unsigned char *name)
{
    static const char wanted[][5] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (memcmp(name, wanted[i], 4) == 0) return true;
    return false;
}

/* Pushes the chunks of the picture. Skips all others: text and profiles may be large or compressed. */
static void push_chunks(png_structp png, png_infop info, const unsigned char *bytes, size_t size,
                        const struct reading *reading)
{
    enum { LENGTH_AND_NAME = 8, FRAME = 12 };
    push(png, info, bytes, SIGNATURE, reading);
    for (size_t at = SIGNATURE; !reading->done;) {
        if (size - at < LENGTH_AND_NAME) png_error(png, "it ends too early");
        size_t length = big_endian(bytes + at), left = size - at;
        bool idat = memcmp(bytes + at + 4, "IDAT", 4) == 0, whole = length <= left && left - length >= FRAME;
        if (!whole && !idat) png_error(png, "it ends too early");
        if (!idat && length > CHUNK_BYTES_MAX && is_wanted(bytes + at + 4)) png_error(png, "a chunk is too large");
        size_t chunk = whole ? length + FRAME : left;
        if (is_wanted(bytes + at + 4)) push(png, info, bytes + at, chunk, reading);
        at += chunk;
    }
}

static void set_bounds(png_structp png, uint32_t width, uint32_t height)
{
    png_set_user_limits(png, width, height);
    png_set_chunk_malloc_max(png, CHUNK_BYTES_MAX);
    png_set_chunk_cache_max(png, 1); /* 0 means no limit; 1 allows none */
}

/* Decodes the file into reading->rgba. */
static enum zr_status read_rows(struct reading *reading, const void *bytes, size_t size)
{
    png_structp png =
        png_create_read_struct_2(PNG_LIBPNG_VER_STRING, reading, leave, take_warning, reading, allocate, keep);
    if (!png) return ZR_NO_MEMORY;
    png_infop info = png_create_info_struct(png);
    /* libpng's errors jump here, at most once. The code behind the jump reads no variable that is set after setjmp. */
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        if (!zr_arena_ok(reading->arena)) return ZR_NO_MEMORY;
        return zr_is_cancelled(reading->arena->cancel) ? ZR_CANCELLED : ZR_BAD_SCENE;
    }
    set_bounds(png, reading->width, reading->height);
    png_set_progressive_read_fn(png, reading, begin_rows, take_row, take_end);
    push_chunks(png, info, bytes, size, reading);
    png_destroy_read_struct(&png, &info, NULL);
    return ZR_OK;
}

enum zr_status zr_png_read(struct zr_arena *arena, const struct zr_parsed_bytes *file, const struct zr_png_head *wanted,
                           uint8_t **rgba, struct zr_reason *reason)
{
    if (!check_head(file, wanted, reason)) return ZR_BAD_SCENE;
    *rgba = zr_arena_zero(arena, (size_t)wanted->width * wanted->height, 4);
    if (!*rgba) return ZR_NO_MEMORY;
    struct reading reading = {.arena = arena,
                              .reason = reason,
                              .width = wanted->width,
                              .height = wanted->height,
                              .row_bytes = (size_t)wanted->width * 4,
                              .rgba = *rgba};
    return read_rows(&reading, file->bytes, file->size);
}

enum zr_status zr_png_read_whole(struct zr_arena *arena, const struct zr_encoded_image *file,
                                 const struct zr_png_head *head, void *rgba, struct zr_reason *reason)
{
    struct reading reading = {.arena = arena,
                              .reason = reason,
                              .width = head->width,
                              .height = head->height,
                              .row_bytes = (size_t)head->width * (head->bits == 16 ? 8 : 4),
                              .rgba = rgba,
                              .is_strict = true};
    return read_rows(&reading, file->bytes, file->size);
}
