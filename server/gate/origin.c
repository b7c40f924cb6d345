#include "origin.h"

#include <string.h>
#include <strings.h>

#include "problem.h"
#include "text.h"

#define EXPOSED                                                                                                        \
    "Content-Disposition, ETag, Location, Retry-After, Server-Timing, traceresponse, WWW-Authenticate, X-Request-Id, " \
    "Zraster-Encoder, Zraster-Look, Zraster-Version, Zraster-Warnings"
#define TAKEN                                                                                                          \
    "Authorization, Content-Encoding, Content-Type, If-None-Match, MCP-Protocol-Version, Mcp-Method, Mcp-Name, "       \
    "X-Request-Id, traceparent, tracestate"

static bool is_text(const char *value, const char *text)
{
    return value && text_trimmed_length(value) == strlen(text) && strncasecmp(value, text, strlen(text)) == 0;
}

static bool allows_all(const struct config *config)
{
    return text_has_item(config->allow_origin, "*", 1);
}

static bool is_read_only(const char *method)
{
    return strcmp(method, "GET") == 0 || strcmp(method, "HEAD") == 0 || strcmp(method, "OPTIONS") == 0;
}

bool origin_is_allowed(const struct config *config, const struct request *request)
{
    return request->origin && (allows_all(config) || text_has_item(config->allow_origin, request->origin,
                                                                   text_trimmed_length(request->origin)));
}

bool origin_check(const struct config *config, const struct request *request, struct answer *answer)
{
    const char *site = request->fetch_site;
    if (!(is_text(site, "cross-site") || is_text(site, "same-site"))) return true;
    if (is_read_only(request->method) || origin_is_allowed(config, request)) return true;
    problem_answer(
        answer, 403,
        "a page of another origin, %.100s, sent this request; to allow it, start zrasterd with --allow-origin",
        request->origin ? request->origin : "unnamed");
    return false;
}

/* Returns true for the question that a browser asks before a request of a page of another origin. */
static bool is_preflight(const struct request *request)
{
    return request->method && strcmp(request->method, "OPTIONS") == 0 && request->route && request->asked_method;
}

/* Access-Control-Allow-Private-Network is not sent: no browser asks for it any more (Local Network Access asks the
 * person). */
void origin_finish(const struct config *config, const struct request *request, struct answer *answer)
{
    if (!*config->allow_origin) return;
    const bool is_any = allows_all(config);
    if (!is_any) answer_vary(answer, "Origin");
    if (!is_any && !origin_is_allowed(config, request)) return;
    answer_header(answer, "Access-Control-Allow-Origin", "%s", is_any ? "*" : request->origin);
    answer_header(answer, "Access-Control-Expose-Headers", EXPOSED);
    if (!is_preflight(request)) return;
    answer_header(answer, "Access-Control-Allow-Methods", "%s", request->route->methods);
    answer_header(answer, "Access-Control-Allow-Headers", TAKEN);
    answer_header(answer, "Access-Control-Max-Age", "7200");
}
