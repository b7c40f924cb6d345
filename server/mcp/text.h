/* text.h - mcp: a text that grows. */
#ifndef MCP_TEXT_H
#define MCP_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Starts as {0}. Without memory, `failed` is set, and the text stays as it is. */
struct mcp_text {
    char *data; /* malloc'd, with a final zero; NULL while empty */
    size_t size, room;
    bool failed;
    int more_digits; /* of places (place.h) */
};

void mcp_text_add(struct mcp_text *text, const void *bytes, size_t size);
void mcp_text_put(struct mcp_text *text, const char *words);
void mcp_text_print(struct mcp_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds up to `most` bytes of a string as a part of one line: control characters become spaces, so that a name in a
 * model's file cannot begin a line of its own. */
void mcp_text_line(struct mcp_text *text, const char *string, size_t most);

/* Adds a JSON string, with its quotes. Bytes that are no UTF-8 become '?'. */
void mcp_text_json(struct mcp_text *text, const char *string);

/* Adds bytes in base64: the standard alphabet, padded (RFC 4648, 4). */
void mcp_text_base64(struct mcp_text *text, const void *bytes, size_t size);

void mcp_text_free(struct mcp_text *text);

#endif
