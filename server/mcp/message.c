#include "message.h"

#include <string.h>

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

/* Passes a value that is left out of the tree if it begins with `first`. */
static void cut(struct mcp_walk *walk, struct cuts *cuts, char first, struct mcp_span *found)
{
    struct mcp_span value;
    const bool is_wanted = mcp_walk_peek(walk) == first && cuts->count < CUTS_MAX;
    mcp_walk_value(walk, &value);
    if (!is_wanted || !value.at) return;
    cuts->at[cuts->count++] = value;
    *found = first == '"' ? inside_quotes(value) : value;
}

static void read_model(struct mcp_message *message, struct mcp_walk *walk, struct cuts *cuts)
{
    struct mcp_span key;
    mcp_walk_enter(walk, '{');
    while (mcp_walk_member(walk, &key))
        if (mcp_span_is(key, "base64"))
            cut(walk, cuts, '"', &message->base64);
        else if (mcp_span_is(key, "text"))
            cut(walk, cuts, '"', &message->text);
        else
            mcp_walk_value(walk, NULL);
}

static void read_arguments(struct mcp_message *message, struct mcp_walk *walk, struct cuts *cuts)
{
    struct mcp_span key;
    mcp_walk_enter(walk, '{');
    while (mcp_walk_member(walk, &key))
        if (mcp_span_is(key, "scene"))
            cut(walk, cuts, '{', &message->scene);
        else if (mcp_span_is(key, "model") && mcp_walk_peek(walk) == '{')
            read_model(message, walk, cuts);
        else
            mcp_walk_value(walk, NULL);
}

static void read_params(struct mcp_message *message, struct mcp_walk *walk, struct cuts *cuts)
{
    struct mcp_span key;
    mcp_walk_enter(walk, '{');
    while (mcp_walk_member(walk, &key))
        if (mcp_span_is(key, "arguments") && mcp_walk_peek(walk) == '{')
            read_arguments(message, walk, cuts);
        else
            mcp_walk_value(walk, NULL);
}

static void walk_over(struct mcp_message *message, struct mcp_walk *walk, struct cuts *cuts)
{
    struct mcp_span key;
    if (mcp_walk_peek(walk) != '{') {
        mcp_walk_value(walk, NULL);
        return;
    }
    mcp_walk_enter(walk, '{');
    while (mcp_walk_member(walk, &key))
        if (mcp_span_is(key, "params") && mcp_walk_peek(walk) == '{')
            read_params(message, walk, cuts);
        else
            mcp_walk_value(walk, mcp_span_is(key, "id") ? &message->id : NULL);
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
    const size_t digits = strspn(id.at + (*id.at == '-'), "0123456789");
    return digits > 0 && id.at + (*id.at == '-') + digits == id.end;
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
    if (id && !is_id(message->id)) {
        message->id = (struct mcp_span){NULL, NULL};
        return MCP_NOT_A_REQUEST;
    }
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

int mcp_message_read(struct mcp_message *message, struct mcp_span text, const struct mcp_host *host, const char **why,
                     enum mcp_walk_fault *fault)
{
    struct cuts cuts = {.count = 0};
    struct mcp_walk walk = mcp_walk_open(text, host);
    int code;
    *message = (struct mcp_message){.root = NULL};
    walk_over(message, &walk, &cuts);
    const bool is_json = mcp_walk_end(&walk);
    *fault = walk.fault;
    *why = walk.fault == MCP_WALK_DEEP ? "the message is nested deeper than 512 levels"
                                       : "the message is not JSON in UTF-8";
    if (!is_json) {
        *message = (struct mcp_message){.root = NULL};
        return MCP_NOT_JSON;
    }
    code = MCP_NOT_A_REQUEST;
    message->root = walk.has_nul ? NULL : parse_rest(text, &cuts, &code);
    if (message->root) return take(message, why);
    if (message->id.at && !is_id(message->id)) message->id = (struct mcp_span){NULL, NULL};
    if (code == MCP_NOT_A_REQUEST) *why = "the message has more than 262144 bytes beside its scene and model";
    if (code == MCP_INTERNAL) *why = "out of memory";
    if (walk.has_nul) *why = "a text has \\u0000, which is not allowed";
    return code;
}

void mcp_message_free(struct mcp_message *message)
{
    cJSON_Delete(message->root);
}
