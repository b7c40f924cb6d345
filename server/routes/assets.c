#include "routes.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "body.h"
#include "gate/admit.h"
#include "problem.h"
#include "render_request.h"
#include "text.h"

enum { WHOLE_MAX = 32 << 10, ASSET_S = 31536000 };

static const char ASSET_TYPE[] = "application/octet-stream";

bool assets_open(const struct service *service, struct request *request, struct answer *answer)
{
    char tag[STORE_NAME_SIZE + 2];
    static const char FORM[] = "multipart/form-data";
    bool is_new = strcmp(request->method, "POST") == 0;
    const char *name = is_new ? "" : request->path + strlen(request->route->path);
    if (!service->store) {
        problem_answer(answer, 404, "no assets are kept here; start zrasterd with --assets-dir=DIRECTORY for that");
        return false;
    }
    if (!is_new && !store_is_name(name)) {
        problem_answer(answer, 404, "an asset's name is its SHA-256, 64 lower-case hexadecimal digits");
        return false;
    }
    if (request->content_type && strncasecmp(request->content_type, FORM, sizeof FORM - 1) == 0) {
        problem_answer(answer, 415, "an asset is the body itself, not a part of %s", FORM);
        return false;
    }
    request->asset = name;
    snprintf(tag, sizeof tag, "\"%s\"", name);
    request->has_asset = text_has_tag(request->if_none_match, tag);
    return true;
}

/* ---- uploads ---- */

static void answer_kept(struct answer *answer, const struct request *request, const char *name, size_t size,
                        bool is_new)
{
    char text[STORE_NAME_SIZE + 64];
    int length = snprintf(text, sizeof text, "{\"sha256\":\"%s\",\"size\":%zu}\n", name, size);
    answer_copy(answer, "application/json", text, (size_t)length);
    if (answer->status != 200) return;
    answer_header(answer, "Location", "%s%s", *request->asset ? request->route->path : ASSETS_PATH, name);
    if (is_new) answer->status = 201;
}

static enum request_next put(const struct work *work)
{
    const struct service *service = work->service;
    const struct request *request = work->request;
    struct answer *answer = work->answer;
    struct work uncancelled = *work;
    struct zr_request body;
    char name[STORE_NAME_SIZE];
    uncancelled.reading = NULL; /* what has arrived is kept */
    const enum request_next next = body_next(work, body_unpack(&uncancelled, &body));
    if (next != REQUEST_WORK) return next;
    store_name(body.bytes, body.size, name);
    if (*request->asset && strcmp(request->asset, name) != 0) {
        problem_answer(answer, 422, "the body's SHA-256 is %s, not %s", name, request->asset);
        return REQUEST_ANSWERED;
    }
    enum store_status status = store_put(service->store, name, body.bytes, body.size);
    switch (status) {
    case STORE_TOO_LARGE:
        problem_answer(answer, 413, "the asset has %zu bytes; assetsMaxBytes, for all together, is %" PRIu64, body.size,
                       service->config->assets_max_bytes);
        break;
    case STORE_DISK_FULL:
        problem_answer(answer, 507, "there is no room for the asset: %s", strerror(errno));
        break;
    case STORE_READ_ONLY:
        problem_answer(answer, 403, "assets cannot be written here: %s", strerror(errno));
        break;
    case STORE_FAILED:
        problem_answer(answer, 500, "the asset could not be written: %s", strerror(errno));
        break;
    default:
        answer_kept(answer, request, name, body.size, status == STORE_NEW);
        break;
    }
    return REQUEST_ANSWERED;
}

/* ---- downloads ---- */

/* A small asset is sent as bytes, in one call with the header: if the daemon is killed, a proxy has got all of the
 * answer or none, and in the latter case can ask another daemon. */
static void answer_asset(struct answer *answer, int file, size_t size)
{
    char *bytes = file > 0 && size > 0 && size <= WHOLE_MAX ? malloc(size) : NULL;
    if (bytes && pread(file, bytes, size, 0) == (ssize_t)size) {
        close(file);
        answer_body(answer, ASSET_TYPE, bytes, size);
        return;
    }
    free(bytes);
    answer_file(answer, ASSET_TYPE, file, size);
}

static void answer_there(const struct request *request, int file, size_t size, struct answer *answer)
{
    answer_asset(answer, file, size);
    answer->status = request->has_asset ? 304 : 200;
    /* The bytes under a hash never change. */
    answer_header(answer, "ETag", "\"%s\"", request->asset);
    admit_caching(request, ASSET_S, true, answer);
    answer_header(answer, "Cross-Origin-Resource-Policy", "cross-origin");
}

static enum request_next get(const struct work *work)
{
    const struct service *service = work->service;
    const struct request *request = work->request;
    struct answer *answer = work->answer;
    int file = 0; /* none: only the size is needed */
    size_t size = 0;
    const bool wants_bytes = strcmp(request->method, "GET") == 0 && !request->has_asset;
    enum store_status status = STORE_THERE;
    if (!wants_bytes || request->small_only) status = store_look(service->store, request->asset, &size);
    if (wants_bytes && request->small_only && status == STORE_THERE && size > REQUEST_SMALL_BYTES) return REQUEST_LARGE;
    if (wants_bytes && status == STORE_THERE)
        status = store_fetch(service->store, request->asset, work->cancel, &file, &size);
    switch (status) {
    case STORE_THERE:
        answer_there(request, file, size, answer);
        break;
    case STORE_CANCELLED:
        problem_answer(answer, 504, "the asset could not be read within renderTimeoutMs, %" PRIu64 " ms",
                       service->config->render_timeout_ms);
        break;
    case STORE_FAILED:
        problem_answer(answer, 500, "the asset could not be read: %s", strerror(errno));
        break;
    default:
        problem_answer(answer, 404, "no asset is kept under this name");
        break;
    }
    return REQUEST_ANSWERED;
}

enum request_next assets_work(const struct work *work)
{
    const char *method = work->request->method;
    return strcmp(method, "GET") == 0 || strcmp(method, "HEAD") == 0 ? get(work) : put(work);
}

/* ---- for scenes ---- */

static enum zr_status read_stored(void *context, const char *sha256, struct zr_arena *arena, const void **bytes,
                                  size_t *size)
{
    switch (store_read(context, sha256, arena, bytes, size)) {
    case STORE_THERE:
        return ZR_OK;
    case STORE_MISSING:
        return ZR_BAD_SCENE;
    case STORE_NO_MEMORY:
        return ZR_NO_MEMORY;
    default:
        return ZR_INTERNAL;
    }
}

static enum zr_status look_at_stored(void *context, const char *sha256, size_t *size)
{
    return store_look(context, sha256, size) == STORE_THERE ? ZR_OK : ZR_BAD_SCENE;
}

struct zr_stored assets_stored(const struct service *service)
{
    if (!service->store)
        return (struct zr_stored){.advice = "zrasterd keeps them with --assets-dir; send the bytes as a part of a "
                                            "multipart/form-data request"};
    return (struct zr_stored){read_stored, look_at_stored, service->store, "upload it with PUT /v1/assets/HASH"};
}
