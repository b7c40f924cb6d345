#include "problem.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "base/visible.h"
#include "cost/cost.h"
#include "text.h"

int problem_http_status(enum zr_status status)
{
    switch (status) {
    case ZR_OK:
        return 200;
    case ZR_BAD_SYNTAX:
        return 400;
    case ZR_BAD_REQUEST:
        return 400;
    case ZR_BAD_TYPE:
        return 415;
    case ZR_BAD_SCENE:
        return 422;
    case ZR_NO_MEMORY:
        return 503;
    case ZR_CANCELLED:
        return 504;
    case ZR_INTERNAL:
        return 500;
    }
    return 500;
}

/* Begins a problem. NULL: out of memory; the following functions accept it. */
static cJSON *new_problem(struct answer *answer, int http_status, const char *detail)
{
    answer->status = http_status;
    text_to_utf8(answer->detail, sizeof answer->detail, detail);
    zr_make_visible(answer->detail, true);
    cJSON *root = cJSON_CreateObject();
    if (cJSON_AddStringToObject(root, "type", "about:blank") &&
        cJSON_AddStringToObject(root, "title", answer_reason(http_status)) &&
        cJSON_AddNumberToObject(root, "status", http_status) && cJSON_AddStringToObject(root, "detail", answer->detail))
        return root;
    cJSON_Delete(root);
    return NULL;
}

static bool add_error(cJSON *errors, const struct zr_error_item *fault)
{
    char text[ZR_DETAIL_SIZE * 3];
    cJSON *item = cJSON_CreateObject();
    text_to_utf8(text, sizeof text, fault->pointer);
    bool added = cJSON_AddStringToObject(item, "pointer", text);
    text_to_utf8(text, sizeof text, fault->detail);
    zr_make_visible(text, true);
    added = added && cJSON_AddStringToObject(item, "detail", text) &&
            (fault->place == 0 || cJSON_AddNumberToObject(item, "offset", (double)(fault->place - 1))) &&
            cJSON_AddItemToArray(errors, item);
    if (!added) cJSON_Delete(item);
    return added;
}

static bool add_errors(cJSON *root, const struct zr_error *error, size_t held)
{
    cJSON *errors = cJSON_AddArrayToObject(root, "errors");
    bool added = errors;
    for (size_t i = 0; i < held && added; i++)
        added = add_error(errors, &error->items[i]);
    return added &&
           (held < ZR_ERROR_ITEMS || cJSON_AddTrueToObject(root, "truncated")); /* readers stop at so many errors */
}

static void finish(struct answer *answer, cJSON *root)
{
    char *text = root ? cJSON_PrintUnformatted(root) : NULL;
    cJSON_Delete(root);
    answer_body(answer, "application/problem+json", text, text ? strlen(text) : 0);
    answer->is_broken |= !text;
}

/* ---- as text ---- */

/* Adds a line. */
static void add_line(char *text, size_t *used, const char *pointer, const char *detail)
{
    char line[2 * ZR_DETAIL_SIZE + 4], clean[3 * sizeof line];
    snprintf(line, sizeof line, "%s%s%s", pointer, *pointer ? ": " : "", detail);
    text_to_utf8(clean, sizeof clean, line);
    zr_make_visible(clean, false);
    const size_t length = strlen(clean);
    if (*used + length + 1 >= PROBLEM_TEXT_SIZE) return;
    memcpy(text + *used, clean, length);
    text[*used + length] = '\n';
    *used += length + 1;
}

/* Makes the lines of `error`, or `detail` if that is NULL. */
static void answer_text(struct answer *answer, int http_status, const char *detail, const struct zr_error *error)
{
    char *text = malloc(PROBLEM_TEXT_SIZE);
    size_t used = 0;
    answer->status = http_status;
    text_to_utf8(answer->detail, sizeof answer->detail, detail);
    for (size_t i = 0; text && error && i < zr_error_held(error); i++)
        add_line(text, &used, error->items[i].pointer, error->items[i].detail);
    if (text && used == 0) add_line(text, &used, "", detail);
    answer_body(answer, "text/plain; charset=utf-8", text, used);
    answer->is_broken |= !text;
}

/* ---- both ---- */

void problem_answer(struct answer *answer, int http_status, const char *format, ...)
{
    char detail[ANSWER_DETAIL_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    if (answer->is_plain)
        answer_text(answer, http_status, detail, NULL);
    else
        finish(answer, new_problem(answer, http_status, detail));
}

void problem_answer_error(struct answer *answer, int http_status, const struct zr_error *error)
{
    size_t held = zr_error_held(error);
    const char *detail = held ? error->items[0].detail : answer_reason(http_status);
    if (answer->is_plain) {
        answer_text(answer, http_status, detail, error);
        return;
    }
    cJSON *root = new_problem(answer, http_status, detail);
    if (root && held && !add_errors(root, error, held)) {
        cJSON_Delete(root);
        root = NULL;
    }
    finish(answer, root);
}

void problem_busy(struct answer *answer, unsigned retry_after_s, enum refusal refusal)
{
    answer_header(answer, "Retry-After", "%u", retry_after_s ? retry_after_s : 1);
    problem_answer(answer, 503, "%s", refusal_text(refusal));
    answer->refusal = refusal;
}

/* Returns true if the request would fit without the shadow maps of its lights. */
static bool are_lamps_too_many(const struct zr_arena *arena, const struct zr_cost *cost)
{
    return cost && cost->lamp_maps > 0 && (double)arena->wanted - cost->lamp_map_bytes <= (double)arena->ceiling;
}

void problem_memory(struct answer *answer, const struct zr_arena *arena, const struct zr_cost *cost)
{
    if (arena->wanted == 0)
        problem_busy(answer, 1, REFUSAL_MEMORY);
    else if (arena->wanted == SIZE_MAX)
        problem_answer(answer, 422, "the request needs more memory than it can get; requestMemoryBytes is %zu bytes",
                       arena->ceiling);
    else if (are_lamps_too_many(arena, cost))
        problem_answer(answer, 422,
                       "the request needs at least %zu bytes of memory, %.0f of them for the depth maps of %" PRIu32
                       " lamps with shadows; requestMemoryBytes, for one, is %zu bytes: fewer lamps with shadows need "
                       "less",
                       arena->wanted, cost->lamp_map_bytes, cost->lamp_maps, arena->ceiling);
    else
        problem_answer(
            answer, 422,
            "the request needs at least %zu bytes of memory; requestMemoryBytes, for one, is %zu bytes: fewer "
            "pixels, samples or faces need less",
            arena->wanted, arena->ceiling);
}

void problem_timeout(struct answer *answer, uint64_t timeout_ms)
{
    problem_answer(answer, 504,
                   "the work took longer than renderTimeoutMs, %" PRIu64
                   " ms: a smaller model, fewer or smaller views, and fewer samples take less",
                   timeout_ms);
}
