#include "support/files.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

char *file_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    char *bytes = NULL;
    long length = -1;
    if (file && fseek(file, 0, SEEK_END) == 0) length = ftell(file);
    if (length >= 0) bytes = malloc((size_t)length + 1);
    if (bytes) {
        rewind(file);
        *size = fread(bytes, 1, (size_t)length, file);
        bytes[*size] = '\0';
    }
    if (file) fclose(file);
    return bytes;
}

int files_each(const char *folder, const char *ending, void (*use)(const char *path, void *context), void *context)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    int used = count < 0 ? -1 : 0;
    for (int i = 0; i < count; i++) {
        char path[600];
        const char *dot = strrchr(entries[i]->d_name, '.');
        snprintf(path, sizeof path, "%s/%s", folder, entries[i]->d_name);
        if (dot && strcmp(dot, ending) == 0) {
            use(path, context);
            used++;
        }
        free(entries[i]);
    }
    if (count >= 0) free(entries);
    return used;
}
