/* webp.c - output: colours as WebP, by libwebp.
 *
 * Memory:       libwebp uses malloc. A bound is charged to the arena before: the most that was measured, for pictures
 *               of noise, and some more.
 * Cancellation: libwebp asks its progress hook, at most a hundred times per picture. */
#include <stdio.h>

#include "base/cancel.h"
#include "output/bytes/buffer.h"
#include "output/images/lossy.h"

#include <webp/encode.h>

/* Bytes of libwebp's memory: OWN_BYTES, and those for each pixel. Alpha is compressed without loss. */
enum { OWN_BYTES = 2 << 20, LOSSLESS_BYTES = 48, LOSSY_BYTES = 32 };

/* Effort of lossless files, 0..9. */
enum { EFFORT_FAST = 1, EFFORT_SMALL = 6 };

struct writing {
    struct zr_buffer out;
    const struct zr_cancel *cancel;
};

static int write_bytes(const uint8_t *bytes, size_t size, const WebPPicture *picture)
{
    struct writing *writing = picture->custom_ptr;
    return zr_buffer_add(&writing->out, bytes, size);
}

static int check_progress(int percent, const WebPPicture *picture)
{
    const struct writing *writing = picture->user_data;
    (void)percent;
    return !zr_is_cancelled(writing->cancel);
}

static bool make_config(const struct zr_lossy *image, WebPConfig *config)
{
    if (!WebPConfigInit(config)) return false;
    config->quality = (float)image->quality;
    if (!image->is_lossless) return true;
    config->exact = 1;
    return WebPConfigLosslessPreset(config, image->is_small ? EFFORT_SMALL : EFFORT_FAST);
}

static enum zr_status status_of(WebPEncodingError error)
{
    if (error == VP8_ENC_ERROR_USER_ABORT) return ZR_CANCELLED;
    if (error == VP8_ENC_ERROR_OUT_OF_MEMORY || error == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY ||
        error == VP8_ENC_ERROR_BAD_WRITE)
        return ZR_NO_MEMORY;
    return ZR_INTERNAL;
}

static enum zr_status encode(struct writing *writing, const struct zr_lossy *image)
{
    WebPConfig config;
    WebPPicture picture;
    if (!make_config(image, &config) || !WebPPictureInit(&picture)) return ZR_INTERNAL;
    picture.use_argb = image->is_lossless;
    picture.width = (int)image->width;
    picture.height = (int)image->height;
    picture.writer = write_bytes;
    picture.custom_ptr = writing;
    picture.progress_hook = check_progress;
    picture.user_data = writing;
    const int stride = 4 * (int)image->width;
    const bool done = (image->has_alpha ? WebPPictureImportRGBA(&picture, image->rgba, stride)
                                        : WebPPictureImportRGBX(&picture, image->rgba, stride)) &&
                      WebPEncode(&config, &picture);
    const enum zr_status status = done ? ZR_OK : status_of(picture.error_code);
    WebPPictureFree(&picture);
    return status;
}

enum zr_status zr_webp_write(struct zr_arena *arena, const struct zr_lossy *image, size_t most,
                             const struct zr_cancel *cancel, struct zr_lossy_file *file)
{
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct writing writing = {.out = {.arena = &scratch}, .cancel = cancel};
    const size_t own = OWN_BYTES + (size_t)image->width * image->height *
                                       (image->is_lossless || image->has_alpha ? LOSSLESS_BYTES : LOSSY_BYTES);
    enum zr_status status = zr_arena_charge(&scratch, own) ? encode(&writing, image) : ZR_NO_MEMORY;
    if (status == ZR_NO_MEMORY) scratch.failed = true;
    if (!scratch.failed) zr_arena_refund(&scratch, own);
    *file = (struct zr_lossy_file){.size = writing.out.size, .quality = image->quality};
    return zr_lossy_end_try(arena, &scratch, &writing.out, most, status, file);
}

struct zr_webp_encoder zr_webp_encoder(void)
{
    struct zr_webp_encoder encoder;
    const int version = WebPGetEncoderVersion();
    snprintf(encoder.text, sizeof encoder.text, "libwebp %d.%d.%d", version >> 16 & 255, version >> 8 & 255,
             version & 255);
    return encoder;
}
