/* A PNG as the colour of a base. */
#include <zlib.h>

#include "fuzz/base.h"
#include "fuzz/fuzz.h"

enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHECKSUM = 4 };

static uint32_t big_endian(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Gives every whole chunk the checksum of what is in it: without, libpng looks at nothing that was changed. */
static void mend_checksums(uint8_t *data, size_t size)
{
    for (size_t at = SIGNATURE; at + CHUNK_HEAD + CHECKSUM <= size;) {
        const size_t length = big_endian(data + at);
        if (length > size - at - CHUNK_HEAD - CHECKSUM) return;
        const uint32_t sum = (uint32_t)crc32(0, data + at + 4, (uInt)(4 + length));
        for (int i = 0; i < CHECKSUM; i++)
            data[at + CHUNK_HEAD + length + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
        at += CHUNK_HEAD + length + CHECKSUM;
    }
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max, unsigned seed)
{
    size = LLVMFuzzerMutate(data, size, max);
    if (seed % 16) mend_checksums(data, size);
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char scene[] =
        BASE_SCENE("\"color\":{\"asset\":\"a\"},\"windowDepth\":{\"asset\":\"z\"}", "{\"channel\":\"color\"}");
    float depths[BASE_PIXELS];
    char z[NPY_BYTES];
    for (size_t i = 0; i < BASE_PIXELS; i++)
        depths[i] = (float)i / BASE_PIXELS;
    base_npy(z, "<f4", depths);
    const struct zr_asset assets[] = {{"a", data, size}, {"z", z, sizeof z}};
    fuzz_request(&(struct zr_request){
        .format = ZR_FORMAT_JSON, .bytes = scene, .size = sizeof scene - 1, .assets = assets, .asset_count = 2});
    return 0;
}
