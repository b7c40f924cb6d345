/* main.c - the daemon zrasterd: starts all parts, waits for a signal, stops all parts. */
#include <fcntl.h>
#include <inttypes.h>
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/visible.h"
#include "config.h"
#include "gate/gate.h"
#include "http/http.h"
#include "jobs/slowness.h"
#include "keep/answers.h"
#include "keep/images.h"
#include "keep/meshes.h"
#include "keep/store.h"
#include "log/log.h"
#include "log/log_writer.h"
#include "mcp/memory.h"
#include "metrics/metrics.h"
#include "request.h"
#include "routes/engine.h"
#include "routes/health_check.h"

enum { EXIT_USAGE = 2, SPARE_FILES = 192, MMAP_BYTES = 1 << 20, TRIM_BYTES = 8 << 20 };

/* Opens /dev/null for closed standard files. Otherwise a socket or an asset could get such a number, and the log would
 * be written to it. */
static bool open_standard_files(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", O_RDWR) != fd) return false;
    return true;
}

/* First of all: threads inherit the signal mask of their creator. */
static void block_signals(sigset_t *signals)
{
    sigemptyset(signals);
    sigaddset(signals, SIGTERM);
    sigaddset(signals, SIGINT);
    sigaddset(signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, signals, NULL);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* writing an asset beyond the file size limit then fails, and does not end the daemon */
}

/* An idle daemon must return its memory: few malloc arenas, and large blocks return at once. Small blocks stay in the
 * heap until the queue is calm. */
static void tune_allocator(void)
{
    mallopt(M_ARENA_MAX, 2);
    mallopt(M_MMAP_THRESHOLD, MMAP_BYTES);
    mallopt(M_TRIM_THRESHOLD, TRIM_BYTES);
}

/* A connection is one descriptor, an asset being sent another; the usual soft limit is 1024. */
static void raise_file_limit(const struct config *config)
{
    struct rlimit limit;
    rlim_t wanted = 2 * (rlim_t)config->max_connections + SPARE_FILES;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
    limit.rlim_cur = wanted < limit.rlim_max ? wanted : limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
    if (limit.rlim_cur < wanted)
        log_event("warn", "file-limit", "fewer files may be open than max-connections asks for");
}

/* Reads tokens, keys and presets anew. If something is wrong, those before stay in force. */
static void reload(const struct config *config, struct http *http)
{
    char message[512], detail[640];
    struct gate *gate = gate_read(config, message, sizeof message);
    if (gate) {
        if (*gate_warning(gate)) log_event("warn", "gate", gate_warning(gate));
        http_change_gate(http, gate); /* which logs it */
    } else {
        snprintf(detail, sizeof detail, "tokens, keys and presets stay as they were: %s", message);
        log_event("error", "reload", detail);
    }
}

/* Returns true if the daemon had a terminal that is closed by now: SIGHUP then means the end. */
static bool has_lost_terminal(bool had_terminal)
{
    return had_terminal && !isatty(STDIN_FILENO);
}

/* Serves until SIGTERM or SIGINT. */
static void serve_until_signal(const struct config *config, struct http *http, const sigset_t *signals)
{
    static const struct {
        int number;
        const char *name;
    } NAMES[] = {{SIGTERM, "SIGTERM"}, {SIGINT, "SIGINT"}, {SIGHUP, "SIGHUP"}};
    const bool had_terminal = isatty(STDIN_FILENO);
    int number = 0, i = 0;
    while (sigwait(signals, &number) != 0 || (number == SIGHUP && !has_lost_terminal(had_terminal)))
        reload(config, http);
    while (NAMES[i].number != number)
        i++;
    log_event("info", "drain", NAMES[i].name);
}

static void announce(const struct config *config, const struct zr_team *team, const struct http *http)
{
    char message[64];
    snprintf(message, sizeof message, "rendering with %s", zr_isa_name(zr_team_isa(team)));
    log_event("info", "start", message);
    const bool is_ipv6 = strchr(config->address, ':') != NULL;
    printf("listening on http://%s%s%s:%u\n", is_ipv6 ? "[" : "", config->address, is_ipv6 ? "]" : "", http_port(http));
    fflush(stdout);
}

/* Frees all that requests shared. */
static void end_service(struct service *service)
{
    slowness_end(service->slowness);
    store_close(service->store);
    for (int i = 0; i < KEPT_TABLES; i++)
        kept_close(service->kept[i]);
    sizes_close(service->sizes);
    zr_team_destroy(service->team);
    gate_free(service->gate);
    metrics_free(service->metrics);
}

static void print_faults(char *message)
{
    zr_make_visible(message, true);
    for (char *rest, *line = strtok_r(message, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
        fprintf(stderr, "zrasterd: %s\n", line);
}

/* Takes ownership of the gate. */
static int serve(const struct config *config, struct gate *gate, const struct engine *engine)
{
    sigset_t signals;
    char message[512];
    struct service service;
    block_signals(&signals);
    tune_allocator();
    if (!log_writer_start()) {
        fprintf(stderr, "zrasterd: the thread that writes the log cannot be started\n");
        gate_free(gate);
        return EXIT_FAILURE;
    }
    raise_file_limit(config);
    if (*gate_warning(gate)) log_event("warn", "gate", gate_warning(gate));
    struct zr_team *team = zr_team_create_for((int)config->threads, config_isa(config));
    if (!team) {
        fprintf(stderr, "zrasterd: %" PRIu64 " render threads cannot be started; give a smaller number by --threads\n",
                config->threads);
        gate_free(gate);
        log_writer_stop();
        return EXIT_FAILURE;
    }
    struct http *http = NULL;
    struct slowness slowness;
    slowness_start(&slowness, config_isa(config));
    service_init(&service, config, team, &slowness);
    service.gate = gate;
    service.engine = engine;
    service.kept[KEPT_IMAGES] = images_open(config->keep_image_bytes);
    service.kept[KEPT_TEXTS] = texts_open(config->keep_text_bytes);
    service.kept[KEPT_MESHES] = meshes_open(config->keep_mesh_bytes);
    service.kept[KEPT_ANSWERS] = answers_open(config->keep_answer_bytes);
    service.sizes = sizes_open();
    service.metrics = metrics_create();
    if (*config->assets_dir)
        service.store = store_open(config->assets_dir, config->assets_max_bytes, message, sizeof message);
    if (service.store || !*config->assets_dir) http = http_start(config, &service, message, sizeof message);
    if (http) {
        announce(config, team, http);
        serve_until_signal(config, http, &signals);
        http_stop(http);
    } else {
        print_faults(message);
    }
    end_service(&service);
    if (http) log_event("info", "stopped", NULL);
    log_writer_stop();
    return http ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* Checks all that a start reads, and listens nowhere. */
static int check(const struct config *config)
{
    char message[CONFIG_MESSAGE_SIZE], fault[CONFIG_MESSAGE_SIZE];
    const bool is_right = config_check_folders(config, message, sizeof message);
    struct gate *gate = gate_read(config, fault, sizeof fault);
    if (!is_right) print_faults(message);
    if (!gate) print_faults(fault);
    struct engine *engine = engine_read(config, fault, sizeof fault);
    if (!engine) print_faults(fault);
    const bool is_whole = is_right && gate && engine;
    if (is_whole) puts(message);
    engine_free(engine);
    gate_free(gate);
    return is_whole ? EXIT_SUCCESS : EXIT_USAGE;
}

int main(int argc, char **argv)
{
    struct config config;
    char message[CONFIG_MESSAGE_SIZE];
    if (!open_standard_files()) return EXIT_FAILURE;
    switch (config_read(&config, argc, argv, message, sizeof message)) {
    case CONFIG_HELP:
        config_print_help(stdout);
        return EXIT_SUCCESS;
    case CONFIG_VERSION:
        puts("zrasterd " ZR_VERSION);
        return EXIT_SUCCESS;
    case CONFIG_HEALTH:
        return health_check(&config) ? EXIT_SUCCESS : EXIT_FAILURE;
    case CONFIG_CHECK:
        return check(&config);
    case CONFIG_PRINT:
        config_print(&config, stdout);
        return EXIT_SUCCESS;
    case CONFIG_WRONG:
        print_faults(message);
        return EXIT_USAGE;
    case CONFIG_SERVE:
        break;
    }
    struct gate *gate = gate_read(&config, message, sizeof message);
    if (!gate) {
        print_faults(message);
        return EXIT_USAGE;
    }
    struct engine *engine = engine_read(&config, message, sizeof message);
    if (!engine) {
        print_faults(message);
        gate_free(gate);
        return EXIT_USAGE;
    }
    mcp_memory_watch();
    const int status = serve(&config, gate, engine);
    engine_free(engine);
    return status;
}
