#include "routes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "problem.h"

static void answer_text(struct answer *answer, char *text, int length)
{
    answer->status = 200;
    answer->is_broken |= length < 0;
    if (length > 0) answer_body(answer, "application/json", text, (size_t)length);
    answer_header(answer, "Cache-Control", "no-store");
}

/* Writes the counts of each table of kept values. */
bool health_open(const struct service *service, struct request *request, struct answer *answer)
{
    enum { TEXT_SIZE = 1024 };
    char *text = malloc(TEXT_SIZE);
    int used = text ? snprintf(text, TEXT_SIZE, "{") : -1;
    (void)request;
    for (int i = 0; text && i < KEPT_TABLES; i++) {
        const struct kept_state state = kept_look(service->kept[i]);
        used +=
            snprintf(text + used, TEXT_SIZE - (size_t)used,
                     "\"%s\":{\"count\":%" PRIu64 ",\"bytes\":%" PRIu64 ",\"hits\":%" PRIu64 ",\"misses\":%" PRIu64
                     ",\"dropped\":%" PRIu64 "},",
                     kept_word((enum kept_table)i), state.count, state.bytes, state.hits, state.misses, state.dropped);
    }
    if (text) used += snprintf(text + used, TEXT_SIZE - (size_t)used, "\"status\":\"ok\"}\n");
    answer_text(answer, text, used);
    return false;
}

enum refusal health_busy_with(const struct service *service, const struct request *request)
{
    const struct load *load = &request->load;
    const struct load any = {.leaving = load->leaving,
                             .draining = load->leaving,
                             .queue = load->queue ? load->queue : load->large_queue,
                             .answers_full = load->answers_full};
    return load_busy_with(&any, service, true);
}

bool health_open_ready(const struct service *service, struct request *request, struct answer *answer)
{
    const enum refusal busy = health_busy_with(service, request);
    if (busy) {
        problem_busy(answer, request->load.retry_after_s, busy);
        return false;
    }
    char *text = NULL;
    const int length = asprintf(&text, "{\"status\":\"ready\"}\n");
    answer_text(answer, text, length);
    return false;
}

bool limits_open(const struct service *service, struct request *request, struct answer *answer)
{
    (void)request;
    cJSON *root = cJSON_CreateObject(), *limits = NULL;
    const bool is_whole = cJSON_AddStringToObject(root, "version", ZR_VERSION) &&
                          cJSON_AddBoolToObject(root, "keepsAssets", service->store != NULL) &&
                          (limits = cJSON_AddObjectToObject(root, "limits")) &&
                          config_add_limits(service->config, limits);
    char *text = is_whole ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    answer->status = 200;
    answer->is_broken |= !text;
    if (text) answer_body(answer, "application/json", text, strlen(text));
    return false;
}
