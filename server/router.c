#include "router.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "gate/admit.h"
#include "gate/origin.h"
#include "problem.h"
#include "routes/routes.h"
#include "text.h"

static const struct route ROUTES[] = {
    {"/v1/render", "POST", false, rendering_open, rendering_work, true, false, false},
    {"/v1/assets", "POST", false, assets_open, assets_work, false, false, false},
    {"/", "GET, HEAD", true, site_open, NULL, false, false, false},
    {"/docs", "GET, HEAD", true, manual_open, NULL, false, false, false},
    {MANUAL_PATH, "GET, HEAD", true, manual_open, NULL, false, false, false},
    {ENGINE_PATH, "GET, HEAD", true, engine_open, NULL, false, false, false},
    {"/v1/examples", "GET, HEAD", false, examples_open, NULL, false, false, false},
    {EXAMPLES_PATH, "GET, HEAD", false, examples_open, NULL, false, false, false},
    {"/v1/looks", "GET, HEAD", false, looks_open, NULL, false, false, false},
    {"/v1/limits", "GET, HEAD", false, limits_open, NULL, false, false, false},
    {AGENTS_PATH, "POST", false, agents_open, agents_work, true, false, false},
    {OPENAPI_PATH, "GET, HEAD", false, contract_open_openapi, NULL, false, false, false},
    {SCENE_SCHEMA_PATH, "GET, HEAD", false, contract_open_schema, NULL, false, false, false},
    {SCHEMA_PATH, "GET, HEAD", false, contract_open_schema, NULL, false, false, false},
    {COMPARE_PATH, "POST", false, comparing_open, comparing_work, true, false, false},
    {DRAWING_PATH, "POST", false, drawing_open, drawing_work, true, false, false},
    {DRAKE_PATH, "POST", false, drake_open, drake_work, true, true, false},
    {"/healthz", "GET, HEAD", true, health_open, NULL, false, false, false},
    {"/metrics", "GET, HEAD", true, metrics_open, NULL, false, false, false},
    {"/readyz", "GET, HEAD", true, health_open_ready, NULL, false, false, false},
    {ASSETS_PATH, "GET, HEAD, PUT", false, assets_open, assets_work, false, false, false},
    {SCENES_PATH, "GET, HEAD, PUT", false, assets_open, assets_work, false, false, false},
    {RENDERS_PATH, "GET, HEAD", false, renders_open, renders_work, true, false, true},
};

enum { ROUTE_COUNT = sizeof ROUTES / sizeof ROUTES[0] };

static bool is_for_all_below(const struct route *route)
{
    const size_t length = strlen(route->path);
    return length > 1 && route->path[length - 1] == '/';
}

static const struct route *find_route(const char *path)
{
    for (const struct route *route = ROUTES; route < ROUTES + ROUTE_COUNT; route++)
        if (is_for_all_below(route) ? strncmp(route->path, path, strlen(route->path)) == 0
                                    : strcmp(route->path, path) == 0)
            return route;
    return NULL;
}

/* Returns true if a path "/v1/assets/" is listed as "/v1/assets". */
static bool is_listed_without_slash(const struct route *route)
{
    char path[64];
    snprintf(path, sizeof path, "%.*s", (int)strlen(route->path) - 1, route->path);
    return is_for_all_below(route) && find_route(path);
}

static void refuse_path(const struct request *request, struct answer *answer)
{
    char known[ANSWER_DETAIL_SIZE] = "";
    size_t used = 0;
    for (const struct route *route = ROUTES; route < ROUTES + ROUTE_COUNT; route++)
        if (!is_listed_without_slash(route) && used < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", route->path);
    problem_answer(answer, 404, "there is no '%.100s' here; there are %s", request->path, known);
}

static bool method_allowed(const char *methods, const char *method)
{
    size_t length = strlen(method);
    for (const char *p = strstr(methods, method); p; p = strstr(p + 1, method))
        if ((p == methods || p[-1] == ' ') && (p[length] == '\0' || p[length] == ',')) return length > 0;
    return false;
}

static bool is_encoding(const char *text, const char *known)
{
    const size_t length = strlen(known);
    return text_trimmed_length(text) == length && strncasecmp(text, known, length) == 0;
}

static bool read_content_encoding(struct request *request, struct answer *answer)
{
    const char *encoding = request->content_encoding;
    if (!encoding || text_trimmed_length(encoding) == 0 || is_encoding(encoding, "identity")) return true;
    request->gzip = is_encoding(encoding, "gzip") || is_encoding(encoding, "x-gzip");
    if (request->gzip) return true;
    answer_header(answer, "Accept-Encoding", "gzip, identity");
    problem_answer(answer, 415, "Content-Encoding '%.80s' is not supported; supported: gzip, identity", encoding);
    return false;
}

/* Opens a request for a worker. */
static enum request_next open_work(const struct service *service, struct request *request, struct answer *answer)
{
    const struct load *load = &request->load;
    if (load->draining) {
        problem_busy(answer, load->retry_after_s, load_busy_with(load, service, false));
        return REQUEST_ANSWERED;
    }
    if (!read_content_encoding(request, answer) || !request->route->open(service, request, answer))
        return REQUEST_ANSWERED;
    const enum refusal busy = load_busy_with(load, service, request->route->makes_answer);
    if (!busy) return REQUEST_WORK;
    problem_busy(answer, load->retry_after_s, busy);
    return REQUEST_ANSWERED;
}

/* Answers OPTIONS of a path or of the daemon (*), without a token: preflights have none. */
static bool answer_options(const struct request *request, struct answer *answer)
{
    const bool is_for_all = strcmp(request->path, "*") == 0;
    if (strcmp(request->method, "OPTIONS") != 0 || !(request->route || is_for_all)) return false;
    answer->status = 204;
    answer_header(answer, "Allow", "%s, OPTIONS", is_for_all ? "GET, HEAD, POST, PUT" : request->route->methods);
    return true;
}

enum request_next router_open(const struct service *service, struct request *request, struct answer *answer)
{
    const struct route *route = request->route = find_route(request->path);
    answer->is_plain = route && route->has_plain_errors;
    if (answer_options(request, answer) || !origin_check(service->config, request, answer)) return REQUEST_ANSWERED;
    if (!admit(service, request, answer)) return REQUEST_ANSWERED;
    if (!route) {
        refuse_path(request, answer);
    } else if (!method_allowed(route->methods, request->method)) {
        answer_header(answer, "Allow", "%s, OPTIONS", route->methods);
        problem_answer(answer, 405, "%s takes %s", route->path, route->methods);
    } else if (route->work) {
        return open_work(service, request, answer);
    } else {
        route->open(service, request, answer);
    }
    return REQUEST_ANSWERED;
}

/* An SVG that is opened as a document runs nothing and loads nothing; its paper is a style. */
#define POLICY "default-src 'none'; style-src 'unsafe-inline'; sandbox"

static void add_missing(struct answer *answer, const char *name, const char *value)
{
    if (!answer_find(answer, name)) answer_header(answer, name, "%s", value);
}

/* Adds headers that let browsers only show an answer, and that keep faults out of caches. Pages have policies of their
 * own. Pictures and assets have Cross-Origin-Resource-Policy: cross-origin, since pages of other sites may show them. */
static void add_safety(struct answer *answer)
{
    add_missing(answer, "X-Content-Type-Options", "nosniff");
    add_missing(answer, "Content-Security-Policy", POLICY);
    add_missing(answer, "Cross-Origin-Resource-Policy", "same-origin");
    add_missing(answer, "Referrer-Policy", "no-referrer");
    if (answer->status >= 400) add_missing(answer, "Cache-Control", "no-store");
}

void router_finish(struct answer *answer, const struct service *service, const struct request *request)
{
    origin_finish(service->config, request, answer);
    add_safety(answer);
    answer_header(answer, "X-Request-Id", "%s", request->id);
    if (*request->trace.id) answer_header(answer, "traceresponse", "%s", request->trace.answer);
    answer_header(answer, "Zraster-Version", ZR_VERSION);
}
