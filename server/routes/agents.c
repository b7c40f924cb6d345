#include "routes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cjson/cJSON.h>

#include "body.h"
#include "for_agents.h"
#include "gate/origin.h"
#include "mcp/faults.h"
#include "problem.h"
#include "render_request.h"
#include "rendering.h"
#include "text.h"

/* ---- opening ---- */

/* Returns true for an origin of this machine. A page of another one can have the daemon's name by DNS rebinding. */
static bool is_local(const char *origin)
{
    static const char *const hosts[] = {"localhost", "127.0.0.1", "[::1]"};
    const char *host = strstr(origin, "://");
    for (size_t i = 0; host && i < sizeof hosts / sizeof *hosts; i++) {
        const size_t length = strlen(hosts[i]);
        if (strncasecmp(host + 3, hosts[i], length) == 0 && strchr(":", host[3 + length])) return true;
    }
    return false;
}

static bool is_json(const char *type)
{
    static const char wanted[] = "application/json";
    const size_t length = type ? strcspn(type, "; \t") : 0;
    return length == sizeof wanted - 1 && strncasecmp(type, wanted, length) == 0;
}

bool agents_open(const struct service *service, struct request *request, struct answer *answer)
{
    if (request->origin && !is_local(request->origin) && !origin_is_allowed(service->config, request))
        problem_answer(answer, 403,
                       "pages of '%.100s' may not call " AGENTS_PATH
                       "; start zrasterd with --allow-origin to allow them, as pages of localhost are",
                       request->origin);
    else if (!is_json(request->content_type))
        problem_answer(answer, 415, AGENTS_PATH " takes messages of the Content-Type application/json");
    else
        return true;
    return false;
}

/* ---- the host of the handler ---- */

static void *allocate(void *context, size_t size)
{
    const struct work *work = context;
    return zr_arena_alloc(work->arena, size, 1);
}

/* The scene is unpacked already. */
static enum body_status unpack(const struct work *work, struct zr_request *render)
{
    *render = *work->request->render;
    return BODY_READY;
}

/* Reads the faults of a problem (problem.h). */
static void read_faults(const struct answer *answer, struct mcp_faults *faults)
{
    cJSON *problem = answer->bytes ? cJSON_ParseWithLength(answer->bytes, answer->size) : NULL;
    const cJSON *error;
    cJSON_ArrayForEach(error, cJSON_GetObjectItemCaseSensitive(problem, "errors"))
    {
        const cJSON *pointer = cJSON_GetObjectItemCaseSensitive(error, "pointer"),
                    *detail = cJSON_GetObjectItemCaseSensitive(error, "detail");
        if (cJSON_IsString(pointer) && cJSON_IsString(detail))
            mcp_fault(faults, pointer->valuestring, "%s", detail->valuestring);
    }
    if (faults->count == 0) mcp_fault(faults, "", "%s", *answer->detail ? answer->detail : "out of memory");
    cJSON_Delete(problem);
}

static bool is_zip(const struct answer *answer)
{
    const char *type = answer_find(answer, "Content-Type");
    return type && strcmp(type, "application/zip") == 0;
}

static enum mcp_draw_status draw(void *context, const struct mcp_draw *draw, struct mcp_drawn *drawn)
{
    static const struct rendering_kind kind = {unpack, NULL, NULL, true};
    struct work work = *(const struct work *)context;
    const struct zr_asset file = {.name = draw->file_name, .bytes = draw->file, .size = draw->file_size};
    struct zr_request scene = {.format = ZR_FORMAT_JSON,
                               .bytes = draw->scene,
                               .size = draw->scene_size,
                               .assets = &file,
                               .asset_count = draw->file_name ? 1 : 0};
    struct request request = *work.request;
    struct answer *made = calloc(1, sizeof *made);
    if (!made) {
        mcp_fault(&drawn->faults, "", "out of memory");
        return MCP_REFUSED;
    }
    request.stream = NULL;
    request.parts = ACCEPT_NO_PARTS;
    request.render = &scene;
    work.request = &request;
    work.answer = made;
    const enum request_next next = rendering_run(&kind, &work);
    if (next != REQUEST_LARGE && made->status == 200 && made->bytes && !made->is_broken) {
        drawn->bytes = made->bytes;
        drawn->size = made->size;
        drawn->is_zip = is_zip(made);
        drawn->owner = made;
        return MCP_DRAWN;
    }
    if (next != REQUEST_LARGE) read_faults(made, &drawn->faults);
    answer_free(made);
    free(made);
    return next == REQUEST_LARGE ? MCP_LATER : MCP_REFUSED;
}

static void release(void *context, struct mcp_drawn *drawn)
{
    (void)context;
    answer_free(drawn->owner);
    free(drawn->owner);
}

static enum mcp_draw_status compare(void *context, const struct mcp_compare *compare, struct mcp_told *told)
{
    return comparing_for_agent(context, compare, told);
}

static enum mcp_draw_status drawing(void *context, const struct mcp_draw *draw, const char *query,
                                    struct mcp_told *told)
{
    return drawing_for_agent(context, draw, query, told);
}

/* All is in the arena. */
static void release_told(void *context, struct mcp_told *told)
{
    (void)context, (void)told;
}

/* ---- working ---- */

static enum request_next answer_message(const struct work *work, const struct zr_request *body)
{
    struct answer *answer = work->answer;
    struct work copy = *work;
    const struct mcp_host host = {.context = &copy,
                                  .version = ZR_VERSION,
                                  .cancel = work->reading,
                                  .allocate = allocate,
                                  .draw = draw,
                                  .release = release,
                                  .compare = compare,
                                  .drawing = drawing,
                                  .release_told = release_told};
    const struct mcp_span message = {body->bytes, body->bytes + body->size};
    struct mcp_reply reply;
    switch (mcp_handle(&host, message, &work->request->mcp, &reply)) {
    case MCP_LATER:
        return REQUEST_LARGE;
    case MCP_CANCELLED:
        return body_next(work, BODY_CANCELLED);
    default:
        break;
    }
    answer->status = reply.http_status;
    if (reply.text.size > 0)
        answer_body(answer, "application/json", reply.text.data, reply.text.size);
    else
        mcp_text_free(&reply.text);
    return REQUEST_ANSWERED;
}

enum request_next agents_work(const struct work *work)
{
    struct zr_request body;
    const enum request_next next = body_next(work, body_unpack(work, &body));
    return next == REQUEST_WORK ? answer_message(work, &body) : next;
}
