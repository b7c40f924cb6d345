#include "compose.h"

#include <stdio.h>
#include <string.h>

#include "text.h"

static struct mcp_span find_item(const struct mcp_job *job, struct mcp_span list, unsigned wanted)
{
    struct mcp_span value = {NULL, NULL};
    struct zr_json json = zr_json_at(&job->message->json, list.at);
    zr_json_enter(&json, '[');
    for (unsigned i = 0; i <= wanted && zr_json_item(&json); i++)
        value = mcp_span_skip(&json);
    return value;
}

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
    if (!sheet && job->has_own_views && job->own[MCP_OWN_SHEET].at) return; /* the scene's */
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
        const struct mcp_span item = find_item(job, job->own[MCP_OWN_VIEWS], only);
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
    } else if (picture->only >= 0 && (views || job->own[MCP_OWN_VIEWS].at)) {
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
    if (job->is_bare && !job->own[MCP_OWN_VIEW].at && !picture->view)
        put(head, "view", "{\"preset\":\"isometric\",\"orthographic\":{}}");
}

static void put_up(const struct mcp_job *job, struct head *head)
{
    const cJSON *up = mcp_job_argument(job, "up");
    if (up)
        put_item(head, "up", up);
    else if (job->is_bare && !job->own[MCP_OWN_UP].at)
        put(head, "up", job->model.z_is_up ? "\"z\"" : "\"y\"");
}

/* Puts what concerns pictures alone. */
static void put_picture(const struct mcp_job *job, const struct mcp_picture *picture, struct head *head)
{
    char window[64];
    const cJSON *item;
    snprintf(window, sizeof window, "{\"width\":%u,\"height\":%u}", picture->width, picture->height);
    put(head, "window", window);
    put_views(job, picture, head);
    item = mcp_job_argument(job, "look");
    if (item)
        put_item(head, "look", item);
    else if (job->is_bare && !job->own[MCP_OWN_LOOK].at)
        put(head, "look", "\"studio\"");
    put_item(head, "materials", mcp_job_argument(job, "materials"));
    item = mcp_job_argument(job, "annotate");
    if (item && cJSON_IsArray(item)) put_item(head, "annotate", item);
    put_up(job, head);
    if (picture->picks) put(head, "picks", picture->picks);
    put_item(head, "sections", mcp_job_argument(job, "sections"));
    cJSON_ArrayForEach(item, mcp_job_argument(job, "parts")) put_item(head, item->string, item);
}

/* Copies a member of the given scene: `meshes` with the model's name, a JSON string, in place of each "model". */
static size_t copy_member(const struct mcp_job *job, struct mcp_span member, const struct mcp_text *name, char *out)
{
    const struct mcp_span meshes = job->own[MCP_OWN_MESHES];
    const char *from = member.at;
    char *end = out;
    struct zr_json json = zr_json_at(&job->message->json, meshes.at);
    struct mcp_span found;
    for (unsigned i = 0; i < job->model_meshes && meshes.end == member.end && mcp_given_next(&json, &found); i++) {
        end = mempcpy(end, from, (size_t)(found.at - from));
        end = mempcpy(end, name->data, name->size);
        from = found.end;
    }
    end = mempcpy(end, from, (size_t)(member.end - from));
    return (size_t)(end - out);
}

/* Copies the members of the given scene that are not taken. */
static size_t copy_own(const struct mcp_job *job, const struct head *head, const struct mcp_text *name, char *out)
{
    struct zr_json_text key;
    size_t size = 0;
    struct zr_json json = zr_json_at(&job->message->json, job->message->scene.at);
    zr_json_enter(&json, '{');
    while (zr_json_member(&json, &key)) {
        const struct mcp_span value = mcp_span_skip(&json);
        bool is_taken = false;
        for (size_t i = 0; i < head->count && !is_taken; i++)
            is_taken = zr_json_is(&key, head->taken[i]);
        if (is_taken || !value.at) continue;
        out[size++] = ',';
        size += copy_member(job, (struct mcp_span){key.at - 1, value.end}, name, out + size);
    }
    return size;
}

bool mcp_compose(const struct mcp_job *job, const struct mcp_picture *picture, struct mcp_draw *draw)
{
    const struct mcp_span own = job->message->scene;
    struct head head = {.count = 0};
    mcp_text_put(&head.text, "{");
    put(&head, "outputs", picture->outputs);
    if (job->is_bare) put_meshes(job, &head);
    if (picture->width > 0) {
        put_picture(job, picture, &head);
    } else if (job->tool == MCP_DRAWING) {
        put_up(job, &head);
    } else {
        /* Pixels that are picked are those of the scene's view. */
        if (job->own[MCP_OWN_PICKS].at)
            put_up(job, &head);
        else
            put_item(&head, "up", mcp_job_argument(job, "up"));
        if (!job->own[MCP_OWN_PICKS].at) put(&head, "render", "false");
        put(&head, "features", "true");
        drop_views(&head);
        take(&head, "visibility");
    }
    struct mcp_text name = {0};
    mcp_text_json(&name, job->model.name);
    const size_t own_size = (own.at ? (size_t)(own.end - own.at) : 0) + job->model_meshes * name.size;
    char *scene =
        head.text.failed || name.failed ? NULL : job->host->allocate(job->host->context, head.text.size + own_size + 3);
    if (scene) {
        memcpy(scene, head.text.data, head.text.size);
        size_t size = head.text.size;
        if (own.at) size += copy_own(job, &head, &name, scene + size);
        scene[size++] = '}';
        const bool has_file = job->model.is_given && strncmp(job->model.name, "sha256:", 7) != 0;
        *draw = (struct mcp_draw){.scene = scene,
                                  .scene_size = size,
                                  .file_name = has_file ? job->model.name : NULL,
                                  .file = job->model.bytes,
                                  .file_size = job->model.size,
                                  .path = job->model.path};
    }
    mcp_text_free(&name);
    mcp_text_free(&head.text);
    return scene;
}
