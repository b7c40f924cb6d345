#include "input/json_list.h"

#include <string.h>

#include "base/inlined.h"
#include "input/chunk.h"

enum { LOOK_AHEAD = 3, CHUNKS_A_TALLY = 254, LISTS_AT_FIRST = 16, MARKS_AT_FIRST = 16, BYTES_A_LOOK = 1 << 20 };

/* ---- lists of rows of numbers ---- */

/* A byte each counts up in each place of a chunk; 255 chunks fit. */
struct tally {
    zr_chunk opens, closes, commas;
    int chunks;
};

struct totals {
    size_t opens, closes, commas;
};

/* Inlined, so that the tally stays in registers: 7 to 11 % of reading a mesh. */
ZR_INLINED void flush(struct tally *tally, struct totals *totals)
{
    totals->opens += zr_chunk_sum(tally->opens);
    totals->closes += zr_chunk_sum(tally->closes);
    totals->commas += zr_chunk_sum(tally->commas);
    *tally = (struct tally){.chunks = 0};
}

static inline void count(struct tally *tally, zr_chunk bytes)
{
    tally->opens -= (zr_chunk)(bytes == '[');
    tally->closes -= (zr_chunk)(bytes == ']');
    tally->commas -= (zr_chunk)(bytes == ',');
    tally->chunks++;
}

/* Where who reads a list by parts may begin. */
struct marks {
    struct zr_arena *arena;
    struct zr_json_list *list;
    size_t room;
    const char *last; /* or the list's beginning; the text's end where there are to be no more */
};

static bool wants_mark(const struct marks *marks, const char *at)
{
    return at - marks->last >= ZR_JSON_MARK_BYTES;
}

static void add_mark(struct marks *marks, struct zr_json_mark mark)
{
    struct zr_json_list *list = marks->list;
    marks->last = mark.at;
    if (list->mark_count == marks->room) {
        size_t room = marks->room ? marks->room * 2 : MARKS_AT_FIRST;
        struct zr_json_mark *more = zr_arena_grow(marks->arena, list->marks, list->mark_count, room, sizeof *more);
        if (!more) return;
        list->marks = more;
        marks->room = room;
    }
    list->marks[list->mark_count++] = mark;
}

static size_t count_commas(const char *at, const char *end)
{
    struct tally tally = {.chunks = 0};
    struct totals totals = {0, 0, 0};
    for (; end - at >= ZR_CHUNK; at += ZR_CHUNK) {
        count(&tally, zr_chunk_load(at));
        if (tally.chunks == CHUNKS_A_TALLY) flush(&tally, &totals);
    }
    flush(&tally, &totals);
    for (; at < end; at++)
        totals.commas += *at == ',';
    return totals.commas;
}

/* Behind the row that `at` is in; of all that is before `at` there are the totals. */
static void mark_next_row(struct marks *marks, const char *at, const char *end, const struct totals *totals)
{
    const char *close = memchr(at, ']', (size_t)(end - at));
    const char *comma = close ? zr_json_skip_space(close + 1, end) : end;
    marks->last = end;
    if (comma == end || *comma != ',') return;
    const size_t numbers = totals->commas + count_commas(at, close) + 1;
    add_mark(marks, (struct zr_json_mark){comma, totals->closes + 1, numbers});
}

/* All ones where a row ends other than with "],[" or "], [", and where a string begins. */
static inline zr_chunk find_odd(const char *at)
{
    zr_chunk zero = zr_chunk_load(at), one = zr_chunk_load(at + 1), two = zr_chunk_load(at + 2),
             three = zr_chunk_load(at + 3);
    zr_chunk next =
        (zr_chunk)(one == ',') & ((zr_chunk)(two == '[') | ((zr_chunk)(two == ' ') & (zr_chunk)(three == '[')));
    return ((zr_chunk)(zero == ']') & ~next) | (zr_chunk)(zero == '"');
}

/* Counts up to the next byte that is odd, and returns it; or the end, as far as chunks go. */
static inline const char *count_chunks(const char *at, const char *end, struct totals *totals, struct marks *marks)
{
    struct tally tally = {.chunks = 0};
    size_t odd = ZR_CHUNK;
    while (end - at >= ZR_CHUNK + LOOK_AHEAD && (odd = zr_chunk_first(find_odd(at))) == ZR_CHUNK) {
        count(&tally, zr_chunk_load(at));
        at += ZR_CHUNK;
        if (tally.chunks < CHUNKS_A_TALLY) continue;
        flush(&tally, totals);
        if (marks && wants_mark(marks, at)) mark_next_row(marks, at, end, totals);
    }
    if (odd < ZR_CHUNK) count(&tally, zr_chunk_load(at) & zr_chunk_of_first(odd));
    flush(&tally, totals);
    return odd < ZR_CHUNK ? at + odd : at;
}

/* As zr_json_skip, for a list whose items are lists of numbers, several times as fast; NULL also where it is anything
 * else. What makes the count exact: the text begins with "[[", behind each ']' comes ",[" or the end, and there are
 * as many '[' as ']': so no '[' is left that could stand inside a row, and between rows is nothing else. */
static inline const char *skip_rows(const char *at, const char *end, size_t *rows, size_t *commas, struct marks *marks)
{
    struct totals totals = {0, 0, 0};
    at = zr_json_skip_space(at + 1, end);
    if (at == end || *at != '[') return NULL;
    while ((at = count_chunks(at, end, &totals, marks)) < end) {
        totals.opens += *at == '[';
        totals.commas += *at == ',';
        if (*at == '"') return NULL;
        if (*at++ != ']') continue;
        totals.closes++;
        const char *next = zr_json_skip_space(at, end);
        if (next == end) return NULL;
        if (*next == ']') {
            *rows = totals.closes;
            *commas = totals.commas;
            return totals.opens == totals.closes ? next + 1 : NULL;
        }
        if (*next != ',') return NULL;
        totals.commas++;
        at = zr_json_skip_space(next + 1, end);
        if (at == end || *at != '[') return NULL;
        if (marks && wants_mark(marks, at)) mark_next_row(marks, at, end, &totals);
    }
    return NULL;
}

/* ---- values of any kind ---- */

/* Behind the closing quote of a string; `at` is behind the opening one. NULL where it has no end. */
static const char *skip_string(const char *at, const char *end, const struct zr_cancel *cancel)
{
    const char *look = at;
    for (; at < end && *at != '"'; at++) {
        if (*at == '\\' && ++at == end) return NULL;
        if (at < look) continue;
        if (zr_is_cancelled(cancel)) return NULL;
        look = at + BYTES_A_LOOK;
    }
    return at < end ? at + 1 : NULL;
}

static const char *skip_nested(const char *at, const char *end, const struct zr_cancel *cancel, size_t *items,
                               size_t *commas)
{
    const char *first = zr_json_skip_space(at + 1, end), *look = at;
    size_t depth = 0;
    *items = first < end && *first != ']' && *first != '}';
    while (at < end) {
        if (at >= look) {
            if (zr_is_cancelled(cancel)) return NULL;
            look = at + BYTES_A_LOOK;
        }
        char byte = *at++;
        if (byte == '"') {
            at = skip_string(at, end, cancel);
            if (!at) return NULL;
        } else if (byte == ',') {
            ++*commas;
            *items += depth == 1;
        } else if (byte == '[' || byte == '{') {
            depth++;
        } else if ((byte == ']' || byte == '}') && --depth == 0) {
            return at;
        }
    }
    return NULL;
}

const char *zr_json_skip(const char *at, const char *end, const struct zr_cancel *cancel, size_t *items, size_t *commas)
{
    *items = *commas = 0;
    if (at == end) return NULL;
    if (*at == '"') return skip_string(at + 1, end, cancel);
    if (*at == '[' || *at == '{') return skip_nested(at, end, cancel, items, commas);
    const char *start = at;
    while (at < end && *at != ',' && *at != ']' && *at != '}' && *at != ' ' && *at != '\n' && *at != '\r' &&
           *at != '\t')
        at++;
    return at == start ? NULL : at;
}

static bool escape_is(const char *at, const char *end, char letter)
{
    char text[] = "\\u0000";
    static const char digits[] = "0123456789abcdef";
    text[4] = digits[(letter >> 4) & 15];
    text[5] = digits[letter & 15];
    if (end - at < 6) return false;
    for (int i = 0; i < 6; i++)
        if (at[i] != text[i] && !(i > 1 && at[i] >= 'A' && at[i] <= 'F' && at[i] + ('a' - 'A') == text[i]))
            return false;
    return true;
}

bool zr_json_key_is(const char *key, const char *key_end, const char *word)
{
    size_t length = strlen(word);
    if ((size_t)(key_end - key) <= length) return (size_t)(key_end - key) == length && memcmp(key, word, length) == 0;
    for (; *word; word++) {
        if (key == key_end) return false;
        if (*key == *word)
            key++;
        else if (escape_is(key, key_end, *word))
            key += 6;
        else
            return false;
    }
    return key == key_end;
}

/* ---- polygons ---- */

/* Rows, or colours as strings, or whatever is wrong: these have no marks. */
static const char *skip_list(const char *at, const char *end, const struct zr_cancel *cancel, size_t *items,
                             size_t *commas, struct marks *marks)
{
    const char *behind = skip_rows(at, end, items, commas, marks);
    if (behind) return behind;
    if (marks) marks->list->mark_count = 0;
    return zr_json_skip(at, end, cancel, items, commas);
}

static const char *skip_holes(const char *at, const char *end, const struct zr_cancel *cancel,
                              struct zr_json_soup *soup)
{
    size_t holes, vertices, commas;
    const char *behind = zr_json_skip(at, end, cancel, &holes, &commas);
    if (!behind || *at != '[') return behind;
    soup->rings += holes;
    for (at = zr_json_skip_space(at + 1, end); holes > 0; holes--) {
        at = skip_list(at, end, cancel, &vertices, &commas, NULL);
        if (!at) return NULL;
        soup->vertices += vertices;
        at = zr_json_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == ',') at = zr_json_skip_space(at + 1, end);
    }
    return behind;
}

/* Of a member that is plainly "vertices":[...]: as most are: 60 instructions around its rows, not 160. */
static inline const char *skip_plain_vertices(const char *at, const char *end, struct zr_json_soup *soup)
{
    static const char key[] = "vertices\":";
    size_t rows, commas;
    if (end - at < 16 || memcmp(at, key, sizeof key - 1) != 0) return NULL;
    at += sizeof key - 1;
    if (*at == ' ') at++;
    if (*at != '[') return NULL;
    at = skip_rows(at, end, &rows, &commas, NULL);
    if (at) soup->vertices += rows;
    return at;
}

/* `at` is behind the opening quote of a key; returns behind the value. */
static const char *skip_member(const char *at, const char *end, const struct zr_cancel *cancel,
                               struct zr_json_soup *soup)
{
    const char *key = at, *behind = skip_string(at, end, cancel);
    size_t items = 0, commas = 0;
    if (!behind) return NULL;
    const char *key_end = behind - 1;
    at = zr_json_skip_space(behind, end);
    if (at == end || *at != ':') return NULL;
    at = zr_json_skip_space(at + 1, end);
    if (at == end) return NULL;
    if (zr_json_key_is(key, key_end, "holes")) {
        soup->has_holes = true;
        return skip_holes(at, end, cancel, soup);
    }
    bool is_list = *at == '[';
    behind =
        is_list ? skip_list(at, end, cancel, &items, &commas, NULL) : zr_json_skip(at, end, cancel, &items, &commas);
    if (zr_json_key_is(key, key_end, "vertices"))
        soup->vertices += is_list ? items : 0;
    else if (zr_json_key_is(key, key_end, "color"))
        soup->has_color = true;
    else if (zr_json_key_is(key, key_end, "colors"))
        soup->has_colors = true;
    else if (zr_json_key_is(key, key_end, "normals"))
        soup->has_normals = true;
    return behind;
}

static const char *skip_polygon(const char *at, const char *end, const struct zr_cancel *cancel,
                                struct zr_json_soup *soup)
{
    size_t items, commas;
    soup->rings++;
    if (at == end || *at != '{') return zr_json_skip(at, end, cancel, &items, &commas);
    at = zr_json_skip_space(at + 1, end);
    if (at < end && *at == '}') return at + 1;
    for (;;) {
        if (at == end || *at != '"') return NULL;
        const char *behind = skip_plain_vertices(at + 1, end, soup);
        at = behind ? behind : skip_member(at + 1, end, cancel, soup);
        if (!at) return NULL;
        at = zr_json_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == '}') return at + 1;
        if (*at != ',') return NULL;
        at = zr_json_skip_space(at + 1, end);
    }
}

/* Adds up what polygons have; returns behind the list, and their count in *polygons. */
static const char *skip_polygons(const char *at, const char *end, struct zr_json_soup *soup, size_t *polygons,
                                 struct marks *marks)
{
    at = zr_json_skip_space(at + 1, end);
    if (at < end && *at == ']') return at + 1;
    for (;;) {
        at = skip_polygon(at, end, marks->arena->cancel, soup);
        if (!at) return NULL;
        ++*polygons;
        at = zr_json_skip_space(at, end);
        if (at == end) return NULL;
        if (*at == ']') return at + 1;
        if (*at != ',') return NULL;
        if (wants_mark(marks, at)) {
            if (zr_is_cancelled(marks->arena->cancel)) return NULL;
            add_mark(marks, (struct zr_json_mark){at, *polygons, soup->vertices});
        }
        at = zr_json_skip_space(at + 1, end);
    }
}

/* ---- the lists of a text ---- */

const char *zr_json_list_add(struct zr_arena *arena, struct zr_json_lists *lists, const char *at, const char *end,
                             bool polygons, size_t depth)
{
    struct zr_json_list list = {.at = at, .depth = (uint32_t)depth};
    struct marks marks = {arena, &list, 0, at};
    size_t commas = 0;
    list.end = polygons ? skip_polygons(at, end, &list.soup, &list.items, &marks)
                        : skip_list(at, end, arena->cancel, &list.items, &commas, &marks);
    /* A comma stands between any two numbers, in one row or not. */
    list.numbers = polygons ? list.soup.vertices : commas + 1;
    if (!list.end) return NULL;
    if (lists->count == lists->room) {
        size_t room = lists->room ? lists->room * 2 : LISTS_AT_FIRST;
        struct zr_json_list *more = zr_arena_grow(arena, lists->list, lists->count, room, sizeof *more);
        if (!more) return NULL;
        lists->list = more;
        lists->room = room;
    }
    lists->list[lists->count++] = list;
    return list.end;
}
