/* json.h - input: a strict pull parser of JSON (RFC 8259). It never changes the text.
 *
 *     zr_json_enter(json, '{');
 *     while (zr_json_member(json, &key))
 *         ... read the value, or zr_json_skip(json)
 *
 * Errors:  a syntax error anywhere in the text takes precedence over all other faults: zr_json_close parses the rest.
 *          So a reader may stop at any fault.
 * Places:  a skipped value is well-formed and can be read later from its first byte (zr_json_at), any number of times.
 *          So there is no tree, and the order of keys does not matter.
 * Ending:  when reading has ended, `at` and `look` equal `end`, so that all loops stop.
 * Bytes:   nothing is read at `end` or after it.
 */
#ifndef ZR_JSON_H
#define ZR_JSON_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/run.h"
#include "base/status.h"
#include "core.h"
#include "input/json/json_text.h"

/* The upper limit of json_depth_max, levels. */
enum { ZR_JSON_DEPTH_MAX = 512 };

struct zr_team; /* base/team.h */
struct zr_parsed_assets;
struct zr_json_uris;
struct zr_far; /* text/recenter.h */

struct zr_json {
    const char *at; /* the next byte to read */
    const char *bytes, *end;
    const char *look; /* the place of the next check for cancellation; at most `end` */
    struct zr_arena *arena;
    struct zr_team *team;           /* may be NULL */
    const struct zr_cancel *cancel; /* may be NULL */
    const struct zr_limits *limits;
    struct zr_error *error;
    struct zr_parsed_assets *assets; /* files/assets.h; NULL: the text is no scene and names no assets */
    const struct zr_far *far;        /* subtracted from places before they are rounded; NULL: nothing */
    const double *move;              /* zr_far_move of the list that is read; NULL without `far` */
    struct zr_json_uris *uris;       /* json_uris.h; NULL: long data: URIs are not noted */
    unsigned depth;                  /* open lists and objects around `at` */
    bool ended;    /* reading has ended: the text is malformed or too deep, or the request is cancelled */
    bool *has_nul; /* set by U+0000 in a string; NULL: it is refused */
    bool is_ahead; /* reads a part of a list in parallel: a fault ends the part without a report (json_list.h) */
    char *room;    /* memory for such parts; NULL until the first large list */
};

enum zr_json_type {
    ZR_JSON_NOTHING, /* no value begins here */
    ZR_JSON_NULL,
    ZR_JSON_BOOL,
    ZR_JSON_NUMBER,
    ZR_JSON_STRING,
    ZR_JSON_LIST,
    ZR_JSON_OBJECT
};

/* Sets at, look, bytes, end, depth and ended; the caller fills the other members. Syntax errors name line and
 * column. */
void zr_json_open(struct zr_json *json, const char *bytes, size_t size);

/* Returns the result of reading, once the root is read or reading has stopped: ZR_OK; ZR_BAD_SYNTAX, with the syntax
 * error alone in *json->error; the status of *json->error; ZR_NO_MEMORY; or ZR_CANCELLED. Excessive depth and U+0000 in
 * a string are ZR_BAD_SCENE; the text after them is not parsed. */
enum zr_status zr_json_close(struct zr_json *json);

/* Returns the run of functions that read parts of the text. */
static inline struct zr_run zr_json_run(const struct zr_json *json)
{
    return (struct zr_run){json->arena, json->arena, json->team, json->cancel, json->error};
}

/* Returns a reader of the same text at the place of a value that was skipped before. */
static inline struct zr_json zr_json_at(const struct zr_json *json, const char *place)
{
    struct zr_json there = *json;
    there.at = there.look = place;
    return there;
}

/* Returns the first byte from `at` on that is not white space, or `end`. */
static inline const char *zr_json_skip_space(const char *at, const char *end)
{
    while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t'))
        at++;
    return at;
}

/* Returns the type of the next value by its first byte, and moves json->at to that byte. */
enum zr_json_type zr_json_type(struct zr_json *json);

/* Enters the next value: a list ('[') or an object ('{'). */
bool zr_json_enter(struct zr_json *json, char bracket);

/* Reads the next key and moves to its value. False at the end of the object, and if reading stops (zr_json_stops). */
bool zr_json_member(struct zr_json *json, struct zr_json_text *key);

/* Moves to the next item of a list; false as for zr_json_member. zr_json_item inlines the usual case: items are lists
 * or objects, and commas are followed by at most one blank. */
bool zr_json_any_item(struct zr_json *json);

static inline bool zr_json_item(struct zr_json *json)
{
    const char *at = json->at;
    if (json->end - at < 3 || at >= json->look) return zr_json_any_item(json);
    if (*at == ']') {
        json->at = at + 1;
        json->depth--;
        return false;
    }
    if (at[-1] != '[') {
        if (*at != ',') return zr_json_any_item(json);
        at += 1 + (at[1] == ' ');
    }
    if (*at != '[' && *at != '{') return zr_json_any_item(json);
    json->at = at;
    return true;
}

/* Reports a list, entered at depth `inside`, that is still open at the end of the text. For loops over items that stop
 * there by themselves. */
void zr_json_check_closed(struct zr_json *json, unsigned inside);

/* Skips the next value of any type. */
bool zr_json_skip(struct zr_json *json);

/* Read the next value, which has this type. False only for a syntax error. */
bool zr_json_take_string(struct zr_json *json, struct zr_json_text *text);
bool zr_json_take_number(struct zr_json *json, double *value);
bool zr_json_take_bool(struct zr_json *json, bool *value);

/* Checks that only white space follows the root. False also if reading has stopped. */
bool zr_json_end(struct zr_json *json);

/* Returns the string with its escapes resolved, zero-terminated, in the arena; NULL if the arena has failed. */
const char *zr_json_decode(struct zr_json *json, const struct zr_json_text *text);

/* Ends reading. */
static inline void zr_json_give_up(struct zr_json *json)
{
    json->ended = true;
    json->at = json->look = json->end;
}

/* Makes the next zr_json_item call zr_json_stops. For functions that report a fault or have no memory, and so may leave
 * a value unread. */
static inline void zr_json_look(struct zr_json *json)
{
    json->look = json->at;
}

/* True if there is another fault than the `before` ones. A fault of syntax replaces all of them, and ends reading. */
static inline bool zr_json_failed_since(const struct zr_json *json, size_t before)
{
    return json->ended || json->error->count != before;
}

/* True if reading must stop: a syntax error, ZR_ERROR_ITEMS faults, a failed arena or a cancelled request. */
bool zr_json_stops(struct zr_json *json);

#endif
