#include "support/mcp_host.h"

#include <stdlib.h>
#include <string.h>

/* Takes memory of each size exactly, so that a sanitizer sees what writes on. */
static void *allocate(void *context, size_t size)
{
    struct mcp_test_host *test = context;
    void **blocks = realloc(test->blocks, (test->block_count + 1) * sizeof *blocks);
    if (!blocks) return NULL;
    test->blocks = blocks;
    void *block = blocks[test->block_count] = malloc(size ? size : 1);
    test->block_count += block != NULL;
    return block;
}

bool mcp_test_is_json(const char *bytes, size_t size, char first)
{
    static const struct zr_limits limits = {.json_depth_max = ZR_JSON_DEPTH_MAX};
    struct zr_error *error = calloc(1, sizeof *error);
    struct zr_arena arena;
    bool has_nul; /* the id of an answer, which is the request's, may have one; a scene may not */
    struct zr_json json = {.arena = &arena, .limits = &limits, .error = error, .has_nul = first ? NULL : &has_nul};
    zr_arena_init(&arena, 0);
    zr_json_open(&json, bytes, size);
    zr_json_type(&json);
    const bool begins = json.at < json.end && (!first || *json.at == first);
    const bool is_json = begins && zr_json_skip(&json) && zr_json_end(&json);
    free(error);
    return is_json;
}

/* ---- an archive ---- */

static void put_number(char **end, size_t value, int bytes)
{
    for (; bytes > 0; bytes--, value >>= 8)
        *(*end)++ = (char)value;
}

/* Puts a stored file, as far as unzip.h reads it. */
static void put_file(char **end, const char *name, const char *bytes, size_t size)
{
    memcpy(*end, "PK\3\4", 4);
    *end += 4;
    put_number(end, 0, 14);
    put_number(end, size, 4);
    put_number(end, size, 4);
    put_number(end, strlen(name), 2);
    put_number(end, 0, 2);
    *end = mempcpy(*end, name, strlen(name));
    *end = mempcpy(*end, bytes, size);
}

static const char INFO[] =
    "{\"window\":{\"width\":640,\"height\":480},\"camera\":{\"worldToCamera\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,-5,1],"
    "\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1],\"azimuthDegrees\":0,\"elevationDegrees\":0},"
    "\"unit\":\"millimetre\",\"bounds\":{\"min\":[0,0,0],\"max\":[1,2,3]},\"look\":\"studio@1\",\"picture\":"
    "{\"coveredShare\":0.5,\"touchesBorder\":false,\"colors\":9,\"blank\":false},\"parts\":[{\"name\":\"a\",\"id\":1,"
    "\"box\":{\"min\":[0,0,0],\"max\":[1,2,3]},\"triangles\":12,\"area\":22,\"volume\":6,\"closed\":true}],"
    "\"warnings\":[\"none\"]}";
static const char FRAGMENTS[] = "{\"x\":1,\"y\":2,\"count\":1,\"fragments\":[{\"depth\":1,\"faceId\":3,\"part\":\"a\","
                                "\"position\":[0,0,0],\"frontFacing\":1,\"shown\":true}]}";

static enum mcp_draw_status draw(void *context, const struct mcp_draw *draw, struct mcp_drawn *drawn)
{
    struct mcp_test_host *test = context;
    char *end = test->answer;
    test->draws++;
    if (!mcp_test_is_json(draw->scene, draw->scene_size, '{')) test->wrong_scenes++;
    free(test->scene);
    test->scene = strndup(draw->scene, draw->scene_size);
    test->scene_size = draw->scene_size;
    const bool is_pick = memmem(draw->scene, draw->scene_size, "\"fragments\"", 11);
    drawn->is_zip = is_pick || memmem(draw->scene, draw->scene_size, "\"color\"", 7);
    if (!drawn->is_zip) {
        end = mempcpy(end, INFO, sizeof INFO - 1);
    } else {
        put_file(&end, is_pick ? "fragments.json" : "color.png", is_pick ? FRAGMENTS : "PNG",
                 is_pick ? sizeof FRAGMENTS - 1 : 3);
        put_file(&end, "info.json", INFO, sizeof INFO - 1);
    }
    drawn->bytes = test->answer;
    drawn->size = (size_t)(end - test->answer);
    return MCP_DRAWN;
}

static void release(void *context, struct mcp_drawn *drawn)
{
    (void)context;
    (void)drawn;
}

void mcp_test_host_open(struct mcp_test_host *test)
{
    *test = (struct mcp_test_host){.draws = 0};
    test->host = (struct mcp_host){.context = test,
                                   .version = "0",
                                   .cancel = &test->cancel,
                                   .allocate = allocate,
                                   .draw = draw,
                                   .release = release};
}

void mcp_test_host_close(struct mcp_test_host *test)
{
    free(test->scene);
    free(test->blocks);
    *test = (struct mcp_test_host){.draws = 0};
}

struct mcp_reply mcp_test_handle(struct mcp_test_host *test, const char *bytes, size_t size)
{
    struct mcp_reply reply;
    mcp_handle(&test->host, (struct mcp_span){bytes, bytes + size}, NULL, &reply);
    while (test->block_count > 0)
        free(test->blocks[--test->block_count]);
    return reply;
}
