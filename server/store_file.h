/* store_file.h - files of a store: opens, reads and writes them, and removes temporary ones. */
#ifndef ZRASTERD_STORE_FILE_H
#define ZRASTERD_STORE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>
#include <time.h>

enum { STORE_TEMPORARY_SIZE = 16 + 16 + 1 }; /* prefix, digits, final zero */

/* Opens a regular file, no link, for reading. -1 with errno on failure. */
int store_file_open(int directory, const char *name, struct stat *info);

/* Reads exactly `size` bytes. False with errno on failure; errno 0: the file has fewer bytes. */
bool store_file_read(int fd, void *bytes, size_t size);

/* Writes and syncs a file under a new temporary name, with the time `used`. A lock on *fd tells other processes that it
 * is in use; close it after renaming or removing the file. False with errno on failure; no file is left. */
bool store_file_write(int directory, const void *bytes, size_t size, struct timespec used,
                      char temporary[STORE_TEMPORARY_SIZE], int *fd);

bool store_file_is_temporary(const char *name);

/* Removes a temporary file without a writer. */
void store_file_sweep(int directory, const char *temporary);

#endif
