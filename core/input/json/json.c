#include "input/json/json.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "input/json/json_uris.h"
#include "input/text/number.h"
#include "input/text/text.h"

/* BYTES_PER_CANCEL_CHECK: bytes between two checks for cancellation. */
enum { WORD_BITS = 64, BYTES_PER_CANCEL_CHECK = 1 << 20 };

static const char A_VALUE[] = "a value";

/* ---- faults ---- */

/* True if reading has ended. A part that is read ahead ends at its first fault, without a report. */
static bool ends_ahead(struct zr_json *json)
{
    if (json->is_ahead) zr_json_give_up(json);
    return json->ended;
}

/* Reports a syntax error at `at`, where `what` was expected, and ends reading. Drops all earlier reports. Returns
 * false. */
static bool fail(struct zr_json *json, const char *at, const char *what)
{
    if (ends_ahead(json)) return false;
    const struct zr_place place = zr_place_of(json->bytes, (size_t)(at - json->bytes));
    const bool is_escape = json->end - at >= 2 && *at == '\\';
    const size_t length = (at < json->end ? zr_utf8_length(at + is_escape, json->end) : 0) + is_escape;
    const bool mark = at == json->bytes && json->end - at >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0;
    zr_json_give_up(json);
    *json->error = (struct zr_error){0};
    zr_error_add(json->error, ZR_BAD_SYNTAX, NULL, "line %zu, column %zu: expected %s, found %s", place.line,
                 place.column, what,
                 at == json->end ? "the end of the text"
                 : mark          ? "a byte order mark"
                                 : zr_quote(at, length ? length : 1).text);
    json->error->items[0].place = 1 + (size_t)(at - json->bytes);
    return false;
}

static bool fail_limit(struct zr_json *json, const char *at, const char *format, unsigned limit)
{
    if (ends_ahead(json)) return false;
    const struct zr_place place = zr_place_of(json->bytes, (size_t)(at - json->bytes));
    char what[64];
    snprintf(what, sizeof what, format, limit);
    zr_json_give_up(json);
    *json->error = (struct zr_error){0};
    zr_error_add(json->error, ZR_BAD_SCENE, NULL, "line %zu, column %zu: %s", place.line, place.column, what);
    json->error->items[0].place = 1 + (size_t)(at - json->bytes);
    return false;
}

/* False if the request is cancelled; checks at most once per BYTES_PER_CANCEL_CHECK. */
static bool may_continue(struct zr_json *json, const char *at)
{
    if (at < json->look) return true;
    json->look = at + (json->end - at < BYTES_PER_CANCEL_CHECK ? json->end - at : BYTES_PER_CANCEL_CHECK);
    if (!zr_is_cancelled(json->cancel)) return !json->ended;
    zr_arena_charge(json->arena, SIZE_MAX); /* fails the arena, so that all readers end as if memory were used up */
    zr_json_give_up(json);
    return false;
}

bool zr_json_stops(struct zr_json *json)
{
    return !may_continue(json, json->at) || json->error->count >= ZR_ERROR_ITEMS || !zr_arena_ok(json->arena);
}

/* ---- strings ---- */

static bool is_digit(char byte)
{
    return (unsigned char)(byte - '0') < 10;
}

/* Bytes that a string holds unescaped: neither control, quote nor backslash, and within ASCII. */
static bool is_plain(char byte)
{
    return (unsigned char)byte >= 0x20 && (unsigned char)byte < 0x80 && byte != '"' && byte != '\\';
}

/* True if one of eight bytes may not be plain. Carries between bytes can only raise false alarms: the caller checks
 * byte by byte. */
static bool may_be_special(uint64_t word)
{
    const uint64_t ones = UINT64_C(0x0101010101010101), tops = ones * 0x80;
    uint64_t quote = word ^ (ones * '"'), backslash = word ^ (ones * '\\');
    return ((word | (word - ones * 0x20) | (quote - ones) | (backslash - ones)) & tops) != 0;
}

/* Returns the byte after the escape at `at`, or NULL. */
static const char *pass_escape(struct zr_json *json, const char *at)
{
    size_t length;
    if (json->end - at < 2) {
        fail(json, at + 1, "an escape");
        return NULL;
    }
    if (at[1] == '\0' || !strchr("\"\\/bfnrtu", at[1])) {
        fail(json, at, "one of the escapes \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
        return NULL;
    }
    if (at[1] != 'u') return at + 2;
    const int32_t character = zr_json_text_unit(at, json->end, &length);
    if (character == 0 && json->has_nul) *json->has_nul = true;
    if (character > 0 || (character == 0 && json->has_nul)) return at + length;
    if (character == 0)
        fail_limit(json, at, "U+0000 in a string", 0);
    else
        fail(json, at, length > 0 ? "both halves of a surrogate pair" : "four hexadecimal digits after \\u");
    return NULL;
}

/* Returns the byte after the closing quote, or NULL; `at` is after the opening one. */
static const char *pass_bytes(struct zr_json *json, const char *at, bool *has_escapes)
{
    const char *end = json->end;
    *has_escapes = false;
    for (;;) {
        uint64_t word;
        if (!may_continue(json, at)) return NULL;
        while (json->look - at >= (ptrdiff_t)sizeof word) {
            memcpy(&word, at, sizeof word);
            if (may_be_special(word)) break;
            at += sizeof word;
        }
        while (at < json->look && is_plain(*at))
            at++;
        if (at == json->look && at < end) continue;
        if (at < end && *at == '"') return at + 1;
        if (at < end && *at == '\\') {
            *has_escapes = true;
            at = pass_escape(json, at);
            if (!at) return NULL;
            continue;
        }
        const size_t length = at < end && (unsigned char)*at >= 0x20 ? zr_utf8_length(at, end) : 0;
        if (length == 0) {
            fail(json, at,
                 at == end                   ? "'\"' at the end of a string"
                 : (unsigned char)*at < 0x20 ? "control characters in a string as escapes"
                                             : "valid UTF-8");
            return NULL;
        }
        at += length;
    }
}

/* Passes a string as pass_bytes does, and notes a long data: URI. */
static const char *pass_uri(struct zr_json *json, const char *at, bool *has_escapes)
{
    struct zr_json_uri uri;
    const struct zr_json_uri *noted = zr_json_uri_at(json->uris, at);
    *has_escapes = false;
    if (noted) return at + noted->size + 1;
    if (zr_json_uri_find(json->uris, at, json->end, &uri)) return at + uri.size + 1;
    const char *behind = pass_bytes(json, at, has_escapes);
    if (behind && !*has_escapes && uri.size > 0 && behind == at + uri.size + 1) zr_json_uri_note(json->uris, &uri);
    return behind;
}

static const char *pass_string(struct zr_json *json, const char *at, bool *has_escapes)
{
    const bool may_be_long = json->uris && json->end - at > ZR_JSON_URI_MIN && memcmp(at, "data:", 5) == 0;
    return may_be_long ? pass_uri(json, at, has_escapes) : pass_bytes(json, at, has_escapes);
}

/* Reads a string without a check for cancellation at its start. */
static bool take_string(struct zr_json *json, struct zr_json_text *text)
{
    text->at = json->at + 1;
    const char *behind = pass_string(json, json->at + 1, &text->has_escapes);
    if (!behind) return false;
    text->end = behind - 1;
    json->at = behind;
    return true;
}

bool zr_json_take_string(struct zr_json *json, struct zr_json_text *text)
{
    json->at = zr_json_skip_space(json->at, json->end);
    return take_string(json, text);
}

const char *zr_json_decode(struct zr_json *json, const struct zr_json_text *text)
{
    char *out = zr_arena_alloc(json->arena, (size_t)(text->end - text->at) + 1, 1);
    if (!out) {
        zr_json_look(json);
        return NULL;
    }
    out[zr_json_text_resolve(text, out)] = '\0';
    return out;
}

/* ---- numbers and words ---- */

/* The missing part of a number, and its place. */
struct lack {
    const char *at, *what;
};

static const char *pass_digits(const char *at, const char *end, struct lack *lack)
{
    const char *first = at;
    while (at < end && is_digit(*at))
        at++;
    if (at > first) return at;
    *lack = (struct lack){at, "a digit"};
    return NULL;
}

/* Returns the byte after the number at `at`, or NULL and the part that it lacks. Source: RFC 8259, section 6. */
static const char *pass_number(const char *at, const char *end, struct lack *lack)
{
    if (at < end && *at == '-') at++;
    const char *first = at;
    if (!(at = pass_digits(at, end, lack))) return NULL;
    if (*first == '0' && at - first > 1) {
        *lack = (struct lack){first, "a number without leading zeros"};
        return NULL;
    }
    if (at < end && *at == '.' && !(at = pass_digits(at + 1, end, lack))) return NULL;
    if (at == end || (*at != 'e' && *at != 'E')) return at;
    at++;
    if (at < end && (*at == '+' || *at == '-')) at++;
    return pass_digits(at, end, lack);
}

static bool skip_number(struct zr_json *json)
{
    struct lack lack = {json->at, A_VALUE};
    const char *behind = pass_number(json->at, json->end, &lack);
    if (!behind) return fail(json, lack.at, lack.what);
    json->at = behind;
    return true;
}

bool zr_json_take_number(struct zr_json *json, double *value)
{
    json->at = zr_json_skip_space(json->at, json->end);
    const char *behind = zr_number_quick(json->at, json->end, value);
    if (!behind) behind = zr_number_read_json(json->at, json->end, value);
    if (!behind) return skip_number(json); /* reports the syntax error */
    json->at = behind;
    return true;
}

static bool take_word(struct zr_json *json, const char *word)
{
    const size_t length = strlen(word);
    if ((size_t)(json->end - json->at) < length || memcmp(json->at, word, length) != 0)
        return fail(json, json->at, A_VALUE);
    json->at += length;
    return true;
}

bool zr_json_take_bool(struct zr_json *json, bool *value)
{
    json->at = zr_json_skip_space(json->at, json->end);
    *value = json->at < json->end && *json->at == 't';
    return take_word(json, *value ? "true" : "false");
}

/* ---- lists and objects ---- */

enum zr_json_type zr_json_type(struct zr_json *json)
{
    json->at = zr_json_skip_space(json->at, json->end);
    if (json->at == json->end) return ZR_JSON_NOTHING;
    switch (*json->at) {
    case '{':
        return ZR_JSON_OBJECT;
    case '[':
        return ZR_JSON_LIST;
    case '"':
        return ZR_JSON_STRING;
    case 't':
    case 'f':
        return ZR_JSON_BOOL;
    case 'n':
        return ZR_JSON_NULL;
    case '-':
        return ZR_JSON_NUMBER;
    default:
        return is_digit(*json->at) ? ZR_JSON_NUMBER : ZR_JSON_NOTHING;
    }
}

bool zr_json_enter(struct zr_json *json, char bracket)
{
    json->at = zr_json_skip_space(json->at, json->end);
    if (json->at == json->end || *json->at != bracket) return fail(json, json->at, A_VALUE);
    if (json->depth == json->limits->json_depth_max)
        return fail_limit(json, json->at, "nested deeper than %u levels", json->depth);
    json->depth++;
    json->at++;
    return true;
}

/* True if nothing was read since the bracket. No value ends with '[' or '{', so the byte before `at` decides. */
static bool is_first(const struct zr_json *json)
{
    return json->at[-1] == '[' || json->at[-1] == '{';
}

static bool next_member(struct zr_json *json, struct zr_json_text *key)
{
    const bool first = is_first(json);
    const char *end = json->end;
    if (json->ended) return false;
    json->at = zr_json_skip_space(json->at, end);
    if (json->at < end && *json->at == '}') {
        json->at++;
        json->depth--;
        return false;
    }
    if (!first) {
        if (json->at == end || *json->at != ',') return fail(json, json->at, "',' or '}'");
        json->at = zr_json_skip_space(json->at + 1, end);
    }
    if (json->at == end || *json->at != '"')
        return fail(json, json->at, first ? "a key in double quotes or '}'" : "a key in double quotes");
    if (!take_string(json, key)) return false;
    json->at = zr_json_skip_space(json->at, end);
    if (json->at == end || *json->at != ':') return fail(json, json->at, "':' after a key");
    json->at++;
    return true;
}

static bool next_item(struct zr_json *json)
{
    const bool first = is_first(json);
    if (json->ended) return false;
    json->at = zr_json_skip_space(json->at, json->end);
    if (json->at < json->end && *json->at == ']') {
        json->at++;
        json->depth--;
        return false;
    }
    if (first) return zr_json_type(json) != ZR_JSON_NOTHING || fail(json, json->at, "a value or ']'");
    if (json->at == json->end || *json->at != ',') return fail(json, json->at, "',' or ']'");
    json->at++;
    return zr_json_type(json) != ZR_JSON_NOTHING || fail(json, json->at, A_VALUE);
}

bool zr_json_member(struct zr_json *json, struct zr_json_text *key)
{
    return !zr_json_stops(json) && next_member(json, key);
}

bool zr_json_any_item(struct zr_json *json)
{
    return !zr_json_stops(json) && next_item(json);
}

void zr_json_check_closed(struct zr_json *json, unsigned inside)
{
    if (json->at == json->end && json->depth == inside) zr_json_any_item(json);
}

/* Skips a value other than a list or an object. */
static bool skip_simple(struct zr_json *json, enum zr_json_type type)
{
    struct zr_json_text text;
    switch (type) {
    case ZR_JSON_STRING:
        return take_string(json, &text);
    case ZR_JSON_NUMBER:
        return skip_number(json);
    case ZR_JSON_BOOL:
        return take_word(json, *json->at == 't' ? "true" : "false");
    case ZR_JSON_NULL:
        return take_word(json, "null");
    default:
        return fail(json, json->at, A_VALUE);
    }
}

bool zr_json_skip(struct zr_json *json)
{
    uint64_t objects[ZR_JSON_DEPTH_MAX / WORD_BITS + 1] = {0}; /* one bit per level: 1 for an object */
    const unsigned around = json->depth;
    struct zr_json_text key;
    do {
        const enum zr_json_type type = zr_json_type(json);
        if (type == ZR_JSON_LIST || type == ZR_JSON_OBJECT) {
            if (!zr_json_enter(json, *json->at)) return false;
            const uint64_t bit = UINT64_C(1) << (json->depth % WORD_BITS);
            uint64_t *word = &objects[json->depth / WORD_BITS];
            *word = type == ZR_JSON_OBJECT ? *word | bit : *word & ~bit;
        } else if (!skip_simple(json, type)) {
            return false;
        }
        while (json->depth > around && !json->ended) {
            const bool is_object = objects[json->depth / WORD_BITS] >> (json->depth % WORD_BITS) & 1u;
            if (is_object ? next_member(json, &key) : next_item(json)) break;
        }
    } while (json->depth > around && may_continue(json, json->at));
    return !json->ended;
}

static bool is_at_end(struct zr_json *json)
{
    json->at = zr_json_skip_space(json->at, json->end);
    return json->at == json->end ? !json->ended : fail(json, json->at, "the end of the text");
}

bool zr_json_end(struct zr_json *json)
{
    return !zr_json_stops(json) && is_at_end(json);
}

/* ---- the whole ---- */

void zr_json_open(struct zr_json *json, const char *bytes, size_t size)
{
    json->at = json->look = json->bytes = bytes;
    json->end = bytes + size;
    json->depth = 0;
    json->ended = false;
}

enum zr_status zr_json_close(struct zr_json *json)
{
    if (zr_is_cancelled(json->cancel)) return ZR_CANCELLED;
    if (!json->ended && json->error->count == 0 && zr_arena_ok(json->arena)) return ZR_OK;
    if (!json->ended) { /* the rest of the text may be unread */
        struct zr_error verdict = {0};
        struct zr_json whole = *json;
        whole.error = &verdict;
        zr_json_open(&whole, json->bytes, (size_t)(json->end - json->bytes));
        if (!zr_json_skip(&whole) || !is_at_end(&whole)) {
            if (zr_is_cancelled(json->cancel)) return ZR_CANCELLED;
            *json->error = verdict;
        }
    }
    return json->error->count > 0 ? json->error->status : ZR_NO_MEMORY;
}
