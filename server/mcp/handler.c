#include "handler.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "faults.h"
#include "memory.h"
#include "near.h"
#include "tools.h"
#include "tree.h"

#define NAMESPACE "io.modelcontextprotocol/"

/* The newest revision for clients that begin with `initialize`, and an older one. */
#define LEGACY     "2025-11-25"
#define LEGACY_OLD "2025-06-18"
/* Of requests without the header. */
#define LEGACY_ASSUMED "2025-03-26"

enum { LIST_MS = 300000, DISCOVER_MS = 3600000 };

struct exchange {
    const struct mcp_host *host;
    const struct mcp_headers *headers; /* NULL: no HTTP */
    struct mcp_message message;
    struct mcp_reply *reply;
};

/* ---- answers ---- */

static void begin(struct exchange *exchange, int http_status)
{
    struct mcp_text *text = &exchange->reply->text;
    const struct mcp_span id = exchange->message.id;
    exchange->reply->http_status = http_status;
    mcp_text_put(text, "{\"jsonrpc\":\"2.0\"");
    if (!id.at) return;
    mcp_text_put(text, ",\"id\":");
    mcp_text_add(text, id.at, (size_t)(id.end - id.at));
}

/* Answers an error. `data`: JSON, or NULL. */
static void refuse(struct exchange *exchange, int code, int http_status, const char *why, const char *data)
{
    struct mcp_text *text = &exchange->reply->text;
    begin(exchange, http_status);
    mcp_text_print(text, ",\"error\":{\"code\":%d,\"message\":", code);
    mcp_text_json(text, why);
    if (data) mcp_text_print(text, ",\"data\":%s", data);
    mcp_text_put(text, "}}");
}

static void begin_result(struct exchange *exchange)
{
    begin(exchange, 200);
    mcp_text_put(&exchange->reply->text, ",\"result\":{");
    if (exchange->message.is_modern) mcp_text_put(&exchange->reply->text, "\"resultType\":\"complete\",");
}

/* Ends a result, which has members. keep_ms: time for which clients and caches may keep it; 0: none. */
static void end_result(struct exchange *exchange, int keep_ms)
{
    struct mcp_text *text = &exchange->reply->text;
    if (exchange->message.is_modern) {
        if (keep_ms) mcp_text_print(text, ",\"ttlMs\":%d,\"cacheScope\":\"public\"", keep_ms);
        mcp_text_print(text, ",\"_meta\":{\"" NAMESPACE "serverInfo\":{\"name\":\"zraster\",\"version\":\"%s\"}}",
                       exchange->host->version);
    }
    mcp_text_put(text, "}}");
}

/* ---- methods ---- */

static void put_instructions(struct mcp_text *text)
{
    mcp_text_put(text, ",\"instructions\":");
    mcp_text_json(text, mcp_instructions);
}

static void discover(struct exchange *exchange)
{
    struct mcp_text *text = &exchange->reply->text;
    begin_result(exchange);
    mcp_text_put(text, "\"supportedVersions\":[\"" MCP_MODERN "\"],\"capabilities\":{\"tools\":{}}");
    put_instructions(text);
    end_result(exchange, DISCOVER_MS);
}

static void initialize(struct exchange *exchange)
{
    struct mcp_text *text = &exchange->reply->text;
    const cJSON *asked = mcp_get(exchange->message.params, "protocolVersion");
    const bool is_old = cJSON_IsString(asked) && strcmp(asked->valuestring, LEGACY_OLD) == 0;
    begin_result(exchange);
    mcp_text_print(text,
                   "\"protocolVersion\":\"%s\",\"capabilities\":{\"tools\":{}},\"serverInfo\":{\"name\":\"zraster\","
                   "\"title\":\"zraster\",\"version\":\"%s\"}",
                   is_old ? LEGACY_OLD : LEGACY, exchange->host->version);
    put_instructions(text);
    end_result(exchange, 0);
}

static void list_tools(struct exchange *exchange)
{
    begin_result(exchange);
    mcp_text_put(&exchange->reply->text, "\"tools\":");
    mcp_tools_list(&exchange->reply->text, exchange->host);
    end_result(exchange, LIST_MS);
}

static void refuse_tool(struct exchange *exchange, const char *name)
{
    struct mcp_faults *faults = calloc(1, sizeof *faults);
    const struct mcp_words names = mcp_tool_names();
    if (faults) mcp_fault_unknown(faults, "", "the tool", name, &names);
    refuse(exchange, MCP_WRONG_PARAMS, 200, faults ? faults->at[0].detail : "the tool is unknown", NULL);
    free(faults);
}

static enum mcp_draw_status call_tool(struct exchange *exchange)
{
    const struct mcp_message *message = &exchange->message;
    const struct mcp_words names = mcp_tool_names();
    int tool = 0;
    if (!message->name) {
        refuse(exchange, MCP_WRONG_PARAMS, 200, "params.name is missing or not a string", NULL);
        return MCP_DRAWN;
    }
    while (tool < MCP_TOOLS && strcmp(message->name, names.at[tool]) != 0)
        tool++;
    if (tool == MCP_TOOLS) {
        refuse_tool(exchange, message->name);
        return MCP_DRAWN;
    }
    if (message->arguments && !cJSON_IsObject(message->arguments)) {
        refuse(exchange, MCP_WRONG_PARAMS, 200, "params.arguments is no object", NULL);
        return MCP_DRAWN;
    }
    begin_result(exchange);
    const enum mcp_draw_status status = mcp_call(exchange->host, message, (enum mcp_tool)tool, &exchange->reply->text);
    if (status == MCP_DRAWN) end_result(exchange, 0);
    return status;
}

/* ---- checks ---- */

static void refuse_version(struct exchange *exchange, const char *version)
{
    struct mcp_text data = {0};
    mcp_text_put(&data, "{\"supported\":[\"" MCP_MODERN "\",\"" LEGACY "\",\"" LEGACY_OLD "\"],\"requested\":");
    mcp_text_json(&data, version);
    mcp_text_put(&data, "}");
    refuse(exchange, MCP_WRONG_VERSION, 400, "this version of the protocol is not served", data.data);
    exchange->reply->text.failed |= data.failed;
    mcp_text_free(&data);
}

/* Compares the value of a header with a text of the body. A value "=?base64?...?=" is decoded first. */
static bool is_value(const char *value, const char *text)
{
    static const char head[] = "=?base64?", tail[] = "?=";
    size_t length = strlen(value);
    while (length > 0 && (value[length - 1] == ' ' || value[length - 1] == '\t'))
        length--;
    if (length < sizeof head + 1 || memcmp(value, head, sizeof head - 1) != 0 ||
        memcmp(value + length - 2, tail, 2) != 0)
        return length == strlen(text) && memcmp(value, text, length) == 0;
    struct mcp_text wanted = {0};
    mcp_text_base64(&wanted, text, strlen(text));
    length -= sizeof head - 1 + sizeof tail - 1;
    const bool is_equal =
        !wanted.failed && wanted.size == length && memcmp(value + sizeof head - 1, wanted.data, length) == 0;
    mcp_text_free(&wanted);
    return is_equal;
}

static bool is_header(struct exchange *exchange, const char *name, const char *given, const char *wanted)
{
    char why[160];
    if (given && is_value(given, wanted)) return true;
    snprintf(why, sizeof why, "the header %s %s", name, given ? "differs from the body" : "is missing");
    refuse(exchange, MCP_HEADERS_DIFFER, 400, why, NULL);
    return false;
}

static bool check_modern(struct exchange *exchange)
{
    const struct mcp_message *message = &exchange->message;
    const struct mcp_headers *headers = exchange->headers;
    const cJSON *version = mcp_get(message->meta, NAMESPACE "protocolVersion"),
                *capabilities = mcp_get(message->meta, NAMESPACE "clientCapabilities");
    if (!cJSON_IsString(version)) {
        refuse(exchange, MCP_WRONG_PARAMS, 400, "params._meta has no " NAMESPACE "protocolVersion", NULL);
        return false;
    }
    if (headers && !is_header(exchange, "MCP-Protocol-Version", headers->version, version->valuestring)) return false;
    if (strcmp(version->valuestring, MCP_MODERN) != 0) {
        refuse_version(exchange, version->valuestring);
        return false;
    }
    if (!cJSON_IsObject(capabilities)) {
        refuse(exchange, MCP_WRONG_PARAMS, 400, "params._meta has no " NAMESPACE "clientCapabilities", NULL);
        return false;
    }
    if (!headers) return true;
    if (!is_header(exchange, "Mcp-Method", headers->method, message->method)) return false;
    return strcmp(message->method, "tools/call") != 0 || !message->name ||
           is_header(exchange, "Mcp-Name", headers->name, message->name);
}

/* Without the header, a request follows a revision that had none. */
static bool check_legacy(struct exchange *exchange)
{
    static const char *const served[] = {LEGACY, LEGACY_OLD, LEGACY_ASSUMED};
    const char *version = exchange->headers ? exchange->headers->version : NULL;
    if (!version || strcmp(exchange->message.method, "initialize") == 0) return true;
    for (size_t i = 0; i < sizeof served / sizeof *served; i++)
        if (is_value(version, served[i])) return true;
    refuse_version(exchange, version);
    return false;
}

/* ---- messages ---- */

static enum mcp_draw_status run(struct exchange *exchange)
{
    const struct mcp_message *message = &exchange->message;
    const char *method = message->method;
    if (message->is_modern ? !check_modern(exchange) : !check_legacy(exchange)) return MCP_DRAWN;
    if (strcmp(method, "tools/call") == 0) return call_tool(exchange);
    if (strcmp(method, "tools/list") == 0) {
        list_tools(exchange);
    } else if (message->is_modern && strcmp(method, "server/discover") == 0) {
        discover(exchange);
    } else if (!message->is_modern && strcmp(method, "initialize") == 0) {
        initialize(exchange);
    } else if (!message->is_modern && strcmp(method, "ping") == 0) {
        begin(exchange, 200);
        mcp_text_put(&exchange->reply->text, ",\"result\":{}}");
    } else {
        refuse(exchange, MCP_NO_METHOD, message->is_modern ? 404 : 200, "there is no such method", NULL);
    }
    return MCP_DRAWN;
}

enum mcp_draw_status mcp_handle(const struct mcp_host *host, struct mcp_span text, const struct mcp_headers *headers,
                                struct mcp_reply *reply)
{
    struct exchange exchange = {.host = host, .headers = headers, .reply = reply};
    struct mcp_message *message = &exchange.message;
    const char *why = NULL;
    enum mcp_draw_status status = MCP_DRAWN;
    *reply = (struct mcp_reply){.http_status = 202};
    mcp_memory_clear();
    const int code = mcp_message_read(message, text, host, &why);
    /* The header alone also marks a modern request. */
    if (code == 0 && headers && headers->version && is_value(headers->version, MCP_MODERN) &&
        strcmp(message->method, "initialize") != 0)
        message->is_modern = true;
    if (mcp_host_is_cancelled(host)) {
        status = MCP_CANCELLED;
    } else if (code == MCP_WRONG_PARAMS && !message->id.at) {
        /* a notification has no answer */
    } else if (code != 0) {
        refuse(&exchange, code, code == MCP_WRONG_PARAMS ? 200 : code == MCP_INTERNAL ? 500 : 400, why, NULL);
    } else if (message->id.at) {
        if (host->begin) host->begin(host->context, message->id);
        status = run(&exchange);
    }
    mcp_message_free(message);
    if (status == MCP_DRAWN && (reply->text.failed || mcp_memory_has_failed())) {
        mcp_text_free(&reply->text);
        refuse(&exchange, MCP_INTERNAL, 500, "out of memory", NULL);
    }
    if (status != MCP_DRAWN) mcp_text_free(&reply->text);
    return status;
}
