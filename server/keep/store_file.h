/* store_file.h - files of a store: names, opens, reads and writes them, and removes temporary ones. The name of an
 * asset is the SHA-256 of its bytes, as 64 lower-case hexadecimal digits. */
#ifndef ZRASTERD_STORE_FILE_H
#define ZRASTERD_STORE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>
#include <time.h>

#include "base/cancel.h"

enum { STORE_NAME_SIZE = 64 + 1 }; /* with a final zero */

bool store_is_name(const char *text);

/* Computes the name of these bytes. */
void store_name(const void *bytes, size_t size, char name[STORE_NAME_SIZE]);

/* Computes the name of the next `size` bytes of a file. False with errno: 0: fewer bytes; ECANCELED; or a read error.
 * `cancel` may be NULL. */
bool store_name_of_file(int fd, size_t size, const struct zr_cancel *cancel, char name[STORE_NAME_SIZE]);

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
