/* warning_list.h - input: what readers find odd but drawable, for zr_scene.warnings. */
#ifndef ZR_WARNING_LIST_H
#define ZR_WARNING_LIST_H

#include <stddef.h>

#include "base/arena.h"

/* All zero to begin with. */
struct zr_warning_list {
    size_t count, room;
    const char **texts;
};

/* Cut to 160 bytes. Lost where the arena has failed, which whoever reads notices anyway. */
void zr_warning_list_add(struct zr_arena *arena, struct zr_warning_list *list, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
