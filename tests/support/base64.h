/* base64.h - support: bytes as a request has them in JSON. */
#ifndef ZR_TEST_BASE64_H
#define ZR_TEST_BASE64_H

#include <stddef.h>

/* Behind `prefix`, zero-terminated; free it. */
char *base64_of(const char *prefix, const void *bytes, size_t size);

#endif
