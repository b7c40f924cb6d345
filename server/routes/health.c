#include "health.h"

#include <inttypes.h>
#include <stdio.h>
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

enum { COUNTS_SIZE = 192 };

/* Writes the counts of kept values as JSON. `kept` may be NULL. */
static void write_counts(struct kept *kept, char out[COUNTS_SIZE])
{
    struct kept_state state = {0};
    if (kept) state = kept_look(kept);
    snprintf(out, COUNTS_SIZE,
             "{\"count\":%" PRIu64 ",\"bytes\":%" PRIu64 ",\"hits\":%" PRIu64 ",\"misses\":%" PRIu64
             ",\"dropped\":%" PRIu64 "}",
             state.count, state.bytes, state.hits, state.misses, state.dropped);
}

bool health_open(const struct service *service, const struct load *load, struct request *request, struct answer *answer)
{
    char images[COUNTS_SIZE], texts[COUNTS_SIZE], meshes[COUNTS_SIZE], answers[COUNTS_SIZE], *text = NULL;
    write_counts(service->images, images);
    write_counts(texts_kept(service->texts), texts);
    write_counts(meshes_kept(service->meshes), meshes);
    write_counts(service->answers, answers);
    (void)load;
    (void)request;
    const int length = asprintf(&text, "{\"images\":%s,\"texts\":%s,\"meshes\":%s,\"answers\":%s,\"status\":\"ok\"}\n",
                                images, texts, meshes, answers);
    answer_text(answer, text, length);
    return false;
}

enum refusal health_busy_with(const struct service *service, const struct load *load)
{
    const bool full = load->queue_full || load->large_queue_full;
    const struct load any = {load->leaving, load->leaving, full, full, load->answers_full, load->retry_after_s};
    return load_busy_with(&any, service, true);
}

bool health_open_ready(const struct service *service, const struct load *load, struct request *request,
                       struct answer *answer)
{
    const enum refusal busy = health_busy_with(service, load);
    (void)request;
    if (busy) {
        problem_busy(answer, load->retry_after_s, busy);
        return false;
    }
    char *text = NULL;
    const int length = asprintf(&text, "{\"status\":\"ready\"}\n");
    answer_text(answer, text, length);
    return false;
}

bool limits_open(const struct service *service, const struct load *load, struct request *request, struct answer *answer)
{
    (void)load;
    (void)request;
    cJSON *root = cJSON_CreateObject(), *limits = NULL;
    const bool is_whole = cJSON_AddStringToObject(root, "version", ZR_VERSION) &&
                          (limits = cJSON_AddObjectToObject(root, "limits")) &&
                          config_add_limits(service->config, limits);
    char *text = is_whole ? cJSON_Print(root) : NULL;
    cJSON_Delete(root);
    answer->status = 200;
    answer->is_broken |= !text;
    if (text) answer_body(answer, "application/json", text, strlen(text));
    return false;
}
