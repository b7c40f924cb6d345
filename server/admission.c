#include "admission.h"

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_SIZE = 8192 }; /* memory.stat has some 2000 bytes */

/* Reads a number from a file of the kernel: the first one, or the one behind `key` at the beginning of a line. False
 * without such a number ("max": no limit). */
static bool read_number(const char *folder, const char *file, const char *key, uint64_t *out)
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

static bool is_short(uint64_t used, uint64_t limit)
{
    return (double)used > (double)limit * (ADMISSION_MEMORY_PERCENT / 100.0);
}

bool admission_memory_is_short(const char *folder)
{
    static const struct {
        const char *used, *limit, *list, *droppable;
    } versions[] = {
        {"memory.current", "memory.max", "memory.stat", "inactive_file "},
        {"memory/memory.usage_in_bytes", "memory/memory.limit_in_bytes", "memory/memory.stat", "total_inactive_file "}};
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) {
        uint64_t used, limit, droppable = 0;
        if (!read_number(folder, versions[i].used, "", &used) || !read_number(folder, versions[i].limit, "", &limit))
            continue;
        if (!is_short(used, limit)) return false;
        /* Last: the kernel may sum it over all groups and processors, which takes milliseconds. */
        read_number(folder, versions[i].list, versions[i].droppable, &droppable);
        return is_short(used - (droppable < used ? droppable : used), limit);
    }
    return false;
}
