/* store_file.h - the files of a store: opened, written, and found at start. */
#ifndef ZRASTERD_STORE_FILE_H
#define ZRASTERD_STORE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>
#include <time.h>

enum { STORE_TEMPORARY_SIZE = 16 + 16 + 1 }; /* what begins all of them, digits, a final zero */

/* Reading. A regular file and no link, or -1 and errno. */
int store_file_open(int directory, const char *name, struct stat *info);

/* Exactly `size` bytes. False: there are fewer (errno 0), or errno. */
bool store_file_read(int fd, void *bytes, size_t size);

/* Writes a file under a new temporary name, synced, with `used` as its time. False, nothing is
 * left, and errno. Its lock tells other processes that somebody works on it; close *fd once it
 * has been renamed or removed. */
bool store_file_write(int directory, const void *bytes, size_t size, struct timespec used,
                      char temporary[STORE_TEMPORARY_SIZE], int *fd);

bool store_file_is_temporary(const char *name);

/* Removes a temporary file that nobody works on any more. */
void store_file_sweep(int directory, const char *temporary);

#endif
