/* json_text.h - input: a scene's text, of which cJSON has parsed all but the large lists.
 *
 * Order of judgement: bad syntax anywhere comes before any complaint about what a scene says. A scene without
 * faults is never scanned strictly as a whole, since the readers of its lists take nothing
 * but JSON; the first fault, and the first failure to allocate, have that made up for (zr_json_verify).
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

/* Part of the text, scanned before, with so many values. cJSON allocates outside the arena: about what its tree will
 * take is charged to it, to be refunded once the tree is deleted. NULL where there is no memory. */
cJSON *zr_json_text_parse(struct zr_json *json, const char *bytes, size_t size, size_t values, size_t *charged);

#endif
