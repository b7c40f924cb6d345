/* place.h - mcp: places, directions and names in words. */
#ifndef MCP_PLACE_H
#define MCP_PLACE_H

#include <cjson/cJSON.h>

#include "text.h"

/* Adds `before` and "(x, y, z)"; nothing if there is no place. Coordinates up to `zero`, or to a billionth of the
 * largest, are rounding errors, and 0. */
void mcp_place_put(struct mcp_text *text, const char *before, const cJSON *place, int digits, double zero);

/* Adds a name in quotes, as a part of one line. */
void mcp_name_put(struct mcp_text *text, const cJSON *name);

#endif
