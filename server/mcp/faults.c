#include "faults.h"

#include <stdarg.h>
#include <stdio.h>

#include "near.h"

bool mcp_fault(struct mcp_faults *faults, const char *pointer, const char *format, ...)
{
    if (faults->count == MCP_FAULTS_MAX) return false;
    struct mcp_fault *fault = &faults->at[faults->count++];
    va_list arguments;
    va_start(arguments, format);
    snprintf(fault->pointer, sizeof fault->pointer, "%s", pointer);
    vsnprintf(fault->detail, sizeof fault->detail, format, arguments);
    va_end(arguments);
    return false;
}

bool mcp_fault_unknown(struct mcp_faults *faults, const char *pointer, const char *what, const char *word,
                       const struct mcp_words *known)
{
    struct near_word near = {.word = word};
    char list[MCP_DETAIL_SIZE / 2] = "";
    size_t used = 0;
    for (size_t i = 0; known->at[i]; i++) {
        near_offer(&near, known->at[i]);
        if (used < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", known->at[i]);
    }
    return mcp_fault(faults, pointer, "%s '%.80s' is unknown%s%s%s; allowed: %s", what, word,
                     near.best ? " (did you mean " : "", near.best ? near.best : "", near.best ? "?)" : "", list);
}
