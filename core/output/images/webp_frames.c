#include "output/images/webp_frames.h"

#include <math.h>
#include <string.h>

enum { RIFF = 12, CHUNK = 8, EXTENDED = 10, ANIMATION = 6, FRAME = 16 /* bytes before the image of a frame */ };
enum {
    FLAGS_AT = RIFF + CHUNK,
    HAS_ALPHA = 0x10,
    IS_ANIMATION = 2,
    REPLACES = 2 /* no blending with the last frame */
};
#define DURATION_MOST 16777215.0 /* milliseconds in 24 bits */
#define SIZE_MOST     UINT32_MAX
#define SPARE         64 /* bytes of heads */

static unsigned char *put(unsigned char *at, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        *at++ = (unsigned char)(value >> (8 * i));
    return at;
}

static unsigned char *put_chunk(unsigned char *at, const char *type, uint32_t size)
{
    memcpy(at, type, 4);
    return put(at + 4, size, 4);
}

/* Returns the bytes of a chunk with its head and its padding. */
static size_t chunk_size(const unsigned char *chunk)
{
    const uint32_t size =
        (uint32_t)chunk[7] << 24 | (uint32_t)chunk[6] << 16 | (uint32_t)chunk[5] << 8 | (uint32_t)chunk[4];
    return CHUNK + (size_t)size + (size & 1u);
}

/* Adds the file's beginning. The last frame sets its size and flags. */
static bool begin(const struct zr_webp_frames *frames)
{
    unsigned char head[RIFF + CHUNK + EXTENDED + CHUNK + ANIMATION] = {0}, *at = head;
    at = put_chunk(at, "RIFF", 0);
    memcpy(at, "WEBP", 4);
    at = put_chunk(at + 4, "VP8X", EXTENDED) + 4;
    at = put(at, frames->width - 1, 3);
    at = put(at, frames->height - 1, 3);
    put_chunk(at, "ANIM", ANIMATION); /* background 0; 0 repeats it for ever */
    return zr_buffer_add(frames->out, head, sizeof head);
}

static void end(const struct zr_webp_frames *frames)
{
    put(frames->out->bytes + 4, (uint32_t)frames->out->size - CHUNK, 4);
    frames->out->bytes[FLAGS_AT] = (unsigned char)(IS_ANIMATION | (frames->has_alpha ? HAS_ALPHA : 0));
}

/* Returns the milliseconds of the next frame. */
static uint32_t duration_of(const struct zr_webp_frames *frames)
{
    const double ms = 1e3 * frames->seconds, from = floor(frames->done * ms + 0.5);
    return (uint32_t)fmin(fmax(floor((frames->done + 1) * ms + 0.5) - from, 1.0), DURATION_MOST);
}

enum zr_status zr_webp_frames_add(struct zr_webp_frames *frames, const unsigned char *webp, size_t size)
{
    struct zr_buffer *out = frames->out;
    const unsigned char *image = webp + RIFF;
    if (memcmp(image, "VP8X", 4) == 0) {
        frames->has_alpha |= (image[CHUNK] & HAS_ALPHA) != 0;
        image += chunk_size(image);
    } else if (memcmp(image, "VP8L", 4) == 0)
        frames->has_alpha |= (image[CHUNK + 4] & HAS_ALPHA) != 0; /* a bit after width and height */
    const size_t bytes = size - (size_t)(image - webp);
    if (size >= SIZE_MOST - SPARE || out->size >= SIZE_MOST - SPARE - size) return ZR_BAD_SCENE;
    if (frames->done == 0 && !begin(frames)) return ZR_NO_MEMORY;
    unsigned char head[CHUNK + FRAME] = {0}, *at = put_chunk(head, "ANMF", (uint32_t)(FRAME + bytes)) + 6;
    at = put(at, frames->width - 1, 3); /* behind the place, 0, 0 */
    at = put(at, frames->height - 1, 3);
    at = put(at, duration_of(frames), 3);
    *at = REPLACES;
    if (!zr_buffer_add(out, head, sizeof head) || !zr_buffer_add(out, image, bytes)) return ZR_NO_MEMORY;
    if (++frames->done == frames->frames) end(frames);
    return ZR_OK;
}
