/* bytes.h - client: whole files in memory. */
#ifndef BYTES_H
#define BYTES_H

#include <stdbool.h>
#include <stddef.h>

struct bytes {
    char *data; /* NULL while empty */
    size_t size, room;
};

bool bytes_add(struct bytes *bytes, const void *data, size_t size);
void bytes_free(struct bytes *bytes);

/* Reads a file; "-": standard input. False with errno on failure. */
bool bytes_read(struct bytes *bytes, const char *path);

/* Returns true if both paths are one regular file. For `a`, "-" is standard input. */
bool bytes_same_file(const char *a, const char *b);

/* Writes a file; "-": standard output. A regular file is written beside its target and renamed, so it is never
 * incomplete. */
bool bytes_write(const struct bytes *bytes, const char *path);

#endif
