/* stock_png.h - bench: PNG by libpng with its default settings, as most programs write it. */
#ifndef ZR_BENCH_STOCK_PNG_H
#define ZR_BENCH_STOCK_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum stock_pixels {
    STOCK_RGB,   /* 3 bytes a pixel */
    STOCK_RGBX,  /* 4 bytes a pixel, the last is left out of the file */
    STOCK_GREY16 /* uint16_t in the machine's order */
};

struct stock_image {
    enum stock_pixels pixels;
    uint32_t width, height;
    bool bottom_up; /* the last row in memory is the top, as GL has it */
    const void *bytes;
};

/* A file in memory that is kept, warm, from one to the next. Zero-initialise; free `bytes`. */
struct stock_file {
    uint8_t *bytes;
    size_t size, room;
};

bool stock_png_write(const struct stock_image *image, struct stock_file *file);

#endif
