#include "input/images/image_file.h"

#include <string.h>

#include "base/cancel.h"

#include <webp/decode.h>

/* AT_ONCE: bytes between checks for cancellation.
 * libwebp's memory: OWN_BYTES, 4 bytes per texel and STRIP_BYTES per column. */
enum { AT_ONCE = 1 << 14, OWN_BYTES = 1 << 20, STRIP_BYTES = 256 };

bool zr_webp_looks_so(const void *bytes, size_t size)
{
    const char *text = bytes;
    return size >= 12 && memcmp(text, "RIFF", 4) == 0 && memcmp(text + 8, "WEBP", 4) == 0;
}

/* True if the file is as long as its header says. */
static bool is_whole(const unsigned char *bytes, size_t size)
{
    const uint32_t rest =
        (uint32_t)bytes[4] | (uint32_t)bytes[5] << 8 | (uint32_t)bytes[6] << 16 | (uint32_t)bytes[7] << 24;
    return size - 8 >= rest;
}

static enum zr_status refuse(VP8StatusCode status, struct zr_reason *reason)
{
    if (status == VP8_STATUS_OUT_OF_MEMORY) return ZR_NO_MEMORY;
    if (status == VP8_STATUS_SUSPENDED || status == VP8_STATUS_NOT_ENOUGH_DATA)
        zr_reason_give(reason, "a broken WebP: it ends too early");
    else
        zr_reason_give(reason, "a broken WebP");
    return ZR_BAD_SCENE;
}

/* Decodes the file in parts. libwebp parses the header again for each part until it returns rows. Parts double until
 * then, which keeps the work linear. */
static enum zr_status decode(WebPIDecoder *decoder, const uint8_t *bytes, size_t size, const struct zr_cancel *cancel,
                             struct zr_reason *reason)
{
    VP8StatusCode status = VP8_STATUS_SUSPENDED;
    for (size_t part = 0; status == VP8_STATUS_SUSPENDED && part < size;) {
        int rows = 0;
        WebPIDecGetRGB(decoder, &rows, NULL, NULL, NULL);
        const size_t step = rows > 0 || part < AT_ONCE ? AT_ONCE : part;
        part = size - part < step ? size : part + step;
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        status = WebPIUpdate(decoder, bytes, part);
    }
    return status == VP8_STATUS_OK ? ZR_OK : refuse(status, reason);
}

/* Decodes the picture into `rgba`, which has its size. */
static enum zr_status read_picture(const struct zr_encoded_image *file, const WebPBitstreamFeatures *features,
                                   uint8_t *rgba, const struct zr_cancel *cancel, struct zr_reason *reason)
{
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) return ZR_NO_MEMORY;
    const size_t row = 4 * (size_t)features->width;
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = (WebPRGBABuffer){rgba, (int)row, row * (size_t)features->height};
    WebPIDecoder *decoder = WebPIDecode(NULL, 0, &config);
    if (!decoder) return ZR_NO_MEMORY;
    const enum zr_status status = decode(decoder, file->bytes, file->size, cancel, reason);
    WebPIDelete(decoder);
    WebPFreeDecBuffer(&config.output);
    return status;
}

enum zr_status zr_webp_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason)
{
    WebPBitstreamFeatures features;
    const VP8StatusCode found =
        is_whole(file->bytes, file->size) ? WebPGetFeatures(file->bytes, file->size, &features) : VP8_STATUS_SUSPENDED;
    if (found != VP8_STATUS_OK) return refuse(found, reason);
    if (features.has_animation) {
        zr_reason_give(reason, "an animated WebP; those of one picture are read");
        return ZR_BAD_SCENE;
    }
    const uint32_t width = (uint32_t)features.width, height = (uint32_t)features.height;
    if (!zr_image_fits(width, height, file->texels_max, reason)) return ZR_BAD_SCENE;
    const size_t texels = (size_t)width * height, own = OWN_BYTES + 4 * texels + STRIP_BYTES * (size_t)width;
    uint8_t *rgba = zr_arena_alloc_beside(arena, scratch, texels, 4);
    if (!rgba || !zr_arena_charge(scratch, own)) return ZR_NO_MEMORY;
    *image = (struct zr_image){width, height, 8, rgba, NULL};
    const enum zr_status status = read_picture(file, &features, rgba, arena->cancel, reason);
    zr_arena_refund(scratch, own);
    if (status == ZR_NO_MEMORY) scratch->failed = true;
    return status;
}
