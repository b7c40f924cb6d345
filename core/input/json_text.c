#include "input/json_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/checked.h"
#include "input/json_scan.h"

/* What cJSON and the allocator take for a value, beside the bytes of its text. */
enum { TREE_BYTES_A_VALUE = 80 };

/* A large list in what cJSON parses: a string that begins with a byte which is in no UTF-8, and so in
 * no string of a text that was scanned; behind it the list's number. */
enum { MARK = 0xFF, MARK_SIZE = 24 };

/* ---- the whole ---- */

/* The text with a mark for each large list; the text itself where it has none. */
static const char *mark_lists(struct zr_json *json, size_t *size)
{
    const struct zr_json_text *text = json->text;
    const struct zr_json_lists *lists = &text->lists;
    size_t room = (size_t)(text->end - text->bytes), used = 0;
    *size = room;
    if (lists->count == 0) return text->bytes;
    for (size_t i = 0; i < lists->count; i++) /* a list may be shorter than its mark */
        room = room - (size_t)(lists->list[i].end - lists->list[i].at) + MARK_SIZE;
    char *marked = zr_arena_alloc(json->arena, room, 1);
    if (!marked) return NULL;
    const char *from = text->bytes;
    for (size_t i = 0; i < lists->count; i++) {
        size_t before = (size_t)(lists->list[i].at - from);
        memcpy(marked + used, from, before);
        used += before;
        used += (size_t)snprintf(marked + used, MARK_SIZE, "\"%c%zu\"", MARK, i);
        from = lists->list[i].end;
    }
    memcpy(marked + used, from, (size_t)(text->end - from));
    *size = used + (size_t)(text->end - from);
    return marked;
}

cJSON *zr_json_text_parse(struct zr_json *json, const char *bytes, size_t size, size_t values, size_t *charged)
{
    size_t cost;
    if (!zr_mul_size(values, TREE_BYTES_A_VALUE, &cost) || !zr_add_size(cost, size, &cost) ||
        !zr_arena_charge(json->arena, cost))
        return NULL;
    cJSON *root = cJSON_ParseWithLengthOpts(bytes, size, NULL, false);
    *charged = root ? cost : 0;
    if (root) return root;
    json->arena->failed = true; /* the scan has seen that it is not for bad syntax */
    return NULL;
}

cJSON *zr_json_text_open(struct zr_json *json, const char *bytes, size_t size)
{
    struct zr_json_text *text = json->text;
    struct zr_error *error = &text->scratch;
    size_t values;
    text->bytes = bytes;
    text->end = bytes + size;
    /* Lists go no deeper than this without a fault, and so a scan around them sees what is too deep. */
    if (json->limits->json_depth_max < ZR_JSON_LIST_DEPTH && !zr_json_verify(json)) return NULL;
    error->count = 0;
    if (zr_json_scan_around_lists(json->arena, bytes, size, json->limits, &text->lists, &values, error) != ZR_OK) {
        if (zr_json_verify(json) && zr_arena_ok(json->arena))
            zr_error_add(json->error, ZR_INTERNAL, NULL, "a list was lost");
        return NULL;
    }
    const char *rest = mark_lists(json, &size);
    return rest ? zr_json_text_parse(json, rest, size, values, &text->charged) : NULL;
}

bool zr_json_verify(struct zr_json *json)
{
    struct zr_json_text *text = json->text;
    if (!text->verified) {
        text->verified = true;
        text->malformed = zr_json_scan_scene(json->arena, text->bytes, (size_t)(text->end - text->bytes), json->limits,
                                             &text->verdict) != ZR_OK;
    }
    return !text->malformed;
}

enum zr_status zr_json_text_close(struct zr_json *json, cJSON *root)
{
    struct zr_json_text *text = json->text;
    cJSON_Delete(root);
    zr_arena_refund(json->arena, text->charged);
    bool good = root && !text->malformed && json->error->count == 0 && zr_arena_ok(json->arena);
    for (size_t i = 0; i < text->lists.count; i++)
        good = good && text->lists.list[i].read;
    if (good) return ZR_OK;
    if (zr_is_cancelled(json->cancel)) return ZR_CANCELLED;
    if (!zr_json_verify(json)) {
        *json->error = text->verdict;
        return json->error->status;
    }
    if (json->error->count > 0) return json->error->status;
    return zr_arena_ok(json->arena) ? ZR_OK : ZR_NO_MEMORY;
}

struct zr_json_list *zr_json_large_list(struct zr_json *json, const struct zr_json_path *path, const cJSON *node)
{
    if (cJSON_IsString(node) && (unsigned char)node->valuestring[0] == MARK)
        return &json->text->lists.list[strtoul(node->valuestring + 1, NULL, 10)];
    zr_json_expect(json, path, node, "a list");
    return NULL;
}
