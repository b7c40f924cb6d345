/* files.h - support: files that tests read. */
#ifndef ZR_TEST_FILES_H
#define ZR_TEST_FILES_H

#include <stddef.h>

/* Reads a whole file and appends a zero; free it. NULL with errno if it cannot be read. */
char *file_read(const char *path, size_t *size);

/* Calls use(path, context) for each file of a folder whose name has the ending, such as ".json", in the order of names.
 * Returns their number; -1 if the folder cannot be read. */
int files_each(const char *folder, const char *ending, void (*use)(const char *path, void *context), void *context);

#endif
