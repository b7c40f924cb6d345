/* warning_list.h - base: texts of warnings about input and rendering. */
#ifndef ZR_WARNING_LIST_H
#define ZR_WARNING_LIST_H

#include <stddef.h>

#include "base/arena.h"

/* Initially all zero. */
struct zr_warning_list {
    size_t count, room;
    const char **texts;
};

/* Appends copies of another list's warnings, which may be in another arena. */
void zr_warning_list_append(struct zr_arena *arena, struct zr_warning_list *list, const struct zr_warning_list *more);

/* Adds a warning, cut to 256 bytes, with control characters as "?". Drops it if the arena fails, which the caller detects anyway. */
void zr_warning_list_add(struct zr_arena *arena, struct zr_warning_list *list, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
