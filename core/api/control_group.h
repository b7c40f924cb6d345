/* control_group.h - api: files of the kernel that tell the memory of control groups, version 2 and 1. */
#ifndef ZR_CONTROL_GROUP_H
#define ZR_CONTROL_GROUP_H

#include <stdbool.h>
#include <stdint.h>

/* Files of a group. `below`: folder of the groups, within that where all of them are mounted. `droppable`: the line of
 * `list` that has the page cache which the kernel can drop at once. */
struct zr_group_files {
    const char *below, *used, *limit, *list, *droppable;
};
enum { ZR_GROUP_VERSIONS = 2 };
extern const struct zr_group_files zr_group_files[ZR_GROUP_VERSIONS]; /* the newer version first */

/* From this number on, a limit is none: version 1 has about 2^63. */
#define ZR_GROUP_UNLIMITED (UINT64_C(1) << 60)

/* Reads a number from a file of the kernel: the first one, or the one behind `key` at the beginning of a line. False
 * without such a number ("max": no limit). Files longer than 8 KiB are cut. */
bool zr_kernel_number(const char *folder, const char *file, const char *key, uint64_t *out);

#endif
