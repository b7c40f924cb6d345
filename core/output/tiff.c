#include "output/tiff.h"

#include <string.h>

enum { SHORT = 3, LONG = 4, RATIONAL = 5 }; /* types of fields */
enum { ENTRY_SIZE = 12, HEAD_MAX = 256 };
enum { COLOR_GREY = 1, COLOR_RGB = 2, UNSPECIFIED = 0, SAMPLES_ARE_FLOATS = 3 };

/* The header, the directory and the values of fields that do not fit an entry. */
struct head {
    unsigned char bytes[HEAD_MAX];
    uint32_t at;   /* of the next entry */
    uint32_t more; /* of the next value behind the directory */
};

static void put(unsigned char *at, uint32_t value, int size)
{
    for (int i = 0; i < size; i++)
        at[i] = (unsigned char)(value >> 8 * i);
}

/* Adds an entry of `count` equal values, which stand behind the directory if they need more than four bytes. */
static void add(struct head *head, uint32_t tag, uint32_t type, uint32_t count, uint32_t value)
{
    const int size = type == SHORT ? 2 : 4;
    const uint32_t words = type == RATIONAL ? 2 : 1; /* 1 / 1 */
    unsigned char *entry = head->bytes + head->at, *values = entry + 8;
    put(entry, tag, 2);
    put(entry + 2, type, 2);
    put(entry + 4, count, 4);
    head->at += ENTRY_SIZE;
    if (count * words * (uint32_t)size > 4) {
        put(values, head->more, 4);
        values = head->bytes + head->more;
        head->more += (count * words * (uint32_t)size + 3) & ~UINT32_C(3);
    }
    for (uint32_t i = 0; i < count * words; i++)
        put(values + i * (uint32_t)size, value, size);
}

/* Tags ascend, as the format requires. */
static void make_head(struct head *head, uint32_t width, uint32_t height, uint32_t words, uint32_t bytes)
{
    enum { BEGIN = 8, ENTRIES = 14 };
    const uint32_t extra = words == 2 || words == 4;
    *head = (struct head){.at = BEGIN + 2, .more = BEGIN + 2 + (ENTRIES + extra) * ENTRY_SIZE + 4};
    memcpy(head->bytes, "II*\0", 4);
    put(head->bytes + 4, BEGIN, 4);
    put(head->bytes + BEGIN, ENTRIES + extra, 2);
    add(head, 256, LONG, 1, width);
    add(head, 257, LONG, 1, height);
    add(head, 258, SHORT, words, 32);                             /* BitsPerSample */
    add(head, 259, SHORT, 1, 1);                                  /* Compression: none */
    add(head, 262, SHORT, 1, words > 2 ? COLOR_RGB : COLOR_GREY); /* PhotometricInterpretation */
    add(head, 273, LONG, 1, HEAD_MAX);                            /* StripOffsets */
    add(head, 277, SHORT, 1, words);                              /* SamplesPerPixel */
    add(head, 278, LONG, 1, height);                              /* RowsPerStrip */
    add(head, 279, LONG, 1, bytes);                               /* StripByteCounts */
    add(head, 282, RATIONAL, 1, 1);                               /* XResolution */
    add(head, 283, RATIONAL, 1, 1);                               /* YResolution */
    add(head, 284, SHORT, 1, 1);                                  /* PlanarConfiguration: pixel by pixel */
    add(head, 296, SHORT, 1, 1);                                  /* ResolutionUnit: none */
    if (extra) add(head, 338, SHORT, 1, UNSPECIFIED);             /* ExtraSamples */
    add(head, 339, SHORT, words, SAMPLES_ARE_FLOATS);             /* SampleFormat */
}

enum zr_status zr_tiff_write(const float *values, uint32_t width, uint32_t height, uint32_t words,
                             struct zr_buffer *out)
{
    struct head head;
    const uint64_t bytes = (uint64_t)width * height * words * 4;
    if (bytes + HEAD_MAX > UINT32_MAX) return ZR_INTERNAL;
    make_head(&head, width, height, words, (uint32_t)bytes);
    if (!zr_buffer_add(out, head.bytes, HEAD_MAX) || !zr_buffer_add(out, values, (size_t)bytes)) return ZR_NO_MEMORY;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    unsigned char *data = out->bytes + out->size - bytes;
    for (size_t i = 0; i < bytes; i += 4) {
        uint32_t value;
        memcpy(&value, data + i, 4);
        value = __builtin_bswap32(value);
        memcpy(data + i, &value, 4);
    }
#endif
    return ZR_OK;
}
