/* faults.h - mcp: lists of faults. */
#ifndef MCP_FAULTS_H
#define MCP_FAULTS_H

#include "host.h"

/* Adds a fault, unless there are too many. Long texts are cut. Returns false, for use as `return mcp_fault(...)`. */
bool mcp_fault(struct mcp_faults *faults, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Words that are allowed; the last one is NULL. */
enum { MCP_WORDS_MAX = 24 };
struct mcp_words {
    const char *at[MCP_WORDS_MAX];
};

/* Adds the fault of a word that is not in a list: names the nearest word and all of them. */
bool mcp_fault_unknown(struct mcp_faults *faults, const char *pointer, const char *what, const char *word,
                       const struct mcp_words *known);

#endif
