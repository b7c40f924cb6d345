#include "request.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <unistd.h>

#include "api/control_group.h"
#include "clock.h"
#include "text.h"

void service_init(struct service *service, const struct config *config, struct zr_team *team, struct slowness *slowness)
{
    *service = (struct service){.config = config, .limits = config_limits(config), .slowness = slowness, .team = team};
    if (getrandom(&service->id_base, sizeof service->id_base, 0) != sizeof service->id_base)
        service->id_base = (uint64_t)clock_us();
    atomic_init(&service->id_next, 0);
}

/* ---- memory of the control group (version 2 or 1) ---- */

enum { MEMORY_PERCENT = 92, FOLDER_SIZE = 512 };

static bool is_short(uint64_t used, uint64_t limit)
{
    return (double)used > (double)limit * (MEMORY_PERCENT / 100.0);
}

/* Writes the folder of a version's groups. `folder` is where all are mounted, such as /sys/fs/cgroup. */
static void put_folder(const struct zr_group_files *files, const char *folder, char out[FOLDER_SIZE])
{
    snprintf(out, FOLDER_SIZE, "%s%s", folder, files->below);
}

double service_memory_limit(const struct service *service)
{
    for (int i = 0; i < ZR_GROUP_VERSIONS; i++) {
        uint64_t limit;
        char group[FOLDER_SIZE];
        put_folder(&zr_group_files[i], service->config->cgroup, group);
        if (zr_kernel_number(group, zr_group_files[i].limit, "", &limit) && limit < ZR_GROUP_UNLIMITED)
            return (double)limit;
    }
    return (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

/* Returns true if more than MEMORY_PERCENT of the control group's memory limit is used. Page cache that the kernel can
 * drop at once does not count. `folder` is that of the control group, such as /sys/fs/cgroup. False without a limit. */
static bool memory_is_short(const char *folder)
{
    for (int i = 0; i < ZR_GROUP_VERSIONS; i++) {
        const struct zr_group_files *files = &zr_group_files[i];
        uint64_t used, limit, droppable = 0;
        char group[FOLDER_SIZE];
        put_folder(files, folder, group);
        if (!zr_kernel_number(group, files->used, "", &used) || !zr_kernel_number(group, files->limit, "", &limit))
            continue;
        if (!is_short(used, limit)) return false;
        /* Last: the kernel may sum it over all groups and processors, which takes milliseconds. */
        zr_kernel_number(group, files->list, files->droppable, &droppable);
        return is_short(used - (droppable < used ? droppable : used), limit);
    }
    return false;
}

/* ---- load ---- */

/* Drops all kept values that no request uses. False if there are none. */
static bool drop_kept(const struct service *service)
{
    bool dropped = false;
    for (int i = 0; i < KEPT_TABLES; i++)
        if (service->kept[i] && kept_drop(service->kept[i])) dropped = true;
    return dropped;
}

enum refusal load_busy_with(const struct load *load, const struct service *service, bool makes_answer)
{
    if (load->draining) return REFUSAL_DRAINING;
    if (load->queue) return load->queue;
    if (makes_answer && load->answers_full) return REFUSAL_ANSWERS;
    if (makes_answer && load->client_full) return REFUSAL_SHARE;
    if (!memory_is_short(service->config->cgroup)) return REFUSAL_NONE;
    if (drop_kept(service) && !memory_is_short(service->config->cgroup)) return REFUSAL_NONE;
    return REFUSAL_CONTAINER;
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

void request_take_trace(struct request *request, struct service *service, const char *traceparent)
{
    if (traceparent)
        trace_read(&request->trace, traceparent, service->id_base + atomic_fetch_add(&service->id_next, 1));
}
