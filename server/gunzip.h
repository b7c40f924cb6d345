/* gunzip.h - request bodies that come compressed (Content-Encoding: gzip), through zlib. */
#ifndef ZRASTERD_GUNZIP_H
#define ZRASTERD_GUNZIP_H

#include <stddef.h>

#include "base/arena.h"
#include "base/cancel.h"

enum gunzip_status {
    GUNZIP_OK,
    GUNZIP_BROKEN,    /* not gzip, cut short, a wrong checksum, or something else behind it */
    GUNZIP_TOO_LARGE, /* more than `max` bytes come out */
    GUNZIP_NO_MEMORY,
    GUNZIP_CANCELLED
};

/* The bytes that come out lie in the arena. A small body cannot claim much memory:
 * room grows only as bytes come, and no further than `max`. `cancel` may be NULL. */
enum gunzip_status gunzip(struct zr_arena *arena, const char *bytes, size_t size, size_t max,
                          const struct zr_cancel *cancel, char **out, size_t *out_size);

#endif
