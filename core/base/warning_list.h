/* warning_list.h - base: what is odd but drawable, as it was read and as it was drawn. */
#ifndef ZR_WARNING_LIST_H
#define ZR_WARNING_LIST_H

#include <stddef.h>

#include "base/arena.h"

/* All zero to begin with. */
struct zr_warning_list {
    size_t count, room;
    const char **texts;
};

/* Adds those of another list, which may be in another arena's memory. */
void zr_warning_list_append(struct zr_arena *arena, struct zr_warning_list *list, const struct zr_warning_list *more);

/* Cut to 256 bytes. Lost where the arena has failed, which is noticed anyway. */
void zr_warning_list_add(struct zr_arena *arena, struct zr_warning_list *list, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
