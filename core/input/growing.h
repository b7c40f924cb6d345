/* growing.h - input: arrays that grow while a list of a text is read, whose length nobody has counted.
 *
 * Why:    to count first takes an eighth of reading a mesh. Room is guessed from the items read so far and the text
 *         that is left, and what was too much is given back: a large array is copied once, when it is small.
 * Memory: in the text's arena. Where the guess would take more than half of what is left there, arrays double.
 */
#ifndef ZR_GROWING_H
#define ZR_GROWING_H

#include "input/json.h"

struct zr_growing {
    size_t size; /* of an item: the caller sets it, and all else is zero to begin with */
    size_t count, room;
    void *items;
    const char *start; /* where in the text the first item was */
};

/* Room for `more` items behind the last. False, and the arena has failed, where there is no memory. */
bool zr_growing_reserve(struct zr_growing *array, struct zr_json *json, size_t more);

/* The place behind the last item, which count does not include yet; NULL where there is no memory. */
static inline void *zr_growing_next(struct zr_growing *array, struct zr_json *json)
{
    if (array->count == array->room && !zr_growing_reserve(array, json, 1)) return NULL;
    return (char *)array->items + array->count * array->size;
}

/* Gives back the room that is left, where that can be. */
void zr_growing_trim(struct zr_growing *array, struct zr_arena *arena);

#endif
