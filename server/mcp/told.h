/* told.h - mcp: the result of a tool for which the host tells numbers and a picture (host.h). */
#ifndef MCP_TOLD_H
#define MCP_TOLD_H

#include "host.h"
#include "text.h"

/* Adds the members of the result: one line, which begins with the name unless it is NULL, holes, regions and warnings;
 * then the picture, as a text if it is an SVG; then all numbers. */
void mcp_told_put(const struct mcp_told *told, const char *name, bool is_svg, struct mcp_text *result);

#endif
