#include "told.h"

#include <string.h>

#include "tree.h"

enum { LISTED_MAX = 8 };

static void describe_regions(const cJSON *content, struct mcp_text *words)
{
    const cJSON *region;
    int listed = 0;
    cJSON_ArrayForEach(region, mcp_get(content, "regions"))
    {
        const cJSON *in = mcp_get(region, "in"), *center = mcp_get(region, "center");
        if (!cJSON_IsString(in) || listed++ == LISTED_MAX) break;
        mcp_text_print(words, "\n- only in %s: volume %.4g around (%.4g, %.4g, %.4g)", in->valuestring,
                       mcp_number_of(region, "volume"), mcp_number_at(center, 0), mcp_number_at(center, 1),
                       mcp_number_at(center, 2));
    }
}

static void describe(const cJSON *content, struct mcp_text *words)
{
    const cJSON *summary = mcp_get(content, "summary"), *warning;
    if (cJSON_IsString(summary)) mcp_text_put(words, summary->valuestring);
    describe_regions(content, words);
    cJSON_ArrayForEach(warning, mcp_get(content, "warnings"))
    {
        mcp_text_put(words, "\nwarning: ");
        if (cJSON_IsString(warning)) mcp_text_line(words, warning->valuestring, MCP_DETAIL_SIZE);
    }
}

static void put_text(struct mcp_text *result, const struct mcp_text *words)
{
    mcp_text_put(result, "{\"type\":\"text\",\"text\":");
    mcp_text_json(result, words->data ? words->data : "");
    mcp_text_put(result, "}");
    result->failed |= words->failed;
}

static void put_picture(const struct mcp_told *told, bool is_svg, struct mcp_text *result)
{
    struct mcp_text svg = {0};
    mcp_text_put(result, ",");
    if (is_svg) {
        mcp_text_add(&svg, told->picture, told->picture_size);
        put_text(result, &svg);
        mcp_text_free(&svg);
        return;
    }
    mcp_text_put(result, "{\"type\":\"image\",\"data\":\"");
    mcp_text_base64(result, told->picture, told->picture_size);
    mcp_text_put(result, "\",\"mimeType\":\"image/png\"}");
}

void mcp_told_put(const struct mcp_told *told, const char *name, bool is_svg, struct mcp_text *result)
{
    struct mcp_text words = {0};
    cJSON *content = cJSON_Parse(told->json);
    if (name) mcp_text_line(&words, name, MCP_DETAIL_SIZE);
    if (name) mcp_text_put(&words, ": ");
    describe(content, &words);
    mcp_text_put(result, "\"content\":[");
    put_text(result, &words);
    if (told->picture) put_picture(told, is_svg, result);
    mcp_text_put(result, "],\"structuredContent\":");
    mcp_text_add(result, told->json, strcspn(told->json, "\n"));
    mcp_text_put(result, ",\"isError\":false");
    result->failed = result->failed || !content;
    mcp_text_free(&words);
    cJSON_Delete(content);
}
