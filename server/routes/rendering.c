#include "rendering.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/run.h"
#include "body.h"
#include "clock.h"
#include "cost/cost.h"
#include "input/formats/formats.h"
#include "input/query/query_text.h"
#include "parts.h"
#include "problem.h"
#include "render_request.h"
#include "routes.h"
#include "scene/camera/resolved_view.h"
#include "scene/looks.h"
#include "scene/scene.h"
#include "text.h"
#include "views/views.h"

/* ---- opening: checks before the body ---- */

char *rendering_begin(struct request *request, size_t room, struct answer *answer)
{
    request->render = malloc(sizeof *request->render + room);
    if (!request->render) {
        problem_busy(answer, 1, REFUSAL_MEMORY);
        return NULL;
    }
    *request->render = (struct zr_request){.format = ZR_FORMAT_UNKNOWN};
    return (char *)(request->render + 1);
}

/* Reads "name=value&name=value" into a new request->render. */
static bool read_query(struct request *request, struct answer *answer)
{
    const char *query = request->query ? request->query : "";
    struct zr_error error = {0};
    char *values = rendering_begin(request, zr_query_room(query), answer);
    if (!values) return false;
    if (zr_query_split(query, values, request->render, &error) == ZR_OK) return true;
    problem_answer(answer, 400, "query: %s", error.items[0].detail);
    return false;
}

#define MULTIPART "multipart/form-data"

/* Adds the accepted types to a 415. */
static void add_accepted_types(struct answer *answer)
{
    answer_header(answer, "Accept-Post", "%s, " MULTIPART, zr_format_types_join().text);
}

bool rendering_is_multipart(const char *type)
{
    const size_t length = sizeof MULTIPART - 1;
    return strncasecmp(type, MULTIPART, length) == 0 && (type[length] == '\0' || strchr("; \t", type[length]));
}

/* Reads the Content-Type. A generic one leaves the format to the bytes. */
static bool read_content_type(struct request *request, enum zr_format *format, struct answer *answer)
{
    const char *type = request->content_type ? request->content_type : "", *fault;
    if (rendering_is_multipart(type)) {
        *format = ZR_FORMAT_JSON; /* until the part's type is known */
        if (multipart_boundary(type, request->boundary, &fault)) return true;
        problem_answer(answer, 400, "%s", fault);
        return false;
    }
    *format = zr_format_of_type(type);
    if (*format != ZR_FORMAT_UNKNOWN || zr_media_type_is_generic(type)) return true;
    add_accepted_types(answer);
    problem_answer(answer, 415, "Content-Type '%.80s' is none of: %s, " MULTIPART, type, zr_format_types_join().text);
    return false;
}

bool rendering_open(const struct service *service, struct request *request, struct answer *answer)
{
    (void)service;
    enum zr_format format;
    if (!read_content_type(request, &format, answer) || !read_query(request, answer)) return false;
    request->render->format = format;
    request->is_shareable = request->parts == ACCEPT_NO_PARTS;
    return true;
}

/* ---- working ---- */

/* Limits of a small request: predicted time on the reference machine, since a small request stays small on a slow one;
 * faces for the painter, whose time cannot be counted; views, each of which is read before its cost is known; input
 * that is read within some milliseconds. */
static const double SMALL_MS = 10.0;
enum {
    SMALL_PAINTER_FACES = 64,
    SMALL_VIEWS = 16,
    SMALL_IMAGE_PIXELS = 1 << 18,
    SMALL_NODE_VISITS = 100000,
    SMALL_ARRAY_BYTES = 4 << 20,
    LARGE_ANSWER_WORDS = 1 << 20
};

/* State of one request. */
struct rendering {
    const struct work *work;
    struct zr_run run;
    struct zr_stored stored; /* all assets, large ones too */
    /* Several views read assets on several threads. */
    atomic_size_t small_left; /* bytes of assets that a small request may still read */
    atomic_bool is_large;     /* gives up: small_only is set, and the request is large */
    struct zr_quick quick;    /* limits of a small request */
    struct images_use images;
    struct texts_use texts;
    struct meshes_use meshes;
    struct zr_cost cost;   /* predicted cost; all 0 before the prediction */
    struct zr_files files; /* drawn */
    struct zr_answer result;
    struct zr_look_pin look;
    bool has_open_look; /* its version is not named */
    enum refusal busy;  /* reason why there can be no stream now */
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

/* Accept chooses the form of several files, but for addresses. */
static void add_look(const struct rendering *r)
{
    answer_header(r->work->answer, "Zraster-Look", "%s", r->look.text);
    if (!*r->work->request->scene) answer_vary(r->work->answer, "Accept");
}

/* ---- early detection of large requests ---- */

static bool too_large(struct rendering *r, bool large)
{
    if (r->work->request->small_only && large) r->is_large = true;
    return r->is_large;
}

/* Reads an asset for zr_request, unless it is too large for a small request. */
static enum zr_status read_stored(void *context, const char *sha256, struct zr_arena *arena, const void **bytes,
                                  size_t *size)
{
    struct rendering *r = context;
    size_t there = 0;
    if (r->work->request->small_only && store_look(r->work->service->store, sha256, &there) == STORE_THERE) {
        const size_t before = atomic_fetch_sub(&r->small_left, there);
        if (too_large(r, there > before)) return ZR_CANCELLED;
    }
    return r->stored.read(r->stored.context, sha256, arena, bytes, size);
}

/* Finds the size of an asset that is kept as read. It must still be stored. */
static enum zr_status look_at_stored(void *context, const char *sha256, size_t *size)
{
    struct rendering *r = context;
    const enum zr_status status = r->stored.look(r->stored.context, sha256, size);
    return status == ZR_OK && too_large(r, *size > r->small_left) ? ZR_CANCELLED : status;
}

/* ---- steps ---- */

/* Checks the predicted memory before drawing, so that a refusal takes no time. That of windows is a lower bound, and that
 * of meshes within a factor of two. */
static bool has_memory(const struct rendering *r)
{
    const double least = fmax(r->cost.window_bytes, 0.5 * r->cost.mesh_bytes);
    struct zr_arena *arena = r->run.arena;
    if (least <= (double)zr_arena_left(arena)) return true;
    return zr_arena_charge(arena, least < 1e18 ? (size_t)least + 1 : SIZE_MAX);
}

/* Returns true if the answer may take more than a small one, by its bytes before compression. */
static bool is_large_answer(const struct rendering *r)
{
    return r->cost.counts[ZR_COST_OUTPUT_WORD] > LARGE_ANSWER_WORDS;
}

/* A sheet is one picture. */
static bool is_stream(const struct rendering *r, const struct zr_views *views)
{
    return views->set && !views->scene->sheet.is_on && r->work->request->stream;
}

static bool has_many_faces_for_the_painter(const struct zr_scene *scene)
{
    uint64_t faces = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        faces += scene->meshes[scene->instances[i].mesh].face_count;
    return scene->algorithm == ZR_ALGORITHM_PAINTER && faces > SMALL_PAINTER_FACES;
}

/* Finds the cost of the scene's view, or of all its views. */
static enum zr_status find_cost(struct rendering *r, struct zr_views *views, const struct zr_resolved_view **resolved)
{
    if (views->set) {
        const enum zr_status status = zr_views_plan(&r->run, views);
        r->cost = views->cost;
        return status;
    }
    const enum zr_status status = zr_resolved_view_find(&r->run, views->scene, resolved);
    if (status == ZR_OK || status == ZR_CANCELLED) r->cost = zr_scene_cost(views->scene, *resolved);
    return status;
}

static double predicted_ms(const struct rendering *r)
{
    return r->cost.ms * slowness_of(r->work->service->slowness, r->cost.ms > SMALL_MS);
}

static bool is_too_long(const struct rendering *r)
{
    return predicted_ms(r) > (double)r->work->service->config->cost_max_ms;
}

static enum zr_status refuse_cost(const struct rendering *r)
{
    const struct zr_cost_most most = zr_cost_most(&r->cost);
    const double ms = predicted_ms(r);
    return zr_error_add(r->run.error, ZR_BAD_SCENE, NULL,
                        "the work is predicted to take %.3g s of processor time, more than costMaxMs, %" PRIu64
                        " ms; %.3g s of that are for %.3g %s: fewer of these take less",
                        1e-3 * ms, r->work->service->config->cost_max_ms, 1e-3 * ms * most.ms / r->cost.ms, most.count,
                        most.words);
}

/* Predicts the cost, and refuses too large work. If the search for the view was cancelled, the prediction still decides
 * whether the request is large. */
static enum zr_status predict(struct rendering *r, struct zr_views *views, const struct zr_resolved_view **resolved)
{
    const struct zr_scene *scene = views->scene;
    if (too_large(r, views->set && views->set->count > SMALL_VIEWS)) return ZR_CANCELLED;
    if (views->set) r->cost = zr_views_foretell(views);
    if (is_too_long(r)) return refuse_cost(r);
    const enum zr_status status = find_cost(r, views, resolved);
    if (status != ZR_OK && status != ZR_CANCELLED) return status;
    r->work->times->predicted_ms = predicted_ms(r);
    const bool may_wait = is_stream(r, views); /* for its reader */
    if (too_large(r, may_wait || r->cost.ms > SMALL_MS || has_many_faces_for_the_painter(scene))) return ZR_CANCELLED;
    if (!has_memory(r)) return ZR_NO_MEMORY;
    if (!may_wait && r->work->request->load.answers_short && is_large_answer(r)) r->busy = REFUSAL_ANSWERS;
    if (r->busy) return ZR_CANCELLED;
    return is_too_long(r) ? refuse_cost(r) : status;
}

/* Joins several files into an archive, unless the answer has them as parts. */
static enum zr_status join_files(struct rendering *r, const struct zr_scene *scene)
{
    const bool is_joined = r->work->request->parts == ACCEPT_NO_PARTS || r->files.count == 1;
    return (is_joined ? zr_files_answer : zr_files_describe)(r->run.arena, &r->files, scene, &r->result, r->run.error);
}

/* Draws and encodes the scene's view. */
static enum zr_status draw_one(struct rendering *r, const struct zr_scene *scene,
                               const struct zr_resolved_view *resolved)
{
    const struct zr_frame *frame = NULL;
    int64_t mark = clock_us();
    enum zr_status status = zr_render(&r->run, scene, resolved, &frame);
    r->work->times->render_ms = ms_since(&mark);
    if (status != ZR_OK) return status;
    status = zr_encode_files(&r->run, scene, frame, NULL, &r->files);
    if (status == ZR_OK) status = join_files(r, scene);
    r->work->times->encode_ms = ms_since(&mark);
    return status;
}

/* Draws and encodes several views; the time of encoding them is part of that of drawing. */
static enum zr_status draw_several(struct rendering *r, struct zr_views *views)
{
    int64_t mark = clock_us();
    enum zr_status status = zr_views_draw(&r->run, views, &r->files);
    r->work->times->render_ms = ms_since(&mark);
    if (status != ZR_OK) return status;
    status = join_files(r, views->scene);
    r->work->times->encode_ms = ms_since(&mark);
    return status;
}

/* ---- streams ---- */

/* The views of a stream that are drawn at once take a part of answer_memory_bytes at most. */
enum { STREAMED_AT_ONCE = 4 };

/* Streams the files of a view. */
static enum zr_status send_view(void *context, const struct zr_drawn_view *view, struct zr_error *error)
{
    struct rendering *r = context;
    const struct zr_files *files = view->files;
    struct stream *stream = r->work->request->stream;
    char warnings[ZR_WARNINGS_SIZE], file[128];
    struct zr_arena scratch = zr_arena_open_scratch(r->run.arena);
    text_to_ascii(warnings, sizeof warnings, zr_warnings_join(&scratch, &files->warnings));
    zr_arena_close_scratch(&scratch, r->run.arena);
    (void)error;
    stream->shrink = zr_drawn_view_shrink;
    stream->memory = view->memory;
    if (view->number == 0) {
        add_look(r);
        add_timing(r->work->answer, r->work->times);
        parts_begin(stream, r->work->request->parts, r->work->answer);
    }
    /* Each view has its own. parts_begin took the answer's headers only. */
    r->work->answer->warnings += files->warnings.count;
    for (uint32_t i = 0; i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        snprintf(file, sizeof file, "%s.%s", view->name, entry->name);
        const struct part part = {file, parts_have_twin(files, i), files->types[i], warnings, entry->bytes, entry->size};
        if (!parts_add(stream, &part)) return ZR_CANCELLED;
    }
    stream_flush(stream);
    return ZR_OK;
}

/* Draws several views, and streams each. The time of drawing includes encoding, and no waits for the reader. */
static enum zr_status stream_several(struct rendering *r, struct zr_views *views)
{
    struct stream *stream = r->work->request->stream;
    const struct zr_views_taker taker = {send_view, r,
                                         (size_t)r->work->service->config->answer_memory_bytes / STREAMED_AT_ONCE};
    r->busy = stream_open(stream);
    if (r->busy) return ZR_CANCELLED;
    int64_t mark = clock_us();
    const enum zr_status status = zr_views_draw_each(&r->run, views, taker);
    stream->shrink = NULL;
    stream->held_bytes = r->run.arena->held; /* while the end of the body waits */
    r->busy = stream->refusal;
    r->work->times->render_ms = ms_since(&mark) - (double)stream->waited_us / 1000.0;
    return status;
}

/* Returns true for a request for headers alone: no picture is drawn. */
static bool is_head(const struct request *request)
{
    return strcmp(request->method, "HEAD") == 0;
}

static enum zr_status run_steps(struct rendering *r, const struct zr_request *request)
{
    struct zr_views views;
    const struct zr_resolved_view *resolved = NULL;
    int64_t mark = clock_us();
    enum zr_status status = zr_views_read(&r->run, request, &r->work->service->limits, &views);
    if (status == ZR_OK) status = predict(r, &views, &resolved);
    r->work->times->parse_ms = ms_since(&mark);
    if (status != ZR_OK) return status;
    r->look = zr_look_pin_of(views.scene->look);
    r->has_open_look = views.scene->has_open_look;
    if (is_head(r->work->request)) return ZR_OK;
    if (!views.set) return draw_one(r, views.scene, resolved);
    return is_stream(r, &views) ? stream_several(r, &views) : draw_several(r, &views);
}

static void answer_image(const struct rendering *r)
{
    const struct zr_answer *result = &r->result;
    struct answer *answer = r->work->answer;
    if (result->bytes)
        answer_copy(answer, result->content_type, result->bytes, result->size);
    else
        parts_answer(answer, r->work->request->parts, &r->files);
    add_look(r);
    answer->warnings = result->warning_count;
    if (*result->encoders) answer_header(answer, "Zraster-Encoder", "%s", result->encoders);
    if (result->warnings && *result->warnings) {
        char warnings[ZR_WARNINGS_SIZE];
        text_to_ascii(warnings, sizeof warnings, result->warnings);
        answer_header(answer, "Zraster-Warnings", "%s", warnings);
    }
}

/* Gives the request the kept images, texts and meshes, and the limits of a small request. */
static void lend(struct rendering *r, const struct rendering_kind *kind, struct zr_request *request)
{
    r->stored = assets_stored(r->work->service);
    r->small_left = REQUEST_SMALL_BYTES;
    request->stored = (struct zr_stored){r->stored.read ? read_stored : NULL, r->stored.look ? look_at_stored : NULL, r,
                                         r->stored.advice};
    request->images = images_lend(&r->images);
    request->texts = texts_lend(&r->texts);
    if (kind->keeps_meshes) request->meshes = meshes_lend(&r->meshes);
    r->quick = (struct zr_quick){SMALL_IMAGE_PIXELS, SMALL_NODE_VISITS, SMALL_ARRAY_BYTES, false};
    if (r->work->request->small_only) request->quick = &r->quick;
}

static void release(struct rendering *r)
{
    images_release(&r->images);
    texts_release(&r->texts);
    meshes_release(&r->meshes);
}

static void answer_drawn(const struct rendering *r, const struct rendering_kind *kind)
{
    struct answer *answer = r->work->answer;
    if (is_head(r->work->request)) {
        answer->status = 200;
        answer->is_unsized = true;
        add_look(r);
    } else if (r->result.look) { /* else it is streamed */
        answer_image(r);
    }
    if (kind->finish) kind->finish(r->work, !r->has_open_look);
}

static void answer_failed(const struct rendering *r, const struct rendering_kind *kind, enum zr_status status)
{
    struct answer *answer = r->work->answer;
    if (r->busy)
        problem_busy(answer, 1, r->busy);
    else if (status == ZR_NO_MEMORY)
        problem_memory(answer, r->run.arena, &r->cost);
    else if (status == ZR_CANCELLED)
        problem_timeout(answer, r->work->service->config->render_timeout_ms);
    else if (kind->report)
        kind->report(answer, status, r->run.error);
    else
        problem_answer_error(answer, problem_http_status(status), r->run.error);
}

enum request_next rendering_run(const struct rendering_kind *kind, const struct work *work)
{
    const struct service *service = work->service;
    struct zr_error error = {0};
    struct rendering r = {.work = work,
                          .run = {.arena = work->arena, .team = service->team, .cancel = work->cancel, .error = &error},
                          .images = {.images = service->kept[KEPT_IMAGES], .texts = &r.texts},
                          .texts = {.texts = service->kept[KEPT_TEXTS]},
                          .meshes = {.meshes = service->kept[KEPT_MESHES]}};
    struct zr_request unpacked;
    int64_t mark = clock_us();
    const enum request_next next = body_next(work, kind->unpack(work, &unpacked));
    if (next != REQUEST_WORK) return next;
    if (too_large(&r, unpacked.size > REQUEST_SMALL_BYTES)) return REQUEST_LARGE;
    lend(&r, kind, &unpacked);
    unpacked.cancel = work->reading;
    const double unpack_ms = ms_since(&mark);
    const enum zr_status status = run_steps(&r, &unpacked);
    release(&r);
    if (too_large(&r, r.quick.is_exceeded || (status == ZR_CANCELLED && zr_is_cancelled(work->cancel->parent))))
        return REQUEST_LARGE;
    work->times->parse_ms += unpack_ms;
    if (status == ZR_OK)
        answer_drawn(&r, kind);
    else
        answer_failed(&r, kind, status);
    if (work->answer->status != 0) add_timing(work->answer, work->times);
    return REQUEST_ANSWERED;
}

static void report(struct answer *answer, enum zr_status status, const struct zr_error *error)
{
    if (status == ZR_BAD_TYPE) add_accepted_types(answer);
    problem_answer_error(answer, problem_http_status(status), error);
}

enum request_next rendering_work(const struct work *work)
{
    static const struct rendering_kind kind = {body_unpack, report, NULL, true};
    return rendering_run(&kind, work);
}
