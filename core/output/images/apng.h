/* apng.h - output: joins PNG files to the frames of an animated PNG.
 *
 * Source: W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", chunks acTL, fcTL and fdAT. The first
 *         frame is also the picture for readers without animation. All frames are whole pictures, and the animation
 *         repeats for ever.
 */
#ifndef ZR_APNG_H
#define ZR_APNG_H

#include <stdint.h>

#include "base/status.h"
#include "output/bytes/buffer.h"

struct zr_apng {
    struct zr_buffer *out;
    uint32_t frames;        /* that will be added */
    double seconds;         /* that a frame is shown */
    uint32_t done;          /* frames added; initially 0 */
    uint32_t sequence;      /* of the next chunk; initially 0 */
    unsigned char head[25]; /* chunk IHDR of the first frame */
};

/* Adds a frame: a whole PNG file in memory, made by zr_png_write. Returns ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE if its
 * size or kind of colours is not that of the first. */
enum zr_status zr_apng_add(struct zr_apng *apng, const unsigned char *png, size_t size);

#endif
