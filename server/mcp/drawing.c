#include "drawing.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "compose.h"
#include "drawing_rows.h"
#include "faults.h"
#include "memory.h"
#include "shots.h"
#include "told.h"
#include "tree.h"

/* Pixels per inch of the usual pictures, which have up to MCP_SIDE_MAX pixels per side: papers of 16.54 and 11.69
 * inches. */
#define DPI_A3 "94"
#define DPI_A4 "134"

/* ---- the query ---- */

static void add_name(struct mcp_text *query, const char *name)
{
    mcp_text_print(query, "%s%s=", query->size > 0 ? "&" : "", name);
}

static void add_text(struct mcp_text *query, const char *name, const char *value)
{
    add_name(query, name);
    for (; *value; value++)
        mcp_text_print(query, isalnum((unsigned char)*value) ? "%c" : "%%%02X", (unsigned char)*value);
}

static void add_argument(struct mcp_job *job, const char *name, struct mcp_text *query)
{
    const cJSON *given = mcp_job_argument(job, name);
    char pointer[32];
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (cJSON_IsString(given)) {
        add_text(query, name, given->valuestring);
    } else if (cJSON_IsBool(given)) {
        add_text(query, name, cJSON_IsTrue(given) ? "true" : "false");
    } else if (cJSON_IsNumber(given)) {
        char number[32];
        snprintf(number, sizeof number, "%.9g", given->valuedouble);
        add_text(query, name, number);
    } else if (given) {
        mcp_fault(&job->faults, pointer, "a word, a number, true or false is expected");
    }
}

static bool is_word(const struct mcp_job *job, const char *name, const char *word)
{
    const cJSON *given = mcp_job_argument(job, name);
    return cJSON_IsString(given) && strcmp(given->valuestring, word) == 0;
}

static void make_query(struct mcp_job *job, struct mcp_text *query)
{
#define ADD(name, ...) add_argument(job, #name, query);
    ZR_DRAWING_ROWS(ADD)
#undef ADD
    if (!mcp_job_argument(job, "format")) add_text(query, "format", "png");
    if (!mcp_job_argument(job, "title") && job->model.path) add_text(query, "title", job->model.name);
    if (!mcp_job_argument(job, "dpi")) add_text(query, "dpi", is_word(job, "page", "a4") ? DPI_A4 : DPI_A3);
}

/* ---- the result ---- */

/* Faults of a parameter are of the argument of its name; those of the scene have pointers. */
static void take_faults(const struct mcp_faults *from, struct mcp_job *job)
{
    static const char word[] = "parameter ";
    for (size_t i = 0; i < from->count; i++) {
        const char *detail = from->at[i].detail, *colon = strstr(detail, ": ");
        char pointer[MCP_POINTER_SIZE];
        snprintf(pointer, sizeof pointer, "%s", from->at[i].pointer);
        mcp_job_point(job, pointer);
        if (!*pointer && colon && strncmp(detail, word, sizeof word - 1) == 0) {
            const int length = (int)(colon - detail) - (int)(sizeof word - 1);
            snprintf(pointer, sizeof pointer, "/%.*s", length < 60 ? length : 60, detail + sizeof word - 1);
            detail = colon + 2;
        }
        mcp_fault(&job->faults, pointer, "%s", detail);
    }
}

/* Checks that a message can have the picture. */
static bool is_small(struct mcp_job *job, bool is_svg, size_t size)
{
    const size_t characters = is_svg ? size : (size + 2) / 3 * 4;
    if (characters <= MCP_IMAGE_BYTES_MAX) return true;
    return mcp_fault(&job->faults, is_svg ? "/format" : "/dpi", "the drawing has %zu characters, more than %d: %s",
                     characters, MCP_IMAGE_BYTES_MAX, is_svg ? "a png has fewer" : "a smaller dpi has fewer");
}

static const char *name_of(const struct mcp_job *job)
{
    return job->model.is_given ? job->model.name : "scene";
}

static enum mcp_draw_status run(struct mcp_job *job, const struct mcp_draw *draw, const char *query,
                                struct mcp_text *result)
{
    const struct mcp_host *host = job->host;
    const bool is_svg = is_word(job, "format", "svg");
    struct mcp_told *told = host->drawing ? host->allocate(host->context, sizeof *told) : NULL;
    if (!told) mcp_fault(&job->faults, "", host->drawing ? "out of memory" : "this server makes no technical drawings");
    if (!told) return MCP_REFUSED;
    *told = (struct mcp_told){.json = NULL};
    enum mcp_draw_status status = host->drawing(host->context, draw, query, told);
    if (status == MCP_REFUSED) take_faults(&told->faults, job);
    if (status != MCP_DRAWN) return status;
    if (mcp_memory_has_failed())
        result->failed = true;
    else if (is_small(job, is_svg, told->picture_size))
        mcp_told_put(told, name_of(job), is_svg, result);
    else
        status = MCP_REFUSED;
    host->release_told(host->context, told);
    return status;
}

enum mcp_draw_status mcp_drawing_call(struct mcp_job *job, struct mcp_text *result)
{
    static const struct mcp_picture none = {.outputs = "[{\"channel\":\"info\"}]", .only = -1};
    struct mcp_text query = {0};
    struct mcp_draw draw;
    enum mcp_draw_status status = MCP_REFUSED;
    make_query(job, &query);
    if (query.failed || (job->faults.count == 0 && !mcp_compose(job, &none, &draw)))
        mcp_fault(&job->faults, "", "out of memory");
    else if (job->faults.count == 0)
        status = run(job, &draw, query.data, result);
    mcp_text_free(&query);
    return status;
}
