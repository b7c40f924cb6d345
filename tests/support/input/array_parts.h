/* array_parts.h - support: scenes whose lists of numbers are replaced by parts of a request: NPY files or arrays. */
#ifndef ZR_TEST_ARRAY_PARTS_H
#define ZR_TEST_ARRAY_PARTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "api/zraster.h"
#include "unit/common/guarded.h"

/* How numbers are handed over. is_whole: floats that are all integers have the type of indices. */
struct array_way {
    const char *name;
    bool is_npy, is_whole;
    uint32_t flags, floats, indices;
};

enum { ARRAY_WAYS = 6, ARRAY_PARTS_MAX = 200 };
extern const struct array_way array_ways[ARRAY_WAYS];

struct array_parts {
    size_t count;
    char names[ARRAY_PARTS_MAX][8];
    struct zraster_part items[ARRAY_PARTS_MAX];
    struct guarded memory[ARRAY_PARTS_MAX]; /* ends at a guard page */
};

/* Adds the part "p0", "p1", ...: a copy of numbers of a type, ZRASTER_F4 to ZRASTER_U8. `columns`: 0 for a list. */
void array_parts_add(struct array_parts *parts, const struct array_way *way, uint32_t type, const void *numbers,
                     size_t bytes, size_t rows, size_t columns);

/* Returns the text of the scene with parts in place of all lists that may be arrays; free it. */
char *array_parts_of_scene(const char *scene, const struct array_way *way, struct array_parts *parts);

/* Overwrites the parts that are not lent: the library must not read them again. */
void array_parts_spoil(struct array_parts *parts);

/* Frees and removes all parts. */
void array_parts_free(struct array_parts *parts);

#endif
