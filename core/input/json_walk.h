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
 *     struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
 *     zr_json_walk_all(&walk, read_things, context);
 *
 * Threads: a list has marks, and threads read what is between them, ahead of one another, as long as it is plain. What
 *         is not plain, or not right, the caller's thread reads alone, and says what is wrong: scenes and complaints
 *         are the same for every team. That a thread keeps to its own places in arrays rests on what marks count, which
 *         is exact of malformed texts too (skip_rows, skip_polygons), and on that walks end at walk->to.items and
 *         readers at walk->to.numbers.
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
    const char *at;         /* the item */
    const char *behind;     /* of the item: set by the reader */
    size_t index;           /* of the item */
    size_t number;          /* of the list's numbers, as marks count them, so many are before it: for readers that go on
                             * counting */
    struct zr_json_mark to; /* where this walk ends: a mark, or the list's ']' */
    bool ahead;             /* of what is read by others: nothing but the walk and places in arrays may be changed,
                             * and zr_json_walk_parse gives NULL */
    bool begun, done;       /* done: came to its end; false again where a reader finds that it must not count */
    size_t charged;         /* for an item that is parsed */
};

/* From a list's first item to its ']'. */
struct zr_json_walk zr_json_walk_begin(struct zr_json *json, const struct zr_json_path *path,
                                       struct zr_json_list *list);

/* Reads the items of a walk from where it is, each into its place of some arrays. Is called for one piece of a list
 * after another, or for several at once. */
typedef void zr_json_walk_fn(struct zr_json_walk *walk, void *context);

/* To the end of a list, by the threads of json->team. Returns how many items were read before it was time to stop. */
size_t zr_json_walk_all(struct zr_json_walk *walk, zr_json_walk_fn *read, void *context);

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

/* The item at hand, parsed by cJSON; NULL where that cannot be, or where the request is cancelled
 * (zr_json_stopped). */
cJSON *zr_json_walk_parse(struct zr_json_walk *walk);
void zr_json_walk_drop(struct zr_json_walk *walk, cJSON *item);

#endif
