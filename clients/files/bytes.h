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

/* Adds a text. bytes_text returns all texts as one, valid until the next change. */
__attribute__((format(printf, 2, 3))) bool bytes_print(struct bytes *bytes, const char *format, ...);
const char *bytes_text(const struct bytes *bytes);

void bytes_free(struct bytes *bytes);

/* Reads a file; "-": standard input. A zero follows the bytes. Returns false with errno on failure, which is
 * EINTR if a signal was caught during a wait for a pipe. */
bool bytes_read(struct bytes *bytes, const char *path);

/* Returns true if both paths are one regular file. For `a`, "-" is standard input. */
bool bytes_same_file(const char *a, const char *b);

/* Writes a file; "-": standard output. A regular file gets its name once it is written, so it is never incomplete, even
 * if the process is killed. */
bool bytes_write(const struct bytes *bytes, const char *path);

#endif
