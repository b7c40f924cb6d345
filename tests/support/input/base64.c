#include "support/input/base64.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "support/cmocka_all.h"

char *base64_of(const char *prefix, const void *bytes, size_t size)
{
    static const char ALPHABET[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t begin = strlen(prefix);
    char *text = malloc(begin + (size + 2) / 3 * 4 + 1), *out = text + begin;
    assert_non_null(text);
    memcpy(text, prefix, begin);
    for (size_t i = 0; i < size; i += 3) {
        const unsigned char *from = (const unsigned char *)bytes + i;
        size_t count = size - i < 3 ? size - i : 3;
        uint32_t bits = (uint32_t)from[0] << 16 | (count > 1 ? (uint32_t)from[1] << 8 : 0) | (count > 2 ? from[2] : 0);
        for (size_t k = 0; k < 4; k++)
            *out++ = k <= count ? ALPHABET[bits >> (18 - 6 * k) & 63] : '=';
    }
    *out = '\0';
    return text;
}
