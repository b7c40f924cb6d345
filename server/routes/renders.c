#include "routes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gate/admit.h"
#include "gate/gate.h"
#include "input/query/query_text.h"
#include "keep/answers.h"
#include "problem.h"
#include "render_key.h"
#include "render_request.h"
#include "rendering.h"
#include "text.h"

/* Times for which caches need not ask again. */
enum { FIXED_S = 31536000, CHANGING_S = 300 };

/* ---- headers ---- */

struct tag {
    char text[2 * sizeof(struct zr_file_hash) + 3];
};

static struct tag tag_of(const struct zr_file_hash *key)
{
    struct tag tag;
    char *at = tag.text;
    *at++ = '"';
    for (size_t i = 0; i < sizeof key->bytes; i++)
        at += sprintf(at, "%02x", key->bytes[i]);
    strcpy(at, "\"");
    return tag;
}

static void add_headers(const struct request *request, bool is_pinned, struct answer *answer)
{
    answer_header(answer, "ETag", "%s", tag_of(&request->answer_key).text);
    const bool is_fixed = !request->has_preset && (is_pinned || request->is_pinned);
    admit_caching(request, is_fixed ? FIXED_S : CHANGING_S, is_fixed, answer);
    answer_header(answer, "Accept-Ranges", "none");
    answer_header(answer, "Cross-Origin-Resource-Policy", "cross-origin"); /* pages of other sites show pictures */
}

static void answer_unchanged(const struct service *service, const struct request *request, struct answer *answer)
{
    bool is_pinned = false;
    answer->status = 304;
    answer->is_unsized = !sizes_find(service->sizes, &request->answer_key, &answer->size, &is_pinned);
    add_headers(request, is_pinned, answer);
}

/* ---- opening ---- */

/* Returns true if the query has a parameter of this name, in plain letters. */
static bool query_has(const char *query, const char *name)
{
    const size_t length = strlen(name);
    for (const char *pair = query; *pair; pair += *pair == '&') {
        if (strncmp(pair, name, length) == 0 && strchr("=&", pair[length])) return true;
        pair += strcspn(pair, "&");
    }
    return false;
}

/* Reads SHA-256 and the name of a preset from the path. *preset is NULL if there is none. */
static bool read_path(struct request *request, const char **preset, struct answer *answer)
{
    const char *name = request->path + sizeof RENDERS_PATH - 1, *slash = strchr(name, '/');
    const size_t length = slash ? (size_t)(slash - name) : strlen(name);
    *preset = slash ? slash + 1 : NULL;
    if (length < STORE_NAME_SIZE) memcpy(request->scene, name, length); /* the rest is zero */
    if (store_is_name(request->scene)) return true;
    problem_answer(answer, 404,
                   "an address is /v1/renders/{sha256}: the SHA-256 of a scene or model, 64 lower-case hexadecimal "
                   "digits");
    return false;
}

/* Returns the parameters of a preset, "" without one. NULL: the answer is ready. */
static const char *find_preset(const struct gate *gate, const char *name, const char *query, struct answer *answer)
{
    const char *parameters = name ? gate_preset(gate, name) : "";
    const bool is_forbidden = gate_has_only_presets(gate) && (!name || (query && *query));
    if (parameters && !is_forbidden) return parameters;
    char known[ANSWER_DETAIL_SIZE];
    gate_list_presets(gate, known, sizeof known);
    if (is_forbidden)
        problem_answer(answer, 403,
                       "this daemon draws addresses with a preset and without parameters: " RENDERS_PATH
                       "{sha256}/PRESET; there are: %s",
                       known);
    else
        problem_answer(answer, 404, "there is no preset '%.64s'%s%s", name,
                       *known ? "; there are: " : "; zrasterd has them with --presets=FILE", known);
    return NULL;
}

/* Reads "name=value&name=value" into a new request->render. */
static bool read_parameters(struct request *request, const char *preset, struct answer *answer)
{
    const char *query = request->query ? request->query : "";
    struct zr_error error = {0};
    if (query_has(query, "url")) {
        problem_answer(answer, 400,
                       "query: the daemon fetches no files: upload the file by PUT /v1/scenes/{sha256}, and ask for "
                       "/v1/renders/{sha256}");
        return false;
    }
    char *values = rendering_begin(request, zr_query_room(preset) + zr_query_room(query), answer);
    if (!values) return false;
    if (zr_query_split(preset, values, request->render, &error) == ZR_OK &&
        zr_query_split(query, values + zr_query_room(preset), request->render, &error) == ZR_OK)
        return true;
    problem_answer(answer, 400, "query: %s", error.items[0].detail);
    return false;
}

/* Answers with the kept answer, which may outlive its scene. */
static bool answer_kept(const struct service *service, const struct request *request, struct answer *answer)
{
    bool is_pinned;
    if (!answers_find(service->kept[KEPT_ANSWERS], &request->answer_key, answer, &is_pinned)) return false;
    if (request->has_answer) {
        answer_free(answer);
        answer_unchanged(service, request, answer);
        return true;
    }
    add_headers(request, is_pinned, answer);
    if (strcmp(request->method, "HEAD") == 0) answer_drop_bytes(answer);
    return true;
}

bool renders_open(const struct service *service, struct request *request, struct answer *answer)
{
    const char *preset;
    if (!service->store) {
        problem_answer(answer, 404, "no scenes are kept here; start zrasterd with --assets-dir=DIRECTORY for that");
        return false;
    }
    if (!read_path(request, &preset, answer)) return false;
    const char *parameters = find_preset(service->gate, preset, request->query, answer);
    if (!parameters || !read_parameters(request, parameters, answer)) return false;
    request->parts = ACCEPT_NO_PARTS; /* an address has one form */
    request->has_preset = preset;
    request->is_pinned = request->render->look && strchr(request->render->look, '@');
    if (!render_key(request->scene, request->render, &service->limits, &request->answer_key)) {
        problem_busy(answer, 1, REFUSAL_MEMORY);
        return false;
    }
    request->is_shareable = true;
    request->has_answer = text_has_tag(request->if_none_match, tag_of(&request->answer_key).text);
    return !answer_kept(service, request, answer);
}

/* ---- working ---- */

static void answer_missing(struct answer *answer)
{
    problem_answer(answer, 404, "no scene is kept under this name; upload it by PUT /v1/scenes/{sha256}");
}

/* Reads the stored file. */
static enum body_status unpack(const struct work *work, struct zr_request *render)
{
    const struct request *request = work->request;
    const uint64_t most = work->service->config->body_max_bytes;
    struct store *store = work->service->store;
    struct answer *answer = work->answer;
    const void *bytes = NULL;
    *render = *request->render;
    enum store_status status = store_look(store, request->scene, &render->size);
    if (status == STORE_THERE && request->small_only && render->size > REQUEST_SMALL_BYTES) return BODY_LARGE;
    if (status == STORE_THERE && render->size > most) {
        problem_answer(answer, 413, "the scene has %zu bytes; bodyMaxBytes is %" PRIu64, render->size, most);
        return BODY_REFUSED;
    }
    if (status == STORE_THERE) status = store_read(store, request->scene, work->arena, &bytes, &render->size);
    render->bytes = bytes;
    if (status == STORE_THERE) return zr_is_cancelled(work->reading) ? BODY_CANCELLED : BODY_READY;
    if (status == STORE_MISSING)
        answer_missing(answer);
    else if (status == STORE_NO_MEMORY)
        problem_memory(answer, work->arena, NULL);
    else
        problem_answer(answer, 500, "the scene could not be read");
    return BODY_REFUSED;
}

/* The type of the file is not a header of the request here. */
static void report(struct answer *answer, enum zr_status status, const struct zr_error *error)
{
    problem_answer_error(answer, status == ZR_BAD_TYPE ? 422 : problem_http_status(status), error);
}

static void finish(const struct work *work, bool is_pinned)
{
    const struct service *service = work->service;
    const struct request *request = work->request;
    struct answer *answer = work->answer;
    if (answer->status != 200) return;
    if (answer->is_unsized)
        answer->is_unsized = !sizes_find(service->sizes, &request->answer_key, &answer->size, &is_pinned);
    else
        sizes_note(service->sizes, &request->answer_key, answer->size, is_pinned);
    answers_keep(service->kept[KEPT_ANSWERS], &request->answer_key, answer, is_pinned);
    add_headers(request, is_pinned, answer);
}

enum request_next renders_work(const struct work *work)
{
    static const struct rendering_kind kind = {unpack, report, finish, true};
    const struct request *request = work->request;
    size_t size;
    if (!request->has_answer) return rendering_run(&kind, work);
    if (store_look(work->service->store, request->scene, &size) == STORE_THERE)
        answer_unchanged(work->service, request, work->answer);
    else
        answer_missing(work->answer);
    return REQUEST_ANSWERED;
}
