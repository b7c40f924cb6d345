#include "input/json_scan.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "input/number.h"
#include "input/text.h"

/* BYTES_A_LOOK: between two looks at the flag of cancellation. */
enum { LEVELS_AT_FIRST = 1024, WORD_BITS = 64, BYTES_A_LOOK = 1 << 20 };

enum expect { VALUE, FIRST_VALUE, KEY, FIRST_KEY, NEXT_ITEM, NEXT_MEMBER, END };

static const char *const expected[] = {
    "a value",    "a value or ']'", "a key in double quotes", "a key in double quotes or '}'",
    "',' or ']'", "',' or '}'",     "the end of the text"};

/* What becomes of the large lists of a scene. */
enum lists { AS_ANY, SCANNED_UNCOUNTED, PASSED_OVER };

enum limit { NO_LIMIT, TOO_DEEP, TOO_MANY, TOO_LONG, HOLDS_ZERO };

struct scan {
    const char *start, *end;
    struct zr_arena *arena;
    struct zr_error *error;
    const struct zr_limits *limits;
    uint64_t *objects; /* a bit a level: is it an object? */
    size_t depth, levels, values;
    enum lists lists_are;
    struct zr_json_lists *lists;
    const char *key, *key_end;  /* of the member that is scanned, in quotes */
    bool in_meshes, in_heights; /* of the root, and of a mesh there */
    size_t uncounted;           /* the depth around a list whose values do not count, or 0 */
    const char *look;           /* at the flag of cancellation, from here on */
    enum limit limit;           /* the first one passed, which counts only if the text is well-formed */
    const char *limit_at;
};

/* Bytes that go on a string as they are: neither control, quote, backslash nor beyond ASCII. */
static bool is_plain(char byte)
{
    return (unsigned char)byte >= 0x20 && (unsigned char)byte < 0x80 && byte != '"' && byte != '\\';
}

static bool is_digit(char byte)
{
    return (unsigned char)(byte - '0') < 10;
}

static const char *fail(struct scan *scan, const char *at, const char *what)
{
    struct zr_place place = zr_place_of(scan->start, (size_t)(at - scan->start));
    if (at == scan->end)
        zr_error_add(scan->error, ZR_BAD_SYNTAX, NULL, "line %zu, column %zu: expected %s, found the end of the text",
                     place.line, place.column, what);
    else
        zr_error_add(scan->error, ZR_BAD_SYNTAX, NULL, "line %zu, column %zu: expected %s, found %s", place.line,
                     place.column, what,
                     zr_quote(at, zr_utf8_length(at, scan->end) ? zr_utf8_length(at, scan->end) : 1).text);
    return NULL;
}

/* False, and the error says so, where the request is cancelled. */
static bool goes_on(struct scan *scan, const char *at)
{
    if (at < scan->look) return true;
    scan->look = at + (scan->end - at < BYTES_A_LOOK ? scan->end - at : BYTES_A_LOOK);
    if (!zr_is_cancelled(scan->arena->cancel)) return true;
    zr_error_add(scan->error, ZR_CANCELLED, NULL, "reading was stopped");
    return false;
}

static void pass_limit(struct scan *scan, const char *at, enum limit limit)
{
    if (scan->limit != NO_LIMIT) return;
    scan->limit = limit;
    scan->limit_at = at;
}

/* Eight bytes that may hold one that is not plain. Carries between bytes can only
 * raise false alarms, and the caller looks again. */
static bool needs_a_look(uint64_t word)
{
    const uint64_t ones = UINT64_C(0x0101010101010101), tops = ones * 0x80;
    uint64_t quote = word ^ (ones * '"'), backslash = word ^ (ones * '\\');
    return ((word | (word - ones * 0x20) | (quote - ones) | (backslash - ones)) & tops) != 0;
}

/* The value of the four hexadecimal digits of a \u escape, or -1. */
static int read_hex(const char *at, const char *end)
{
    if (end - at < 4) return -1;
    int value = 0;
    for (int i = 0; i < 4; i++) {
        char c = at[i];
        int digit = is_digit(c)            ? c - '0'
                    : c >= 'a' && c <= 'f' ? c - 'a' + 10
                    : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                           : -1;
        if (digit < 0) return -1;
        value = value * 16 + digit;
    }
    return value;
}

/* `at` is a backslash; returns behind the escape. */
static const char *scan_escape(struct scan *scan, const char *at)
{
    if (scan->end - at < 2 || at[1] == '\0' || !strchr("\"\\/bfnrtu", at[1]))
        return fail(scan, at, "one of the escapes \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
    if (at[1] != 'u') return at + 2;
    int unit = read_hex(at + 2, scan->end);
    if (unit < 0) return fail(scan, at, "four hexadecimal digits after \\u");
    if (unit == 0) pass_limit(scan, at, HOLDS_ZERO);
    if (unit < 0xD800 || unit > 0xDFFF) return at + 6;
    int low = unit < 0xDC00 && scan->end - at >= 8 && at[6] == '\\' && at[7] == 'u' ? read_hex(at + 8, scan->end) : -1;
    if (low < 0xDC00 || low > 0xDFFF) return fail(scan, at, "both halves of a surrogate pair");
    return at + 12;
}

/* `at` is behind the opening quote; returns behind the closing one. */
static const char *scan_string(struct scan *scan, const char *at)
{
    const char *end = scan->end;
    for (;;) {
        uint64_t word;
        if (!goes_on(scan, at)) return NULL;
        while (scan->look - at >= (ptrdiff_t)sizeof word) {
            memcpy(&word, at, sizeof word);
            if (needs_a_look(word)) break;
            at += sizeof word;
        }
        while (at < scan->look && is_plain(*at))
            at++;
        if (at == scan->look && at < end) continue;
        if (at == end) return fail(scan, at, "'\"' at the end of a string");
        if (*at == '"') return at + 1;
        if (*at == '\\') {
            at = scan_escape(scan, at);
            if (!at) return NULL;
        } else if ((unsigned char)*at < 0x20) {
            return fail(scan, at, "control characters in a string as escapes");
        } else {
            size_t length = zr_utf8_length(at, end);
            if (length == 0) return fail(scan, at, "valid UTF-8");
            at += length;
        }
    }
}

static const char *scan_digits(struct scan *scan, const char *at)
{
    if (at == scan->end || !is_digit(*at)) return fail(scan, at, "a digit");
    do
        at++;
    while (at < scan->end && is_digit(*at));
    return at;
}

static const char *scan_number(struct scan *scan, const char *at)
{
    const char *start = at, *end = scan->end;
    if (*at == '-') at++;
    if (at < end && *at == '0') {
        at++;
        if (at < end && is_digit(*at)) return fail(scan, at - 1, "a number without leading zeros");
    } else {
        at = scan_digits(scan, at);
        if (!at) return NULL;
    }
    if (at < end && *at == '.') {
        at = scan_digits(scan, at + 1);
        if (!at) return NULL;
    }
    if (at < end && (*at == 'e' || *at == 'E')) {
        at++;
        if (at < end && (*at == '+' || *at == '-')) at++;
        at = scan_digits(scan, at);
        if (!at) return NULL;
    }
    if (at - start > ZR_NUMBER_JSON_MAX) pass_limit(scan, start, TOO_LONG);
    return at;
}

static const char *scan_literal(struct scan *scan, const char *at, const char *literal)
{
    size_t length = strlen(literal);
    if ((size_t)(scan->end - at) < length || memcmp(at, literal, length) != 0) return fail(scan, at, expected[VALUE]);
    return at + length;
}

static bool in_object(const struct scan *scan)
{
    size_t level = scan->depth - 1;
    return scan->objects[level / WORD_BITS] >> (level % WORD_BITS) & 1u;
}

static bool open_level(struct scan *scan, const char *at, bool object)
{
    if (scan->depth == scan->levels) {
        size_t words = scan->levels / WORD_BITS;
        uint64_t *more = zr_arena_grow(scan->arena, scan->objects, words, words * 2, sizeof *more);
        if (!more) {
            zr_error_add(scan->error, ZR_NO_MEMORY, NULL, "no memory to follow %zu levels of nesting", scan->depth);
            return false;
        }
        scan->objects = more;
        scan->levels *= 2;
    }
    uint64_t bit = UINT64_C(1) << (scan->depth % WORD_BITS), *word = &scan->objects[scan->depth / WORD_BITS];
    *word = object ? *word | bit : *word & ~bit;
    if (++scan->depth > scan->limits->json_depth_max) pass_limit(scan, at, TOO_DEEP);
    return true;
}

static enum expect after_value(const struct scan *scan)
{
    return scan->depth == 0 ? END : in_object(scan) ? NEXT_MEMBER : NEXT_ITEM;
}

static void count_value(struct scan *scan, const char *at)
{
    if (scan->uncounted > 0) return;
    if (++scan->values > scan->limits->json_values_max) pass_limit(scan, at, TOO_MANY);
}

static bool key_is(const struct scan *scan, const char *word)
{
    return zr_json_key_is(scan->key, scan->key_end, word);
}

/* Is the value at `at` one of the large lists that json_scan.h names? */
static bool is_large_list(struct scan *scan, const char *at, bool *polygons)
{
    static const char *const lists[] = {"positions", "faces", "normals", "colors", "faceColors", "lines", "heights"};
    bool is_list = *at == '[';
    *polygons = false;
    if (scan->depth == 0 || scan->depth > 4 || !in_object(scan)) return false;
    if (scan->depth == 1) {
        scan->in_meshes = is_list && key_is(scan, "meshes");
        return *polygons = is_list && key_is(scan, "polygons");
    }
    if (scan->depth == 3 && scan->in_meshes) {
        scan->in_heights = *at == '{' && key_is(scan, "heights");
        for (size_t i = 0; is_list && i < sizeof lists / sizeof *lists; i++)
            if (key_is(scan, lists[i])) return true;
    }
    return scan->depth == 4 && scan->in_meshes && scan->in_heights && is_list && key_is(scan, "values");
}

static const char *scan_value(struct scan *scan, const char *at, enum expect *expect)
{
    bool polygons;
    count_value(scan, at);
    if (scan->lists_are != AS_ANY && scan->uncounted == 0 && is_large_list(scan, at, &polygons)) {
        if (scan->lists_are == PASSED_OVER) {
            const char *behind = zr_json_list_add(scan->arena, scan->lists, at, scan->end, polygons, scan->depth + 1);
            *expect = after_value(scan);
            return behind ? behind : fail(scan, at, "a list with an end");
        }
        scan->uncounted = scan->depth;
    }
    if (*at == '[' || *at == '{') {
        *expect = *at == '{' ? FIRST_KEY : FIRST_VALUE;
        return open_level(scan, at, *at == '{') ? at + 1 : NULL;
    }
    const char *next;
    if (*at == '"')
        next = scan_string(scan, at + 1);
    else if (*at == '-' || is_digit(*at))
        next = scan_number(scan, at);
    else if (*at == 't')
        next = scan_literal(scan, at, "true");
    else if (*at == 'f')
        next = scan_literal(scan, at, "false");
    else if (*at == 'n')
        next = scan_literal(scan, at, "null");
    else
        next = fail(scan, at, expected[*expect]);
    *expect = after_value(scan);
    return next;
}

/* `at` is behind a comma in a list. Most of a scene is lists of numbers: these
 * are gone through without a turn of the state machine for each. */
static const char *scan_numbers(struct scan *scan, const char *at, enum expect *expect)
{
    for (;;) {
        at = zr_json_skip_space(at, scan->end);
        *expect = VALUE;
        if (at == scan->end || (*at != '-' && !is_digit(*at))) return at;
        if (!goes_on(scan, at)) return NULL;
        count_value(scan, at);
        at = scan_number(scan, at);
        *expect = NEXT_ITEM;
        if (!at || at == scan->end || *at != ',') return at;
        at++;
    }
}

/* A key and its colon. */
static const char *scan_key(struct scan *scan, const char *at, enum expect *expect)
{
    if (*at != '"') return fail(scan, at, expected[*expect]);
    scan->key = at + 1;
    at = scan_string(scan, at + 1);
    if (!at) return NULL;
    scan->key_end = at - 1;
    at = zr_json_skip_space(at, scan->end);
    if (at == scan->end || *at != ':') return fail(scan, at, "':' after a key");
    *expect = VALUE;
    return at + 1;
}

static const char *close_level(struct scan *scan, const char *at, enum expect *expect)
{
    if (--scan->depth == scan->uncounted) scan->uncounted = 0;
    *expect = after_value(scan);
    return at + 1;
}

static bool scan_text(struct scan *scan)
{
    enum expect expect = VALUE;
    for (const char *at = zr_json_skip_space(scan->start, scan->end); at;
         at = at ? zr_json_skip_space(at, scan->end) : NULL) {
        if (at == scan->end) return expect == END || fail(scan, at, expected[expect]);
        if (!goes_on(scan, at)) return false;
        bool closing = expect == FIRST_VALUE || expect == NEXT_ITEM
                           ? *at == ']'
                           : (expect == FIRST_KEY || expect == NEXT_MEMBER) && *at == '}';
        if (closing)
            at = close_level(scan, at, &expect);
        else if (expect == VALUE || expect == FIRST_VALUE)
            at = scan_value(scan, at, &expect);
        else if (expect == KEY || expect == FIRST_KEY)
            at = scan_key(scan, at, &expect);
        else if (expect == END || *at != ',')
            at = fail(scan, at, expected[expect]);
        else if (expect == NEXT_ITEM)
            at = scan_numbers(scan, at + 1, &expect);
        else {
            expect = KEY;
            at++;
        }
    }
    return false;
}

static enum zr_status report_limit(const struct scan *scan)
{
    char what[96];
    switch (scan->limit) {
    case TOO_DEEP:
        snprintf(what, sizeof what, "nested deeper than %u levels", scan->limits->json_depth_max);
        break;
    case TOO_MANY:
        snprintf(what, sizeof what, "%zu values in the text, more than the limit of %u", scan->values,
                 scan->limits->json_values_max);
        break;
    case TOO_LONG:
        snprintf(what, sizeof what, "a number of more than %d characters", ZR_NUMBER_JSON_MAX);
        break;
    default:
        snprintf(what, sizeof what, "U+0000 in a string");
        break;
    }
    struct zr_place place = zr_place_of(scan->start, (size_t)(scan->limit_at - scan->start));
    return zr_error_add(scan->error, ZR_BAD_SCENE, NULL, "line %zu, column %zu: %s", place.line, place.column, what);
}

static enum zr_status scan_all(struct scan *scan, struct zr_arena *arena, const char *bytes, size_t size,
                               const struct zr_limits *limits, struct zr_error *error)
{
    uint64_t first_levels[LEVELS_AT_FIRST / WORD_BITS] = {0};
    scan->start = scan->look = bytes;
    scan->end = bytes + size;
    scan->arena = arena;
    scan->error = error;
    scan->limits = limits;
    scan->objects = first_levels;
    scan->levels = LEVELS_AT_FIRST;
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "line 1, column 1: expected a value, found a byte order mark");
    if (!scan_text(scan)) return error->status;
    return scan->limit == NO_LIMIT ? ZR_OK : report_limit(scan);
}

enum zr_status zr_json_scan(struct zr_arena *arena, const char *bytes, size_t size, const struct zr_limits *limits,
                            size_t *values, struct zr_error *error)
{
    struct scan scan = {.lists_are = AS_ANY};
    enum zr_status status = scan_all(&scan, arena, bytes, size, limits, error);
    *values = scan.values;
    return status;
}

enum zr_status zr_json_scan_scene(struct zr_arena *arena, const char *bytes, size_t size,
                                  const struct zr_limits *limits, struct zr_error *error)
{
    struct scan scan = {.lists_are = SCANNED_UNCOUNTED};
    return scan_all(&scan, arena, bytes, size, limits, error);
}

enum zr_status zr_json_scan_around_lists(struct zr_arena *arena, const char *bytes, size_t size,
                                         const struct zr_limits *limits, struct zr_json_lists *lists, size_t *values,
                                         struct zr_error *error)
{
    struct scan scan = {.lists_are = PASSED_OVER, .lists = lists};
    enum zr_status status = scan_all(&scan, arena, bytes, size, limits, error);
    *values = scan.values;
    return status;
}
