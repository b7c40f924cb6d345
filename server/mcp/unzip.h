/* unzip.h - mcp, client: the files of an answer with several outputs. */
#ifndef UNZIP_H
#define UNZIP_H

#include <stdbool.h>
#include <stddef.h>

struct unzip {
    const unsigned char *at, *end;
};
struct unzip_file {
    char name[128]; /* "depth.npy", "front.depth.npy" */
    const void *data;
    size_t size;
};

/* Moves to the next stored file of an archive, which begins at unzip->at. Returns false after the last one, and if the
 * archive is broken, with NULL in unzip->at. */
bool unzip_next(struct unzip *unzip, struct unzip_file *file);

#endif
