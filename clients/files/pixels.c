#include "pixels.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

#include "input/images/image_read.h"

enum { TEXELS_MAX = 1 << 28 };

struct reading {
    const unsigned char *at, *end;
    struct bytes *faults;
};

static void read_bytes(png_structp png, png_bytep out, size_t size)
{
    struct reading *reading = png_get_io_ptr(png);
    if ((size_t)(reading->end - reading->at) < size) png_error(png, "it ends too early");
    memcpy(out, reading->at, size);
    reading->at += size;
}

static void fail(png_structp png, png_const_charp text)
{
    struct reading *reading = png_get_error_ptr(png);
    bytes_print(reading->faults, "it is not a readable PNG: %s", text);
    png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp text)
{
    (void)png, (void)text;
}

/* Reads rows as RGBA of 8 or 16 bits. */
static void read_rows(png_structp png, png_infop info, struct pixels *pixels, png_bytep *row)
{
    png_read_info(png, info);
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    pixels->width = png_get_image_width(png, info);
    pixels->height = png_get_image_height(png, info);
    pixels->is_16_bit = png_get_bit_depth(png, info) == 16;
    png_set_add_alpha(png, 65535, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const size_t row_size = png_get_rowbytes(png, info), count = (size_t)pixels->width * 4;
    pixels->rgba = calloc((size_t)pixels->height * count, sizeof *pixels->rgba);
    *row = calloc(pixels->height, row_size);
    if (!pixels->rgba || !*row) png_error(png, "out of memory");
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < pixels->height; y++)
            png_read_row(png, *row + y * row_size, NULL);
    for (uint32_t y = 0; y < pixels->height; y++)
        for (size_t i = 0; i < count; i++) {
            const png_bytep at = *row + y * row_size + i * (pixels->is_16_bit ? 2 : 1);
            pixels->rgba[y * count + i] = pixels->is_16_bit ? (uint16_t)(at[0] << 8 | at[1]) : at[0];
        }
}

static bool begins(const void *data, size_t size, const char *text, size_t text_size)
{
    return size >= text_size && memcmp(data, text, text_size) == 0;
}

/* Returns what a file is that begins as no PNG does. */
static const char *format_of(const void *data, size_t size)
{
    static const struct {
        const char *text;
        size_t size;
        const char *name;
    } rows[] = {{"GIF8", 4, "a GIF"},
                {"II*", 4, "a TIFF"},
                {"\x93NUMPY", 6, "an NPY file"},
                {"PF\n", 3, "a PFM file"},
                {"<svg", 4, "an SVG"},
                {"<?xml", 5, "an XML file"},
                {"PK\3\4", 4, "a ZIP archive"},
                {"version https://git", 19, "a pointer of Git LFS, whose file is missing"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (begins(data, size, rows[i].text, rows[i].size)) return rows[i].name;
    return size ? "another file" : "empty";
}

bool pixels_are_in(const void *head, size_t size)
{
    static const struct {
        const char *text;
        size_t size;
    } rows[] = {
        {"\x89PNG\r\n\x1a\n", 8}, {"\xff\xd8\xff", 3}, {"RIFF", 4}, {"GIF8", 4}, {"II*", 4}, {"MM\0*", 4}, {"PF\n", 3},
        {"\x93NUMPY", 6}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (begins(head, size, rows[i].text, rows[i].size)) return true;
    return false;
}

/* Copies an image of the core. False without memory. */
static bool take_image(struct pixels *pixels, const struct zr_image *image)
{
    const size_t count = 4 * (size_t)image->width * image->height;
    *pixels = (struct pixels){.width = image->width, .height = image->height, .is_16_bit = image->bits == 16};
    pixels->rgba = malloc(count * sizeof *pixels->rgba);
    for (size_t i = 0; pixels->rgba && i < count; i++)
        pixels->rgba[i] =
            image->bits == 16 ? ((const uint16_t *)image->texels)[i] : ((const uint8_t *)image->texels)[i];
    return pixels->rgba;
}

/* Decodes a JPEG or a WebP as textures are. */
static bool read_lossy(struct pixels *pixels, const void *data, size_t size, struct bytes *faults)
{
    const struct zr_encoded_image file = {.bytes = data, .size = size, .texels_max = TEXELS_MAX};
    struct zr_arena arena;
    struct zr_image image;
    struct zr_reason reason;
    zr_arena_init(&arena, SIZE_MAX / 2);
    const enum zr_status status = zr_image_read(&arena, &file, &image, &reason);
    const bool ok = status == ZR_OK && take_image(pixels, &image);
    if (!ok) bytes_print(faults, "%s", status == ZR_BAD_SCENE ? reason.text : "out of memory");
    zr_arena_free(&arena);
    return ok;
}

bool pixels_read(struct pixels *pixels, const void *data, size_t size, struct bytes *faults)
{
    *pixels = (struct pixels){.width = 0};
    if (begins(data, size, "\xff\xd8\xff", 3) || begins(data, size, "RIFF", 4))
        return read_lossy(pixels, data, size, faults);
    if (!begins(data, size, "\x89PNG\r\n\x1a\n", 8)) {
        bytes_print(faults, "it is %s: PNG, JPEG and WebP are compared; draw it with the ending .png, or convert it",
                    format_of(data, size));
        return false;
    }
    struct reading reading = {data, (const unsigned char *)data + size, faults};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, fail, ignore);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_bytep *volatile rows = calloc(1, sizeof *rows);
    volatile bool ok = false;
    if (info && rows && setjmp(png_jmpbuf(png)) == 0) {
        png_set_read_fn(png, &reading, read_bytes);
        read_rows(png, info, pixels, rows);
        ok = true;
    }
    if (rows) free(*rows);
    free(rows);
    png_destroy_read_struct(&png, &info, NULL);
    if (!ok) pixels_free(pixels);
    return ok;
}

void pixels_free(struct pixels *pixels)
{
    free(pixels->rgba);
    pixels->rgba = NULL;
}

bool pixels_write(struct bytes *bytes, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = PNG_FORMAT_RGB};
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    char *data = malloc(size);
    if (!data || !png_image_write_to_memory(&image, data, &size, 0, rgb, 0, NULL)) {
        free(data);
        return false;
    }
    *bytes = (struct bytes){.data = data, .size = size, .room = size};
    return true;
}
