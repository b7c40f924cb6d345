/* admission.h - is there memory for more work? What the control group says, version 2 or 1,
 * where the daemon runs in one that has a limit. (Time: rendering.c.)
 */
#ifndef ZRASTERD_ADMISSION_H
#define ZRASTERD_ADMISSION_H

#include <stdbool.h>

/* True where more than ADMISSION_MEMORY_PERCENT of the control group's memory limit is
 * used. Page cache that the kernel can drop at once does not count. `folder` is where the
 * kernel tells, such as /sys/fs/cgroup. */
enum { ADMISSION_MEMORY_PERCENT = 92 };
bool admission_memory_is_short(const char *folder);

#endif
