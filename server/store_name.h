/* store_name.h - names of assets: the SHA-256 of their bytes, as 64 lower-case hexadecimal digits. */
#ifndef ZRASTERD_STORE_NAME_H
#define ZRASTERD_STORE_NAME_H

#include <stdbool.h>
#include <stddef.h>

#include "base/cancel.h"

enum { STORE_NAME_SIZE = 64 + 1 }; /* with a final zero */

bool store_is_name(const char *text);

/* Computes the name of these bytes. */
void store_name(const void *bytes, size_t size, char name[STORE_NAME_SIZE]);

/* Computes the name of the next `size` bytes of a file. False with errno: 0: fewer bytes; ECANCELED; or a read error.
 * `cancel` may be NULL. */
bool store_name_of_file(int fd, size_t size, const struct zr_cancel *cancel, char name[STORE_NAME_SIZE]);

#endif
