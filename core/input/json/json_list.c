#include "input/json/json_list.h"

#include <string.h>

#include "base/team.h"
#include "input/text/parts.h"

/* ITEMS_TO_GUESS_FROM: fewer items give no useful estimate. GUESS_MARGIN: a sixteenth is added to the estimate. */
enum { ITEMS_AT_FIRST = 16, ITEMS_TO_GUESS_FROM = 256, GUESS_MARGIN = 16 };

/* Estimates the number of items, if the rest of the text has as many per byte. */
static size_t guess(const struct zr_growing *array, const struct zr_json *json)
{
    const double read = (double)(json->at - array->start), left = (double)(json->end - json->at);
    const double more = (double)array->count * (left / (read > 1.0 ? read : 1.0));
    return array->count + (size_t)(more * (GUESS_MARGIN + 1) / GUESS_MARGIN) + ITEMS_AT_FIRST;
}

bool zr_growing_reserve(struct zr_growing *array, struct zr_json *json, size_t more)
{
    if (array->room - array->count >= more) return true;
    size_t room = array->room < ITEMS_AT_FIRST ? ITEMS_AT_FIRST : array->room * 2;
    if (!array->start) array->start = json->at;
    if (array->count >= ITEMS_TO_GUESS_FROM) {
        const size_t guessed = guess(array, json), left = zr_arena_left(json->arena);
        if (guessed > room && guessed < left / 2 / array->size) room = guessed;
    }
    if (room < array->count + more) room = array->count + more;
    void *items = zr_arena_grow(json->arena, array->items, array->count, room, array->size);
    if (!items) {
        zr_json_look(json);
        return false;
    }
    array->items = items;
    array->room = room;
    return true;
}

bool zr_growing_fill(struct zr_growing *array, struct zr_json *json, size_t count, const void *item)
{
    if (array->count >= count) return true;
    if (!zr_growing_reserve(array, json, count - array->count)) return false;
    for (; array->count < count; array->count++)
        memcpy((char *)array->items + array->count * array->size, item, array->size);
    return true;
}

void zr_growing_trim(struct zr_growing *array, struct zr_arena *arena)
{
    if (array->items) zr_arena_trim(arena, array->items, array->room, array->count, array->size);
    array->room = array->count;
}

#ifndef ZR_JSON_PART_BYTES /* smaller in tests/unit/json/test_json_parts.c */
#define ZR_JSON_PART_BYTES (1 << 15)
#endif

/* PART_BYTES: 30 us of reading. ROOM_BYTES: memory for the items of a part, which may exceed its text. WINDOW_PARTS:
 * parts per job, since a thread takes 50 us to wake. FIRST_BYTES: read first, to estimate the items of a part. */
enum {
    PART_BYTES = ZR_JSON_PART_BYTES,
    ROOM_BYTES = (5 * PART_BYTES / 2 + 4096) / ZR_ARENA_ALIGN * ZR_ARENA_ALIGN,
    WINDOW_PARTS = 8,
    FIRST_BYTES = PART_BYTES / 2,
    LARGE_BYTES = 4 * PART_BYTES
};

/* Factor of the items that a part has room for, over its share of the text. */
#define MARGIN 1.25

struct part {
    struct zr_json json;
    struct zr_arena arena;
    _Alignas(16) char state[ZR_JSON_STATE_MAX];
};

struct window {
    const struct zr_json_list *list;
    const struct zr_json_path *path;
    char *room; /* ROOM_BYTES for each part */
    size_t count;
    struct part parts[WINDOW_PARTS];
};

/* Returns the first ',' between two items from `at` on, within PART_BYTES, or NULL. */
static const char *find_item(const char *at, const char *end, char opening)
{
    const char closing = opening == '[' ? ']' : '}';
    if (end - at > PART_BYTES) end = at + PART_BYTES;
    while ((at = memchr(at, closing, (size_t)(end - at)))) {
        const char *comma = zr_json_skip_space(at + 1, end);
        if (comma == end) return NULL;
        const char *item = zr_json_skip_space(comma + 1, end);
        if (*comma == ',' && item < end && *item == opening) return comma;
        at++;
    }
    return NULL;
}

/* Cuts parts from json->at on, which is between two items. */
static void cut_window(struct window *window, const struct zr_json *json)
{
    const char *at = json->at;
    for (window->count = 0; window->count < WINDOW_PARTS && json->end - at > PART_BYTES; window->count++) {
        const char *end = find_item(at + PART_BYTES, json->end, window->list->opening);
        if (!end) return;
        struct zr_json *part = &window->parts[window->count].json;
        *part = *json;
        part->at = part->look = at;
        part->end = at = end;
        part->is_ahead = true;
        part->team = NULL;
        part->arena = &window->parts[window->count].arena;
    }
}

/* Reads one part. True if reading ends exactly at the next part, in the same list. */
static bool read_part(void *context, size_t number)
{
    struct window *window = context;
    struct part *part = &window->parts[number];
    const unsigned inside = part->json.depth;
    window->list->read(&part->json, window->path, part->state, part->json.end);
    return part->json.at == part->json.end && part->json.depth == inside && !part->json.ended &&
           zr_arena_ok(&part->arena);
}

/* Reads a window of parts from json->at, between two items, and appends those before the first failure. `start`: the
 * list's first item. True if all parts were read. */
static bool read_window(struct zr_json *json, struct window *window, void *state, const char *start)
{
    cut_window(window, json);
    for (size_t i = 0; i < window->count; i++) {
        struct part *part = &window->parts[i];
        const double share = MARGIN * (double)(part->json.end - part->json.at) / (double)(json->at - start);
        zr_arena_init_within(&part->arena, window->room + i * ROOM_BYTES, ROOM_BYTES);
        if (!window->list->begin_part(&part->json, state, part->state, share)) window->count = i;
    }
    const size_t read = zr_parts_read(json->team, json->cancel, 0, window->count, read_part, window);
    for (size_t i = 0; i < read; i++) {
        json->at = window->parts[i].json.end;
        if (!window->list->join(json, state, window->parts[i].state)) return false;
    }
    return read == WINDOW_PARTS;
}

/* Reads the list's items on several threads until a part fails or the list ends. */
static void read_ahead(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       void *state)
{
    const char *start = json->at;
    const unsigned inside = json->depth;
    struct window *window = zr_arena_alloc(json->arena, 1, sizeof *window);
    if (!json->room) json->room = zr_arena_alloc(json->arena, WINDOW_PARTS, ROOM_BYTES);
    if (!window || !json->room) return;
    *window = (struct window){.list = list, .path = path, .room = json->room};
    list->read(json, path, state, json->at + FIRST_BYTES);
    while (json->depth == inside && !zr_json_stops(json) && read_window(json, window, state, start))
        ;
}

bool zr_json_list_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       void *state)
{
    if (!zr_json_list(json, path) || !zr_json_enter(json, '[')) return false;
    const unsigned inside = json->depth;
    /* If memory is short, the scene gets it. */
    if (json->team && zr_team_size(json->team) > 1 && json->end - json->at > LARGE_BYTES &&
        zr_arena_left(json->arena) / 8 > (size_t)WINDOW_PARTS * ROOM_BYTES)
        read_ahead(json, path, list, state);
    if (json->depth == inside && !zr_json_stops(json)) list->read(json, path, state, json->end);
    zr_json_check_closed(json, inside);
    return !json->ended;
}

bool zr_growing_begin_part(struct zr_json *json, const struct zr_growing *array, struct zr_growing *part, double share,
                           size_t more)
{
    *part = (struct zr_growing){.size = array->size, .start = json->at};
    return zr_growing_reserve(part, json, (size_t)((double)array->count * share) + more);
}

bool zr_growing_join(struct zr_json *json, struct zr_growing *array, const struct zr_growing *part)
{
    if (part->count == 0) return true;
    if (!zr_growing_reserve(array, json, part->count)) return false;
    memcpy((char *)array->items + array->count * array->size, part->items, part->count * part->size);
    array->count += part->count;
    return true;
}
