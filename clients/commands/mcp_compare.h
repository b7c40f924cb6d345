/* mcp_compare.h - client: compares two models for an agent. */
#ifndef MCP_COMPARE_HERE_H
#define MCP_COMPARE_HERE_H

#include "engine/engine.h"
#include "mcp/host.h"

/* Reads both models below the root, compares and draws. The caller calls mcp_compare_release after MCP_DRAWN. */
enum mcp_draw_status mcp_compare_here(const struct engine *engine, const char *root, const struct mcp_compare *compare,
                                      struct mcp_compared *compared);
void mcp_compare_release(struct mcp_compared *compared);

/* Takes the faults of the library. */
void mcp_compare_faults(const zraster_error *error, struct mcp_faults *faults);

#endif
