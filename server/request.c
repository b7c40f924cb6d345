#include "request.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "admission.h"
#include "clock.h"
#include "text.h"

void service_init(struct service *service, const struct config *config, struct zr_team *team, double slowness,
                  struct store *store)
{
    service->config = config;
    service->store = store;
    service->slowness = slowness;
    service->limits = config_limits(config);
    service->team = team;
    if (getrandom(&service->id_base, sizeof service->id_base, 0) != sizeof service->id_base)
        service->id_base = (uint64_t)clock_us();
    atomic_init(&service->id_next, 0);
}

const char *load_busy_with(const struct load *load, const struct service *service, bool makes_answer)
{
    if (load->draining) return "the service is going down";
    if (load->queue_full) return "the queue is full";
    if (makes_answer && load->answers_full) return "the answers that wait for their readers fill answerMemoryBytes";
    if (!admission_memory_is_short(service->config->cgroup)) return NULL;
    return "the memory of the container is nearly used up";
}

void request_free(struct request *request)
{
    free(request->query_values);
    request->query_values = NULL;
}

void request_take_id(struct request *request, struct service *service, const char *client_id)
{
    static const char ALLOWED[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    size_t length = client_id ? text_trimmed_length(client_id) : 0;
    if (length >= 1 && length < REQUEST_ID_SIZE && strspn(client_id, ALLOWED) == length) {
        memcpy(request->id, client_id, length); /* the rest is zero */
        return;
    }
    uint64_t number = atomic_fetch_add(&service->id_next, 1);
    snprintf(request->id, sizeof request->id, "%016" PRIx64 "-%06" PRIx64, service->id_base, number);
}
