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
