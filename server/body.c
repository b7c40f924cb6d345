#include "body.h"

#include <string.h>
#include <strings.h>

#include "gunzip.h"
#include "multipart.h"
#include "problem.h"

/* The body without its Content-Encoding. */
static enum body_status decompress(const struct request *request, size_t max, struct zr_arena *arena,
                                   const struct zr_cancel *cancel, struct zr_request *render, struct answer *answer)
{
    if (!request->gzip) return BODY_READY;
    char *bytes = NULL;
    bool is_bounded = request->small_only && max > REQUEST_SMALL_BYTES;
    switch (gunzip(arena, render->bytes, render->size, is_bounded ? REQUEST_SMALL_BYTES : max, cancel, &bytes,
                   &render->size)) {
    case GUNZIP_OK:
        render->bytes = bytes;
        return BODY_READY;
    case GUNZIP_BROKEN:
        problem_answer(answer, 400, "the body is not what Content-Encoding says: no whole gzip");
        break;
    case GUNZIP_TOO_LARGE:
        if (is_bounded) return BODY_LARGE;
        problem_answer(answer, 413, "the body inflates to more than bodyMaxBytes, %zu bytes", max);
        break;
    case GUNZIP_NO_MEMORY:
        problem_memory(answer, arena);
        break;
    case GUNZIP_CANCELLED:
        return BODY_CANCELLED;
    }
    return BODY_REFUSED;
}

static bool is_json(const struct multipart_part *part)
{
    static const char JSON[] = "application/json";
    size_t length = 0;
    while (length < part->type_size && !strchr("; \t", part->type[length]))
        length++;
    return !part->type || (length == sizeof JSON - 1 && strncasecmp(part->type, JSON, length) == 0);
}

/* False: the answer says why. The part `scene` becomes the bytes, the others assets. Names lie in the arena. */
static bool unpack_parts(const struct request *request, struct zr_arena *arena, struct zr_request *render,
                         struct answer *answer)
{
    const char *fault;
    struct multipart *parts = zr_arena_alloc(arena, 1, sizeof *parts);
    struct zr_asset *assets = zr_arena_alloc(arena, MULTIPART_PARTS_MAX, sizeof *assets);
    if (!parts || !assets) {
        problem_memory(answer, arena);
        return false;
    }
    if (!multipart_parse(request->boundary, render->bytes, render->size, parts, &fault)) {
        problem_answer(answer, 400, "multipart/form-data: %s", fault);
        return false;
    }
    const struct multipart_part *scene = multipart_find(parts, "scene");
    if (!scene || !is_json(scene)) {
        problem_answer(answer, 400, "multipart/form-data: %s",
                       scene ? "the part 'scene' has a Content-Type other than application/json"
                             : "no part has the name 'scene'");
        return false;
    }
    render->asset_count = 0;
    for (const struct multipart_part *part = parts->parts; part < parts->parts + parts->count; part++)
        if (part != scene) assets[render->asset_count++] = (struct zr_asset){part->name, part->bytes, part->size};
    render->assets = assets;
    render->bytes = scene->bytes;
    render->size = scene->size;
    return true;
}

enum body_status body_unpack(const struct request *request, size_t max, struct zr_arena *arena,
                             const struct zr_cancel *cancel, struct zr_request *render, struct answer *answer)
{
    *render = request->render;
    enum body_status status = decompress(request, max, arena, cancel, render, answer);
    if (status != BODY_READY || !request->boundary[0]) return status;
    return unpack_parts(request, arena, render, answer) ? BODY_READY : BODY_REFUSED;
}
