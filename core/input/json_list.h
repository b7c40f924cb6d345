/* json_list.h - input: item after item of a list; of a large one, by several threads.
 *
 * Why:    two threads read a mesh in two thirds of the time of one (README.md, "make bench": the rows 2T of JSON).
 * How:    parts of the text begin where an item seems to begin, and are read ahead into arrays of their own. A part
 *         counts only if reading what is before it arrives exactly where it begins: the same place in the same list
 *         means the same result. So nothing is counted first, and a wrong guess costs time only. What is odd or wrong
 *         ends a part: the caller's thread goes on from there alone, and reports.
 * Memory: parts are read into one block of the request's arena, 1.3 MB, which all lists of a text use, one after the
 *         other: a list inside an item of such a list is read by one thread.
 */
#ifndef ZR_JSON_LIST_H
#define ZR_JSON_LIST_H

#include "input/growing.h"
#include "input/json_value.h"

struct zr_json_list {
    char opening; /* of items: '[' or '{' */
    /* Reads items into *state, from where `json` is in the list, up to one that begins at `until` or behind it, or to
     * the list's end. */
    void (*read)(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until);
    /* *part becomes a state as of a list with no items yet, like *state in all else, with room for `share` of the items
     * that *state has. Calls of it come one after another. */
    bool (*begin_part)(struct zr_json *json, const void *state, void *part, double share);
    /* Items of a part behind those in *state. */
    bool (*join)(struct zr_json *json, void *state, const void *part);
};

/* What a state may take. */
enum { ZR_JSON_STATE_MAX = 512 };

/* The list that is next, all of it. False where it is none, which is reported, or where reading stopped. */
bool zr_json_list_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       void *state);

/* For begin_part and join: an array with room for a share of another's items and some more; the items of a part behind
 * another's. */
bool zr_growing_begin_part(struct zr_json *json, const struct zr_growing *array, struct zr_growing *part, double share,
                           size_t more);
bool zr_growing_join(struct zr_json *json, struct zr_growing *array, const struct zr_growing *part);

#endif
