/* json_list.h - input: the large lists of a scene, found and counted in its text without being read.
 *
 * Why:    nearly all of a large scene is lists of numbers. They stay text until the reader comes that knows
 *         what they are, and goes from the text into the scene's arrays in one step (json_rows.h); cJSON gets
 *         the small rest. So that the arrays have their size before the first number is read, lists
 *         are counted where the scan passes them, at 8 GB/s, polygons at 3.
 * Trust:  what is found here holds of every well-formed text. Whether it is well-formed, only readers see, or
 *         zr_json_verify: of a malformed one an end may be NULL or in the wrong place, within the text always.
 */
#ifndef ZR_JSON_LIST_H
#define ZR_JSON_LIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"

/* How deep an item of the innermost list goes that a scene may have: /meshes/0/heights/values/0. */
enum { ZR_JSON_LIST_DEPTH = 6 };

/* From one mark to the next. To read it takes 0.1 ms, as it does to wake a thread for that. */
enum { ZR_JSON_MARK_BYTES = 1 << 16 };

/* What a list of polygons comes to. */
struct zr_json_soup {
    size_t vertices, rings;
    bool has_holes, has_color, has_colors, has_normals; /* any polygon */
};

/* Between two items of a list: */
struct zr_json_mark {
    const char *at;        /* the comma */
    size_t items, numbers; /* before it; vertices, where items are polygons */
};

struct zr_json_list {
    const char *at, *end; /* from its '[' to behind its ']' */
    size_t items;
    size_t numbers;           /* in all of its rows, or more; of polygons, vertices */
    uint32_t depth;           /* levels of nesting around an item */
    bool read;                /* all of it, strictly */
    struct zr_json_soup soup; /* for polygons only */
    size_t mark_count;        /* one about every ZR_JSON_MARK_BYTES, of polygons, or where all items are rows */
    struct zr_json_mark *marks;
};

struct zr_json_lists {
    size_t count, room;
    struct zr_json_list *list;
};

/* Adds the list that begins at `at`, which is '[', and returns behind it; NULL where it does not end, or the
 * arena has failed. polygons: its items are those of a scene's "polygons". */
const char *zr_json_list_add(struct zr_arena *arena, struct zr_json_lists *lists, const char *at, const char *end,
                             bool polygons, size_t depth);

/* Behind the value that begins at `at`, or NULL; so it is where `cancel`, which may be NULL, is raised. Of a list or an
 * object, *items becomes the count of items or members, *commas that of all commas between the two. */
const char *zr_json_skip(const char *at, const char *end, const struct zr_cancel *cancel, size_t *items,
                         size_t *commas);

/* Is the text of a key, from behind its opening quote to its closing one, this word of ASCII letters? As it is
 * written or with escapes. */
bool zr_json_key_is(const char *key, const char *key_end, const char *word);

static inline const char *zr_json_skip_space(const char *at, const char *end)
{
    while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t'))
        at++;
    return at;
}

#endif
