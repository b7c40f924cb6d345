/* gif.h - output: a picture as GIF, and GIF files joined to the frames of an animation.
 *
 * Source: CompuServe, "Graphics Interchange Format, Version 89a", and Netscape's application extension, by which the
 *         animation repeats for ever. Each frame has its own 256 colours and replaces the last one.
 *
 * Colours: up to 256 are kept as they are. More are sorted into boxes, each split at the mean of its most scattered
 * channel; a pixel has the mean of its box. Pixels with alpha below 128 are transparent, all others opaque.
 */
#ifndef ZR_GIF_H
#define ZR_GIF_H

#include "base/cancel.h"
#include "base/status.h"
#include "output/bytes/buffer.h"
#include "output/images/gif_colors.h"

/* Least time of a frame in seconds; browsers show a shorter one for 0.1 s. */
#define ZR_GIF_SECONDS_MIN 0.02

/* Appends the file to `out`; its arena is used for scratch memory, too. Returns ZR_OK, ZR_NO_MEMORY or
 * ZR_CANCELLED. */
enum zr_status zr_gif_write(const struct zr_gif *gif, const struct zr_cancel *cancel, struct zr_buffer *out);

struct zr_gif_frames {
    struct zr_buffer *out;
    uint32_t frames; /* that will be added */
    double seconds;  /* that a frame is shown; rounded to hundredths so that the whole animation is exact */
    uint32_t done;   /* frames added; initially 0 */
};

/* Adds a frame: a whole file in memory, made by zr_gif_write. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_gif_frames_add(struct zr_gif_frames *frames, const unsigned char *gif, size_t size);

#endif
