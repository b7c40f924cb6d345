#include "message.h"

#include <stdlib.h>
#include <string.h>

#include "host.h"
#include "tree.h"

/* REST_MAX: bytes of a message without its scene and model; a tree takes up to 40 times as many. */
enum { CUTS_MAX = 16, REST_MAX = 256 << 10 };

/* Spans of the text that the tree leaves out. */
struct cuts {
    struct mcp_span at[CUTS_MAX];
    size_t count;
};

static struct mcp_span inside_quotes(struct mcp_span string)
{
    return (struct mcp_span){string.at + 1, string.end - 1};
}

/* Passes a value, which is left out of the tree if it has the type. */
static void cut(struct zr_json *json, struct cuts *cuts, enum zr_json_type type, struct mcp_span *found)
{
    const bool is_wanted = zr_json_type(json) == type && cuts->count < CUTS_MAX;
    const struct mcp_span value = mcp_span_skip(json);
    if (!is_wanted || !value.at) return;
    cuts->at[cuts->count++] = value;
    *found = type == ZR_JSON_STRING ? inside_quotes(value) : value;
}

static void read_model(struct zr_json *json, struct cuts *cuts, struct mcp_span *base64, struct mcp_span *text)
{
    struct zr_json_text key;
    zr_json_enter(json, '{');
    while (zr_json_member(json, &key))
        if (zr_json_is(&key, "base64"))
            cut(json, cuts, ZR_JSON_STRING, base64);
        else if (zr_json_is(&key, "text"))
            cut(json, cuts, ZR_JSON_STRING, text);
        else
            zr_json_skip(json);
}

static void read_arguments(struct mcp_message *message, struct zr_json *json, struct cuts *cuts)
{
    struct zr_json_text key;
    zr_json_enter(json, '{');
    while (zr_json_member(json, &key))
        if (zr_json_is(&key, "scene"))
            cut(json, cuts, ZR_JSON_OBJECT, &message->scene);
        else if (zr_json_is(&key, "model") && zr_json_type(json) == ZR_JSON_OBJECT)
            read_model(json, cuts, &message->base64, &message->text);
        else if (zr_json_is(&key, "a") && zr_json_type(json) == ZR_JSON_OBJECT)
            read_model(json, cuts, &message->sides[0].base64, &message->sides[0].text);
        else if (zr_json_is(&key, "b") && zr_json_type(json) == ZR_JSON_OBJECT)
            read_model(json, cuts, &message->sides[1].base64, &message->sides[1].text);
        else
            zr_json_skip(json);
}

static void read_params(struct mcp_message *message, struct zr_json *json, struct cuts *cuts)
{
    struct zr_json_text key;
    zr_json_enter(json, '{');
    while (zr_json_member(json, &key))
        if (zr_json_is(&key, "arguments") && zr_json_type(json) == ZR_JSON_OBJECT)
            read_arguments(message, json, cuts);
        else
            zr_json_skip(json);
}

static void read_root(struct mcp_message *message, struct cuts *cuts)
{
    struct zr_json_text key;
    struct zr_json *json = &message->json;
    if (zr_json_type(json) != ZR_JSON_OBJECT) {
        zr_json_skip(json);
        return;
    }
    zr_json_enter(json, '{');
    while (zr_json_member(json, &key))
        if (zr_json_is(&key, "params") && zr_json_type(json) == ZR_JSON_OBJECT)
            read_params(message, json, cuts);
        else if (zr_json_is(&key, "id"))
            message->id = mcp_span_skip(json);
        else
            zr_json_skip(json);
}

/* Makes the tree of the rest. Without it, `code` has the reason. */
static cJSON *parse_rest(struct mcp_span text, const struct cuts *cuts, int *code)
{
    struct mcp_text rest = {0};
    size_t size = (size_t)(text.end - text.at);
    for (size_t i = 0; i < cuts->count; i++)
        size -= (size_t)(cuts->at[i].end - cuts->at[i].at);
    *code = MCP_NOT_A_REQUEST;
    if (size > REST_MAX) return NULL;
    const char *at = text.at;
    for (size_t i = 0; i < cuts->count; i++) {
        mcp_text_add(&rest, at, (size_t)(cuts->at[i].at - at));
        mcp_text_put(&rest, *cuts->at[i].at == '"' ? "\"\"" : "{}");
        at = cuts->at[i].end;
    }
    mcp_text_add(&rest, at, (size_t)(text.end - at));
    *code = rest.failed ? MCP_INTERNAL : MCP_NOT_JSON;
    cJSON *root = rest.failed ? NULL : cJSON_ParseWithLength(rest.data, rest.size);
    mcp_text_free(&rest);
    return root;
}

/* Returns true for a string, and for a number without a fraction. */
static bool is_id(struct mcp_span id)
{
    if (*id.at == '"') return true;
    const char *at = id.at + (*id.at == '-');
    while (at < id.end && *at >= '0' && *at <= '9')
        at++;
    return at == id.end && at[-1] != '-';
}

/* A modern request has a key of the revision in its _meta. */
static bool is_modern(const cJSON *meta)
{
    static const char *const keys[] = {"protocolVersion", "clientCapabilities", "clientInfo"};
    char name[64] = "io.modelcontextprotocol/";
    const size_t length = strlen(name);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        memcpy(name + length, keys[i], strlen(keys[i]) + 1);
        if (mcp_get(meta, name)) return true;
    }
    return false;
}

static int take(struct mcp_message *message, const char **why)
{
    const cJSON *root = message->root, *id = mcp_get(root, "id"), *method = mcp_get(root, "method"),
                *version = mcp_get(root, "jsonrpc");
    *why = cJSON_IsArray(root) ? "batches are not served: send one object per message" : "the message is no object";
    if (!cJSON_IsObject(root)) return MCP_NOT_A_REQUEST;
    *why = "id is neither a string nor an integer";
    if (id && !message->id.at) return MCP_NOT_A_REQUEST;
    *why = "jsonrpc is not \"2.0\"";
    if (!cJSON_IsString(version) || strcmp(version->valuestring, "2.0") != 0) return MCP_NOT_A_REQUEST;
    *why = "method is missing or not a string";
    if (!cJSON_IsString(method)) return MCP_NOT_A_REQUEST;
    message->method = method->valuestring;
    message->params = mcp_get(root, "params");
    message->meta = mcp_get(message->params, "_meta");
    message->arguments = mcp_get(message->params, "arguments");
    const cJSON *name = mcp_get(message->params, "name");
    message->name = cJSON_IsString(name) ? name->valuestring : NULL;
    message->is_modern = is_modern(message->meta) || strcmp(message->method, "server/discover") == 0;
    *why = "params is no object";
    return message->params && !cJSON_IsObject(message->params) ? MCP_WRONG_PARAMS : 0;
}

/* Reads the text. Returns 0, or a code with its words. A valid id before a fault is kept. */
static int read_text(struct mcp_message *message, struct mcp_span text, const struct mcp_host *host, struct cuts *cuts,
                     const char **why)
{
    static const struct zr_limits limits = {.json_depth_max = ZR_JSON_DEPTH_MAX};
    struct zr_json *json = &message->json;
    *why = "out of memory";
    if (!(message->error = calloc(1, sizeof *message->error))) return MCP_INTERNAL;
    zr_arena_init(&message->arena, 0);
    *json = (struct zr_json){.arena = &message->arena,
                             .cancel = host->cancel,
                             .limits = &limits,
                             .error = message->error,
                             .has_nul = &message->has_nul};
    zr_json_open(json, text.at, (size_t)(text.end - text.at));
    read_root(message, cuts);
    zr_json_end(json);
    const enum zr_status status = zr_json_close(json);
    if (message->id.at && !is_id(message->id)) message->id = (struct mcp_span){NULL, NULL};
    if (status == ZR_OK) return 0;
    if (message->error->count == 0) return MCP_INTERNAL;
    *why = status == ZR_BAD_SCENE ? "the message is nested deeper than 512 levels" : message->error->items[0].detail;
    return MCP_NOT_JSON;
}

int mcp_message_read(struct mcp_message *message, struct mcp_span text, const struct mcp_host *host, const char **why)
{
    struct cuts cuts = {.count = 0};
    *message = (struct mcp_message){.root = NULL};
    int code = read_text(message, text, host, &cuts, why);
    if (code != 0) return code;
    code = MCP_NOT_A_REQUEST;
    message->root = message->has_nul ? NULL : parse_rest(text, &cuts, &code);
    if (message->root) return take(message, why);
    *why = message->has_nul            ? "a text has \\u0000, which is not allowed"
           : code == MCP_NOT_A_REQUEST ? "the message has more than 262144 bytes beside its scene and model"
           : code == MCP_INTERNAL      ? "out of memory"
                                       : "the message is not JSON in UTF-8";
    return code;
}

void mcp_message_free(struct mcp_message *message)
{
    cJSON_Delete(message->root);
    free(message->error);
}
