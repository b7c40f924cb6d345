/* given.h - mcp: keys of a given scene that the answer of a tool cannot follow. */
#ifndef MCP_GIVEN_H
#define MCP_GIVEN_H

#include "job.h"

/* Checks `outputs`, `visibility`, `render`, `sheet` and `meshes`. Counts the meshes that are the model. Adds faults,
 * each with what to do instead. A picture's encoding becomes the format of the job, unless the arguments have one.
 * False: the job has faults. */
bool mcp_given_check(struct mcp_job *job);

#endif
