/* json_fault.h - input: places in a text, and faults there. */
#ifndef ZR_JSON_FAULT_H
#define ZR_JSON_FAULT_H

#include "input/json/json.h"

struct zr_json_field;

/* The place of a reader in the text: a chain of links on the stack, formatted as a JSON Pointer (RFC 6901) for faults
 * only. `key` is NULL for an item of a list. */
struct zr_json_path {
    const struct zr_json_path *parent; /* NULL: the root */
    const char *key;
    size_t index;
    const struct zr_json_field *field; /* row of the key whose value is read; NULL: an item, or a key of no table */
};

#define ZR_JSON_KEY(parent, key)    (&(const struct zr_json_path){(parent), (key), 0, NULL})
#define ZR_JSON_ITEM(parent, index) (&(const struct zr_json_path){(parent), NULL, (index), NULL})

/* Reports ZR_BAD_SCENE at `path` (NULL: the root); returns false. Reports nothing once the arena has failed, since
 * values that could not be kept would seem to be missing. Ends a part that json_list.h reads ahead. */
bool zr_json_fault(struct zr_json *json, const struct zr_json_path *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Returns the JSON Pointer of a path, in the arena. NULL without memory. */
const char *zr_json_pointer(struct zr_arena *arena, const struct zr_json_path *path);

#endif
