/* png_files.h - tests: PNGs of every kind, written by libpng, and what their pixels are by the letter of the
 * specification. */
#ifndef ZR_TESTS_PNG_FILES_H
#define ZR_TESTS_PNG_FILES_H

#include <png.h>
#include <string.h>
#include <zlib.h>

#include "support/cmocka_all.h"
#include "support/random.h"

enum { PNG_WIDTH = 13, PNG_HEIGHT = 9, PNG_PIXELS = PNG_WIDTH * PNG_HEIGHT, PNG_FILE_MAX = 1 << 16 };

struct png_file {
    unsigned char bytes[PNG_FILE_MAX];
    size_t size;
};

/* What a file is made of beside its samples. */
struct png_kind {
    int color, bits, interlace;
    bool key;   /* a transparent palette entry or colour */
    bool gamma; /* says what would change the values if it were applied */
};

static const png_color PNG_PALETTE[4] = {{1, 2, 3}, {200, 100, 50}, {255, 0, 128}, {7, 7, 7}};

static inline void png_file_append(png_structp png, png_bytep bytes, size_t size)
{
    struct png_file *file = png_get_io_ptr(png);
    assert_true(file->size + size <= PNG_FILE_MAX);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

/* `samples` are rows of packed samples, `stride` bytes each. */
static inline void png_file_make(struct png_file *file, struct png_kind kind, png_bytep samples, size_t stride)
{
    file->size = 0;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, file, png_file_append, NULL);
    png_set_IHDR(png, info, PNG_WIDTH, PNG_HEIGHT, kind.bits, kind.color, kind.interlace, 0, 0);
    if (kind.color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, PNG_PALETTE, kind.bits == 1 ? 2 : 4);
    png_byte alphas[2] = {255, 77};
    png_color_16 key = {.red = 10, .green = 20, .blue = 30, .gray = 1};
    if (kind.key) png_set_tRNS(png, info, alphas, 2, &key);
    if (kind.gamma) png_set_gAMA(png, info, 1.0);
    png_write_info(png, info);
    png_bytep rows[PNG_HEIGHT];
    for (size_t y = 0; y < PNG_HEIGHT; y++)
        rows[y] = samples + y * stride;
    png_write_image(png, rows);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
}

static inline unsigned png_sample(const unsigned char *row, size_t x, int bits)
{
    if (bits == 16) return (unsigned)row[2 * x] << 8 | row[2 * x + 1];
    size_t bit = x * (size_t)bits;
    return (unsigned)row[bit / 8] >> (8 - bits - (int)(bit % 8)) & ((1u << bits) - 1);
}

static inline size_t png_channels(struct png_kind kind)
{
    return kind.color == PNG_COLOR_TYPE_RGB          ? 3
           : kind.color == PNG_COLOR_TYPE_RGB_ALPHA  ? 4
           : kind.color == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                                     : 1;
}

/* What the pixel is: 16 bits per channel where the file has them, else 8. */
static inline void png_expect(struct png_kind kind, const unsigned char *row, size_t x, unsigned want[4])
{
    const size_t channels = png_channels(kind);
    unsigned values[4];
    for (size_t c = 0; c < channels; c++)
        values[c] = png_sample(row, channels * x + c, kind.bits);
    want[3] = kind.bits == 16 ? 65535 : 255;
    if (kind.color == PNG_COLOR_TYPE_PALETTE) {
        const png_color color = PNG_PALETTE[values[0]];
        memcpy(want, (unsigned[]){color.red, color.green, color.blue}, 3 * sizeof *want);
        if (kind.key && values[0] == 1) want[3] = 77;
        return;
    }
    const unsigned scale = kind.bits < 8 ? 255 / ((1u << kind.bits) - 1) : 1;
    for (size_t c = 0; c < 3; c++)
        want[c] = scale * values[channels > 2 ? c : 0];
    if (channels % 2 == 0) want[3] = values[channels - 1];
    if (kind.key && channels == 1 && values[0] == 1) want[3] = 0;
    if (kind.key && channels == 3 && values[0] == 10 && values[1] == 20 && values[2] == 30) want[3] = 0;
}

enum { PNG_SAMPLES_MAX = PNG_PIXELS * 8 };

/* Random ones, of which the first has the transparent colour. Returns their stride. */
static inline size_t png_make_samples(struct random *random, struct png_kind kind, unsigned char *samples)
{
    const size_t stride = (PNG_WIDTH * png_channels(kind) * (size_t)kind.bits + 7) / 8;
    for (size_t i = 0; i < PNG_HEIGHT * stride; i++) {
        samples[i] = (unsigned char)random_next(random);
        if (kind.color == PNG_COLOR_TYPE_PALETTE && kind.bits > 2) samples[i] &= kind.bits == 8 ? 3 : 0x33;
    }
    if (kind.color == PNG_COLOR_TYPE_RGB && kind.bits == 8) memcpy(samples, "\x0a\x14\x1e", 3);
    if (kind.color == PNG_COLOR_TYPE_RGB && kind.bits == 16) memcpy(samples, "\0\x0a\0\x14\0\x1e", 6);
    if (kind.color == PNG_COLOR_TYPE_GRAY && kind.bits == 16) memcpy(samples, "\0\1", 2);
    return stride;
}

/* A chunk of that name and data behind the header. */
static inline void png_insert_chunk(struct png_file *file, const char *name, const void *data, uint32_t size)
{
    enum { BEHIND_HEADER = 33 };
    unsigned char *at = file->bytes + BEHIND_HEADER;
    assert_true(file->size + size + 12 <= PNG_FILE_MAX);
    memmove(at + size + 12, at, file->size - BEHIND_HEADER);
    file->size += size + 12;
    const unsigned char length[4] = {(unsigned char)(size >> 24), (unsigned char)(size >> 16),
                                     (unsigned char)(size >> 8), (unsigned char)size};
    memcpy(at, length, 4);
    memcpy(at + 4, name, 4);
    memcpy(at + 8, data, size);
    uint32_t sum = (uint32_t)crc32(0, at + 4, size + 4);
    const unsigned char crc[4] = {(unsigned char)(sum >> 24), (unsigned char)(sum >> 16), (unsigned char)(sum >> 8),
                                  (unsigned char)sum};
    memcpy(at + 8 + size, crc, 4);
}

/* With their checksums mended, so that libpng looks at what was changed. */
static inline void png_mend(struct png_file *file)
{
    size_t at = 8;
    while (file->size - at >= 12) {
        const unsigned char *c = file->bytes + at;
        size_t size = (size_t)c[0] << 24 | (size_t)c[1] << 16 | (size_t)c[2] << 8 | c[3];
        if (size > file->size - at - 12) return;
        uint32_t sum = (uint32_t)crc32(0, c + 4, (uInt)size + 4);
        for (int i = 0; i < 4; i++)
            file->bytes[at + 8 + size + (size_t)i] = (unsigned char)(sum >> (24 - 8 * i));
        at += size + 12;
    }
}

#endif
