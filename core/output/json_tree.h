/* json_tree.h - output: builds JSON with cJSON and prints it when it is complete.
 *
 * cJSON records no failure, accepts NULL as an item, and leaves an item that it could not add to the caller. So every
 * item is checked here, items outside the tree are freed, and an incomplete tree is not printed. cJSON does not
 * allocate from the arena: the builder of a tree charges the arena beforehand. */
#ifndef ZR_JSON_TREE_H
#define ZR_JSON_TREE_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "output/buffer.h"

struct zr_tree {
    bool ok;
};

/* Upper bounds of cJSON's memory, in bytes: per mesh or face without its name; for everything else without texts; and
 * per character of a name or text. A character takes one byte in the tree, and up to six when printed, in a buffer that
 * doubles and is copied. */
enum { ZR_TREE_LISTED_BYTES = 2 << 10, ZR_TREE_OTHER_BYTES = 32 << 10, ZR_TREE_CHARACTER_BYTES = 1 + 3 * 6 };

/* Returns `item`, and records a failure if it is NULL. */
cJSON *zr_tree_check(struct zr_tree *w, cJSON *item);

/* Returns the shortest decimal that reads back as the same float. */
cJSON *zr_tree_number(struct zr_tree *w, float value);
cJSON *zr_tree_numbers(struct zr_tree *w, const float *values, int count);
cJSON *zr_tree_vec3(struct zr_tree *w, zr_vec3 v);

/* The tree takes ownership of the item; if that fails, the item is freed. */
void zr_tree_put(struct zr_tree *w, cJSON *object, const char *key, cJSON *item);
void zr_tree_put_count(struct zr_tree *w, cJSON *object, const char *key, uint64_t count);
void zr_tree_append(struct zr_tree *w, cJSON *array, cJSON *item);

/* Appends the text and a line feed to `out`, and frees the tree. Returns false if an item is missing or memory ran
 * out. */
bool zr_tree_print(struct zr_tree *w, cJSON *root, struct zr_buffer *out);

#endif
