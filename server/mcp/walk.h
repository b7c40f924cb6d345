/* walk.h - mcp: reads JSON text (RFC 8259), strictly, and finds the places of values. It copies nothing, so that a
 * message may hold a large scene or model.
 *
 *     mcp_walk_enter(&walk, '{');
 *     while (mcp_walk_member(&walk, &key))
 *         mcp_walk_value(&walk, &value);
 *
 * After a fault all loops stop, and `fault` has the reason. */
#ifndef MCP_WALK_H
#define MCP_WALK_H

#include <stdbool.h>
#include <stddef.h>

#include "span.h"

struct mcp_host; /* host.h */

enum mcp_walk_fault { MCP_WALK_OK, MCP_WALK_BROKEN, MCP_WALK_DEEP, MCP_WALK_CANCELLED };

struct mcp_walk {
    const char *at, *end;
    const char *look; /* place of the next look at cancellation */
    const struct mcp_host *host;
    unsigned depth;
    bool is_first; /* after the bracket of a list or object */
    bool has_nul;  /* a string has \u0000, which would end names and paths */
    enum mcp_walk_fault fault;
};

struct mcp_walk mcp_walk_open(struct mcp_span text, const struct mcp_host *host);

/* Returns the first byte of the next value: '{', '[', '"', a digit, ...; 0: none. */
char mcp_walk_peek(struct mcp_walk *walk);

/* Enters an object or a list. */
void mcp_walk_enter(struct mcp_walk *walk, char bracket);

/* Goes to the next member of the object, or item of the list; false at its end, which it passes. `key`: the text
 * between the quotes, as written. */
bool mcp_walk_member(struct mcp_walk *walk, struct mcp_span *key);
bool mcp_walk_item(struct mcp_walk *walk);

/* Passes a value; `value` may be NULL. */
void mcp_walk_value(struct mcp_walk *walk, struct mcp_span *value);

/* Returns true if the text ends here. */
bool mcp_walk_end(struct mcp_walk *walk);

bool mcp_span_is(struct mcp_span span, const char *text);

#endif
