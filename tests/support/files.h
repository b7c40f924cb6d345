/* files.h - support: files that tests read. */
#ifndef ZR_TEST_FILES_H
#define ZR_TEST_FILES_H

#include <stddef.h>

/* Reads a whole file and appends a zero; free it. NULL with errno if it cannot be read. */
char *file_read(const char *path, size_t *size);

#endif
