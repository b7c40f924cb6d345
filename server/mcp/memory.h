/* memory.h - mcp: failed allocations of JSON trees (cJSON), recorded per thread. Without memory, cJSON omits members
 * and reports nothing. */
#ifndef MCP_MEMORY_H
#define MCP_MEMORY_H

#include <stdbool.h>

/* Records failures from now on. Call it once, before there are threads. */
void mcp_memory_watch(void);

/* Clears the failures of this thread. */
void mcp_memory_clear(void);

/* Returns true if an allocation of this thread has failed since they were cleared. */
bool mcp_memory_has_failed(void);

#endif
