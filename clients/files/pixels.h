/* pixels.h - client: decoded PNGs. */
#ifndef PIXELS_H
#define PIXELS_H

#include <stdint.h>

#include "bytes.h"

struct pixels {
    uint32_t width, height;
    bool is_16_bit;
    uint16_t *rgba; /* 4 per pixel, from the top left; 0..255, or 0..65535 if is_16_bit */
};

/* Decodes a PNG of any kind, a JPEG or a WebP as RGBA, without any conversion of colours. Returns false with a line in *faults on
 * failure. */
bool pixels_read(struct pixels *pixels, const void *png, size_t size, struct bytes *faults);
/* Returns true if a file that begins with these bytes is a picture, of any format. */
enum { PIXELS_HEAD = 16 };
bool pixels_are_in(const void *head, size_t size);

void pixels_free(struct pixels *pixels);

/* Encodes RGB, 8 bits, as a PNG. */
bool pixels_write(struct bytes *png, uint32_t width, uint32_t height, const uint8_t *rgb);

#endif
