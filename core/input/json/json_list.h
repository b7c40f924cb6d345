/* json_list.h - input: reads the items of a list into arrays that grow; large lists on several threads.
 *
 * Why:    two threads read a mesh in two thirds of the time of one (README.md, "make bench": the rows 2T of JSON).
 * How:    the text is cut into parts where an item seems to begin. Each part is read ahead into arrays of its own. A
 *         part counts only if reading the text before it ends exactly at its first byte, in the same list: then a
 *         single thread would read the same. So no pass counts items first, and a wrong cut costs only time. A fault or
 *         an unusual item ends a part; the caller's thread then reads on from there and reports.
 * Memory: all lists of a text use one block of the request's arena, 0.7 MB, one after the other. A list inside an item
 *         of such a list is read by one thread.
 */
#ifndef ZR_JSON_LIST_H
#define ZR_JSON_LIST_H

#include "input/json/json.h"
#include "input/json/json_value.h"

/* An array that grows while a list of unknown length is read.
 *
 * Why:    counting first takes an eighth of the time of reading a mesh. Instead the room is estimated from the items
 *         read so far and the text left, and the excess is returned. So a large array is copied once, while it is
 *         small.
 * Memory: in the text's arena. If the estimate exceeds half of the memory left, arrays double instead.
 */
struct zr_growing {
    size_t size; /* bytes per item, set by the caller; all other members start at zero */
    size_t count, room;
    void *items;
    const char *start; /* the text's place at the first item */
    size_t first;      /* item 0 of the list that is read, if others precede it; numbers the items of its path */
};

/* Makes room for `more` items after the last. False if memory runs out; the arena has then failed. */
bool zr_growing_reserve(struct zr_growing *array, struct zr_json *json, size_t more);

/* Returns the slot after the last item; the caller increments count. NULL if memory runs out. */
static inline void *zr_growing_next(struct zr_growing *array, struct zr_json *json)
{
    if (array->count == array->room && !zr_growing_reserve(array, json, 1)) return NULL;
    return (char *)array->items + array->count * array->size;
}

/* Appends a number to an array of uint32_t. False if memory runs out. */
static inline bool zr_growing_add(struct zr_growing *array, struct zr_json *json, size_t number)
{
    uint32_t *place = zr_growing_next(array, json);
    if (!place) return false;
    *place = (uint32_t)number;
    array->count++;
    return true;
}

/* Extends the array to `count` items by copies of `item`. False if memory runs out. */
bool zr_growing_fill(struct zr_growing *array, struct zr_json *json, size_t count, const void *item);

/* Returns unused room to the arena if the array is its newest allocation. */
void zr_growing_trim(struct zr_growing *array, struct zr_arena *arena);

struct zr_json_list {
    char opening; /* first byte of each item: '[' or '{' */
    /* Reads items from json->at into *state, until the first item that begins at `until` or after it, or the list's
     * end. */
    void (*read)(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until);
    /* Makes *part the state of a list without items, otherwise equal to *state, with room for `share` times the items
     * of *state. Calls are sequential. */
    bool (*begin_part)(struct zr_json *json, const void *state, void *part, double share);
    /* Appends the items of a part to *state. */
    bool (*join)(struct zr_json *json, void *state, const void *part);
};

/* The largest size of a state, bytes. */
enum { ZR_JSON_STATE_MAX = 512 };

/* Reads the next value, a list, into *state. False if it is no list, which is reported, or if reading stops. */
bool zr_json_list_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       void *state);

/* For begin_part and join: an array with room for `share` times the items of `array` and `more`; and the append of a
 * part's items. */
bool zr_growing_begin_part(struct zr_json *json, const struct zr_growing *array, struct zr_growing *part, double share,
                           size_t more);
bool zr_growing_join(struct zr_json *json, struct zr_growing *array, const struct zr_growing *part);

#endif
