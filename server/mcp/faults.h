/* faults.h - mcp: lists of what a caller can mend. */
#ifndef MCP_FAULTS_H
#define MCP_FAULTS_H

#include "host.h"

/* Adds a fault, unless there are too many. Long texts are cut. Returns false, for use as `return mcp_fault(...)`. */
bool mcp_fault(struct mcp_faults *faults, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds that a word is none of a list, which ends with NULL, and the nearest of them. */
bool mcp_fault_unknown(struct mcp_faults *faults, const char *pointer, const char *what, const char *word,
                       const char *const *known);

#endif
