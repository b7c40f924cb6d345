#include "told.h"

#include <math.h>
#include <stdio.h>
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

/* Writes a place; parts of it that are next to nothing, as lengths, are 0. */
static void put_place(struct mcp_text *words, const char *before, const cJSON *at, double nothing)
{
    double place[3];
    if (!at) return;
    for (int i = 0; i < 3; i++)
        place[i] = fabs(mcp_number_at(at, i)) > nothing ? mcp_number_at(at, i) : 0;
    mcp_text_print(words, "%s(%.6g, %.6g, %.6g)", before, place[0], place[1], place[2]);
}

/* Writes a length, and the new one if it differs. */
static void put_length(struct mcp_text *words, const cJSON *hole, const char *name, const char *new_name)
{
    char before[32], now[32];
    snprintf(before, sizeof before, "%.5g", mcp_number_of(hole, name));
    snprintf(now, sizeof now, "%.5g", mcp_number_of(hole, new_name));
    mcp_text_put(words, before);
    if (mcp_get(hole, new_name) && strcmp(before, now) != 0) mcp_text_print(words, " to %s", now);
}

static void describe_hole(const cJSON *hole, const char *kind, struct mcp_text *words)
{
    const cJSON *through = mcp_get(hole, "through"), *now = mcp_get(hole, "newThrough"), *at = mcp_get(hole, "newAt");
    const double nothing = 1e-6 * mcp_number_of(hole, "diameter");
    mcp_text_print(words, "\n- hole %s: diameter ", kind);
    put_length(words, hole, "diameter", "newDiameter");
    mcp_text_put(words, ", ");
    put_length(words, hole, "depth", "newDepth");
    mcp_text_put(words, " deep");
    if (through) mcp_text_put(words, cJSON_IsTrue(through) ? ", through" : ", blind");
    if (now && through && cJSON_IsTrue(now) != cJSON_IsTrue(through))
        mcp_text_put(words, cJSON_IsTrue(now) ? " to through" : " to blind");
    put_place(words, at ? ", from " : ", at ", mcp_get(hole, "at"), nothing);
    put_place(words, " to ", at, nothing);
}

static void describe_holes(const cJSON *content, struct mcp_text *words)
{
    static const char *const kinds[] = {"moved", "changed", "removed", "added"};
    const cJSON *holes = mcp_get(mcp_get(content, "features"), "holes"), *hole;
    int count = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        cJSON_ArrayForEach(hole, mcp_get(holes, kinds[i]))
        {
            if (count++ < LISTED_MAX) describe_hole(hole, kinds[i], words);
        }
    count += (int)mcp_number_of(holes, "omitted");
    if (count > LISTED_MAX) mcp_text_print(words, "\n- and %d more holes", count - LISTED_MAX);
}

static void describe(const cJSON *content, struct mcp_text *words)
{
    const cJSON *summary = mcp_get(content, "summary"), *warning;
    if (cJSON_IsString(summary)) mcp_text_put(words, summary->valuestring);
    describe_holes(content, words);
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
