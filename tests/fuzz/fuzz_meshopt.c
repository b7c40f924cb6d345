/* The decoder of EXT_ and KHR_meshopt_compression. The first six bytes choose the layout. */
#include <stdlib.h>
#include <string.h>

#include "fuzz/fuzz.h"
#include "input/codecs/meshopt.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 6) return 0;
    const struct zr_meshopt of = {data[0] % 3, data[1] % 5, data[2] | (uint32_t)data[3] << 8,
                                  data[4] | (data[5] & 1u) << 8};
    struct zr_reason reason = {""};
    if (!zr_meshopt_check(&of, data + 6, size - 6, &reason)) {
        fuzz_expect(*reason.text, "a refusal says why");
        return 0;
    }
    unsigned char *packed = malloc(size - 6), *out = malloc((size_t)of.count * of.stride);
    if (packed && out) {
        memcpy(packed, data + 6, size - 6); /* exact size, so that sanitizers find reads beyond it */
        fuzz_accepted = zr_meshopt_decode(&of, packed, size - 6, out, NULL, &reason);
        fuzz_expect(fuzz_accepted || *reason.text, "a refusal says why");
    }
    free(packed);
    free(out);
    return 0;
}
