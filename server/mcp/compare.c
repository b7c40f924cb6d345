#include "compare.h"

#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "faults.h"
#include "memory.h"
#include "model.h"
#include "told.h"
#include "tree.h"

/* ---- arguments ---- */

static void check_names(const struct mcp_message *message, struct mcp_faults *faults)
{
    const struct mcp_words known = mcp_words_of_keys(mcp_arguments, 1u << MCP_COMPARE);
    const cJSON *item;
    cJSON_ArrayForEach(item, message->arguments)
    {
        char pointer[MCP_POINTER_SIZE];
        snprintf(pointer, sizeof pointer, "/%.100s", item->string);
        if (!mcp_words_find(&known, item->string))
            mcp_fault_unknown(faults, pointer, "the argument", item->string, &known);
    }
}

/* Adds a word to the query. */
static void add_word(const struct mcp_message *message, const char *name, const char *otherwise, struct mcp_text *query,
                     struct mcp_faults *faults)
{
    const cJSON *given = mcp_get(message->arguments, name);
    char pointer[32];
    snprintf(pointer, sizeof pointer, "/%s", name);
    const char *word = cJSON_IsString(given) ? given->valuestring : otherwise;
    if (given && (!cJSON_IsString(given) || word[strcspn(word, "&=%+ ")] != '\0' || strlen(word) > 60))
        mcp_fault(faults, pointer, "a word is expected");
    else if (word)
        mcp_text_print(query, "%s%s=%s", query->size > 0 ? "&" : "", name, word);
}

/* Adds "on" or "off" to the query. */
static void add_switch(const struct mcp_message *message, const char *name, struct mcp_text *query,
                       struct mcp_faults *faults)
{
    const cJSON *given = mcp_get(message->arguments, name);
    char pointer[32];
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (given && !cJSON_IsBool(given))
        mcp_fault(faults, pointer, "true or false is expected");
    else if (given)
        mcp_text_print(query, "&%s=%s", name, cJSON_IsTrue(given) ? "on" : "off");
}

static void make_query(const struct mcp_message *message, struct mcp_text *query, struct mcp_faults *faults)
{
    static const char *const names[] = {"align", "look", "view"}, *const switches[] = {"rescale", "deviation",
                                                                                       "features"};
    const cJSON *tolerance = mcp_get(message->arguments, "tolerance");
    add_word(message, "show", "difference", query, faults);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        add_word(message, names[i], NULL, query, faults);
    for (size_t i = 0; i < sizeof switches / sizeof *switches; i++)
        add_switch(message, switches[i], query, faults);
    if (tolerance && !(cJSON_IsNumber(tolerance) && tolerance->valuedouble >= 0))
        mcp_fault(faults, "/tolerance", "a length of at least 0 is expected");
    else if (tolerance)
        mcp_text_print(query, "&tolerance=%.17g", tolerance->valuedouble);
}

/* Writes the scene that has the model alone, with the axes of its file. */
static void make_scene(const struct mcp_model *model, struct mcp_text *scene, struct mcp_draw *draw)
{
    mcp_text_print(scene, "{%s\"meshes\":[{\"asset\":", model->z_is_up ? "\"up\":\"z\"," : "");
    mcp_text_json(scene, model->name);
    mcp_text_put(scene, "}]}");
    *draw = (struct mcp_draw){.scene = scene->data,
                              .scene_size = scene->size,
                              .file_name = model->bytes ? model->name : NULL,
                              .file = model->bytes,
                              .file_size = model->size,
                              .path = model->path};
}

/* ---- the result ---- */

/* Parameters of the query are arguments: "align" becomes "/align". */
static void take_faults(const struct mcp_faults *from, struct mcp_faults *faults)
{
    for (size_t i = 0; i < from->count; i++) {
        const struct mcp_fault *fault = &from->at[i];
        char pointer[MCP_POINTER_SIZE];
        snprintf(pointer, sizeof pointer, "%s%.180s", *fault->pointer && *fault->pointer != '/' ? "/" : "",
                 fault->pointer);
        mcp_fault(faults, pointer, "%s", fault->detail);
    }
}

static enum mcp_draw_status run(const struct mcp_host *host, const struct mcp_compare *compare,
                                struct mcp_faults *faults, struct mcp_text *result)
{
    struct mcp_told *told = host->compare ? host->allocate(host->context, sizeof *told) : NULL;
    if (!told) mcp_fault(faults, "", host->compare ? "out of memory" : "this server does not compare models");
    if (!told) return MCP_REFUSED;
    *told = (struct mcp_told){.json = NULL};
    const enum mcp_draw_status status = host->compare(host->context, compare, told);
    if (status == MCP_REFUSED) take_faults(&told->faults, faults);
    if (status != MCP_DRAWN) return status;
    if (mcp_memory_has_failed())
        result->failed = true;
    else
        mcp_told_put(told, NULL, false, result);
    host->release_told(host->context, told);
    return MCP_DRAWN;
}

enum mcp_draw_status mcp_compare_call(const struct mcp_host *host, const struct mcp_message *message,
                                      struct mcp_faults *faults, struct mcp_text *result)
{
    struct mcp_model models[2];
    struct mcp_text query = {0}, scenes[2] = {{0}, {0}};
    struct mcp_compare compare;
    enum mcp_draw_status status = MCP_REFUSED;
    bool are_read = true;
    check_names(message, faults);
    make_query(message, &query, faults);
    for (int i = 0; i < 2; i++)
        are_read = mcp_side_read(host, message, i, &models[i], faults) && are_read;
    for (int i = 0; i < 2 && are_read; i++)
        make_scene(&models[i], &scenes[i], &compare.sides[i]);
    compare.query = query.data;
    if (mcp_host_is_cancelled(host))
        status = MCP_CANCELLED;
    else if (are_read && faults->count == 0 && !query.failed && !scenes[0].failed && !scenes[1].failed)
        status = run(host, &compare, faults, result);
    mcp_text_free(&query);
    for (int i = 0; i < 2; i++)
        mcp_text_free(&scenes[i]);
    return status;
}
