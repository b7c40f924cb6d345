/* base64.h - support: Base64 encoding for requests in JSON. */
#ifndef ZR_TEST_BASE64_H
#define ZR_TEST_BASE64_H

#include <stddef.h>

/* Returns `prefix` and the encoded bytes, zero-terminated; free it. */
char *base64_of(const char *prefix, const void *bytes, size_t size);

#endif
