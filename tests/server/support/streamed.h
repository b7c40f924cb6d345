/* streamed.h - streamed answers of a daemon, read as parts. */
#ifndef TEST_STREAMED_H
#define TEST_STREAMED_H

#include "client.h"

struct streamed {
    int fd;
    char *bytes; /* as received, with a final zero */
    size_t size, capacity;
    bool has_ended; /* the daemon has closed, or sent the last chunk */
    int status;
};

/* Asks for a stream; `buffer`: bytes that the client's system takes beyond those that are read, 0: its own choice. */
struct streamed streamed_begin(const struct daemon *daemon, const char *scene, int buffer);

/* Reads the bytes that have arrived, or waits for some. False: the connection ended, or none arrived in time. */
bool streamed_read(struct streamed *streamed);

/* Reads until the first part is whole. */
void streamed_read_part(struct streamed *streamed);

/* Reads to the end. */
void streamed_read_all(struct streamed *streamed);

void streamed_end(struct streamed *streamed);

/* ---- its parts ---- */

struct streamed_part {
    char name[128], type[64]; /* "": none */
    const char *bytes;
    size_t size;
};

struct streamed_parts {
    char *body; /* without the frames of chunks */
    size_t size, at;
    char boundary[80];
    bool is_whole; /* all chunks are there */
};

/* Of an answer with status 200; the test fails if it is malformed so far. */
struct streamed_parts streamed_parts(const struct streamed *streamed);

/* Returns the next part; false after the last complete one. */
bool streamed_next(struct streamed_parts *parts, struct streamed_part *part);

/* Whether the final delimiter comes next, and nothing behind it. */
bool streamed_is_final(const struct streamed_parts *parts);

#endif
