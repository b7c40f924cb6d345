/* files.h - support: files that tests read. */
#ifndef ZR_TEST_FILES_H
#define ZR_TEST_FILES_H

#include <stddef.h>

/* All of a file, with a zero behind it, to be freed; NULL where it cannot be read: errno says why. */
char *file_read(const char *path, size_t *size);

#endif
