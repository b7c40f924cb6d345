/* comparing.h - comparisons of two models for other routes than /v1/compare. */
#ifndef ZRASTERD_COMPARING_H
#define ZRASTERD_COMPARING_H

#include "mcp/host.h"
#include "request.h"

/* Compares for an agent. Results and faults are as host->compare has them; they live in the arena of the work. */
enum mcp_draw_status comparing_for_agent(const struct work *work, const struct mcp_compare *compare,
                                         struct mcp_compared *compared);

#endif
