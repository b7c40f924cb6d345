#include "api/spare_memory.h"

#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

enum { LINE = 512, MOST_GROUPS = 32 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Returns a number of a text times `unit`; SIZE_MAX for "max" and for other words. */
static size_t number_of(const char *text, size_t unit)
{
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    return end == text || errno != 0 || value > SIZE_MAX / unit ? SIZE_MAX : (size_t)value * unit;
}

/* Returns the number of a file with one; SIZE_MAX: none. */
static size_t read_number(const char *path)
{
    char line[LINE];
    FILE *file = fopen(path, "re");
    const bool is_read = file && fgets(line, sizeof line, file);
    if (file) fclose(file);
    return is_read ? number_of(line, 1) : SIZE_MAX;
}

/* Returns the number behind a name that begins a line; SIZE_MAX: there is no such line. */
static size_t read_named(const char *path, const char *name, size_t unit)
{
    char line[LINE];
    size_t found = SIZE_MAX;
    FILE *file = fopen(path, "re");
    while (file && found == SIZE_MAX && fgets(line, sizeof line, file))
        if (strncmp(line, name, strlen(name)) == 0) found = number_of(line + strlen(name), unit);
    if (file) fclose(file);
    return found;
}

/* ---- control groups ---- */

/* Files of a control group's memory, by version. */
struct group_files {
    const char *mount, *most, *used, *cache; /* cache: line of memory.stat */
};
static const struct group_files groups_2 = {"/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file "},
                                groups_1 = {"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                            "total_inactive_file "};

static size_t left_in_group(const struct group_files *files, const char *group)
{
    char path[2 * LINE];
    snprintf(path, sizeof path, "%s%s/%s", files->mount, group, files->most);
    const size_t most = read_number(path);
    snprintf(path, sizeof path, "%s%s/%s", files->mount, group, files->used);
    const size_t used = read_number(path);
    if (most == SIZE_MAX || used == SIZE_MAX) return SIZE_MAX;
    snprintf(path, sizeof path, "%s%s/memory.stat", files->mount, group);
    const size_t cache = read_named(path, files->cache, 1), held = cache < used ? used - cache : used;
    return most > held ? most - held : 0;
}

/* Returns the least of a group, such as "/a/b", and of those above it. A container may mount its own group as the root
 * and still name it by the path on the host; that path is then missing. */
static size_t left_in_groups(const struct group_files *files, char *group)
{
    size_t left = left_in_group(files, "");
    for (int i = 0; i < MOST_GROUPS && *group; i++) {
        left = least(left, left_in_group(files, group));
        char *slash = strrchr(group, '/');
        if (!slash) break;
        *slash = '\0';
    }
    return left;
}

/* Reads "0::/path" of version 2 and "5:memory:/path" of version 1. */
static size_t left_in_all_groups(void)
{
    char line[LINE];
    size_t left = SIZE_MAX;
    FILE *file = fopen("/proc/self/cgroup", "re");
    while (file && fgets(line, sizeof line, file)) {
        char *names = strchr(line, ':'), *group = names ? strchr(names + 1, ':') : NULL;
        if (!group) continue;
        *group++ = '\0';
        group[strcspn(group, "\n")] = '\0';
        if (names[1] == '\0')
            left = least(left, left_in_groups(&groups_2, group));
        else if (strstr(names, "memory"))
            left = least(left, left_in_groups(&groups_1, group));
    }
    if (file) fclose(file);
    return left;
}

/* ---- address space ---- */

static size_t left_in_address_space(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return SIZE_MAX;
    const long page = sysconf(_SC_PAGESIZE);
    const size_t pages = read_number("/proc/self/statm"), most = (size_t)limit.rlim_cur;
    if (page <= 0 || pages > most / (size_t)page) return 0;
    return most - pages * (size_t)page;
}

size_t zr_spare_memory(void)
{
    const size_t machine = read_named("/proc/meminfo", "MemAvailable:", 1024);
    return least(least(machine, left_in_all_groups()), left_in_address_space());
}

size_t zr_default_memory(void)
{
    const size_t spare = zr_spare_memory(), few = (size_t)1 << 30;
    if (spare == SIZE_MAX) return few;
    return spare / 4 * 3 > few ? spare / 4 * 3 : few;
}
