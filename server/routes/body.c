#include "body.h"

#include <stdio.h>
#include <string.h>

#include "gunzip.h"
#include "input/formats/formats.h"
#include "multipart.h"
#include "problem.h"
#include "render_request.h"
#include "routes.h"

#define SCENE_NAME "scene" /* of the part that is the body */

/* all known media types are shorter */
enum { TYPE_SIZE = 128 };

/* Fills *render with the query and the body as sent. */
static void begin(const struct request *request, struct zr_request *render)
{
    *render = request->render ? *request->render : (struct zr_request){.format = ZR_FORMAT_JSON};
    render->bytes = request->body;
    render->size = request->body_size;
}

/* Undoes the Content-Encoding of the body. */
static enum body_status decompress(const struct work *work, struct zr_request *render)
{
    struct answer *answer = work->answer;
    const size_t max = (size_t)work->service->config->body_max_bytes;
    if (!work->request->gzip) return BODY_READY;
    const bool is_bounded = work->request->small_only && max > REQUEST_SMALL_BYTES;
    switch (gunzip(work->arena, work->reading, is_bounded ? REQUEST_SMALL_BYTES : max, &render->bytes, &render->size)) {
    case GUNZIP_OK:
        return BODY_READY;
    case GUNZIP_BROKEN:
        problem_answer(answer, 400, "Content-Encoding is gzip, but the body is not a complete gzip file");
        break;
    case GUNZIP_TOO_LARGE:
        if (is_bounded) return BODY_LARGE;
        problem_answer(answer, 413, "the body inflates to more than bodyMaxBytes, %zu bytes", max);
        break;
    case GUNZIP_NO_MEMORY:
        problem_memory(answer, work->arena, NULL);
        break;
    case GUNZIP_CANCELLED:
        return BODY_CANCELLED;
    }
    return BODY_REFUSED;
}

/* Finds the format of the body's part from its Content-Type. Without one, the part `scene` is JSON; another part, and one
 * of a generic type, stay unknown, and the reader detects the format. False: the type names no format. */
static bool find_format(const struct multipart_part *scene, enum zr_format *format)
{
    char type[TYPE_SIZE] = "";
    *format = strcmp(scene->name, SCENE_NAME) == 0 ? ZR_FORMAT_JSON : ZR_FORMAT_UNKNOWN;
    if (!scene->type) return true;
    snprintf(type, sizeof type, "%.*s", (int)scene->type_size, scene->type);
    *format = zr_format_of_type(type);
    return *format != ZR_FORMAT_UNKNOWN || zr_media_type_is_generic(type);
}

enum body_status body_split(const struct work *work, struct zr_request *render, struct multipart **parts)
{
    const char *fault;
    begin(work->request, render);
    const enum body_status status = decompress(work, render);
    if (status != BODY_READY) return status;
    *parts = zr_arena_zero(work->arena, 1, sizeof **parts);
    if (!*parts) {
        problem_memory(work->answer, work->arena, NULL);
        return BODY_REFUSED;
    }
    if (multipart_parse(work->request->boundary, render->bytes, render->size, *parts, &fault)) return BODY_READY;
    const size_t failed = (*parts)->count; /* the part with the fault, unless it is that of the whole body */
    const char *name = failed < MULTIPART_PARTS_MAX ? (*parts)->parts[failed].name : "";
    problem_answer(work->answer, 400, "multipart/form-data: %s%s%s%s", fault, *name ? ": '" : "", name,
                   *name ? "'" : "");
    return BODY_REFUSED;
}

enum body_status body_parts(const struct work *work, struct multipart **parts)
{
    struct zr_request render;
    return body_split(work, &render, parts);
}

/* Returns the part `scene`, or the only part, as forms of one file have it. NULL: the answer has the error. */
static const struct multipart_part *find_scene(const struct multipart *parts, struct answer *answer)
{
    const struct multipart_part *scene = multipart_find(parts, SCENE_NAME);
    if (scene || parts->count == 1) return scene ? scene : parts->parts;
    problem_answer(answer, 400,
                   "multipart/form-data: none of the %zu parts has the name '" SCENE_NAME "': "
                   "give it to the scene or the model",
                   parts->count);
    return NULL;
}

/* Makes the part `scene` the bytes, and the other parts assets. Names lie in the arena. False: the answer has the
 * error. */
static bool use_parts(const struct work *work, const struct multipart *parts, struct zr_request *render)
{
    struct answer *answer = work->answer;
    struct zr_asset *assets = zr_arena_alloc(work->arena, MULTIPART_PARTS_MAX, sizeof *assets);
    if (!assets) {
        problem_memory(answer, work->arena, NULL);
        return false;
    }
    const struct multipart_part *scene = find_scene(parts, answer);
    if (!scene) return false;
    if (!find_format(scene, &render->format)) {
        problem_answer(answer, 400,
                       "multipart/form-data: the part '%s' has the Content-Type '%.*s', which is none of: %s",
                       scene->name, (int)(scene->type_size < 80 ? scene->type_size : 80), scene->type,
                       zr_format_types_join().text);
        return false;
    }
    render->asset_count = 0;
    for (const struct multipart_part *part = parts->parts; part < parts->parts + parts->count; part++)
        if (part != scene)
            assets[render->asset_count++] = (struct zr_asset){
                .name = part->name, .bytes = part->bytes, .size = part->size, .is_optional = part->is_optional};
    render->assets = assets;
    render->bytes = scene->bytes;
    render->size = scene->size;
    return true;
}

enum body_status body_unpack(const struct work *work, struct zr_request *render)
{
    struct multipart *parts;
    begin(work->request, render);
    if (!work->request->boundary[0]) return decompress(work, render);
    const enum body_status status = body_split(work, render, &parts);
    if (status != BODY_READY) return status;
    return use_parts(work, parts, render) ? BODY_READY : BODY_REFUSED;
}

enum request_next body_next(const struct work *work, enum body_status status)
{
    if (status == BODY_READY) return REQUEST_WORK;
    if (status == BODY_LARGE || (status == BODY_CANCELLED && work->request->small_only)) return REQUEST_LARGE;
    if (status == BODY_CANCELLED) problem_timeout(work->answer, work->service->config->render_timeout_ms);
    return REQUEST_ANSWERED;
}

enum body_status body_read_scene(const struct work *work, const struct zr_run *run, const struct zr_scene **scene,
                                 enum zr_status *status)
{
    struct zr_request render;
    const enum body_status body = body_unpack(work, &render);
    if (body != BODY_READY) return body;
    render.cancel = work->reading;
    render.stored = assets_stored(work->service);
    *status = zr_scene_read(run, &render, &work->service->limits, scene);
    return BODY_READY;
}
