/* mcp_files.h - client: the files that an agent's scene refers to. Only regular files below the root are read, after
 * all links are resolved. */
#ifndef MCP_FILES_H
#define MCP_FILES_H

#include "files/input.h"
#include "mcp/faults.h"

/* Makes the scene the body of the input, and adds the model and all files that they refer to as parts. `root`: a real
 * path. False: there are faults, or memory is exhausted. The caller calls mcp_files_free in both cases. */
bool mcp_files_read(struct input *input, const char *root, const struct mcp_draw *draw, struct mcp_faults *faults);
void mcp_files_free(struct input *input, const struct mcp_draw *draw);

#endif
