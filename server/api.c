#include "api.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/random.h>

#include <cjson/cJSON.h>

#include "admission.h"
#include "assets.h"
#include "clock.h"
#include "problem.h"
#include "rendering.h"
#include "text.h"

enum route { ROUTE_RENDER, ROUTE_HEALTH, ROUTE_READY, ROUTE_LIMITS, ROUTE_ASSETS, ROUTE_ASSET };

static const struct {
    const char *path, *methods; /* a path that ends with a slash: and all below it */
    bool open_to_all;           /* no token is asked for */
} ROUTES[] = {
    [ROUTE_RENDER] = {"/v1/render", "POST", false}, [ROUTE_HEALTH] = {"/healthz", "GET, HEAD", true},
    [ROUTE_READY] = {"/readyz", "GET, HEAD", true}, [ROUTE_LIMITS] = {"/v1/limits", "GET, HEAD", false},
    [ROUTE_ASSETS] = {"/v1/assets", "POST", false}, [ROUTE_ASSET] = {ASSETS_PATH, "GET, HEAD, PUT", false},
};

enum { ROUTE_COUNT = sizeof ROUTES / sizeof ROUTES[0] };

static const struct {
    const char *type;
    enum zr_format format;
    bool parts; /* the scene is one part of several */
} FORMATS[] = {
    {"application/json", ZR_FORMAT_JSON, false},
    {"model/obj", ZR_FORMAT_OBJ, false},
    {"model/stl", ZR_FORMAT_STL, false},
    {"multipart/form-data", ZR_FORMAT_JSON, true},
};

#define FORMAT_NAMES "application/json, model/obj, model/stl, multipart/form-data"

static const struct {
    const char *name;
    size_t offset; /* of a const char * in zr_request */
} PARAMETERS[] = {
    {"channel", offsetof(struct zr_request, channel)}, {"encoding", offsetof(struct zr_request, encoding)},
    {"scale", offsetof(struct zr_request, scale)},     {"preset", offsetof(struct zr_request, preset)},
    {"width", offsetof(struct zr_request, width)},     {"height", offsetof(struct zr_request, height)},
    {"shading", offsetof(struct zr_request, shading)}, {"compress", offsetof(struct zr_request, compress)},
};

#define PARAMETER_NAMES "channel, encoding, scale, preset, width, height, shading, compress"

void api_init(struct api *api, const struct config *config, struct zr_team *team, struct foresight *foresight,
              struct store *store)
{
    api->config = config;
    api->store = store;
    api->foresight = foresight;
    api->limits = config_limits(config);
    api->team = team;
    if (getrandom(&api->id_base, sizeof api->id_base, 0) != sizeof api->id_base) api->id_base = (uint64_t)clock_us();
    atomic_init(&api->id_next, 0);
}

void api_request_free(struct api_request *request)
{
    free(request->query_values);
    request->query_values = NULL;
}

void api_take_id(struct api *api, struct api_request *request, const char *client_id)
{
    static const char ALLOWED[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    size_t length = client_id ? text_trimmed_length(client_id) : 0;
    if (length >= 1 && length < API_ID_SIZE && strspn(client_id, ALLOWED) == length) {
        memcpy(request->id, client_id, length); /* the rest is zero */
        return;
    }
    uint64_t number = atomic_fetch_add(&api->id_next, 1);
    snprintf(request->id, sizeof request->id, "%016" PRIx64 "-%06" PRIx64, api->id_base, number);
}

/* ---- opening: all that can be said before the body ---- */

/* The time it takes depends on what the client sent, not on where it differs. */
static bool token_matches(const char *token, const char *authorization)
{
    static const char SCHEME[] = "Bearer ";
    if (!authorization || strncasecmp(authorization, SCHEME, sizeof SCHEME - 1) != 0) return false;
    const char *given = authorization + sizeof SCHEME - 1;
    given += strspn(given, " ");
    size_t length = text_trimmed_length(given), wanted = strlen(token);
    volatile unsigned char difference = length != wanted;
    for (size_t i = 0; i < length; i++)
        difference = (unsigned char)(difference | (given[i] ^ token[wanted ? i % wanted : 0]));
    return difference == 0;
}

static bool method_allowed(const char *methods, const char *method)
{
    size_t length = strlen(method);
    for (const char *p = strstr(methods, method); p; p = strstr(p + 1, method))
        if ((p == methods || p[-1] == ' ') && (p[length] == '\0' || p[length] == ',')) return length > 0;
    return false;
}

/* "name=value&name=value" into request->render. */
static bool read_query(struct api_request *request, struct answer *answer)
{
    if (!request->query || !*request->query) return true;
    /* A decoded text is never longer, and every pair gives up its '=' or '&' for the final zeros. */
    char *values = request->query_values = malloc(2 * strlen(request->query) + 2);
    if (!values) {
        api_refuse_busy(answer, 1, "out of memory");
        return false;
    }
    for (const char *pair = request->query; *pair; pair += *pair == '&') {
        size_t length = strcspn(pair, "&"), name_length = strcspn(pair, "=&");
        const char *text = pair;
        pair += length;
        if (length == 0) continue;
        char *name = values;
        char *value = name + name_length + 1;
        size_t value_length = name_length < length ? length - name_length - 1 : 0;
        if (!text_percent_decode(name, text, name_length) ||
            !text_percent_decode(value, text + length - value_length, value_length)) {
            problem_answer(answer, 400, "query: a %%-escape is broken");
            return false;
        }
        const char **field = NULL;
        for (size_t i = 0; i < sizeof PARAMETERS / sizeof PARAMETERS[0]; i++)
            if (strcmp(PARAMETERS[i].name, name) == 0)
                field = (const char **)(void *)((char *)&request->render + PARAMETERS[i].offset);
        if (!field || *field) {
            problem_answer(answer, 400, "query: %s parameter '%.60s'; known: " PARAMETER_NAMES,
                           field ? "duplicate" : "unknown", name);
            return false;
        }
        *field = value;
        values = value + value_length + 1;
    }
    return true;
}

static bool read_content_type(struct api_request *request, struct answer *answer)
{
    const char *type = request->content_type ? request->content_type : "";
    size_t length = strcspn(type, "; \t");
    for (size_t i = 0; i < sizeof FORMATS / sizeof FORMATS[0]; i++)
        if (strlen(FORMATS[i].type) == length && strncasecmp(FORMATS[i].type, type, length) == 0) {
            const char *fault;
            request->render.format = FORMATS[i].format;
            if (!FORMATS[i].parts || multipart_boundary(type, request->boundary, &fault)) return true;
            problem_answer(answer, 400, "%s", fault);
            return false;
        }
    answer_header(answer, "Accept-Post", FORMAT_NAMES);
    if (*type)
        problem_answer(answer, 415, "Content-Type '%.80s' is none of: " FORMAT_NAMES, type);
    else
        problem_answer(answer, 415, "Content-Type is missing; supported: " FORMAT_NAMES);
    return false;
}

static bool is_encoding(const char *text, const char *known)
{
    const size_t length = strlen(known);
    return text_trimmed_length(text) == length && strncasecmp(text, known, length) == 0;
}

static bool read_content_encoding(struct api_request *request, struct answer *answer)
{
    const char *encoding = request->content_encoding;
    if (!encoding || text_trimmed_length(encoding) == 0 || is_encoding(encoding, "identity")) return true;
    request->gzip = is_encoding(encoding, "gzip") || is_encoding(encoding, "x-gzip");
    if (request->gzip) return true;
    answer_header(answer, "Accept-Encoding", "gzip, identity");
    problem_answer(answer, 415, "Content-Encoding '%.80s' is not supported; supported: gzip, identity", encoding);
    return false;
}

/* Why no work can be taken on now; NULL: one can. makes_answer: a large one, in memory. */
static const char *busy_with(const struct api *api, const struct api_load *load, bool makes_answer)
{
    if (load->draining) return "the service is going down";
    if (load->queue_full) return "the queue is full";
    if (makes_answer && load->answers_full) return "the answers that wait for their readers fill answerMemoryBytes";
    if (!admission_memory_is_short(api->config->cgroup)) return NULL;
    return "the memory of the container is nearly used up";
}

static bool open_render(struct api_request *request, struct answer *answer)
{
    return read_content_type(request, answer) && read_query(request, answer);
}

/* What is done by a worker. */
static enum api_next open_work(const struct api *api, const struct api_load *load, enum route route,
                               struct api_request *request, struct answer *answer)
{
    if (load->draining) {
        api_refuse_busy(answer, load->retry_after_s, busy_with(api, load, false));
    } else if (!read_content_encoding(request, answer)) {
        return API_ANSWERED;
    } else if (route == ROUTE_RENDER ? open_render(request, answer) : assets_open(api, request, answer)) {
        const char *busy = busy_with(api, load, route == ROUTE_RENDER);
        if (!busy) return API_WORK;
        api_refuse_busy(answer, load->retry_after_s, busy);
    }
    return API_ANSWERED;
}

static void answer_state(struct answer *answer, const char *state)
{
    char *text = NULL;
    int length = asprintf(&text, "{\"status\":\"%s\"}\n", state);
    answer->status = 200;
    answer->is_broken |= length < 0;
    if (length > 0) answer_body(answer, "application/json", text, (size_t)length);
    answer_header(answer, "Cache-Control", "no-store");
}

static void answer_limits(const struct api *api, struct answer *answer)
{
    cJSON *root = cJSON_CreateObject(), *limits = NULL;
    const bool is_whole = cJSON_AddStringToObject(root, "version", ZR_VERSION) &&
                          (limits = cJSON_AddObjectToObject(root, "limits")) && config_add_limits(api->config, limits);
    char *text = is_whole ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    answer->status = 200;
    answer->is_broken |= !text;
    if (text) answer_body(answer, "application/json", text, strlen(text));
}

static size_t find_route(const char *path)
{
    size_t route = 0;
    for (; route < ROUTE_COUNT; route++) {
        const char *known = ROUTES[route].path;
        size_t length = strlen(known);
        if (known[length - 1] == '/' ? strncmp(known, path, length) == 0 : strcmp(known, path) == 0) break;
    }
    return route;
}

enum api_next api_open(const struct api *api, const struct api_load *load, struct api_request *request,
                       struct answer *answer)
{
    size_t route = find_route(request->path);
    const char *token = api->config->token;
    if (*token && !(route < ROUTE_COUNT && ROUTES[route].open_to_all) &&
        !token_matches(token, request->authorization)) {
        answer_header(answer, "WWW-Authenticate", "Bearer realm=\"zraster\"");
        problem_answer(answer, 401, "Authorization: Bearer with the right token is asked for");
    } else if (route == ROUTE_COUNT) {
        problem_answer(answer, 404,
                       "there is no '%.100s' here; there are /v1/render, /v1/assets, /v1/limits, /healthz, /readyz",
                       request->path);
    } else if (!method_allowed(ROUTES[route].methods, request->method)) {
        answer_header(answer, "Allow", "%s", ROUTES[route].methods);
        problem_answer(answer, 405, "%s takes %s", ROUTES[route].path, ROUTES[route].methods);
    } else if (route == ROUTE_RENDER || route == ROUTE_ASSETS || route == ROUTE_ASSET) {
        return open_work(api, load, (enum route)route, request, answer);
    } else if (route == ROUTE_LIMITS) {
        answer_limits(api, answer);
    } else {
        /* Whoever asks whether we are ready will send what is large, too. */
        bool full = load->queue_full || load->large_queue_full;
        const struct api_load any = {load->draining, full, full, load->answers_full, load->retry_after_s};
        const char *busy = route == ROUTE_READY ? busy_with(api, &any, true) : NULL;
        if (busy)
            api_refuse_busy(answer, load->retry_after_s, busy);
        else
            answer_state(answer, route == ROUTE_READY ? "ready" : "ok");
    }
    return API_ANSWERED;
}

/* ---- working ---- */

enum api_next api_work(const struct api *api, const struct api_request *request, struct zr_arena *arena,
                       const struct zr_cancel *cancel, struct step_times *times, struct answer *answer)
{
    enum api_next next = API_ANSWERED;
    foresight_begin(api->foresight);
    if (request->asset)
        next = assets_work(api, request, arena, cancel, answer);
    else
        next = rendering_work(api, request, arena, cancel, times, answer);
    foresight_end(api->foresight);
    return next;
}

void api_answer_copy(struct answer *answer, const char *content_type, const void *bytes, size_t size)
{
    char *copy = malloc(size ? size : 1);
    if (!copy) {
        api_refuse_busy(answer, 1, "out of memory");
        return;
    }
    memcpy(copy, bytes, size);
    answer->status = 200;
    answer_body(answer, content_type, copy, size);
}

void api_refuse_memory(struct answer *answer, const struct zr_arena *arena)
{
    if (arena->wanted == 0)
        api_refuse_busy(answer, 1, "the system has no memory for the request now");
    else if (arena->wanted == SIZE_MAX)
        problem_answer(answer, 422, "the request needs more memory than can be had; requestMemoryBytes is %zu bytes",
                       arena->ceiling);
    else
        problem_answer(answer, 422,
                       "the request needs at least %zu bytes of memory; requestMemoryBytes, for one, is %zu bytes",
                       arena->wanted, arena->ceiling);
}

void api_refuse_late(const struct api *api, struct answer *answer)
{
    problem_answer(answer, 504, "the work took longer than renderTimeoutMs, %" PRIu64 " ms",
                   api->config->render_timeout_ms);
}

void api_refuse_busy(struct answer *answer, unsigned retry_after_s, const char *detail)
{
    answer_header(answer, "Retry-After", "%u", retry_after_s ? retry_after_s : 1);
    problem_answer(answer, 503, "%s", detail);
}

void api_finish(struct answer *answer, const char *request_id)
{
    answer_header(answer, "X-Request-Id", "%s", request_id);
    answer_header(answer, "Zraster-Version", ZR_VERSION);
}
