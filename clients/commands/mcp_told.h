/* mcp_told.h - client: numbers of models, each with a picture, for an agent. */
#ifndef MCP_TOLD_H
#define MCP_TOLD_H

#include "engine/engine.h"
#include "mcp/host.h"

/* Read models below the root, and compare them or make a technical drawing, as the host's functions of these names do.
 * The caller calls mcp_told_release after MCP_DRAWN. */
enum mcp_draw_status mcp_told_compare(const struct engine *engine, const char *root, const struct mcp_compare *compare,
                                      struct mcp_told *told);
enum mcp_draw_status mcp_told_drawing(const struct engine *engine, const char *root, const struct mcp_draw *draw,
                                      const char *query, struct mcp_told *told);
void mcp_told_release(struct mcp_told *told);

/* Takes the faults of the library. */
void mcp_told_faults(const zraster_error *error, struct mcp_faults *faults);

#endif
