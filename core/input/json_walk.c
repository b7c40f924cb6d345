#include "input/json_walk.h"

#include "base/team.h"
#include "input/json_scan.h"
#include "input/parts.h"

/* Fewer parts are read before a helper has woken. So many a thread make up for one that was read in vain. */
enum { PARTS_MIN = 3, PARTS_WORTH = 8 };

/* ---- item after item ---- */

struct zr_json_walk zr_json_walk_begin(struct zr_json *json, const struct zr_json_path *path, struct zr_json_list *list)
{
    return (struct zr_json_walk){
        .json = json, .path = path, .list = list, .at = list->at, .to = {list->end - 1, list->items, list->numbers}};
}

/* The list is not what it was counted as. */
static bool lose(struct zr_json_walk *walk)
{
    if (!walk->ahead && zr_json_verify(walk->json) && zr_arena_ok(walk->json->arena))
        zr_error_add(walk->json->error, ZR_INTERNAL, NULL, "a list was miscounted");
    return false;
}

bool zr_json_walk_next(struct zr_json_walk *walk)
{
    struct zr_json *json = walk->json;
    const char *end = json->text->end;
    if (zr_json_full(json) || !zr_arena_ok(json->arena) || (walk->begun && !walk->behind)) return false;
    const char *at = zr_json_skip_space(walk->begun ? walk->behind : walk->list->at + 1, end);
    walk->index += walk->begun;
    if (walk->index == walk->to.items) {
        if (at != walk->to.at || (*at != ']' && *at != ',')) return lose(walk);
        walk->done = true;
        if (!walk->ahead && *at == ']') walk->list->read = true;
        return false;
    }
    if (walk->begun) {
        if (at == end || *at != ',') return lose(walk);
        at = zr_json_skip_space(at + 1, end);
    }
    if (at == end) return lose(walk);
    walk->begun = true;
    walk->at = at;
    walk->behind = NULL;
    return true;
}

cJSON *zr_json_walk_parse(struct zr_json_walk *walk)
{
    struct zr_json *json = walk->json;
    struct zr_json_text *text = json->text;
    size_t items, commas, values;
    if (walk->ahead || zr_json_stopped(json)) return NULL;
    const char *behind = zr_json_skip(walk->at, text->end, json->cancel, &items, &commas);
    if (!behind) {
        lose(walk);
        return NULL;
    }
    struct zr_limits limits = *json->limits;
    size_t size = (size_t)(behind - walk->at);
    limits.json_depth_max -= limits.json_depth_max < walk->list->depth ? limits.json_depth_max : walk->list->depth;
    text->scratch.count = 0;
    if (zr_json_scan(json->arena, walk->at, size, &limits, &values, &text->scratch) != ZR_OK) {
        if (zr_json_verify(json) && zr_arena_ok(json->arena))
            zr_json_fault(json, ZR_JSON_ITEM(walk->path, walk->index), "more values than the limit of %u",
                          json->limits->json_values_max);
        return NULL;
    }
    walk->behind = behind;
    return zr_json_text_parse(json, walk->at, size, values, &walk->charged);
}

void zr_json_walk_drop(struct zr_json_walk *walk, cJSON *item)
{
    cJSON_Delete(item);
    zr_arena_refund(walk->json->arena, walk->charged);
    if (zr_json_full(walk->json)) walk->behind = NULL;
}

/* ---- by several threads ---- */

/* Parts of a list lie between its marks. */
struct reading {
    const struct zr_json_walk *whole;
    zr_json_walk_fn *read;
    void *context;
};

/* From the beginning of a part to the end of its list. */
static struct zr_json_walk walk_from(const struct zr_json_walk *whole, size_t part)
{
    struct zr_json_walk walk = *whole;
    if (part == 0) return walk;
    const struct zr_json_mark *from = &whole->list->marks[part - 1];
    walk.begun = true;
    walk.behind = from->at;
    walk.index = from->items - 1;
    walk.number = from->numbers;
    return walk;
}

static bool read_part(void *context, size_t part)
{
    const struct reading *r = context;
    const struct zr_json_list *list = r->whole->list;
    struct zr_json_walk walk = walk_from(r->whole, part);
    walk.ahead = true;
    if (part < list->mark_count) walk.to = list->marks[part];
    r->read(&walk, r->context);
    return walk.done;
}

/* Up to a mark, by this thread; leaves the walk there, to go on to where it would have ended. False where it is time to
 * stop. */
static bool read_alone(struct zr_json_walk *walk, const struct zr_json_mark *to, zr_json_walk_fn *read, void *context)
{
    const struct zr_json_mark end = walk->to;
    walk->to = *to;
    read(walk, context);
    if (!walk->done) return false;
    walk->to = end;
    walk->done = false;
    walk->index--; /* it stands at the item before the mark again */
    return true;
}

size_t zr_json_walk_all(struct zr_json_walk *walk, zr_json_walk_fn *read, void *context)
{
    const struct zr_json_walk whole = *walk;
    const struct zr_json *json = whole.json;
    struct zr_json_list *list = whole.list;
    const size_t threads = (size_t)zr_team_size(json->team), parts = threads > 1 ? list->mark_count + 1 : 1;
    struct reading reading = {&whole, read, context};
    /* What was read behind a failed part was in vain, at most a part for each thread. The caller's thread reads that
     * part alone, and what it met for the first time others may know now; each time it was in vain again, it reads
     * twice as many. */
    size_t part = 0, alone = 1;
    while (parts - part >= PARTS_MIN && json->error->count == 0) {
        const size_t failed = zr_parts_read(json->team, NULL, part, parts, read_part, &reading);
        if (failed == parts) {
            walk->index = list->items;
            walk->number = list->numbers;
            list->read = true;
            return walk->index;
        }
        if (failed - part >= PARTS_WORTH * threads) alone = 1;
        part = failed;
        *walk = walk_from(&whole, part);
        if (parts - part <= alone) break;
        part += alone;
        alone *= 2;
        if (!read_alone(walk, &list->marks[part - 1], read, context)) return walk->index;
    }
    read(walk, context);
    return walk->index;
}
