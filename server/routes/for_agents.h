/* for_agents.h - work of other routes for the tools of agents: results and faults are as the functions of mcp_host have
 * them, and live in the arena of the work. */
#ifndef ZRASTERD_FOR_AGENTS_H
#define ZRASTERD_FOR_AGENTS_H

#include "base/run.h"
#include "mcp/host.h"
#include "request.h"
#include "scene/scene.h"

/* Reads the scene of a tool. */
enum zr_status for_agent_read(const struct work *work, const struct zr_run *run, const struct mcp_draw *draw,
                              const struct zr_scene **scene);

/* Moves the faults of a failed run to those of a tool. Returns MCP_REFUSED, or MCP_CANCELLED. */
enum mcp_draw_status for_agent_refuse(const struct zr_run *run, enum zr_status status, struct mcp_faults *faults);

enum mcp_draw_status comparing_for_agent(const struct work *work, const struct mcp_compare *compare,
                                         struct mcp_told *told);
enum mcp_draw_status drawing_for_agent(const struct work *work, const struct mcp_draw *draw, const char *query,
                                       struct mcp_told *told);

#endif
