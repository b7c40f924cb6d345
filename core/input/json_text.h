/* json_text.h - input: a scene's text, of which cJSON has parsed all but the large lists.
 *
 * Order of judgement: bad syntax anywhere comes before any complaint about what a scene says. A scene without
 * faults is never scanned strictly as a whole, since the readers of its lists take nothing
 * but JSON; the first fault, and the first failure to allocate, have that made up for (zr_json_verify).
 *
 *     struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
 *     for (; zr_json_walk_on(&walk); i++) {
 *         walk.behind = ... straight from walk.at, or NULL
 *         if (!walk.behind && (item = zr_json_walk_parse(&walk))) {
 *             ... by the usual readers, with their complaints, at ZR_JSON_ITEM(path, walk.index)
 *             zr_json_walk_drop(&walk, item);
 *         }
 *     }
 */
#ifndef ZR_JSON_TEXT_H
#define ZR_JSON_TEXT_H

#include "input/json_list.h"
#include "input/json_value.h"

struct zr_json_text {
    const char *bytes, *end;
    struct zr_json_lists lists;
    size_t charged; /* to the arena, for the tree */
    bool verified, malformed;
    struct zr_error verdict; /* where it is malformed */
    struct zr_error scratch;
};

/* Parses all but the large lists, which stand in the tree as zr_json_large_list knows them. NULL where the
 * text is malformed, or passes a limit, which is in json->text->verdict, or where the arena has
 * failed. End with zr_json_text_close, also where it is NULL. */
cJSON *zr_json_text_open(struct zr_json *json, const char *bytes, size_t size);

/* ZR_OK where all is well; else the status of *json->error, or ZR_NO_MEMORY, with syntax judged first. */
enum zr_status zr_json_text_close(struct zr_json *json, cJSON *root);

/* Makes sure that the whole text is well-formed, once; false where it is not, and reading should end. */
bool zr_json_verify(struct zr_json *json);

/* The list that `node` stands for; NULL, and a complaint, where it is something else. */
struct zr_json_list *zr_json_large_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node);

/* Item after item of a large list. */
struct zr_json_walk {
    struct zr_json *json;
    const struct zr_json_path *path;
    struct zr_json_list *list;
    const char *at;     /* the item */
    const char *behind; /* of the item: set by the reader */
    size_t index;
    size_t charged; /* for an item that is parsed */
    bool begun;
};

struct zr_json_walk zr_json_walk_begin(struct zr_json *json, const struct zr_json_path *path,
                                       struct zr_json_list *list);

/* Moves to the next item, the first time to the first; false at the end, or where it is time to stop. */
bool zr_json_walk_next(struct zr_json_walk *walk);

/* The same, inlined for how nearly all lists are written. */
static inline bool zr_json_walk_on(struct zr_json_walk *walk)
{
    const char *at = walk->behind;
    if (!at || walk->index + 1 >= walk->list->items || walk->json->text->end - at < 3 || *at != ',')
        return zr_json_walk_next(walk);
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
