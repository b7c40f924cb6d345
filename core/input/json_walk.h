/* json_walk.h - input: item after item of a large list; of a very large one, by several threads.
 *
 *     static void read_things(struct zr_json_walk *walk, void *context)
 *     {
 *         while (zr_json_walk_on(walk)) {
 *             walk->behind = ... straight from walk->at, or NULL
 *             if (walk->behind || !(item = zr_json_walk_parse(walk))) continue;
 *             ... by the usual readers, with their complaints, at ZR_JSON_ITEM(walk->path, walk->index)
 *             zr_json_walk_drop(walk, item);
 *         }
 *     }
 *
 * Threads: a thread begins wherever a row seems to end, ahead of what is before it, and goes on straight from the
 *         text only. That it began at an item is known once the thread before it has come to that place. From the
 *         first part on that did not go so, the caller alone goes on, and says what is wrong: scenes and complaints
 *         are the same for every team.
 */
#ifndef ZR_JSON_WALK_H
#define ZR_JSON_WALK_H

#include "input/json_list.h"
#include "input/json_text.h"
#include "input/json_value.h"

struct zr_json_walk {
    struct zr_json *json;
    const struct zr_json_path *path;
    struct zr_json_list *list;
    const char *at;     /* the item */
    const char *behind; /* of the item: set by the reader */
    size_t index;       /* of the item */
    size_t number;      /* of its first number among all of the list, where items are rows of them: set by the reader */
    struct zr_json_mark to; /* its end: as a mark, or the list's ']' */
    bool ahead;             /* of other walks: the reader changes nothing but the walk and places in arrays */
    bool begun, done;
    size_t charged; /* for an item that is parsed */
};

/* Reads the items of a walk, each in its place of some arrays, from walk->index on. */
typedef void zr_json_walk_fn(struct zr_json_walk *walk, void *context);

/* All items of a list, by the threads of json->team; returns how many were read before it was time to stop. */
size_t zr_json_walk_all(struct zr_json *json, const struct zr_json_path *path, struct zr_json_list *list,
                        zr_json_walk_fn *read, void *context);

/* The same by this thread, in a loop of the caller's. */
struct zr_json_walk zr_json_walk_begin(struct zr_json *json, const struct zr_json_path *path,
                                       struct zr_json_list *list);

/* Moves to the next item, the first time to the first; false at the end, or where it is time to stop. */
bool zr_json_walk_next(struct zr_json_walk *walk);

/* The same, inlined for how nearly all lists are written. */
static inline bool zr_json_walk_on(struct zr_json_walk *walk)
{
    const char *at = walk->behind;
    if (!at || walk->index + 1 >= walk->to.items || walk->to.at - at < 3 || *at != ',') return zr_json_walk_next(walk);
    at += 1 + (at[1] == ' ');
    if (*at != '[' && *at != '{') return zr_json_walk_next(walk);
    walk->index++;
    walk->at = at;
    walk->behind = NULL;
    return true;
}

/* The item at hand, parsed by cJSON; NULL where that cannot be. */
cJSON *zr_json_walk_parse(struct zr_json_walk *walk);
void zr_json_walk_drop(struct zr_json_walk *walk, cJSON *item);

#endif
