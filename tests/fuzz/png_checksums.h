/* png_checksums.h - tests/fuzz: what is made up gets checksums that are right: without, libpng looks at nothing that
 * was changed. */
#ifndef ZR_FUZZ_PNG_CHECKSUMS_H
#define ZR_FUZZ_PNG_CHECKSUMS_H

#include <stddef.h>
#include <stdint.h>
#include <zlib.h>

/* Of every whole chunk. */
static inline void png_checksums_mend(uint8_t *data, size_t size)
{
    enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHECKSUM = 4 };
    for (size_t at = SIGNATURE; at + CHUNK_HEAD + CHECKSUM <= size;) {
        const size_t length =
            (size_t)data[at] << 24 | (size_t)data[at + 1] << 16 | (size_t)data[at + 2] << 8 | data[at + 3];
        if (length > size - at - CHUNK_HEAD - CHECKSUM) return;
        const uint32_t sum = (uint32_t)crc32(0, data + at + 4, (uInt)(4 + length));
        for (int i = 0; i < CHECKSUM; i++)
            data[at + CHUNK_HEAD + length + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
        at += CHUNK_HEAD + length + CHECKSUM;
    }
}

#endif
