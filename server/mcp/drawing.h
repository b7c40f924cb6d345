/* drawing.h - mcp: the tool drawing. */
#ifndef MCP_DRAWING_H
#define MCP_DRAWING_H

#include "job.h"
#include "text.h"

/* Makes a technical drawing of the job's model, and adds the members of the result. MCP_REFUSED: the job has the
 * faults, or there is no memory. */
enum mcp_draw_status mcp_drawing_call(struct mcp_job *job, struct mcp_text *result);

#endif
