#include "told.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "features.h"
#include "place.h"
#include "tree.h"

enum { LISTED_MAX = 8, REGION_DIGITS = 5 };

static const double PI = 3.14159265358979323846;

/* Coordinates up to this share of a length are rounding errors: of a region, and of the model. */
#define REGION_ZERO 1e-4
#define PLACE_ZERO  1e-6

/* Returns a side of a box, x, y or z. */
static double side_of(const cJSON *box, int axis)
{
    return mcp_number_at(mcp_get(box, "max"), axis) - mcp_number_at(mcp_get(box, "min"), axis);
}

static double longest_side_of(const cJSON *box)
{
    return fmax(side_of(box, 0), fmax(side_of(box, 1), side_of(box, 2)));
}

/* Writes size, area, volume and tunnels of a model, so that it is clear which of two is larger. */
static void describe_side(const cJSON *content, const char *name, struct mcp_text *words)
{
    const cJSON *side = mcp_get(content, name), *box = mcp_get(side, "box");
    if (!side) return;
    mcp_text_print(words, "\n- %s: box %.6g x %.6g x %.6g, area %.6g", name, side_of(box, 0), side_of(box, 1),
                   side_of(box, 2), mcp_number_of(side, "area"));
    if (mcp_get(side, "volume")) mcp_text_print(words, ", volume %.6g", mcp_number_of(side, "volume"));
    if (mcp_get(side, "volumeError")) mcp_text_print(words, " +- %.2g", mcp_number_of(side, "volumeError"));
    const cJSON *tunnels = mcp_get(side, "handles");
    if (tunnels && !mcp_get(side, "volumeError"))
        mcp_text_print(words, ", %.0f tunnel%s", tunnels->valuedouble, tunnels->valuedouble == 1 ? "" : "s");
    if (cJSON_IsFalse(mcp_get(side, "closed"))) mcp_text_put(words, ", not closed");
}

static void describe_regions(const cJSON *content, struct mcp_text *words)
{
    const cJSON *region;
    int listed = 0;
    cJSON_ArrayForEach(region, mcp_get(content, "regions"))
    {
        const cJSON *in = mcp_get(region, "in"), *box = mcp_get(region, "box");
        if (!cJSON_IsString(in) || listed++ >= LISTED_MAX) continue;
        mcp_text_print(words, "\n- only in %s", in->valuestring);
        if (mcp_get(region, "part")) mcp_text_put(words, ", part ");
        if (mcp_get(region, "part")) mcp_name_put(words, mcp_get(region, "part"));
        mcp_text_print(words, ": volume %.4g, box %.3g x %.3g x %.3g", mcp_number_of(region, "volume"), side_of(box, 0),
                       side_of(box, 1), side_of(box, 2));
        mcp_place_put(words, " around ", mcp_get(region, "center"), REGION_DIGITS, REGION_ZERO * longest_side_of(box));
    }
    if (listed > LISTED_MAX) mcp_text_print(words, "\n- and %d more regions", listed - LISTED_MAX);
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

/* Writes the steps of a hole, and the new ones if they differ. */
static void put_steps(struct mcp_text *words, const cJSON *hole)
{
    struct mcp_text before = {0}, now = {0};
    mcp_features_describe_steps(&before, mcp_get(hole, "steps"));
    mcp_features_describe_steps(&now, mcp_get(hole, "newSteps"));
    const char *own = before.data ? before.data : "", *other = now.data ? now.data : ", no step";
    mcp_text_put(words, own);
    if (mcp_get(hole, "newSteps") && strcmp(own, other) != 0) mcp_text_print(words, ", now%s", other + 1);
    words->failed |= before.failed || now.failed;
    mcp_text_free(&before);
    mcp_text_free(&now);
}

/* Returns the second place if it differs from the first one, else NULL. */
static const cJSON *other_place(const cJSON *place, const cJSON *other, double zero)
{
    for (int i = 0; other && i < 3; i++)
        if (fabs(mcp_number_at(place, i) - mcp_number_at(other, i)) > zero) return other;
    return NULL;
}

static void describe_hole(const cJSON *hole, double size, struct mcp_text *words)
{
    const double zero = PLACE_ZERO * size;
    const cJSON *through = mcp_get(hole, "through"), *now = mcp_get(hole, "newThrough"),
                *to = other_place(mcp_get(hole, "at"), mcp_get(hole, "newAt"), zero);
    mcp_text_put(words, "diameter ");
    put_length(words, hole, "diameter", "newDiameter");
    mcp_text_put(words, ", ");
    put_length(words, hole, "depth", "newDepth");
    mcp_text_put(words, " deep");
    if (through) mcp_text_put(words, cJSON_IsTrue(through) ? ", through" : ", blind");
    if (now && through && cJSON_IsTrue(now) != cJSON_IsTrue(through))
        mcp_text_put(words, cJSON_IsTrue(now) ? " to through" : " to blind");
    put_steps(words, hole);
    mcp_place_put(words, to ? ", from " : ", at ", mcp_get(hole, "at"), 6, zero);
    mcp_place_put(words, " to ", to, 6, zero);
}

static void describe_part(const cJSON *part, double size, struct mcp_text *words)
{
    mcp_name_put(words, mcp_get(part, "name"));
    mcp_place_put(words, " by ", mcp_get(part, "by"), 6, PLACE_ZERO * size);
}

/* Writes the lists of what moved, changed, is gone or is new. `size`: of the model. */
static void describe_changes(const cJSON *lists, const char *what,
                             void (*describe)(const cJSON *, double, struct mcp_text *), double size,
                             struct mcp_text *words)
{
    static const char *const kinds[] = {"moved", "changed", "removed", "added"};
    const cJSON *item;
    int count = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        cJSON_ArrayForEach(item, mcp_get(lists, kinds[i]))
        {
            if (count++ >= LISTED_MAX) continue;
            mcp_text_print(words, "\n- %s %s: ", what, kinds[i]);
            describe(item, size, words);
        }
    count += (int)mcp_number_of(lists, "omitted");
    if (count > LISTED_MAX) mcp_text_print(words, "\n- and %d more %ss", count - LISTED_MAX, what);
}

/* Writes how b was moved before it was compared. */
static void describe_alignment(const cJSON *alignment, double size, struct mcp_text *words)
{
    const cJSON *matrix = mcp_get(alignment, "matrix");
    const double trace = mcp_number_at(matrix, 0) + mcp_number_at(matrix, 5) + mcp_number_at(matrix, 10);
    const double scale = mcp_get(alignment, "scale") ? mcp_number_of(alignment, "scale") : 1;
    const double angle = acos(fmax(-1, fmin(1, 0.5 * (trace - 1)))) * 180 / PI;
    if (!matrix) return;
    mcp_text_put(words, "\n- before that, b was moved to fit a:");
    if (scale != 1) mcp_text_print(words, " scaled by %.6g,", scale);
    if (angle > 1e-3) mcp_text_print(words, " turned by %.4g degrees,", angle);
    cJSON *shift = cJSON_CreateArray();
    for (int i = 12; i < 15; i++)
        mcp_append(shift, cJSON_CreateNumber(mcp_number_at(matrix, i)));
    mcp_place_put(words, " then shifted by ", shift, MCP_PLACE_DIGITS, PLACE_ZERO * size);
    cJSON_Delete(shift);
}

static void describe(const cJSON *content, struct mcp_text *words)
{
    const cJSON *summary = mcp_get(content, "summary"), *warning;
    if (cJSON_IsString(summary)) mcp_text_put(words, summary->valuestring);
    describe_side(content, "a", words);
    describe_side(content, "b", words);
    const cJSON *box = mcp_get(mcp_get(content, "a"), "box");
    const double size = longest_side_of(box);
    describe_alignment(mcp_get(content, "alignment"), size, words);
    mcp_place_set_digits(words, box);
    describe_changes(mcp_get(content, "parts"), "part", describe_part, size, words);
    describe_changes(mcp_get(mcp_get(content, "features"), "holes"), "hole", describe_hole, size, words);
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
