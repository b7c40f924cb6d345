/* meshes.h - mcp: meshes of a given scene that are the model of the call. */
#ifndef MCP_MESHES_H
#define MCP_MESHES_H

#include "span.h"

/* Goes to the next mesh {"asset": "model"} of a list of meshes, which is the next value of `json`. `name`: the string "model"
 * with its quotes. False: there are no more. */
bool mcp_meshes_next(struct zr_json *json, struct mcp_span *name);

#endif
