/* place.h - mcp: places, directions and names in words. */
#ifndef MCP_PLACE_H
#define MCP_PLACE_H

#include <cjson/cJSON.h>

#include "text.h"

enum { MCP_DIRECTION_DIGITS = 4, MCP_PLACE_DIGITS = 6 };

/* Gives places of the text more digits if the box is farther from the origin than it is large. */
void mcp_place_set_digits(struct mcp_text *text, const cJSON *box);

/* Adds `before` and "(x, y, z)"; nothing if there is no place. Coordinates up to `zero`, or to a billionth of the
 * largest, are rounding errors, and 0. `digits`: as above. */
void mcp_place_put(struct mcp_text *text, const char *before, const cJSON *place, int digits, double zero);

/* Adds a name in quotes, as a part of one line. */
void mcp_name_put(struct mcp_text *text, const cJSON *name);

#endif
