/* lines.h - small files of lines, which an operator writes: tokens, keys, presets.
 *
 * Blank lines, and lines that begin with '#', are comments. Spaces at both ends of a line do not count.
 */
#ifndef ZRASTERD_LINES_H
#define ZRASTERD_LINES_H

#include <stdbool.h>
#include <stddef.h>

enum { LINES_BYTES_MAX = 1 << 20 };

struct lines {
    const char *path; /* as it was given; must outlive this */
    char *text;       /* malloc'd; each line that was read ends with a zero */
    size_t size, at;  /* at: of the next line */
    unsigned number;  /* of the last line, from 1 */
    bool is_public;   /* all users of the machine may read the file */
};

/* Reads a regular file of up to LINES_BYTES_MAX bytes. False: `message` has the file and the reason. */
bool lines_open(struct lines *lines, const char *path, char *message, size_t message_size);

/* Returns the next line that is no comment, NULL at the end. It belongs to `lines`, and may be changed in place. */
char *lines_next(struct lines *lines);

/* Writes "FILE:LINE: " and a fault of the last line. Returns false. */
bool lines_fault(const struct lines *lines, char *message, size_t message_size, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Overwrites the text, and frees it. */
void lines_close(struct lines *lines);

#endif
