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

/* Cut to 160 bytes. Lost where the arena has failed, which is noticed anyway. */
void zr_warning_list_add(struct zr_arena *arena, struct zr_warning_list *list, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
