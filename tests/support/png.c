#include "support/png.h"

#include <png.h>
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

/* Free it; NULL where it is no PNG. */
static uint8_t *decode(const void *bytes, size_t size, png_image *image)
{
    *image = (png_image){.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_memory(image, bytes, size)) return NULL;
    image->format = PNG_FORMAT_RGBA;
    uint8_t *pixels = malloc(PNG_IMAGE_SIZE(*image));
    if (pixels && png_image_finish_read(image, NULL, pixels, 0, NULL)) return pixels;
    png_image_free(image);
    free(pixels);
    return NULL;
}

bool png_same_pixels(const void *a, size_t a_size, const void *b, size_t b_size)
{
    png_image one, other;
    uint8_t *p = decode(a, a_size, &one), *q = decode(b, b_size, &other);
    bool same =
        p && q && one.width == other.width && one.height == other.height && memcmp(p, q, PNG_IMAGE_SIZE(one)) == 0;
    free(p);
    free(q);
    return same;
}
