/* webp_frames.h - output: joins WebP files to the frames of an animated WebP.
 *
 * Source: RFC 9649, "WebP Image Format", sections 2.7 and 2.7.1. Frames keep the bytes of their images. All are whole
 *         pictures, which replace the last one, and the animation repeats for ever. Times are milliseconds; they are
 *         rounded so that the whole animation is exact.
 */
#ifndef ZR_WEBP_FRAMES_H
#define ZR_WEBP_FRAMES_H

#include <stdint.h>

#include "base/status.h"
#include "output/bytes/buffer.h"

struct zr_webp_frames {
    struct zr_buffer *out;
    uint32_t frames;        /* that will be added */
    double seconds;         /* that a frame is shown */
    uint32_t width, height; /* of each frame */
    uint32_t done;          /* frames added; initially 0 */
    bool has_alpha;         /* one of these has alpha */
};

/* Adds a frame: a whole WebP file in memory, made by zr_webp_write. Returns ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE if the
 * file would have 4 GiB or more. */
enum zr_status zr_webp_frames_add(struct zr_webp_frames *frames, const unsigned char *webp, size_t size);

#endif
