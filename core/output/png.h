/* png.h - output: pixels -> PNG, through libpng.
 *
 * Row 0 is the top. No time stamps: the same pixels give the same bytes.
 */
#ifndef ZR_PNG_H
#define ZR_PNG_H

#include "output/buffer.h"
#include "zraster.h"

enum zr_png_kind {
    ZR_PNG_RGB,   /* of RGBA, 4 bytes a pixel; alpha is left out */
    ZR_PNG_RGBA,  /* of the same */
    ZR_PNG_GREY16 /* of uint16_t in the machine's order */
};

struct zr_png {
    enum zr_png_kind kind;
    uint32_t width, height;
    const void *pixels;
    const char *text; /* a comment kept in the file, ASCII; NULL: none */
};

/* Appends the file to `out`. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED or ZR_INTERNAL. */
enum zr_status zr_png_write(const struct zr_png *image, const struct zr_cancel *cancel, struct zr_buffer *out);

#endif
