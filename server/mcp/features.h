/* features.h - mcp: the features of a part in words: holes, flat faces, symmetry, least wall and others. */
#ifndef MCP_FEATURES_H
#define MCP_FEATURES_H

#include <cjson/cJSON.h>

#include "text.h"

/* Writes the lines of a part of the channel info. Each begins with a line feed and two spaces. */
void mcp_features_describe(struct mcp_text *text, const cJSON *part);

/* Writes the steps of a hole: ", step of diameter 8, 2 deep". */
void mcp_features_describe_steps(struct mcp_text *text, const cJSON *steps);

#endif
