/* picked.h - mcp: picks of pixels and distances of parts, in words. */
#ifndef MCP_PICKED_H
#define MCP_PICKED_H

#include <cjson/cJSON.h>

#include "text.h"

/* Writes a line per item of `distances`, `picks` and `between` of the channel info. */
void mcp_picked_describe(struct mcp_text *text, const cJSON *info);

/* Writes the feature and the normal of a pick. */
void mcp_picked_describe_surface(struct mcp_text *text, const cJSON *pick);

/* Writes distance, offset and angle between two picks. */
void mcp_picked_describe_between(struct mcp_text *text, const cJSON *between);

#endif
