#include "output/images/apng.h"

#include <math.h>
#include <string.h>

#include "output/images/png_chunk.h"

enum { SIGNATURE = 8, AROUND = 12 /* length, type and check sum of a chunk */, DELAY_MOST = 65535 };

static uint32_t get_u32(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Adds a chunk. `number`: before its data; NULL: none. */
static bool add_chunk(struct zr_buffer *out, const char *type, const uint32_t *number, const unsigned char *data,
                      size_t size)
{
    const size_t at = zr_png_chunk_begin(out, type);
    if (number) zr_png_put_word(out, *number);
    zr_buffer_add(out, data, size);
    return zr_png_chunk_end(out, at);
}

/* Finds the fraction of two 16-bit numbers that is nearest to a time, by continued fractions. */
static void find_delay(double seconds, uint32_t *numerator, uint32_t *denominator)
{
    double p[2] = {0, 1}, q[2] = {1, 0}; /* of the last two convergents */
    double rest = fmin(seconds, DELAY_MOST);
    for (int i = 0; i < 32; i++) {
        const double whole = floor(rest), next_p = whole * p[1] + p[0], next_q = whole * q[1] + q[0];
        if (next_p > DELAY_MOST || next_q > DELAY_MOST) break;
        p[0] = p[1], q[0] = q[1], p[1] = next_p, q[1] = next_q;
        if (rest - whole < 1e-9) break;
        rest = 1.0 / (rest - whole);
    }
    *numerator = p[1] > 0 ? (uint32_t)p[1] : 1; /* 0 would be as fast as the reader can */
    *denominator = p[1] > 0 ? (uint32_t)q[1] : DELAY_MOST;
}

static bool add_frame_control(struct zr_apng *apng)
{
    uint32_t numerator, denominator;
    find_delay(apng->seconds, &numerator, &denominator);
    unsigned char control[22] = {0};    /* frames begin at 0, 0, and replace the last one */
    memcpy(control, apng->head + 8, 8); /* width and height */
    control[16] = (unsigned char)(numerator >> 8);
    control[17] = (unsigned char)numerator;
    control[18] = (unsigned char)(denominator >> 8);
    control[19] = (unsigned char)denominator;
    const uint32_t number = apng->sequence++;
    return add_chunk(apng->out, "fcTL", &number, control, sizeof control);
}

/* Adds the file's beginning, with the chunks before the pixels of the first frame. */
static bool begin(struct zr_apng *apng, const unsigned char *png)
{
    const unsigned char *pixels = png + SIGNATURE;
    while (memcmp(pixels + 4, "IDAT", 4) != 0)
        pixels += get_u32(pixels) + AROUND;
    memcpy(apng->head, png + SIGNATURE, sizeof apng->head);
    zr_buffer_add(apng->out, png, (size_t)(pixels - png));
    const size_t at = zr_png_chunk_begin(apng->out, "acTL");
    zr_png_put_word(apng->out, apng->frames);
    zr_png_put_word(apng->out, 0); /* repeats for ever */
    return zr_png_chunk_end(apng->out, at);
}

enum zr_status zr_apng_add(struct zr_apng *apng, const unsigned char *png, size_t size)
{
    if (apng->done == 0 && !begin(apng, png)) return ZR_NO_MEMORY;
    if (memcmp(apng->head, png + SIGNATURE, sizeof apng->head) != 0) return ZR_BAD_SCENE;
    if (!add_frame_control(apng)) return ZR_NO_MEMORY;
    const unsigned char *const end = png + size;
    for (const unsigned char *at = png + SIGNATURE; at < end; at += get_u32(at) + AROUND) {
        if (memcmp(at + 4, "IDAT", 4) != 0) continue;
        const uint32_t number = apng->sequence;
        if (apng->done > 0) apng->sequence++;
        if (!add_chunk(apng->out, apng->done == 0 ? "IDAT" : "fdAT", apng->done == 0 ? NULL : &number, at + 8,
                       get_u32(at)))
            return ZR_NO_MEMORY;
    }
    if (++apng->done == apng->frames && !add_chunk(apng->out, "IEND", NULL, NULL, 0)) return ZR_NO_MEMORY;
    return ZR_OK;
}
