#include "job.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "faults.h"

/* Arguments of each tool. */
#define OF_ALL      "model", "scene", "up"
#define OF_PICTURES OF_ALL, "views", "sheet", "look", "parts", "sections", "annotate", "width", "height"
static const char *const ARGUMENTS[MCP_TOOLS][16] = {
    [MCP_RENDER] = {OF_PICTURES, "format"}, [MCP_FACTS] = {OF_ALL}, [MCP_PICK] = {OF_PICTURES, "image", "x", "y"}};
static const char *const PARTS[] = {"hide", "isolate", "ghost", "highlight", "explode", "colors", NULL};

/* Keys of a scene that make several pictures. */
static const char *const SEVERAL[] = {"turntable", "orbit", "animate", NULL};

const cJSON *mcp_job_argument(const struct mcp_job *job, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(job->message->arguments, name);
}

static bool is_in(const char *const *list, const char *word)
{
    for (; *list; list++)
        if (strcmp(*list, word) == 0) return true;
    return false;
}

/* ---- the scene's own keys ---- */

/* Finds a member of the scene that was given. */
static struct mcp_span find_own(const struct mcp_job *job, const char *name)
{
    struct mcp_span found = {NULL, NULL}, key, value;
    if (!job->message->scene.at) return found;
    struct mcp_walk walk = mcp_walk_open(job->message->scene, job->host);
    mcp_walk_enter(&walk, '{');
    while (mcp_walk_member(&walk, &key)) {
        mcp_walk_value(&walk, &value);
        if (mcp_span_is(key, name)) found = value;
    }
    return found;
}

static unsigned count_items(const struct mcp_job *job, struct mcp_span list)
{
    unsigned count = 0;
    if (!list.at || *list.at != '[') return 0;
    struct mcp_walk walk = mcp_walk_open(list, job->host);
    mcp_walk_enter(&walk, '[');
    for (; mcp_walk_item(&walk); count++)
        mcp_walk_value(&walk, NULL);
    return count;
}

static struct mcp_span find_item(const struct mcp_job *job, struct mcp_span list, unsigned wanted)
{
    struct mcp_span value = {NULL, NULL};
    struct mcp_walk walk = mcp_walk_open(list, job->host);
    mcp_walk_enter(&walk, '[');
    for (unsigned i = 0; i <= wanted && mcp_walk_item(&walk); i++)
        mcp_walk_value(&walk, &value);
    return value;
}

/* ---- checks ---- */

static void check_names(struct mcp_job *job)
{
    const cJSON *item;
    char pointer[MCP_POINTER_SIZE];
    cJSON_ArrayForEach(item, job->message->arguments)
    {
        snprintf(pointer, sizeof pointer, "/%.100s", item->string);
        if (!is_in(ARGUMENTS[job->tool], item->string))
            mcp_fault_unknown(&job->faults, pointer, "the argument", item->string, ARGUMENTS[job->tool]);
    }
    const cJSON *parts = mcp_job_argument(job, "parts");
    if (parts && !cJSON_IsObject(parts))
        mcp_fault(&job->faults, "/parts", "an object is expected, such as {\"hide\": [\"cover\"]}");
    cJSON_ArrayForEach(item, parts)
    {
        snprintf(pointer, sizeof pointer, "/parts/%.100s", item->string ? item->string : "");
        if (item->string && !is_in(PARTS, item->string))
            mcp_fault_unknown(&job->faults, pointer, "the key", item->string, PARTS);
    }
}

/* Reads a number of pixels, or its default. */
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
    static const char *const known[] = {"png", "jpeg", "webp", NULL};
    const cJSON *given = mcp_job_argument(job, "format");
    if (!given) return;
    if (!cJSON_IsString(given))
        mcp_fault(&job->faults, "/format", "a string is expected");
    else if (!is_in(known, given->valuestring))
        mcp_fault_unknown(&job->faults, "/format", "the format", given->valuestring, known);
    else
        job->format = given->valuestring;
}

/* Finds out how many pictures there will be. */
static void read_views(struct mcp_job *job)
{
    const cJSON *views = mcp_job_argument(job, "views"), *sheet = mcp_job_argument(job, "sheet");
    const struct mcp_span own_sheet = find_own(job, "sheet");
    job->views = find_own(job, "views");
    job->has_own_views = !views && job->message->scene.at != NULL;
    if (views && (!cJSON_IsArray(views) || cJSON_GetArraySize(views) == 0)) {
        mcp_fault(&job->faults, "/views", "a list is expected, such as [\"front\", \"isometric\"]");
        return;
    }
    if (sheet && !cJSON_IsString(sheet)) mcp_fault(&job->faults, "/sheet", "balanced, threeView or views is expected");
    job->is_sheet = sheet || (!views && (own_sheet.at || !job->has_own_views));
    const unsigned count = views ? (unsigned)cJSON_GetArraySize(views) : count_items(job, job->views);
    job->images = job->is_sheet || count == 0 ? 1 : count;
    if (job->images > MCP_IMAGES_MAX)
        mcp_fault(&job->faults, views ? "/views" : "/scene/views",
                  "an answer has up to %d pictures, not %u; \"sheet\": \"views\" draws all into one", MCP_IMAGES_MAX,
                  job->images);
    for (size_t i = 0; SEVERAL[i] && !job->is_sheet && job->has_own_views; i++) {
        char pointer[48];
        snprintf(pointer, sizeof pointer, "/scene/%s", SEVERAL[i]);
        if (find_own(job, SEVERAL[i]).at)
            mcp_fault(&job->faults, pointer, "it makes many pictures: leave it out, or give a sheet or views");
    }
}

/* The window of a scene stays, unless it is too large. */
static void keep_window(struct mcp_job *job, unsigned *width, unsigned *height)
{
    const struct mcp_span own = find_own(job, "window");
    cJSON *window = own.at ? cJSON_ParseWithLength(own.at, (size_t)(own.end - own.at)) : NULL;
    const cJSON *w = cJSON_GetObjectItemCaseSensitive(window, "width"),
                *h = cJSON_GetObjectItemCaseSensitive(window, "height");
    const double wide = w ? w->valuedouble : 640, high = h ? h->valuedouble : 480, larger = wide > high ? wide : high;
    if (window && wide >= 1 && high >= 1 && larger <= 1e6) {
        job->is_resized = larger > MCP_SIDE_MAX;
        const double factor = job->is_resized ? MCP_SIDE_MAX / larger : 1;
        *width = wide * factor < 1 ? 1 : (unsigned)(wide * factor);
        *height = high * factor < 1 ? 1 : (unsigned)(high * factor);
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
    if (tool != MCP_FACTS) {
        read_views(job);
        if (job->images > MCP_IMAGES_MAX) return false;
        read_window(job);
    }
    if (tool == MCP_RENDER) read_format(job);
    if (tool == MCP_PICK) read_pixel(job);
    return job->faults.count == 0;
}

/* ---- the scene ---- */

enum { TAKEN_MAX = 32 };

/* The keys that the arguments give, before the scene's own. */
struct head {
    struct mcp_text text;
    const char *taken[TAKEN_MAX + 1];
    size_t count;
};

static void take(struct head *head, const char *key)
{
    if (head->count < TAKEN_MAX) head->taken[head->count++] = key;
}

static void put(struct head *head, const char *key, const char *json)
{
    take(head, key);
    mcp_text_print(&head->text, "%s\"%s\":%s", head->text.size > 1 ? "," : "", key, json);
}

static void put_item(struct head *head, const char *key, const cJSON *item)
{
    char *json = item ? cJSON_PrintUnformatted(item) : NULL;
    if (json)
        put(head, key, json);
    else if (item)
        head->text.failed = true;
    cJSON_free(json);
}

static void put_meshes(const struct mcp_job *job, struct head *head)
{
    struct mcp_text json = {0};
    mcp_text_put(&json, "[{\"asset\":");
    mcp_text_json(&json, job->model.name);
    mcp_text_put(&json, "}]");
    if (json.failed)
        head->text.failed = true;
    else
        put(head, "meshes", json.data);
    mcp_text_free(&json);
}

static void put_sheet(const struct mcp_job *job, struct head *head)
{
    const cJSON *sheet = mcp_job_argument(job, "sheet"), *annotate = mcp_job_argument(job, "annotate");
    struct mcp_text json = {0};
    if (!sheet && job->has_own_views && find_own(job, "sheet").at) return; /* the scene's */
    mcp_text_put(&json, "{\"layout\":");
    mcp_text_json(&json, sheet ? sheet->valuestring : mcp_job_argument(job, "views") ? "views" : "balanced");
    mcp_text_print(&json, ",\"captions\":%s}", cJSON_IsFalse(annotate) ? "false" : "true");
    if (json.failed)
        head->text.failed = true;
    else
        put(head, "sheet", json.data);
    mcp_text_free(&json);
}

/* Puts one item of a list of views, as the only one. */
static void put_only(const struct mcp_job *job, struct head *head, unsigned only)
{
    const cJSON *views = mcp_job_argument(job, "views");
    struct mcp_text json = {0};
    if (views) {
        char *item = cJSON_PrintUnformatted(cJSON_GetArrayItem(views, (int)only));
        mcp_text_print(&json, "[%s]", item ? item : "");
        json.failed |= !item;
        cJSON_free(item);
    } else {
        const struct mcp_span item = find_item(job, job->views, only);
        mcp_text_put(&json, "[");
        mcp_text_add(&json, item.at, item.at ? (size_t)(item.end - item.at) : 0);
        mcp_text_put(&json, "]");
    }
    if (json.failed)
        head->text.failed = true;
    else
        put(head, "views", json.data);
    mcp_text_free(&json);
}

static void drop_views(struct head *head)
{
    static const char *const keys[] = {"views", "sheet", "turntable", "orbit", "animate"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        take(head, keys[i]);
}

static void put_views(const struct mcp_job *job, const struct mcp_picture *picture, struct head *head)
{
    const cJSON *views = mcp_job_argument(job, "views"), *sheet = mcp_job_argument(job, "sheet");
    const bool names_views = sheet && cJSON_IsString(sheet) && strcmp(sheet->valuestring, "views") != 0;
    if (picture->view) {
        put(head, "view", picture->view);
        drop_views(head);
    } else if (picture->only >= 0 && (views || job->views.at)) {
        put_only(job, head, (unsigned)picture->only);
        drop_views(head);
    } else if (job->is_sheet) {
        put_sheet(job, head);
        if (views) put_item(head, "views", views);
        if (views || names_views) drop_views(head);
    } else if (views) {
        put_item(head, "views", views);
        drop_views(head);
    }
    /* Parallel rays show lengths; the presets of a list keep the projection of the view. */
    if (!job->message->scene.at && !picture->view) put(head, "view", "{\"preset\":\"isometric\",\"orthographic\":{}}");
}

/* Puts what concerns pictures alone. */
static void put_picture(const struct mcp_job *job, const struct mcp_picture *picture, struct head *head)
{
    char window[64];
    const cJSON *item;
    const bool is_bare = !job->message->scene.at;
    snprintf(window, sizeof window, "{\"width\":%u,\"height\":%u}", picture->width, picture->height);
    put(head, "window", window);
    put_views(job, picture, head);
    item = mcp_job_argument(job, "look");
    if (item)
        put_item(head, "look", item);
    else if (is_bare)
        put(head, "look", "\"studio\"");
    item = mcp_job_argument(job, "up");
    if (item)
        put_item(head, "up", item);
    else if (is_bare)
        put(head, "up", job->model.z_is_up ? "\"z\"" : "\"y\"");
    put_item(head, "sections", mcp_job_argument(job, "sections"));
    cJSON_ArrayForEach(item, mcp_job_argument(job, "parts")) put_item(head, item->string, item);
}

/* Copies the members of the given scene that are not taken. */
static size_t copy_own(const struct mcp_job *job, const struct head *head, char *out)
{
    struct mcp_span key, value;
    size_t size = 0;
    struct mcp_walk walk = mcp_walk_open(job->message->scene, job->host);
    mcp_walk_enter(&walk, '{');
    while (mcp_walk_member(&walk, &key)) {
        mcp_walk_value(&walk, &value);
        bool is_taken = false;
        for (size_t i = 0; i < head->count && !is_taken; i++)
            is_taken = mcp_span_is(key, head->taken[i]);
        if (is_taken || !value.at) continue;
        out[size++] = ',';
        const size_t length = (size_t)(value.end - key.at) + 1;
        memcpy(out + size, key.at - 1, length);
        size += length;
    }
    return size;
}

bool mcp_job_compose(const struct mcp_job *job, const struct mcp_picture *picture, struct mcp_draw *draw)
{
    const struct mcp_span own = job->message->scene;
    struct head head = {.count = 0};
    mcp_text_put(&head.text, "{");
    put(&head, "outputs", picture->outputs);
    if (!own.at) put_meshes(job, &head);
    if (picture->width > 0) {
        put_picture(job, picture, &head);
    } else {
        put(&head, "render", "false");
        put_item(&head, "up", mcp_job_argument(job, "up"));
        drop_views(&head);
    }
    const size_t own_size = own.at ? (size_t)(own.end - own.at) : 0;
    char *scene = head.text.failed ? NULL : job->host->allocate(job->host->context, head.text.size + own_size + 3);
    if (scene) {
        memcpy(scene, head.text.data, head.text.size);
        size_t size = head.text.size;
        if (own.at) size += copy_own(job, &head, scene + size);
        scene[size++] = '}';
        const bool has_file = job->model.is_given && strncmp(job->model.name, "sha256:", 7) != 0;
        *draw = (struct mcp_draw){.scene = scene,
                                  .scene_size = size,
                                  .file_name = has_file ? job->model.name : NULL,
                                  .file = job->model.bytes,
                                  .file_size = job->model.size,
                                  .path = job->model.path};
    }
    mcp_text_free(&head.text);
    return scene;
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
    if (cJSON_GetObjectItemCaseSensitive(mcp_job_argument(job, "parts"), key))
        replace(pointer, 0, "/parts");
    else if (strcmp(key, "window") == 0)
        replace(pointer, length + 1, "");
    else if (strcmp(key, "outputs") == 0)
        replace(pointer, strlen(pointer), mcp_job_argument(job, "format") ? "/format" : "");
    else if (mcp_job_argument(job, key))
        return;
    else if (job->message->scene.at)
        replace(pointer, 0, "/scene");
    else if (strcmp(key, "meshes") == 0)
        replace(pointer, strlen(pointer), "/model");
}
