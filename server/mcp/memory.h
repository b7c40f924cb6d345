/* memory.h - mcp: allocations of trees of JSON (cJSON), whose failures are noted for each thread: a tree without memory
 * lacks members in silence. */
#ifndef MCP_MEMORY_H
#define MCP_MEMORY_H

#include <stdbool.h>

/* Notes failures from now on. Call it once, before there are threads. */
void mcp_memory_watch(void);

/* Forgets the failures of this thread. */
void mcp_memory_clear(void);

/* Returns true if an allocation of this thread has failed since. */
bool mcp_memory_has_failed(void);

#endif
