#include "input/growing.h"

/* ITEMS_TO_GUESS_FROM: fewer items give no useful estimate. MARGIN: a sixteenth is added to the estimate. */
enum { ITEMS_AT_FIRST = 16, ITEMS_TO_GUESS_FROM = 256, MARGIN = 16 };

/* Estimates the number of items, if the rest of the text has as many per byte. */
static size_t guess(const struct zr_growing *array, const struct zr_json *json)
{
    const double read = (double)(json->at - array->start), left = (double)(json->end - json->at);
    const double more = (double)array->count * (left / (read > 1.0 ? read : 1.0));
    return array->count + (size_t)(more * (MARGIN + 1) / MARGIN) + ITEMS_AT_FIRST;
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

void zr_growing_trim(struct zr_growing *array, struct zr_arena *arena)
{
    if (array->items) zr_arena_trim(arena, array->items, array->room, array->count, array->size);
    array->room = array->count;
}
