#include "bench/versus/stock_png.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

static size_t pixel_bytes(enum stock_pixels pixels)
{
    return pixels == STOCK_RGB ? 3 : pixels == STOCK_RGBX ? 4 : 2;
}

static bool is_little_endian(void)
{
    const uint16_t one = 1;
    return *(const uint8_t *)&one == 1;
}

static void append(png_structp png, png_bytep bytes, size_t size)
{
    struct stock_file *file = png_get_io_ptr(png);
    if (size > file->room - file->size) {
        size_t room = (file->size + size) * 2;
        uint8_t *wider = realloc(file->bytes, room);
        if (!wider) png_error(png, "out of memory");
        file->bytes = wider;
        file->room = room;
    }
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static void flush(png_structp png)
{
    (void)png;
}

bool stock_png_write(const struct stock_image *image, struct stock_file *file)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    file->size = 0;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    bool grey = image->pixels == STOCK_GREY16;
    png_set_write_fn(png, file, append, flush);
    png_set_IHDR(png, info, image->width, image->height, grey ? 16 : 8, grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);
    if (image->pixels == STOCK_RGBX) png_set_filler(png, 0, PNG_FILLER_AFTER);
    if (grey && is_little_endian()) png_set_swap(png);
    size_t row_bytes = image->width * pixel_bytes(image->pixels);
    for (uint32_t y = 0; y < image->height; y++) {
        uint32_t row = image->bottom_up ? image->height - 1 - y : y;
        png_write_row(png, (png_const_bytep)image->bytes + row * row_bytes);
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}
