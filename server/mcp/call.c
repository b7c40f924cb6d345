#include "tools.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "drawing.h"
#include "faults.h"
#include "memory.h"
#include "picked.h"
#include "place.h"
#include "shots.h"
#include "tree.h"

/* ---- results ---- */

static void put_block(struct mcp_text *result, const struct mcp_text *words)
{
    mcp_text_print(
        result, "%s{\"type\":\"text\",\"text\":", result->size > 0 && result->data[result->size - 1] != '[' ? "," : "");
    mcp_text_json(result, words->data ? words->data : "");
    mcp_text_put(result, "}");
    result->failed |= words->failed;
}

static void put_image(struct mcp_text *result, const struct mcp_shot *shot)
{
    mcp_text_put(result, ",{\"type\":\"image\",\"data\":\"");
    mcp_text_base64(result, shot->image, shot->size);
    mcp_text_print(result, "\",\"mimeType\":\"%s\"}", shot->type);
}

static void put_content(struct mcp_text *result, cJSON *content)
{
    char *json = cJSON_PrintUnformatted(content);
    if (json) mcp_text_print(result, "],\"structuredContent\":%s,\"isError\":false", json);
    result->failed |= !json;
    cJSON_free(json);
}

static void put_faults(struct mcp_text *result, const struct mcp_faults *faults)
{
    struct mcp_text words = {0};
    for (size_t i = 0; i < faults->count; i++) {
        mcp_text_put(&words, i ? "\n" : "");
        mcp_text_line(&words, faults->at[i].pointer, MCP_POINTER_SIZE);
        mcp_text_put(&words, *faults->at[i].pointer ? ": " : "");
        mcp_text_line(&words, faults->at[i].detail, MCP_DETAIL_SIZE);
    }
    mcp_text_put(result, "\"content\":[");
    put_block(result, &words);
    mcp_text_put(result, "],\"isError\":true");
    mcp_text_free(&words);
}

/* Adds the facts (of a pick: the unit alone), views and warnings of all shots. */
static cJSON *make_content(const struct mcp_job *job, const struct mcp_shots *shots)
{
    cJSON *content = cJSON_CreateObject(), *views = cJSON_CreateArray(), *warnings = cJSON_CreateArray();
    if (job->tool == MCP_PICK)
        mcp_facts_add_unit(content, shots->at[0].info);
    else
        mcp_facts_add(content, shots->at[0].info);
    for (unsigned i = 0; i < shots->count; i++) {
        if (mcp_draws(job->tool)) mcp_facts_add_views(views, &shots->at[i], i, job->is_sheet);
        mcp_facts_add_warnings(warnings, shots->at[i].info);
    }
    if (shots->is_smaller)
        mcp_append(warnings, cJSON_CreateString("the picture is smaller than asked for, to fit into a message"));
    if (job->is_resized)
        mcp_append(warnings, cJSON_CreateString("the scene's window is larger than 1568 pixels; the picture "
                                                "is smaller"));
    if (mcp_draws(job->tool))
        mcp_add(content, "views", views);
    else
        cJSON_Delete(views);
    mcp_add(content, "warnings", warnings);
    return content;
}

/* ---- render, facts ---- */

/* Returns true if all views of a sheet are blank. */
static bool is_sheet_blank(const cJSON *content)
{
    const cJSON *view;
    cJSON_ArrayForEach(view, mcp_get(content, "views")) if (!cJSON_IsTrue(mcp_get(view, "blank"))) return false;
    return true;
}

static void add_picture(const struct mcp_job *job, cJSON *content, const struct mcp_shots *shots)
{
    cJSON *picture = cJSON_AddObjectToObject(content, "picture");
    size_t bytes = 0;
    bool is_blank = false;
    for (unsigned i = 0; i < shots->count; i++) {
        bytes += shots->at[i].size;
        is_blank |= job->is_sheet ? is_sheet_blank(content)
                                  : cJSON_IsTrue(mcp_get(mcp_get(shots->at[i].info, "picture"), "blank"));
    }
    cJSON_AddNumberToObject(picture, "images", shots->count);
    cJSON_AddNumberToObject(picture, "width", shots->at[0].width);
    cJSON_AddNumberToObject(picture, "height", shots->at[0].height);
    cJSON_AddStringToObject(picture, "mimeType", shots->at[0].type);
    cJSON_AddNumberToObject(picture, "bytes", (double)bytes);
    cJSON_AddBoolToObject(picture, "blank", is_blank);
    const cJSON *look = mcp_get(shots->at[0].info, "look");
    if (look) mcp_add(picture, "look", cJSON_Duplicate(look, true));
}

/* Puts the texts, the pictures and the structured content of a complete tree. */
static void put_shown(const struct mcp_job *job, const struct mcp_shots *shots, cJSON *content, struct mcp_text *result)
{
    struct mcp_text words = {0};
    mcp_facts_describe(&words, content);
    mcp_text_put(result, "\"content\":[");
    put_block(result, &words);
    mcp_text_free(&words);
    for (unsigned i = 0; job->tool == MCP_RENDER && i < shots->count; i++) {
        mcp_facts_describe_shot(&words, content, &shots->at[i], i);
        put_block(result, &words);
        put_image(result, &shots->at[i]);
        mcp_text_free(&words);
    }
    put_content(result, content);
}

static enum mcp_draw_status show(struct mcp_job *job, struct mcp_text *result)
{
    struct mcp_shots shots = {.count = 0};
    const bool is_render = job->tool == MCP_RENDER;
    const enum mcp_draw_status status = mcp_shots_draw(job, !is_render, &shots);
    if (status == MCP_DRAWN) {
        cJSON *content = make_content(job, &shots);
        if (is_render) add_picture(job, content, &shots);
        if (mcp_memory_has_failed())
            result->failed = true;
        else
            put_shown(job, &shots, content, result);
        cJSON_Delete(content);
    }
    mcp_shots_free(job->host, &shots);
    return status;
}

/* ---- pick ---- */

/* A view that is picked: its matrices in a sheet. */
struct target {
    char *view; /* JSON; NULL: that of the job */
    unsigned width, height, x, y;
    bool has_to; /* another pixel of the view */
    unsigned to_x, to_y;
    bool is_paper;                    /* between the views of a sheet */
    bool is_to_in_other, is_to_paper; /* the other pixel is in another view of the sheet, between the views */
};

static bool is_in(const cJSON *box, unsigned x, unsigned y)
{
    return x >= mcp_number_at(box, 0) && y >= mcp_number_at(box, 1) && x < mcp_number_at(box, 2) &&
           y < mcp_number_at(box, 3);
}

/* Finds the view of a sheet that has the pixel. */
static enum mcp_draw_status find_target(struct mcp_job *job, struct mcp_shots *shots, struct target *target)
{
    const struct mcp_picture picture = {
        .outputs = "[{\"channel\":\"info\"}]", .width = job->width, .height = job->height, .only = -1};
    const enum mcp_draw_status status = mcp_shots_draw_once(job, &picture, shots);
    const cJSON *cell;
    bool is_to_in_view = false;
    if (status != MCP_DRAWN) return status;
    target->is_paper = true;
    cJSON_ArrayForEach(cell, mcp_get(shots->at[0].info, "sheet"))
    {
        const cJSON *box = mcp_get(cell, "box");
        const unsigned x0 = (unsigned)mcp_number_at(box, 0), y0 = (unsigned)mcp_number_at(box, 1),
                       x1 = (unsigned)mcp_number_at(box, 2), y1 = (unsigned)mcp_number_at(box, 3);
        is_to_in_view = is_to_in_view || is_in(box, job->to_x, job->to_y);
        if (!is_in(box, job->x, job->y)) continue;
        cJSON *view = cJSON_CreateObject();
        static const char *const keys[] = {"worldToCamera", "projectionMatrix"};
        for (int i = 0; i < 2; i++)
            mcp_add(view, keys[i], cJSON_Duplicate(mcp_get(cell, keys[i]), true));
        *target = (struct target){.view = cJSON_PrintUnformatted(view),
                                  .width = x1 - x0,
                                  .height = y1 - y0,
                                  .x = job->x - x0,
                                  .y = job->y - y0,
                                  .has_to = job->has_to && is_in(box, job->to_x, job->to_y),
                                  .to_x = job->to_x - x0,
                                  .to_y = job->to_y - y0};
        cJSON_Delete(view);
    }
    target->is_to_in_other = job->has_to && !target->has_to && is_to_in_view;
    target->is_to_paper = job->has_to && !target->has_to && !is_to_in_view;
    return status;
}

static cJSON *make_fragment(const cJSON *given)
{
    static const char *const keys[][2] = {
        {"faceId", "face"}, {"depth", "depth"}, {"position", "point"}, {"shown", "shown"}};
    const cJSON *part = mcp_get(given, "part"), *side = mcp_get(given, "frontFacing");
    cJSON *made = cJSON_CreateObject();
    cJSON_AddStringToObject(made, "part", cJSON_IsString(part) ? part->valuestring : "");
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        mcp_add(made, keys[i][1], cJSON_Duplicate(mcp_get(given, keys[i][0]), true));
    cJSON_AddBoolToObject(made, "front", side && side->valuedouble == 1);
    return made;
}

static void describe_fragments(struct mcp_text *words, const cJSON *content)
{
    const cJSON *fragments = mcp_get(content, "fragments"), *fragment;
    cJSON_ArrayForEach(fragment, fragments)
    {
        mcp_text_put(words, "\n- part ");
        mcp_name_put(words, mcp_get(fragment, "part"));
        mcp_text_print(words, ", face %.0f", mcp_number_of(fragment, "face"));
        mcp_place_put(words, ", point ", mcp_get(fragment, "point"), 6, 0);
        mcp_text_print(words, ", depth %.6g, %s%s", mcp_number_of(fragment, "depth"),
                       cJSON_IsTrue(mcp_get(fragment, "front")) ? "front side" : "back side",
                       cJSON_IsTrue(mcp_get(fragment, "shown")) ? ", visible" : ", hidden");
    }
}

enum { FRAGMENTS_MAX = 32 };

/* Adds the normal and the feature of the visible surface, and the way to the other pixel. */
static void add_picked(cJSON *content, const cJSON *info)
{
    static const char *const keys[] = {"normal", "feature"};
    const cJSON *picked = cJSON_GetArrayItem(mcp_get(info, "picks"), 0);
    const cJSON *between = cJSON_GetArrayItem(mcp_get(info, "between"), 0);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (mcp_get(picked, keys[i])) mcp_add(content, keys[i], cJSON_Duplicate(mcp_get(picked, keys[i]), true));
    if (between) mcp_add(content, "between", cJSON_Duplicate(between, true));
}

/* Says why there is no way to the other pixel. */
static void add_no_way(const struct mcp_job *job, const struct target *target, cJSON *content)
{
    const bool is_hit = cJSON_IsTrue(mcp_get(content, "hit"));
    char text[160];
    if (!job->has_to || mcp_get(content, "between")) return;
    const bool is_first = target->is_paper || (!is_hit && !target->is_to_paper && !target->is_to_in_other);
    snprintf(text, sizeof text, "pixel (%u, %u) %s", is_first ? job->x : job->to_x, is_first ? job->y : job->to_y,
             target->is_paper || target->is_to_paper ? "is between the views of the sheet"
             : target->is_to_in_other                ? "is in another view of the sheet than the first pixel"
                                                     : "shows no surface, but the background");
    cJSON_AddStringToObject(content, "betweenOmitted", text);
}

static void describe_picked(struct mcp_text *words, const cJSON *content)
{
    const cJSON *between = mcp_get(content, "between"), *omitted = mcp_get(content, "betweenOmitted");
    if (cJSON_IsArray(mcp_get(content, "normal"))) mcp_text_put(words, "\nvisible surface");
    mcp_picked_describe_surface(words, content);
    if (omitted) mcp_text_print(words, "\nto the other pixel: no distance, since %s", omitted->valuestring);
    if (!between) return;
    mcp_text_put(words, "\nto the other pixel: ");
    mcp_picked_describe_between(words, between);
}

static void put_pick(const struct mcp_job *job, const struct target *target, const struct mcp_shots *shots,
                     const cJSON *found, struct mcp_text *result)
{
    struct mcp_text words = {0};
    const cJSON *list = mcp_get(found, "fragments"), *fragment, *count = mcp_get(found, "count");
    cJSON *content = make_content(job, shots);
    cJSON_AddNumberToObject(content, "x", job->x);
    cJSON_AddNumberToObject(content, "y", job->y);
    cJSON_AddBoolToObject(content, "hit", count && count->valuedouble > 0);
    cJSON_AddNumberToObject(content, "count", count ? count->valuedouble : 0);
    cJSON *made = cJSON_AddArrayToObject(content, "fragments");
    cJSON_ArrayForEach(fragment, list)
    {
        if (cJSON_GetArraySize(made) < FRAGMENTS_MAX) mcp_append(made, make_fragment(fragment));
    }
    if (!target->is_paper) add_picked(content, shots->at[0].info);
    add_no_way(job, target, content);
    mcp_text_print(&words, "pixel (%u, %u) of image %u: %s", job->x, job->y, job->image,
                   target->is_paper           ? "background between the views of the sheet"
                   : cJSON_GetArraySize(made) ? "surfaces, the nearest first:"
                                              : "nothing, the background");
    if (mcp_memory_has_failed())
        result->failed = true;
    else
        describe_fragments(&words, content);
    if (!mcp_memory_has_failed()) describe_picked(&words, content);
    mcp_text_put(result, "\"content\":[");
    put_block(result, &words);
    put_content(result, content);
    mcp_text_free(&words);
    cJSON_Delete(content);
}

static enum mcp_draw_status pick_at(struct mcp_job *job, const struct target *target, struct mcp_shots *shots,
                                    struct mcp_text *result)
{
    char outputs[128];
    snprintf(outputs, sizeof outputs, "[{\"channel\":\"fragments\",\"x\":%u,\"y\":%u},{\"channel\":\"info\"}]",
             target->x, target->y);
    char picks[64];
    if (target->has_to)
        snprintf(picks, sizeof picks, "[[%u,%u],[%u,%u]]", target->x, target->y, target->to_x, target->to_y);
    else
        snprintf(picks, sizeof picks, "[[%u,%u]]", target->x, target->y);
    const struct mcp_picture picture = {outputs, target->width, target->height, target->view, picks, (int)job->image};
    const enum mcp_draw_status status = mcp_shots_draw_once(job, &picture, shots);
    if (status == MCP_DRAWN) put_pick(job, target, shots, shots->fragments, result);
    return status;
}

static enum mcp_draw_status pick(struct mcp_job *job, struct mcp_text *result)
{
    struct mcp_shots shots = {.count = 0};
    struct target target = {.width = job->width,
                            .height = job->height,
                            .x = job->x,
                            .y = job->y,
                            .has_to = job->has_to,
                            .to_x = job->to_x,
                            .to_y = job->to_y};
    enum mcp_draw_status status = job->is_sheet ? find_target(job, &shots, &target) : MCP_DRAWN;
    if (status == MCP_DRAWN && target.is_paper)
        put_pick(job, &target, &shots, NULL, result);
    else if (status == MCP_DRAWN)
        status = pick_at(job, &target, &shots, result);
    cJSON_free(target.view);
    mcp_shots_free(job->host, &shots);
    return status;
}

enum mcp_draw_status mcp_call(const struct mcp_host *host, const struct mcp_message *message, enum mcp_tool tool,
                              struct mcp_text *result)
{
    struct mcp_job *job = malloc(sizeof *job);
    if (!job) {
        result->failed = true;
        return MCP_DRAWN;
    }
    enum mcp_draw_status status = MCP_REFUSED;
    if (tool == MCP_COMPARE) {
        job->faults.count = 0;
        status = mcp_compare_call(host, message, &job->faults, result);
    } else if (mcp_job_read(job, host, message, tool) && mcp_given_check(job))
        status = tool == MCP_PICK      ? pick(job, result)
                 : tool == MCP_DRAWING ? mcp_drawing_call(job, result)
                                       : show(job, result);
    else if (mcp_host_is_cancelled(host))
        status = MCP_CANCELLED;
    else if (job->faults.count == 0)
        mcp_fault(&job->faults, tool == MCP_COMPARE ? "" : "/model", "there is no memory for the model");
    if (status == MCP_REFUSED) {
        put_faults(result, &job->faults);
        status = MCP_DRAWN;
    }
    free(job);
    return status;
}
