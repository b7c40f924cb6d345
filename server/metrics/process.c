#include "process.h"

#include <dirent.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

/* Counts the open files, without the one that lists them. */
static double count_files(void)
{
    DIR *folder = opendir("/proc/self/fd");
    double count = -1;
    if (!folder) return -1;
    for (const struct dirent *entry; (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

static void read_memory(struct process_now *now)
{
    unsigned long pages, resident;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file) return;
    if (fscanf(file, "%lu %lu", &pages, &resident) == 2) {
        const double page = (double)sysconf(_SC_PAGESIZE);
        now->virtual_bytes = page * (double)pages;
        now->resident_bytes = page * (double)resident;
    }
    fclose(file);
}

struct process_now process_look(void)
{
    struct process_now now = {-1, -1, -1, count_files(), -1};
    struct rusage usage;
    struct rlimit limit;
    read_memory(&now);
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        now.cpu_s = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                    1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        now.max_files = (double)limit.rlim_cur;
    return now;
}
