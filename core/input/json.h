/* json.h - input: JSON (RFC 8259), token after token, strictly, from a text that stays as it is.
 *
 *     zr_json_enter(json, '{');
 *     while (zr_json_member(json, &key))
 *         ... read the value, or zr_json_skip(json)
 *
 * Order of judgement: a text that is malformed anywhere is refused as such, whatever else is wrong with what it says
 *         (zr_json_close sees to that); so readers may stop at whatever they dislike.
 * Places: a value that was skipped is known to be well-formed, and may be read later from where it began
 *         (zr_json_at), as often as it takes. So no tree is made, and the order of keys does not matter.
 * Ending: once nothing more is to be read, `at` and `look` are at `end`, and so no loop goes on.
 * Bytes:  nothing is read at `end` or behind it.
 */
#ifndef ZR_JSON_H
#define ZR_JSON_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"
#include "input/json_text.h"
#include "zraster.h"

/* What json_depth_max may be. */
enum { ZR_JSON_DEPTH_MAX = 512 };

struct zr_team; /* base/team.h */

struct zr_json {
    const char *at; /* behind what was read */
    const char *bytes, *end;
    const char *look; /* from here on it is asked whether to stop; never behind `end` */
    struct zr_arena *arena;
    struct zr_team *team;           /* may be NULL */
    const struct zr_cancel *cancel; /* may be NULL */
    const struct zr_limits *limits;
    struct zr_error *error;
    unsigned depth; /* lists and objects around `at` */
    bool ended;     /* nothing more is read: the text is malformed or too deep, or the request cancelled */
    bool is_ahead;  /* of a part of a list that is read beside others: whatever is wrong only ends it (json_list.h) */
    char *room;     /* for such parts, once there are some */
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

/* Sets bytes..end, look and at; all else is the caller's to fill. Faults of syntax name line and column. */
void zr_json_open(struct zr_json *json, const char *bytes, size_t size);

/* What reading came to, once the root was read or reading has stopped: ZR_OK; ZR_BAD_SYNTAX, alone in *json->error; the
 * status of *json->error; ZR_NO_MEMORY or ZR_CANCELLED. Too deep a text is ZR_BAD_SCENE where that shows, and
 * U+0000 in a string too: nothing behind it is looked at. */
enum zr_status zr_json_close(struct zr_json *json);

/* Another reader of the same text, at a value that was skipped before. */
static inline struct zr_json zr_json_at(const struct zr_json *json, const char *place)
{
    struct zr_json there = *json;
    there.at = there.look = place;
    return there;
}

/* Behind white space. */
static inline const char *zr_json_skip_space(const char *at, const char *end)
{
    while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t'))
        at++;
    return at;
}

/* Of the value that is next, by its first byte; json->at is there then. */
enum zr_json_type zr_json_type(struct zr_json *json);

/* Steps into a list, '[', or an object, '{', which the next value is known to be. */
bool zr_json_enter(struct zr_json *json, char bracket);

/* To the next member's value. False behind the last one, and where reading stops: at bad syntax, where as many faults
 * are reported as are kept, where memory is used up or the request is cancelled. */
bool zr_json_member(struct zr_json *json, struct zr_json_text *key);

/* The same for lists, to the next item; zr_json_item inlines what is usual: no space but a blank behind a comma, and
 * items that are lists or objects. */
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

/* For loops over items that stop at the text's end by themselves: reports a list, entered at this depth, that is still
 * open there. */
void zr_json_check_closed(struct zr_json *json, unsigned inside);

/* Behind the next value, whatever it is. */
bool zr_json_skip(struct zr_json *json);

/* The next value, of this type. False only for bad syntax. */
bool zr_json_take_string(struct zr_json *json, struct zr_json_text *text);
bool zr_json_take_number(struct zr_json *json, double *value);
bool zr_json_take_bool(struct zr_json *json, bool *value);

/* The root is read: nothing but white space may follow. False also where reading stopped before. */
bool zr_json_end(struct zr_json *json);

/* As it is meant, escapes resolved, zero-terminated and in the arena; NULL where that has failed. */
const char *zr_json_decode(struct zr_json *json, const struct zr_json_text *text);

/* Nothing more is read. */
static inline void zr_json_give_up(struct zr_json *json)
{
    json->ended = true;
    json->at = json->look = json->end;
}

/* Makes zr_json_item ask at once whether to stop: for whoever reports a fault or has no memory, and so may leave a
 * value unread. */
static inline void zr_json_look(struct zr_json *json)
{
    json->look = json->at;
}

/* Time to stop: see zr_json_member. */
bool zr_json_stops(struct zr_json *json);

#endif
