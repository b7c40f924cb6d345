#include "support/files.h"

#include <stdio.h>
#include <stdlib.h>

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
