#include "job.h"

#include <stdio.h>
#include <string.h>

#include "faults.h"
#include "input/scene/outputs.h"
#include "text.h"
#include "tree.h"

/* OUTPUTS_BYTES: of a list that is read. IN_MESH: depth of the members of a mesh. */
enum { OUTPUTS_BYTES = 64 << 10, IN_MESH = 2 };

/* Channels that are not pictures, each with the call that gives its values. */
static const char *const INSTEAD[][2] = {
    {"depth", "pick gives the depth at a pixel"},
    {"windowDepth", "pick gives the depth at a pixel"},
    {"distance", "pick gives the point at a pixel"},
    {"position", "pick gives the point at a pixel"},
    {"thickness", "pick gives the points of all surfaces at a pixel"},
    {"fragments", "pick lists all surfaces at a pixel"},
    {"faceId", "pick gives the part and the face at a pixel"},
    {"instanceId", "{\"parts\": {\"colors\": \"parts\"}} gives each part a colour, which the answer lists"},
    {"masks", "{\"parts\": {\"colors\": \"parts\"}} gives each part a colour, and the answer counts its pixels"},
    {"normals", "{\"shading\": \"normals\"} in the scene draws them as colours"},
    {"frontFacing", "pick gives the side of each surface at a pixel"},
    {"layers", "pick lists all surfaces at a pixel, and {\"look\": \"xray\"} draws hidden surfaces"}};

static void refuse_channel(struct mcp_job *job, int number, const char *channel)
{
    char pointer[48];
    const char *instead = NULL;
    snprintf(pointer, sizeof pointer, "/scene/outputs/%d/channel", number);
    for (size_t i = 0; i < sizeof INSTEAD / sizeof *INSTEAD; i++)
        if (strcmp(channel, INSTEAD[i][0]) == 0) instead = INSTEAD[i][1];
    mcp_fault(&job->faults, pointer, "render draws color, not '%.40s'%s%s; POST /v1/render answers all channels",
              channel, instead ? ": " : "", instead ? instead : "");
}

static void take_color(struct mcp_job *job, int number, const cJSON *output)
{
    const struct mcp_words formats = mcp_words_of_formats();
    const cJSON *key;
    cJSON_ArrayForEach(key, output)
    {
        char pointer[96];
        const bool is_taken = strcmp(key->string, "channel") == 0;
        const bool is_encoding = strcmp(key->string, "encoding") == 0 && cJSON_IsString(key);
        const char *format = is_encoding ? mcp_words_find(&formats, key->valuestring) : NULL;
        if (format && !job->format) job->format = format;
        snprintf(pointer, sizeof pointer, "/scene/outputs/%d/%.40s", number, key->string);
        if (!is_taken && !format)
            mcp_fault(&job->faults, pointer,
                      "pictures here are %s, of a size for a message; POST /v1/render has the other encodings",
                      zr_encodings_having(ZR_ENCODING_FOR_AGENTS).text);
    }
}

static void check_outputs(struct mcp_job *job, const cJSON *outputs)
{
    const cJSON *output;
    int number = 0, pictures = 0;
    if (!cJSON_IsArray(outputs) || cJSON_GetArraySize(outputs) == 0) {
        mcp_fault(&job->faults, "/scene/outputs",
                  "leave it out: render draws color, and its answer has the facts of info");
        return;
    }
    cJSON_ArrayForEach(output, outputs)
    {
        const cJSON *channel = mcp_get(output, "channel");
        char pointer[48];
        snprintf(pointer, sizeof pointer, "/scene/outputs/%d", number);
        if (!cJSON_IsString(channel))
            mcp_fault(&job->faults, pointer, "an object with a channel is expected, such as {\"channel\": \"color\"}");
        else if (strcmp(channel->valuestring, "color") == 0 && pictures++ == 0)
            take_color(job, number, output);
        else if (strcmp(channel->valuestring, "color") == 0)
            mcp_fault(&job->faults, pointer, "an answer has one picture per view");
        else if (strcmp(channel->valuestring, "info") != 0)
            refuse_channel(job, number, channel->valuestring);
        number++;
    }
}

static void read_outputs(struct mcp_job *job, struct mcp_span outputs)
{
    const size_t size = (size_t)(outputs.end - outputs.at);
    cJSON *tree = size <= OUTPUTS_BYTES ? cJSON_ParseWithLength(outputs.at, size) : NULL;
    check_outputs(job, tree);
    cJSON_Delete(tree);
}

/* Returns true if a text has the model's name as a string. Others than ASCII may be written in several ways. */
static bool has_name(const struct mcp_job *job, struct mcp_span scene)
{
    struct mcp_text name = {0};
    for (const char *at = job->model.name; *at; at++)
        if (*at < ' ' || *at > '~') return true;
    mcp_text_json(&name, job->model.name);
    const bool has = name.failed || memmem(scene.at, (size_t)(scene.end - scene.at), name.data, name.size);
    mcp_text_free(&name);
    return has;
}

bool mcp_given_next(struct zr_json *json, struct mcp_span *name)
{
    struct zr_json_text key;
    if (json->depth == 0 && zr_json_type(json) == ZR_JSON_LIST) zr_json_enter(json, '[');
    while (json->depth > 0 && !zr_json_stops(json)) {
        if (json->depth == IN_MESH) {
            if (!zr_json_member(json, &key)) continue;
            *name = mcp_span_skip(json);
            if (zr_json_is(&key, "asset") && mcp_span_is(*name, "\"model\"")) return true;
        } else if (zr_json_item(json)) {
            if (zr_json_type(json) == ZR_JSON_OBJECT)
                zr_json_enter(json, '{');
            else
                zr_json_skip(json);
        }
    }
    return false;
}

static void check_meshes(struct mcp_job *job, struct mcp_span meshes)
{
    static const char name[] = "\"model\"";
    struct mcp_span found;
    struct zr_json json = zr_json_at(&job->message->json, meshes.at);
    if (memmem(meshes.at, (size_t)(meshes.end - meshes.at), name, sizeof name - 1))
        while (mcp_given_next(&json, &found))
            job->model_meshes++;
    if (job->model_meshes > 0 && !job->model.is_given)
        mcp_fault(&job->faults, "/model", "the model is missing, which the scene names by {\"asset\": \"model\"}");
    else if (job->model_meshes == 0 && job->model.is_given && !has_name(job, meshes))
        mcp_fault(&job->faults, "/scene/meshes",
                  "no mesh is the model: give one as {\"asset\": \"model\"}, or leave the model out");
}

static bool has_several_views(const struct mcp_job *job)
{
    for (int i = MCP_OWN_VIEWS; i < MCP_OWN_COUNT; i++)
        if (job->own[i].at) return true;
    return false;
}

bool mcp_given_check(struct mcp_job *job)
{
    const struct mcp_span visibility = job->own[MCP_OWN_VISIBILITY], render = job->own[MCP_OWN_RENDER];
    if (job->own[MCP_OWN_MESHES].at) check_meshes(job, job->own[MCP_OWN_MESHES]);
    if (job->tool == MCP_FACTS && job->own[MCP_OWN_PICKS].at && has_several_views(job))
        mcp_fault(&job->faults, "/scene/picks",
                  "the pixels are those of one view: give view, and leave out views, sheet, turntable, orbit and "
                  "animate");
    if (!mcp_draws(job->tool)) return job->faults.count == 0;
    if (render.at && *render.at == 'f')
        mcp_fault(&job->faults, "/scene/render", "leave it out, or call facts, which draws nothing");
    if (job->own[MCP_OWN_SHEET].at && !mcp_job_argument(job, "sheet") && !mcp_job_argument(job, "views") &&
        cJSON_IsBool(mcp_job_argument(job, "annotate")))
        mcp_fault(&job->faults, "/annotate", "the scene has a sheet: give captions there, or a sheet here");
    if (visibility.at && *visibility.at == 't')
        mcp_fault(&job->faults, "/scene/visibility",
                  "leave it out: the answer counts the visible pixels of each part; POST /v1/render answers masks");
    if (job->tool == MCP_RENDER && job->own[MCP_OWN_OUTPUTS].at) read_outputs(job, job->own[MCP_OWN_OUTPUTS]);
    return job->faults.count == 0;
}
