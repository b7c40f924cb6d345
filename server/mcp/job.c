#include "job.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "faults.h"
#include "scene/defaults.h"
#include "tree.h"

static const char *const OWN[MCP_OWN_COUNT] = {[MCP_OWN_MESHES] = "meshes",
                                               [MCP_OWN_LOOK] = "look",
                                               [MCP_OWN_UP] = "up",
                                               [MCP_OWN_OUTPUTS] = "outputs",
                                               [MCP_OWN_VISIBILITY] = "visibility",
                                               [MCP_OWN_RENDER] = "render",
                                               [MCP_OWN_WINDOW] = "window",
                                               [MCP_OWN_PICKS] = "picks",
                                               [MCP_OWN_VIEW] = "view",
                                               [MCP_OWN_VIEWS] = "views",
                                               [MCP_OWN_SHEET] = "sheet",
                                               [MCP_OWN_TURNTABLE] = "turntable",
                                               [MCP_OWN_ORBIT] = "orbit",
                                               [MCP_OWN_ANIMATE] = "animate"};

const cJSON *mcp_job_argument(const struct mcp_job *job, const char *name)
{
    return mcp_get(job->message->arguments, name);
}

/* ---- the scene's own keys ---- */

/* Finds the keys in one pass; the last of a name counts. */
static void find_own(struct mcp_job *job)
{
    struct zr_json_text key;
    if (!job->message->scene.at) return;
    struct zr_json json = zr_json_at(&job->message->json, job->message->scene.at);
    zr_json_enter(&json, '{');
    while (zr_json_member(&json, &key)) {
        const struct mcp_span value = mcp_span_skip(&json);
        for (int i = 0; i < MCP_OWN_COUNT; i++)
            if (zr_json_is(&key, OWN[i])) job->own[i] = value;
    }
}

static unsigned count_items(const struct mcp_job *job, struct mcp_span list)
{
    unsigned count = 0;
    if (!list.at || *list.at != '[') return 0;
    struct zr_json json = zr_json_at(&job->message->json, list.at);
    zr_json_enter(&json, '[');
    for (; zr_json_item(&json); count++)
        zr_json_skip(&json);
    return count;
}

/* ---- checks ---- */

static void check_parts(struct mcp_job *job)
{
    const struct mcp_words known = mcp_words_of_keys(mcp_part_keys, ~0u);
    const cJSON *parts = mcp_job_argument(job, "parts"), *item;
    char pointer[MCP_POINTER_SIZE];
    if (parts && !cJSON_IsObject(parts))
        mcp_fault(&job->faults, "/parts", "an object is expected, such as {\"hide\": [\"cover\"]}");
    cJSON_ArrayForEach(item, parts)
    {
        snprintf(pointer, sizeof pointer, "/parts/%.100s", item->string ? item->string : "");
        if (item->string && !mcp_words_find(&known, item->string))
            mcp_fault_unknown(&job->faults, pointer, "the key", item->string, &known);
    }
}

static void check_names(struct mcp_job *job)
{
    const struct mcp_words known = mcp_words_of_keys(mcp_arguments, 1u << job->tool),
                           sources = mcp_words_of_keys(mcp_model_sources, ~0u);
    const cJSON *item;
    char pointer[MCP_POINTER_SIZE];
    cJSON_ArrayForEach(item, job->message->arguments)
    {
        snprintf(pointer, sizeof pointer, "/%.100s", item->string);
        if (mcp_words_find(&known, item->string)) continue;
        if (mcp_words_find(&sources, item->string))
            mcp_fault(&job->faults, pointer, "it is a key of model: {\"model\": {\"%s\": ...}}", item->string);
        else
            mcp_fault_unknown(&job->faults, pointer, "the argument", item->string, &known);
    }
    if (job->faults.count > 0)
        mcp_fault(&job->faults, "",
                  "other keys, such as background and lights, go into scene; a model may be beside it");
    const cJSON *annotate = mcp_job_argument(job, "annotate");
    if (annotate && !cJSON_IsBool(annotate) && !cJSON_IsArray(annotate))
        mcp_fault(&job->faults, "/annotate", "true or false, or a list of words, is expected");
    check_parts(job);
}

/* Reads a whole number, or its default. */
static unsigned read_number(struct mcp_job *job, const char *name, unsigned least, unsigned most, unsigned otherwise)
{
    const cJSON *given = mcp_job_argument(job, name);
    char pointer[32];
    if (!given) return otherwise;
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (cJSON_IsNumber(given) && given->valuedouble >= least && given->valuedouble <= most &&
        given->valuedouble == (unsigned)given->valuedouble)
        return (unsigned)given->valuedouble;
    mcp_fault(&job->faults, pointer, "a whole number from %u to %u is expected", least, most);
    return otherwise;
}

static void read_format(struct mcp_job *job)
{
    const struct mcp_words known = mcp_words_of_formats();
    const cJSON *given = mcp_job_argument(job, "format");
    if (!given) return;
    if (!cJSON_IsString(given))
        mcp_fault(&job->faults, "/format", "a string is expected");
    else if (!(job->format = mcp_words_find(&known, given->valuestring)))
        mcp_fault_unknown(&job->faults, "/format", "the format", given->valuestring, &known);
}

/* Counts the pictures of the answer. */
static void read_views(struct mcp_job *job)
{
    const cJSON *views = mcp_job_argument(job, "views"), *sheet = mcp_job_argument(job, "sheet");
    job->has_own_views = !views && !job->is_bare;
    for (int i = MCP_OWN_VIEW; i < MCP_OWN_COUNT && !views; i++)
        job->has_own_views = job->has_own_views || job->own[i].at;
    if (views && (!cJSON_IsArray(views) || cJSON_GetArraySize(views) == 0)) {
        mcp_fault(&job->faults, "/views", "a list is expected, such as [\"front\", \"isometric\"]");
        return;
    }
    if (sheet && !cJSON_IsString(sheet)) mcp_fault(&job->faults, "/sheet", "balanced, threeView or views is expected");
    job->is_sheet = sheet || (!views && (job->own[MCP_OWN_SHEET].at || !job->has_own_views));
    const unsigned count = views ? (unsigned)cJSON_GetArraySize(views) : count_items(job, job->own[MCP_OWN_VIEWS]);
    job->images = job->is_sheet || count == 0 ? 1 : count;
    if (job->images > MCP_IMAGES_MAX)
        mcp_fault(&job->faults, views ? "/views" : "/scene/views",
                  "an answer has up to %d pictures, not %u; \"sheet\": \"views\" draws all into one", MCP_IMAGES_MAX,
                  job->images);
    for (int i = MCP_OWN_TURNTABLE; i < MCP_OWN_COUNT && !job->is_sheet && job->has_own_views; i++) {
        char pointer[48];
        snprintf(pointer, sizeof pointer, "/scene/%s", OWN[i]);
        if (job->own[i].at)
            mcp_fault(&job->faults, pointer, "it makes many pictures: leave it out, or give a sheet or views");
    }
}

/* The window of a scene stays, unless it is too large. */
static void keep_window(struct mcp_job *job, unsigned *width, unsigned *height)
{
    const struct mcp_span own = job->own[MCP_OWN_WINDOW];
    cJSON *window = own.at ? cJSON_ParseWithLength(own.at, (size_t)(own.end - own.at)) : NULL;
    const cJSON *w = mcp_get(window, "width"), *h = mcp_get(window, "height");
    const double wide = w ? w->valuedouble : ZR_DEFAULT_WIDTH, high = h ? h->valuedouble : ZR_DEFAULT_HEIGHT,
                 larger = wide > high ? wide : high;
    if (window && wide >= 1 && high >= 1 && larger <= 1e6) {
        job->is_resized = larger > MCP_SIDE_MAX;
        const double factor = job->is_resized ? MCP_SIDE_MAX / larger : 1;
        *width = wide * factor < 1 ? 1 : (unsigned)(wide * factor + 0.5);
        *height = high * factor < 1 ? 1 : (unsigned)(high * factor + 0.5);
    }
    cJSON_Delete(window);
}

static void read_window(struct mcp_job *job)
{
    static const unsigned sizes[][2] = {{800, 600}, {640, 480}, {512, 384}};
    const unsigned *size = sizes[job->images == 1 ? 0 : job->images <= 4 ? 1 : 2];
    unsigned width = job->is_sheet ? 1024 : size[0], height = job->is_sheet ? 768 : size[1];
    keep_window(job, &width, &height);
    job->width = read_number(job, "width", MCP_SIDE_MIN, MCP_SIDE_MAX, width);
    job->height = read_number(job, "height", MCP_SIDE_MIN, MCP_SIDE_MAX, height);
}

static void read_pixel(struct mcp_job *job)
{
    for (int i = 0; i < 2; i++) {
        const char *name = i == 0 ? "x" : "y";
        if (!mcp_job_argument(job, name))
            mcp_fault(&job->faults, i == 0 ? "/x" : "/y", "the pixel's %s is missing",
                      i == 0 ? "column, from 0 at the left," : "row, from 0 at the top,");
    }
    job->image = read_number(job, "image", 0, job->images - 1, 0);
    job->x = read_number(job, "x", 0, job->width - 1, 0);
    job->y = read_number(job, "y", 0, job->height - 1, 0);
    const bool has_x = mcp_job_argument(job, "toX") != NULL, has_y = mcp_job_argument(job, "toY") != NULL;
    if (has_x != has_y) mcp_fault(&job->faults, has_x ? "/toY" : "/toX", "missing beside %s", has_x ? "toX" : "toY");
    job->has_to = has_x && has_y;
    job->to_x = read_number(job, "toX", 0, job->width - 1, 0);
    job->to_y = read_number(job, "toY", 0, job->height - 1, 0);
}

bool mcp_job_read(struct mcp_job *job, const struct mcp_host *host, const struct mcp_message *message,
                  enum mcp_tool tool)
{
    *job = (struct mcp_job){.host = host, .message = message, .tool = tool, .images = 1};
    const cJSON *scene = mcp_job_argument(job, "scene");
    check_names(job);
    if (scene && !cJSON_IsObject(scene)) mcp_fault(&job->faults, "/scene", "an object is expected");
    if (!scene && !mcp_job_argument(job, "model"))
        mcp_fault(&job->faults, "", "give a model, a scene, or a scene that names the model");
    if (!mcp_model_read(host, message, &job->model, &job->faults)) return false;
    find_own(job);
    job->is_bare = !job->message->scene.at || (job->model.is_given && !job->own[MCP_OWN_MESHES].at);
    if (tool == MCP_RENDER) read_format(job);
    if (mcp_draws(tool)) {
        read_views(job);
        if (job->images > MCP_IMAGES_MAX) return false;
        read_window(job);
    }
    if (tool == MCP_PICK) read_pixel(job);
    return job->faults.count == 0;
}

/* ---- pointers ---- */

/* Replaces the first `length` characters of a pointer. */
static void replace(char pointer[MCP_POINTER_SIZE], size_t length, const char *by)
{
    char rest[MCP_POINTER_SIZE];
    snprintf(rest, sizeof rest, "%s", pointer + length);
    snprintf(pointer, MCP_POINTER_SIZE, "%.60s%.120s", by, rest);
}

void mcp_job_point(const struct mcp_job *job, char pointer[MCP_POINTER_SIZE])
{
    if (*pointer != '/') return;
    const size_t length = strcspn(pointer + 1, "/");
    char key[64];
    snprintf(key, sizeof key, "%.*s", (int)(length < 60 ? length : 60), pointer + 1);
    if (mcp_get(mcp_job_argument(job, "parts"), key))
        replace(pointer, 0, "/parts");
    else if (strcmp(key, "window") == 0)
        replace(pointer, length + 1, "");
    else if (strcmp(key, "outputs") == 0)
        replace(pointer, strlen(pointer), mcp_job_argument(job, "format") ? "/format" : "");
    else if (mcp_job_argument(job, key))
        return;
    else if (job->is_bare && strcmp(key, "meshes") == 0)
        replace(pointer, strlen(pointer), "/model");
    else if (job->message->scene.at)
        replace(pointer, 0, "/scene");
}
