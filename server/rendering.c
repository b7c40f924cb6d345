#include "rendering.h"

#include <inttypes.h>
#include <stdio.h>

#include "assets.h"
#include "body.h"
#include "clock.h"
#include "problem.h"
#include "scene/sight.h"
#include "text.h"

/* Corners that are measured to foresee the work. COST_CORNERS: in well under a millisecond. COST_CORNERS_MORE: in
 * about half a second, for scenes that would be refused; more than most have. */
enum { COST_CORNERS = 4096, COST_CORNERS_MORE = 1 << 22 };

/* What request->small_only lets pass: 10 ms foreseen, and what is read in a millisecond or two. */
static const double SMALL_MS = 10.0;

/* One request on its way. */
struct rendering {
    const struct api *api;
    const struct api_request *request;
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    struct step_times *times;
    struct zr_stored stored; /* of all assets, large ones too */
    size_t small_left;       /* bytes that a small request may still read */
    bool is_large;           /* and request->small_only: to be given up */
};

static double ms_since(int64_t *mark_us)
{
    int64_t now = clock_us();
    double ms = (double)(now - *mark_us) / 1000.0;
    *mark_us = now;
    return ms;
}

static void add_timing(struct answer *answer, const struct step_times *times)
{
    const struct {
        const char *name;
        double ms;
    } steps[] = {{"parse", times->parse_ms},
                 {"queue", times->queue_ms},
                 {"render", times->render_ms},
                 {"encode", times->encode_ms}};
    char text[160] = "";
    size_t used = 0;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        if (steps[i].ms >= 0)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s;dur=%.3f", used ? ", " : "", steps[i].name,
                                     steps[i].ms);
    if (used) answer_header(answer, "Server-Timing", "%s", text);
}

/* ---- what is large is found out as early as can be ---- */

static bool too_large(struct rendering *r, bool large)
{
    r->is_large |= r->request->small_only && large;
    return r->is_large;
}

/* For zr_request: an asset, if a small request may have one of its size. */
static enum zr_status read_stored(void *context, const char *sha256, struct zr_arena *arena, const void **bytes,
                                  size_t *size)
{
    struct rendering *r = context;
    size_t there = 0;
    if (r->request->small_only && store_look(r->api->store, sha256, &there) == STORE_THERE) {
        if (too_large(r, there > r->small_left)) return ZR_CANCELLED;
        r->small_left -= there;
    }
    return r->stored.read(r->stored.context, sha256, arena, bytes, size);
}

/* ---- steps ---- */

/* A sample may mislead: before a scene is refused, all of it is measured. Where looking for the sight was cancelled,
 * what is large has yet to be told from what is not, and pixels and triangles can be counted without. */
static enum zr_status foresee(struct rendering *r, const struct zr_scene *scene, const struct zr_sight **sight,
                              struct zr_cost *cost, struct zr_error *error)
{
    const uint32_t samples[] = {COST_CORNERS, COST_CORNERS_MORE};
    const struct api *api = r->api;
    const enum zr_status status = zr_sight_find(r->arena, api->team, scene, r->cancel, sight, error);
    if (status != ZR_OK && status != ZR_CANCELLED) return status;
    for (int i = 0; i < 2; i++) {
        *cost = zr_scene_cost(scene, *sight, samples[i], r->cancel);
        r->times->foreseen_ms = foresight_predict_ms(api->foresight, cost);
        if (too_large(r, r->times->foreseen_ms > SMALL_MS)) return ZR_CANCELLED;
        if (r->times->foreseen_ms <= (double)api->config->cost_max_ms) return status;
    }
    foresight_refused(api->foresight, cost);
    return zr_error_add(
        error, ZR_BAD_SCENE, NULL,
        "work like that of %.0f triangles and %.3g pixels is foreseen to take %.3g s, more than costMaxMs, %" PRIu64
        " ms",
        cost->triangles + cost->shape_triangles, cost->fragments + cost->shape_fragments, r->times->foreseen_ms * 1e-3,
        api->config->cost_max_ms);
}

static enum zr_status run_steps(struct rendering *r, const struct zr_request *request, struct zr_answer *result,
                                struct zr_error *error)
{
    const struct api *api = r->api;
    const struct zr_scene *scene = NULL;
    const struct zr_sight *sight = NULL;
    const struct zr_frame *frame = NULL;
    struct zr_cost cost = {0};
    int64_t mark = clock_us();
    enum zr_status status = zr_scene_read(r->arena, api->team, request, &api->limits, &scene, error);
    if (status == ZR_OK) status = foresee(r, scene, &sight, &cost, error);
    r->times->parse_ms = ms_since(&mark);
    if (status != ZR_OK) return status;
    struct foresight_lap lap = foresight_start_lap(api->foresight);
    status = zr_render(r->arena, api->team, scene, sight, r->cancel, &frame, error);
    double render_ms = foresight_end_lap(api->foresight, &lap);
    r->times->render_ms = ms_since(&mark);
    if (status != ZR_OK) return status;
    status = zr_encode(r->arena, api->team, scene, frame, r->cancel, result, error);
    double encode_ms = foresight_end_lap(api->foresight, &lap);
    r->times->encode_ms = ms_since(&mark);
    if (status == ZR_OK) foresight_learn(api->foresight, &cost, render_ms, encode_ms);
    return status;
}

static void answer_image(struct answer *answer, const struct zr_answer *result)
{
    api_answer_copy(answer, result->content_type, result->bytes, result->size);
    if (result->warnings && *result->warnings) {
        char warnings[ZR_WARNINGS_SIZE];
        text_to_ascii(warnings, sizeof warnings, result->warnings);
        answer_header(answer, "Zraster-Warnings", "%s", warnings);
    }
}

enum api_next rendering_work(const struct api *api, const struct api_request *request, struct zr_arena *arena,
                             const struct zr_cancel *cancel, struct step_times *times, struct answer *answer)
{
    struct rendering r = {.api = api, .request = request, .arena = arena, .cancel = cancel, .times = times};
    struct zr_error error = {0};
    struct zr_answer result = {0};
    struct zr_request unpacked;
    int64_t mark = clock_us();
    /* A small request is read to its end even where its time is over: only then is it known whether it is large work,
     * to be handed on, and it has API_SMALL_BYTES at most. */
    const struct zr_cancel *reading = request->small_only ? cancel->parent : cancel;
    switch (body_unpack(request, (size_t)api->config->body_max_bytes, arena, reading, &unpacked, answer)) {
    case BODY_READY:
        break;
    case BODY_REFUSED:
        return API_ANSWERED;
    case BODY_LARGE:
        return API_LARGE;
    case BODY_CANCELLED:
        if (request->small_only) return API_LARGE;
        api_refuse_late(api, answer);
        return API_ANSWERED;
    }
    if (too_large(&r, unpacked.size > API_SMALL_BYTES)) return API_LARGE;
    r.stored = assets_stored(api);
    r.small_left = API_SMALL_BYTES;
    unpacked.stored = (struct zr_stored){r.stored.read ? read_stored : NULL, &r};
    unpacked.cancel = reading;
    double unpack_ms = ms_since(&mark);
    enum zr_status status = run_steps(&r, &unpacked, &result, &error);
    if (too_large(&r, status == ZR_CANCELLED && zr_is_cancelled(cancel->parent))) return API_LARGE;
    times->parse_ms += unpack_ms;
    if (status == ZR_OK) {
        answer_image(answer, &result);
    } else if (status == ZR_NO_MEMORY) {
        api_refuse_memory(answer, arena);
    } else if (status == ZR_CANCELLED) {
        api_refuse_late(api, answer);
    } else {
        problem_answer_error(answer, problem_http_status(status), &error);
    }
    add_timing(answer, times);
    return API_ANSWERED;
}
