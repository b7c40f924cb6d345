#include "walk.h"

#include <stdint.h>
#include <string.h>

#include "base/utf8.h"
#include "host.h"

/* LOOK_BYTES: passed within 1 ms. */
enum { DEPTH_MAX = 512, LOOK_BYTES = 256 << 10 };

static bool stop(struct mcp_walk *walk, enum mcp_walk_fault fault)
{
    if (walk->fault == MCP_WALK_OK) walk->fault = fault;
    walk->at = walk->end;
    return false;
}

/* Looks at cancellation now and then. */
static bool has_time(struct mcp_walk *walk)
{
    if (walk->at < walk->look) return true;
    walk->look = walk->end - walk->at > LOOK_BYTES ? walk->at + LOOK_BYTES : walk->end;
    if (mcp_host_is_cancelled(walk->host)) return stop(walk, MCP_WALK_CANCELLED);
    return true;
}

static void skip_space(struct mcp_walk *walk)
{
    const char *at = walk->at;
    while (at < walk->end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t'))
        at++;
    walk->at = at;
}

struct mcp_walk mcp_walk_open(struct mcp_span text, const struct mcp_host *host)
{
    return (struct mcp_walk){.at = text.at, .end = text.end, .look = text.at, .host = host};
}

char mcp_walk_peek(struct mcp_walk *walk)
{
    skip_space(walk);
    return walk->at < walk->end ? *walk->at : '\0';
}

void mcp_walk_enter(struct mcp_walk *walk, char bracket)
{
    if (mcp_walk_peek(walk) != bracket || walk->depth == DEPTH_MAX) {
        stop(walk, walk->depth == DEPTH_MAX ? MCP_WALK_DEEP : MCP_WALK_BROKEN);
        return;
    }
    walk->at++;
    walk->depth++;
    walk->is_first = true;
}

/* ---- scalars ---- */

static bool is_hex(char c)
{
    return (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'f');
}

/* Passes an escape, whose backslash is at `at`. */
static const char *pass_escape(struct mcp_walk *walk, const char *at)
{
    const char *const end = walk->end;
    if (end - at < 2) return NULL;
    if (at[1] && strchr("\"\\/bfnrt", at[1])) return at + 2;
    if (at[1] != 'u' || end - at < 6) return NULL;
    for (int i = 2; i < 6; i++)
        if (!is_hex(at[i])) return NULL;
    walk->has_nul |= memcmp(at + 2, "0000", 4) == 0;
    return at + 6;
}

/* Returns true if eight bytes are all plain: ASCII, neither a quote nor a backslash nor a control character. */
static bool are_plain(const char *at)
{
    static const uint64_t ones = UINT64_MAX / 255, tops = UINT64_MAX / 255 * 128;
    uint64_t bytes;
    memcpy(&bytes, at, sizeof bytes);
    const uint64_t quotes = bytes ^ ones * '"', strokes = bytes ^ ones * '\\';
    const uint64_t found = ((quotes - ones) & ~quotes) | ((strokes - ones) & ~strokes) | (bytes - ones * ' ') | bytes;
    return (found & tops) == 0;
}

static bool pass_string(struct mcp_walk *walk)
{
    walk->at++;
    while (walk->at < walk->end && has_time(walk)) {
        const char *at = walk->at, *const end = walk->end - at > LOOK_BYTES ? at + LOOK_BYTES : walk->end;
        while (end - at >= 8 && are_plain(at))
            at += 8;
        while (at < end && (unsigned char)*at < 0x80 && *at != '"' && *at != '\\' && (unsigned char)*at >= ' ')
            at++;
        walk->at = at;
        if (at == end) continue;
        if (*at == '"') {
            walk->at++;
            return true;
        }
        const size_t length = *at == '\\' || (unsigned char)*at < ' ' ? 0 : zr_utf8_length(at, walk->end);
        const char *next = *at == '\\' ? pass_escape(walk, at) : length ? at + length : NULL;
        if (!next) break;
        walk->at = next;
    }
    return stop(walk, MCP_WALK_BROKEN);
}

static const char *pass_digits(const char *at, const char *end)
{
    const char *const begin = at;
    while (at < end && *at >= '0' && *at <= '9')
        at++;
    return at > begin ? at : NULL;
}

static bool pass_number(struct mcp_walk *walk)
{
    const char *at = walk->at, *const end = walk->end;
    if (at < end && *at == '-') at++;
    const char *const whole = at;
    at = pass_digits(at, end);
    if (!at || (*whole == '0' && at > whole + 1)) return stop(walk, MCP_WALK_BROKEN);
    if (at < end && *at == '.') at = pass_digits(at + 1, end);
    if (at && at < end && (*at | 32) == 'e') {
        at++;
        if (at < end && (*at == '+' || *at == '-')) at++;
        at = pass_digits(at, end);
    }
    if (!at) return stop(walk, MCP_WALK_BROKEN);
    walk->at = at;
    return true;
}

static bool pass_word(struct mcp_walk *walk, const char *word)
{
    const size_t length = strlen(word);
    if ((size_t)(walk->end - walk->at) < length || memcmp(walk->at, word, length) != 0)
        return stop(walk, MCP_WALK_BROKEN);
    walk->at += length;
    return true;
}

static bool pass_scalar(struct mcp_walk *walk, char first)
{
    switch (first) {
    case '"':
        return pass_string(walk);
    case 't':
        return pass_word(walk, "true");
    case 'f':
        return pass_word(walk, "false");
    case 'n':
        return pass_word(walk, "null");
    default:
        return pass_number(walk);
    }
}

/* ---- lists and objects ---- */

/* Moves past a comma, or past the closing bracket. */
static bool next(struct mcp_walk *walk, char closing)
{
    const char byte = has_time(walk) ? mcp_walk_peek(walk) : '\0';
    const bool is_first = walk->is_first;
    walk->is_first = false;
    if (byte == closing) {
        walk->at++;
        walk->depth--;
        return false;
    }
    if (is_first) return byte || stop(walk, MCP_WALK_BROKEN);
    if (byte != ',') return stop(walk, MCP_WALK_BROKEN);
    walk->at++;
    return true;
}

bool mcp_walk_item(struct mcp_walk *walk)
{
    return next(walk, ']');
}

bool mcp_walk_member(struct mcp_walk *walk, struct mcp_span *key)
{
    if (!next(walk, '}')) return false;
    if (mcp_walk_peek(walk) != '"') return stop(walk, MCP_WALK_BROKEN);
    const char *const at = walk->at + 1;
    if (!pass_string(walk)) return false;
    *key = (struct mcp_span){at, walk->at - 1};
    if (mcp_walk_peek(walk) != ':') return stop(walk, MCP_WALK_BROKEN);
    walk->at++;
    return true;
}

/* Passes nested values without recursion: a flag per level marks objects. */
static void pass_nested(struct mcp_walk *walk)
{
    unsigned char is_object[DEPTH_MAX + 1] = {0};
    const unsigned base = walk->depth;
    struct mcp_span key;
    do {
        const char first = mcp_walk_peek(walk);
        if (first == '{' || first == '[') {
            mcp_walk_enter(walk, first);
            is_object[walk->depth] = first == '{';
        } else {
            pass_scalar(walk, first);
        }
        while (walk->fault == MCP_WALK_OK && walk->depth > base &&
               !(is_object[walk->depth] ? mcp_walk_member(walk, &key) : mcp_walk_item(walk))) {
        }
    } while (walk->fault == MCP_WALK_OK && walk->depth > base);
}

void mcp_walk_value(struct mcp_walk *walk, struct mcp_span *value)
{
    const char first = mcp_walk_peek(walk), *const at = walk->at;
    if (first == '{' || first == '[')
        pass_nested(walk);
    else
        pass_scalar(walk, first);
    walk->is_first = false;
    if (value) *value = walk->fault == MCP_WALK_OK ? (struct mcp_span){at, walk->at} : (struct mcp_span){NULL, NULL};
}

bool mcp_walk_end(struct mcp_walk *walk)
{
    skip_space(walk);
    if (walk->fault == MCP_WALK_OK && walk->at < walk->end) stop(walk, MCP_WALK_BROKEN);
    return walk->fault == MCP_WALK_OK;
}

bool mcp_span_is(struct mcp_span span, const char *text)
{
    const size_t length = strlen(text);
    return span.at && (size_t)(span.end - span.at) == length && memcmp(span.at, text, length) == 0;
}
