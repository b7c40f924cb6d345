/* admission.h - checks the memory limit of the daemon's control group (version 2 or 1). Limits of time: rendering.c. */
#ifndef ZRASTERD_ADMISSION_H
#define ZRASTERD_ADMISSION_H

#include <stdbool.h>

/* Returns true if more than ADMISSION_MEMORY_PERCENT of the control group's memory limit is used. Page cache that the
 * kernel can drop at once does not count. `folder` is that of the control group, such as /sys/fs/cgroup. False without
 * a limit. */
enum { ADMISSION_MEMORY_PERCENT = 92 };
bool admission_memory_is_short(const char *folder);

#endif
