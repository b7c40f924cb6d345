#include "api/control_group.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_SIZE = 8192 }; /* memory.stat has some 2000 bytes */

const struct zr_group_files zr_group_files[ZR_GROUP_VERSIONS] = {
    {"", "memory.current", "memory.max", "memory.stat", "inactive_file "},
    {"/memory", "memory.usage_in_bytes", "memory.limit_in_bytes", "memory.stat", "total_inactive_file "}};

bool zr_kernel_number(const char *folder, const char *file, const char *key, uint64_t *out)
{
    char path[512], text[FILE_SIZE], *end;
    snprintf(path, sizeof path, "%s/%s", folder, file);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return false;
    ssize_t size = read(fd, text, sizeof text - 1);
    close(fd);
    text[size > 0 ? size : 0] = '\0';
    const char *line = text;
    size_t length = strlen(key);
    while (line && strncmp(line, key, length) != 0) {
        line = strchr(line, '\n');
        if (line) line++;
    }
    if (!line) return false;
    *out = strtoull(line + length, &end, 10);
    return end != line + length;
}
