#include "preset.h"

#include <string.h>

#include "base/arena.h"
#include "base/run.h"
#include "input/query/query_text.h"
#include "render_request.h"
#include "views/views.h"

enum { ARENA_BYTES = 64 << 20 };

/* The smallest bodies: of a model, and of a scene, which takes other parameters. */
static const char MODEL[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char SCENE[] = "{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}";

static enum zr_status read_with(const struct zr_request *query, enum zr_format format, const char *body,
                                const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_arena arena;
    struct zr_views views;
    struct zr_request request = *query;
    request.format = format;
    request.bytes = body;
    request.size = strlen(body);
    request.camera = request.animation = request.member = NULL;
    zr_arena_init(&arena, ARENA_BYTES);
    const enum zr_status status =
        zr_views_read(&(struct zr_run){.arena = &arena, .error = error}, &request, limits, &views);
    zr_arena_free(&arena);
    return status;
}

bool preset_check(const char *query, const struct zr_limits *limits, struct zr_error *error)
{
    char room[2 * PRESET_QUERY_MAX + 2];
    struct zr_request request = {0};
    struct zr_error of_scene = {0};
    if (zr_query_split(query, room, &request, error) != ZR_OK) return false;
    return request.frames || read_with(&request, ZR_FORMAT_OBJ, MODEL, limits, error) == ZR_OK ||
           read_with(&request, ZR_FORMAT_JSON, SCENE, limits, &of_scene) == ZR_OK;
}
