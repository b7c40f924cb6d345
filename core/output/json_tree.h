/* json_tree.h - output: JSON that is put together with cJSON, and printed once it is whole.
 *
 * cJSON remembers no failure, takes NULL for an item, and leaves an item that it could not add to the caller: so every
 * item is checked here, what belongs to no tree is freed, and a tree that lacks one is not printed. Its memory is none
 * of the arena's: whoever builds a tree charges the arena with it beforehand.
 */
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

/* Bytes that cJSON may have at once for a mesh or a face beside a name, for all else beside texts, and for a byte of a
 * name or a text: one in the tree, and printed up to six in memory that doubles, beside what it was copied from. */
enum { ZR_TREE_LISTED_BYTES = 2 << 10, ZR_TREE_OTHER_BYTES = 32 << 10, ZR_TREE_CHARACTER_BYTES = 1 + 3 * 6 };

/* An item as cJSON made it. */
cJSON *zr_tree_check(struct zr_tree *w, cJSON *item);

/* The shortest decimal that reads back as the same float. */
cJSON *zr_tree_number(struct zr_tree *w, float value);
cJSON *zr_tree_numbers(struct zr_tree *w, const float *values, int count);
cJSON *zr_tree_vec3(struct zr_tree *w, zr_vec3 v);

/* The item belongs to the tree from then on, or is freed. */
void zr_tree_put(struct zr_tree *w, cJSON *object, const char *key, cJSON *item);
void zr_tree_put_count(struct zr_tree *w, cJSON *object, const char *key, uint64_t count);
void zr_tree_append(struct zr_tree *w, cJSON *array, cJSON *item);

/* Appends it and a line feed, and frees it. False where something is missing, or there is no memory. */
bool zr_tree_print(struct zr_tree *w, cJSON *root, struct zr_buffer *out);

#endif
