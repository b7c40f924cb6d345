/* meshes.h - mcp: meshes of a given scene that are the model of the call. */
#ifndef MCP_MESHES_H
#define MCP_MESHES_H

#include "walk.h"

/* Goes to the next mesh {"asset": "model"} of a list of meshes, which `walk` was opened on. `name`: the string "model"
 * with its quotes. False: there are no more. */
bool mcp_meshes_next(struct mcp_walk *walk, struct mcp_span *name);

#endif
