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

/* "-" is standard input or output. False with errno set. */
bool bytes_read(struct bytes *bytes, const char *path);

/* Do both paths lead to one regular file? "-", for the first, is standard input. */
bool bytes_same_file(const char *a, const char *b);

/* Writes beside the target first and renames, so that no half file is ever seen. */
bool bytes_write(const struct bytes *bytes, const char *path);

#endif
