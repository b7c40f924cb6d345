#include "request.h"

#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <unistd.h>

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

enum { MEMORY_PERCENT = 92, FILE_SIZE = 8192 }; /* memory.stat has some 2000 bytes */

/* Reads a number from a file of the kernel: the first one, or the one behind `key` at the beginning of a line. False
 * without such a number ("max": no limit). */
static bool read_number(const char *folder, const char *file, const char *key, uint64_t *out)
{
    char path[512], text[FILE_SIZE], *end;
    snprintf(path, sizeof path, "%s/%s", folder, file);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return false;
    ssize_t size = read(fd, text, sizeof text - 1);
    close(fd);
    text[size > 0 ? size : 0] = '\0';
    const char *line = text;
    size_t length = strlen(key);
    while (line && strncmp(line, key, length) != 0) {
        line = strchr(line, '\n');
        if (line) line++;
    }
    if (!line) return false;
    *out = strtoull(line + length, &end, 10);
    return end != line + length;
}

static bool is_short(uint64_t used, uint64_t limit)
{
    return (double)used > (double)limit * (MEMORY_PERCENT / 100.0);
}

static const struct {
    const char *used, *limit, *list, *droppable;
} versions[] = {
    {"memory.current", "memory.max", "memory.stat", "inactive_file "},
    {"memory/memory.usage_in_bytes", "memory/memory.limit_in_bytes", "memory/memory.stat", "total_inactive_file "}};

double service_memory_limit(const struct service *service)
{
    uint64_t limit;
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) /* version 1 without a limit has about 2^63 */
        if (read_number(service->config->cgroup, versions[i].limit, "", &limit) && limit < UINT64_C(1) << 60)
            return (double)limit;
    return (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

/* Returns true if more than MEMORY_PERCENT of the control group's memory limit is used. Page cache that the kernel can
 * drop at once does not count. `folder` is that of the control group, such as /sys/fs/cgroup. False without a limit. */
static bool memory_is_short(const char *folder)
{
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) {
        uint64_t used, limit, droppable = 0;
        if (!read_number(folder, versions[i].used, "", &used) || !read_number(folder, versions[i].limit, "", &limit))
            continue;
        if (!is_short(used, limit)) return false;
        /* Last: the kernel may sum it over all groups and processors, which takes milliseconds. */
        read_number(folder, versions[i].list, versions[i].droppable, &droppable);
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
