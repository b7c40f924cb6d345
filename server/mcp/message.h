/* message.h - mcp: reads a message of JSON-RPC 2.0, and finds the revision of MCP that it follows.
 *
 * The scene and the bytes of a model, which may be large, stay where they are; the rest becomes a tree of bounded size.
 */
#ifndef MCP_MESSAGE_H
#define MCP_MESSAGE_H

#include <cjson/cJSON.h>

#include "span.h"
#include "text.h"

#define MCP_MODERN "2026-07-28"

struct mcp_host; /* host.h */

enum mcp_code {
    MCP_NOT_JSON = -32700,
    MCP_NOT_A_REQUEST = -32600,
    MCP_NO_METHOD = -32601,
    MCP_WRONG_PARAMS = -32602,
    MCP_INTERNAL = -32603,
    MCP_HEADERS_DIFFER = -32020,
    MCP_WRONG_VERSION = -32022
};

struct mcp_message {
    cJSON *root; /* without what is in the spans below */
    const cJSON *params, *arguments, *meta;
    const char *method;
    struct mcp_span id; /* a string or an integer, as written; NULL: none */
    bool is_modern;     /* each request describes itself (2026-07-28); else after `initialize` (2025) */
    const char *name;   /* of the tool; NULL: none is given */
    /* In the text of the message. Of strings: between the quotes, as written. */
    struct mcp_span scene;        /* params.arguments.scene, an object */
    struct mcp_span base64, text; /* params.arguments.model.base64 and text, strings */
    struct {
        struct mcp_span base64, text;
    } sides[2]; /* those of a and b */
    /* A reader of the text for places in it (zr_json_at), and its members. */
    struct zr_json json;
    struct zr_arena arena;
    struct zr_error *error;
    bool has_nul; /* a string has \u0000, which would end names and paths */
};

/* Reads a message, which then stays where it is. Returns 0, or the code of an error, whose words `why` points to; a
 * cancelled request has any. The caller frees the message in every case. */
int mcp_message_read(struct mcp_message *message, struct mcp_span text, const struct mcp_host *host, const char **why);
void mcp_message_free(struct mcp_message *message);

#endif
