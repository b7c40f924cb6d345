#include "routes.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "openapi.h"
#include "problem.h"
#include "schema/schema.h"
#include "text.h"

enum { MEMORY = 8 << 20, NAME_SIZE = 64 };

/* Answers a text with its hash as ETag: clients that have it get 304. */
static void answer_text(const struct request *request, struct answer *answer, const char *type,
                        const struct zr_buffer *text)
{
    char tag[24];
    uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
    for (size_t i = 0; i < text->size; i++)
        hash = (hash ^ text->bytes[i]) * UINT64_C(1099511628211);
    snprintf(tag, sizeof tag, "\"%016" PRIx64 "\"", hash);
    answer_header(answer, "ETag", "%s", tag);
    answer_header(answer, "Cache-Control", "no-cache");
    if (text_has_tag(request->if_none_match, tag))
        answer->status = 304;
    else
        answer_copy(answer, type, text->bytes, text->size);
}

static void answer_made(const struct request *request, struct answer *answer, const char *type, bool is_made,
                        struct zr_buffer *text)
{
    zr_buffer_add(text, "\n", 1);
    if (is_made && zr_arena_ok(text->arena))
        answer_text(request, answer, type, text);
    else
        answer->is_broken |= !zr_arena_ok(text->arena);
}

/* Reads the name of an object from a path. False if it is not NAME.json. */
static bool read_name(const char *path, char name[NAME_SIZE])
{
    static const char ending[] = ".json";
    const char *from = path + strlen(SCHEMA_PATH);
    const size_t length = strlen(from), end = sizeof ending - 1;
    if (length <= end || length - end >= NAME_SIZE || strcmp(from + length - end, ending) != 0) return false;
    memcpy(name, from, length - end);
    name[length - end] = '\0';
    return true;
}

static void refuse_name(struct answer *answer, const char *path)
{
    char known[ANSWER_DETAIL_SIZE] = "";
    size_t used = 0;
    for (size_t i = 0; i < zr_schema_object_count && used < sizeof known; i++)
        used +=
            (size_t)snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", zr_schema_objects[i]->name);
    problem_answer(answer, 404, "there is no schema %.100s; there are %s, each with .json", path + strlen(SCHEMA_PATH),
                   known);
}

bool contract_open_schema(const struct service *service, struct request *request, struct answer *answer)
{
    struct zr_arena arena;
    char name[NAME_SIZE] = "scene";
    const bool is_scene = strcmp(request->path, SCENE_SCHEMA_PATH) == 0;
    if (!is_scene && !read_name(request->path, name)) {
        refuse_name(answer, request->path);
        return false;
    }
    zr_arena_init(&arena, MEMORY);
    struct zr_buffer text = {.arena = &arena};
    const bool is_made = zr_schema_print(&text, &service->limits, name, NULL);
    if (!is_made && zr_arena_ok(&arena))
        refuse_name(answer, request->path);
    else
        answer_made(request, answer, "application/schema+json", is_made, &text);
    zr_arena_free(&arena);
    return false;
}

bool contract_open_openapi(const struct service *service, struct request *request, struct answer *answer)
{
    struct zr_arena arena;
    zr_arena_init(&arena, MEMORY);
    struct zr_buffer text = {.arena = &arena};
    openapi_print(&text, &service->limits);
    answer_made(request, answer, "application/json", true, &text);
    zr_arena_free(&arena);
    return false;
}
