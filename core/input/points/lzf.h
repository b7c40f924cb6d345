/* lzf.h - input: decodes LZF, the compression of PCD. Source: the format of liblzf 3.6 (Marc Lehmann). */
#ifndef ZR_LZF_H
#define ZR_LZF_H

#include <stdbool.h>
#include <stddef.h>

#include "base/cancel.h"

/* Decoded bytes per compressed byte, at most: three bytes copy 264. */
enum { ZR_LZF_PER_BYTE = 88 };

/* Decodes exactly `out_size` bytes. False if the bytes are broken, or if cancelled. */
bool zr_lzf_decode(const unsigned char *bytes, size_t size, unsigned char *out, size_t out_size,
                   const struct zr_cancel *cancel);

#endif
