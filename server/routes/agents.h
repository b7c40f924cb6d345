/* agents.h - POST /mcp: the tools of the Model Context Protocol (mcp/handler.h), whose pictures are those of
 * /v1/render. */
#ifndef ZRASTERD_AGENTS_H
#define ZRASTERD_AGENTS_H

#include "request.h"

#define AGENTS_PATH "/mcp"

/* Checks type and origin. */
bool agents_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);
enum request_next agents_work(const struct work *work);

#endif
