/* striped_images.h - tests: makes PNG files of small images with different texels. */
#ifndef STRIPED_IMAGES_H
#define STRIPED_IMAGES_H

#include <stdbool.h>

#include "support/pictures/png.h"

enum { STRIPED_SIDE = 64, STRIPED_BYTES = STRIPED_SIDE * STRIPED_SIDE * 4 };

/* Returns byte k of the texels of an image, RGBA. */
static inline uint8_t striped_byte(int number, size_t k)
{
    return (uint8_t)(k * (size_t)(number + 1) >> 3);
}

/* Makes the files of the images 0 to count - 1, which the caller frees. */
static inline bool striped_files_make(int count, uint8_t **files, size_t *sizes)
{
    static uint8_t rgba[STRIPED_BYTES];
    for (int i = 0; i < count; i++) {
        for (size_t k = 0; k < STRIPED_BYTES; k++)
            rgba[k] = striped_byte(i, k);
        files[i] = png_memory_write(rgba, STRIPED_SIDE, STRIPED_SIDE, &sizes[i]);
        if (!files[i]) return false;
    }
    return true;
}

#endif
