/* memory.h - client: the value of --memory. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a number of bytes, with K, M, G or T behind it, KB or KiB (powers of 1024), or "50%" of `spare`. False: it is
 * none, or less than 1M. */
bool memory_read(const char *text, size_t spare, size_t *bytes);

#endif
