/* gunzip.h - decompresses request bodies (Content-Encoding: gzip) by zlib. */
#ifndef ZRASTERD_GUNZIP_H
#define ZRASTERD_GUNZIP_H

#include <stddef.h>

#include "base/arena.h"
#include "base/cancel.h"

enum gunzip_status {
    GUNZIP_OK,
    GUNZIP_BROKEN,    /* not gzip, cut short, a wrong checksum, or other bytes after it */
    GUNZIP_TOO_LARGE, /* the output exceeds `max` bytes */
    GUNZIP_NO_MEMORY,
    GUNZIP_CANCELLED
};

/* Decompresses the bytes into the arena and replaces them by the result, if it is GUNZIP_OK. A small body cannot claim
 * much memory: room grows with the output, up to `max`. `cancel` may be NULL. */
enum gunzip_status gunzip(struct zr_arena *arena, const struct zr_cancel *cancel, size_t max, const char **bytes,
                          size_t *size);

#endif
