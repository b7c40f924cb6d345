/* utf8.h - mcp: characters of UTF-8 (RFC 3629). */
#ifndef MCP_UTF8_H
#define MCP_UTF8_H

#include <stddef.h>

/* Returns the bytes of the character at `at`, before `end`; 0: it is broken. */
static inline size_t mcp_utf8_length(const char *at, const char *end)
{
    const unsigned char *byte = (const unsigned char *)at;
    const size_t left = (size_t)(end - at);
    if (left == 0) return 0;
    if (byte[0] < 0x80) return 1;
    const size_t length = byte[0] >= 0xF0 ? 4 : byte[0] >= 0xE0 ? 3 : 2;
    if (byte[0] < 0xC2 || byte[0] > 0xF4 || left < length) return 0;
    for (size_t i = 1; i < length; i++)
        if ((byte[i] & 0xC0) != 0x80) return 0;
    const unsigned char next = byte[1];
    if ((byte[0] == 0xE0 && next < 0xA0) || (byte[0] == 0xED && next > 0x9F)) return 0; /* overlong; surrogates */
    if ((byte[0] == 0xF0 && next < 0x90) || (byte[0] == 0xF4 && next > 0x8F)) return 0; /* overlong; > U+10FFFF */
    return length;
}

#endif
