#include "api/spare_memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "api/control_group.h"

enum { LINE = 512, MOST_GROUPS = 32 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Returns a number of a file of the kernel times `unit`; SIZE_MAX: there is none. */
static size_t number_of(const char *folder, const char *file, const char *key, size_t unit)
{
    uint64_t value;
    return zr_kernel_number(folder, file, key, &value) && value < SIZE_MAX / unit ? (size_t)value * unit : SIZE_MAX;
}

/* ---- control groups ---- */

static size_t left_in_group(const struct zr_group_files *files, const char *group)
{
    char folder[2 * LINE];
    snprintf(folder, sizeof folder, "/sys/fs/cgroup%s%s", files->below, group);
    const size_t most = number_of(folder, files->limit, "", 1), used = number_of(folder, files->used, "", 1);
    if (most >= ZR_GROUP_UNLIMITED || used == SIZE_MAX) return SIZE_MAX;
    const size_t cache = number_of(folder, files->list, files->droppable, 1), held = cache < used ? used - cache : used;
    return most > held ? most - held : 0;
}

/* Returns the least of a group, such as "/a/b", and of those above it. A container may mount its own group as the root
 * and still name it by the path on the host; that path is then missing. */
static size_t left_in_groups(const struct zr_group_files *files, char *group)
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
            left = least(left, left_in_groups(&zr_group_files[0], group));
        else if (strstr(names, "memory"))
            left = least(left, left_in_groups(&zr_group_files[1], group));
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
    const size_t pages = number_of("/proc/self", "statm", "", 1), most = (size_t)limit.rlim_cur;
    if (page <= 0 || pages > most / (size_t)page) return 0;
    return most - pages * (size_t)page;
}

size_t zr_spare_memory(void)
{
    const size_t machine = number_of("/proc", "meminfo", "MemAvailable:", 1024);
    return least(least(machine, left_in_all_groups()), left_in_address_space());
}

size_t zr_default_memory(void)
{
    const size_t spare = zr_spare_memory(), few = (size_t)1 << 30;
    if (spare == SIZE_MAX) return few;
    return spare / 4 * 3 > few ? spare / 4 * 3 : few;
}
