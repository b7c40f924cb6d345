#include "output/images/tiff.h"

#include "output/bytes/words.h"

enum { SHORT = 3, LONG = 4, RATIONAL = 5, FLOAT_SAMPLES = 3, HEADER = 8, ENTRY = 12 };

/* An entry of the directory. Values that do not fit four bytes lie after the directory, from `behind` on. */
struct directory {
    struct zr_buffer *out;
    uint32_t behind;
};

static void add_entry(const struct directory *d, uint32_t tag, uint32_t type, uint32_t count, uint32_t value)
{
    zr_half_add(d->out, tag);
    zr_half_add(d->out, type);
    zr_word_add(d->out, count);
    zr_word_add(d->out, value);
}

static void add_value(const struct directory *d, uint32_t tag, uint32_t type, uint32_t value)
{
    add_entry(d, tag, type, 1, value);
}

/* Adds the same short for each sample: within the entry for up to two of them. */
static void add_per_sample(struct directory *d, uint32_t tag, uint32_t samples, uint32_t value)
{
    const uint32_t inside = samples == 2 ? value | value << 16 : value;
    add_entry(d, tag, SHORT, samples, samples > 2 ? d->behind : inside);
    if (samples > 2) d->behind += 2 * samples;
}

/* Entries are in the order of their tags. */
static void add_directory(struct zr_buffer *out, uint32_t width, uint32_t height, uint32_t components)
{
    const uint32_t entries = components == 2 ? 15 : 14, end = HEADER + 2 + entries * ENTRY + 4;
    const uint32_t shorts = components > 2 ? 4 * components : 0, data = end + 2 * 8 + shorts;
    struct directory d = {out, end};
    zr_half_add(out, entries);
    add_value(&d, 256, LONG, width);
    add_value(&d, 257, LONG, height);
    add_per_sample(&d, 258, components, 32);            /* bits */
    add_value(&d, 259, SHORT, 1);                       /* uncompressed */
    add_value(&d, 262, SHORT, components == 3 ? 2 : 1); /* RGB, or 0 is black */
    add_value(&d, 273, LONG, data + data % 4);          /* the strip */
    add_value(&d, 277, SHORT, components);
    add_value(&d, 278, LONG, height); /* rows of the strip */
    add_value(&d, 279, LONG, 4 * components * width * height);
    add_value(&d, 282, RATIONAL, d.behind); /* resolution: 1, without a unit */
    add_value(&d, 283, RATIONAL, d.behind + 8);
    d.behind += 16;
    add_value(&d, 284, SHORT, 1);                      /* samples of a pixel side by side */
    add_value(&d, 296, SHORT, 1);                      /* no unit */
    if (components == 2) add_value(&d, 338, SHORT, 0); /* the second sample is of no set meaning */
    add_per_sample(&d, 339, components, FLOAT_SAMPLES);
    zr_word_add(out, 0); /* no directory follows */
    for (uint32_t i = 0; i < components && components > 2; i++)
        zr_half_add(out, 32);
    for (int i = 0; i < 4; i++)
        zr_word_add(out, 1);
    for (uint32_t i = 0; i < components && components > 2; i++)
        zr_half_add(out, FLOAT_SAMPLES);
    for (uint32_t i = 0; i < data % 4; i++)
        zr_buffer_add(out, "", 1);
}

enum zr_status zr_tiff_write(uint32_t width, uint32_t height, uint32_t components, const float *values,
                             struct zr_buffer *out)
{
    enum { DIRECTORY_MAX = 512 };
    const size_t words = (size_t)width * height * components;
    if (!zr_buffer_room(out, DIRECTORY_MAX + 4 * words)) return ZR_NO_MEMORY;
    zr_buffer_add(out, "II*\0", 4);
    zr_word_add(out, HEADER);
    add_directory(out, width, height, components);
    zr_words_add(out, values, words);
    return ZR_OK;
}
