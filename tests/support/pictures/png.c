#include "support/pictures/png.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static png_image image_of(uint32_t width, uint32_t height)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGBA;
    return image;
}

bool png_file_write(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height)
{
    png_image image = image_of(width, height);
    if (png_image_write_to_file(&image, path, 0, rgba, 0, NULL)) return true;
    fprintf(stderr, "%s: %s\n", path, image.message);
    return false;
}

uint8_t *png_memory_write(const uint8_t *rgba, uint32_t width, uint32_t height, size_t *size)
{
    png_image image = image_of(width, height);
    png_alloc_size_t room = PNG_IMAGE_PNG_SIZE_MAX(image);
    uint8_t *bytes = malloc(room);
    if (bytes && png_image_write_to_memory(&image, bytes, &room, 0, rgba, 0, NULL)) {
        *size = room;
        return bytes;
    }
    free(bytes);
    return NULL;
}

/* ---- reading ---- */

struct rest {
    const uint8_t *bytes;
    size_t size;
};

static void take(png_structp png, png_bytep bytes, size_t size)
{
    struct rest *rest = png_get_io_ptr(png);
    if (size > rest->size) png_error(png, "the file is too short");
    memcpy(bytes, rest->bytes, size);
    rest->bytes += size;
    rest->size -= size;
}

static size_t pixel_bytes(enum png_pixels pixels)
{
    return pixels == PNG_AS_RGB ? 3 : pixels == PNG_AS_RGBA ? 4 : 2;
}

static void ask_for(png_structp png, enum png_pixels pixels)
{
    png_set_expand(png);
    if (pixels == PNG_AS_GREY16) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
        png_set_swap(png);
#endif
        return;
    }
    png_set_gray_to_rgb(png);
    if (pixels == PNG_AS_RGB)
        png_set_strip_alpha(png);
    else
        png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
}

/* Apart from what follows, for libpng leaves it by longjmp. *out is there before anything can go wrong behind it. */
static bool read_rows(png_structp png, png_infop info, enum png_pixels pixels, uint8_t **out)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_read_info(png, info);
    if ((png_get_bit_depth(png, info) == 16) != (pixels == PNG_AS_GREY16)) return false;
    ask_for(png, pixels);
    png_read_update_info(png, info);
    size_t row_bytes = png_get_image_width(png, info) * pixel_bytes(pixels), height = png_get_image_height(png, info);
    if (png_get_rowbytes(png, info) != row_bytes || png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
        return false;
    *out = malloc(row_bytes * height);
    for (size_t y = 0; *out && y < height; y++)
        png_read_row(png, *out + y * row_bytes, NULL);
    png_read_end(png, NULL);
    return *out != NULL;
}

void *png_memory_read(const void *bytes, size_t size, enum png_pixels pixels, uint32_t *width, uint32_t *height)
{
    struct rest rest = {bytes, size};
    uint8_t *out = NULL;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info) png_set_read_fn(png, &rest, take);
    bool ok = info && read_rows(png, info, pixels, &out) && rest.size == 0;
    if (ok) *width = png_get_image_width(png, info);
    if (ok) *height = png_get_image_height(png, info);
    png_destroy_read_struct(&png, &info, NULL);
    if (ok) return out;
    free(out);
    return NULL;
}
