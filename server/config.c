#include "config.h"

#include <ctype.h>
#include <inttypes.h>
#include <netdb.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cjson/cJSON.h>

enum kind { TEXT, ADDRESS, ISA, ORIGINS, SWITCH, NUMBER };

enum { NAME_SIZE = 64, QUEUE_PER_WORKER = 256 };

struct setting {
    const char *flag;
    enum kind kind;
    size_t offset;
    bool is_limit; /* shown by /v1/limits */
    uint64_t initial, min, max;
    const char *text; /* default of all kinds but NUMBER */
    const char *unit; /* "" if the name includes it */
    const char *help;
};

#define MIB      ((uint64_t)1 << 20)
#define GIB      ((uint64_t)1 << 30)
#define DAY_MS   ((uint64_t)86400000)
#define AT(name) offsetof(struct config, name)

/* Side and coordinates cannot be raised: the rasterizer's fixed point is proven up to these bounds. */
static const struct setting SETTINGS[] = {
    {"address", ADDRESS, AT(address), false, 0, 0, 0, "127.0.0.1", "", "numeric IPv4 or IPv6 address to listen on"},
    {"port", NUMBER, AT(port), false, 8080, 0, 65535, NULL, "", "port to listen on; 0: any free port"},
    {"token", TEXT, AT(token), false, 0, 0, 0, "", "",
     "bearer token that clients must send; empty: none; prefer its variable, which ps does not show"},
    {"page", SWITCH, AT(page), false, 0, 0, 0, "on", "",
     "on or off: the page at / for browsers and the manual at /docs/"},
    {"origins", ORIGINS, AT(origins), false, 0, 0, 0, "", "",
     "origins whose web pages may use the daemon (CORS), such as https://example.org, with spaces or commas between "
     "them; *: all; empty: only its own page"},
    {"workers", NUMBER, AT(workers), true, 0, 0, 256, NULL, "",
     "requests processed at once, besides one small request; 0: one per core"},
    {"threads", NUMBER, AT(threads), true, 0, 0, ZR_TEAM_MAX, NULL, "",
     "render threads, shared by all requests; 0: one per core"},
    {"isa", ISA, AT(isa), false, 0, 0, 0, "auto", "",
     "instruction set of the renderer: scalar, sse2, avx2, avx512, neon, or auto, the widest of the machine; "
     "pixels do not depend on it"},
    {"queue", NUMBER, AT(queue), true, 0, 0, 65536, NULL, "requests",
     "that may wait in each queue, small and large; beyond 2 per worker, only those that should start within a second; "
     "0: 256 per worker"},
    {"max-per-client", NUMBER, AT(max_per_client), true, 4, 0, 65536, NULL, "requests",
     "in flight per public address (IPv6: per network of 64 bits); 0: no limit, for use behind a proxy"},
    {"max-per-private-client", NUMBER, AT(max_per_private_client), true, 0, 0, 65536, NULL, "requests",
     "in flight per address of this machine or of a private network; 0: no limit"},
    {"max-connections", NUMBER, AT(max_connections), true, 1024, 8, 65536, NULL, "", "open connections"},
    {"max-streams", NUMBER, AT(max_streams), true, 16, 1, 256, NULL, "answers",
     "streamed at once; each has a thread, which waits while its reader is slow"},
    {"body-max-bytes", NUMBER, AT(body_max_bytes), true, 64 * MIB, 1, 4 * GIB, NULL, "bytes", "of one request body"},
    {"upload-memory-bytes", NUMBER, AT(upload_memory_bytes), true, 512 * MIB, 1, 1024 * GIB, NULL, "bytes",
     "of all request bodies held at once; their pages may take up to twice that"},
    {"request-memory-bytes", NUMBER, AT(request_memory_bytes), true, GIB, MIB, 1024 * GIB, NULL, "bytes",
     "that one render may allocate"},
    {"keep-memory-bytes", NUMBER, AT(keep_memory_bytes), true, 256 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "that a worker may keep between requests; they return to the system after 2 s without a request"},
    {"keep-image-bytes", NUMBER, AT(keep_image_bytes), true, 128 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of decoded texture images kept between requests, in blocks of 4096; the least recently used are dropped first, "
     "and all if memory is short; 0: none"},
    {"keep-text-bytes", NUMBER, AT(keep_text_bytes), true, 128 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of data: URIs of glTF kept from the second time on, as text and decoded, in blocks of 4096; the least recently "
     "used are dropped first, and all if memory is short; 0: none"},
    {"keep-mesh-bytes", NUMBER, AT(keep_mesh_bytes), true, 256 * MIB, 0, 1024 * GIB, NULL, "bytes",
     "of model files kept as read from the second time on, with copies of those that were not stored, in blocks of "
     "4096; the least recently used are dropped first, and all if memory is short; 0: none"},
    {"answer-memory-bytes", NUMBER, AT(answer_memory_bytes), true, 512 * MIB, 1, 1024 * GIB, NULL, "bytes",
     "of all answers that wait for their readers, and of streams that do; beyond it, no render begins"},
    {"cgroup", TEXT, AT(cgroup), false, 0, 0, 0, "/sys/fs/cgroup", "",
     "folder of the control group; requests get 503 beyond 92 % of its memory limit"},
    {"assets-dir", TEXT, AT(assets_dir), false, 0, 0, 0, "", "",
     "existing directory for uploaded assets, stored under their hash; empty: no assets"},
    {"assets-max-bytes", NUMBER, AT(assets_max_bytes), true, GIB, 4096, 1024 * 1024 * GIB, NULL, "bytes",
     "of all assets together, in blocks of 4096; the least recently used are removed first"},
    {"header-timeout-ms", NUMBER, AT(header_timeout_ms), true, 10000, 1, DAY_MS, NULL, "ms",
     "for a complete request header to arrive"},
    {"idle-timeout-ms", NUMBER, AT(idle_timeout_ms), true, 60000, 1, DAY_MS, NULL, "ms",
     "that a kept connection may stay silent"},
    {"body-timeout-ms", NUMBER, AT(body_timeout_ms), true, 30000, 1, DAY_MS, NULL, "ms",
     "for a complete request body to arrive"},
    {"body-min-bytes-per-second", NUMBER, AT(body_min_bytes_per_second), true, 1024, 0, GIB, NULL, "bytes/s",
     "that a body must average after its first 5 s; 0: no limit"},
    {"answer-min-bytes-per-second", NUMBER, AT(answer_min_bytes_per_second), true, 1024, 0, GIB, NULL, "bytes/s",
     "at which a client must read its answer; 0: no limit"},
    {"write-timeout-ms", NUMBER, AT(write_timeout_ms), true, 60000, 1, DAY_MS, NULL, "ms",
     "for a client to read its complete answer"},
    {"render-timeout-ms", NUMBER, AT(render_timeout_ms), true, 10000, 1, DAY_MS, NULL, "ms",
     "that a worker may spend on one request"},
    {"cost-max-ms", NUMBER, AT(cost_max_ms), true, 20000, 1, DAY_MS, NULL, "ms",
     "of predicted processor time of one request"},
    {"drain-timeout-ms", NUMBER, AT(drain_timeout_ms), true, 30000, 0, DAY_MS, NULL, "ms",
     "for requests in flight to end after SIGTERM"},
    {"json-depth-max", NUMBER, AT(json_depth_max), true, 0, 1, 512, NULL, "", "nesting of arrays and objects"},
    {"window-side-max", NUMBER, AT(window_side_max), true, 0, 1, 8192, NULL, "pixels", "per side of an image"},
    {"window-pixels-max", NUMBER, AT(window_pixels_max), true, 0, 1, GIB, NULL, "pixels",
     "of all outputs of a request together"},
    {"polygon-vertices-max", NUMBER, AT(polygon_vertices_max), true, 0, 3, 8192, NULL, "", "vertices of one polygon"},
    {"instances-max", NUMBER, AT(instances_max), true, 0, 1, 1u << 24, NULL, "", "meshes placed by nodes"},
    {"image-pixels-max", NUMBER, AT(image_pixels_max), true, 0, 1, GIB, NULL, "pixels",
     "of all images of a scene's textures together"},
    {"coordinate-max", NUMBER, AT(coordinate_max), true, 0, 1, 1000000, NULL, "", "magnitude of a coordinate"},
};

enum { SETTING_COUNT = sizeof SETTINGS / sizeof SETTINGS[0] };

static uint64_t *number_at(struct config *config, const struct setting *setting)
{
    return (uint64_t *)(void *)((char *)config + setting->offset);
}

static uint64_t number_of(const struct config *config, const struct setting *setting)
{
    return *(const uint64_t *)(const void *)((const char *)config + setting->offset);
}

static void set_defaults(struct config *config)
{
    *config = (struct config){0};
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        const struct setting *s = &SETTINGS[i];
        if (s->kind != NUMBER)
            snprintf((char *)config + s->offset, CONFIG_TEXT_SIZE, "%s", s->text);
        else
            *number_at(config, s) = s->initial;
    }
    struct zr_limits limits = zr_limits_default();
    config->json_depth_max = limits.json_depth_max;
    config->window_side_max = limits.window_side_max;
    config->window_pixels_max = limits.window_pixels_max;
    config->polygon_vertices_max = limits.polygon_vertices_max;
    config->instances_max = limits.instances_max;
    config->image_pixels_max = limits.image_pixels_max;
    config->coordinate_max = (uint64_t)limits.coordinate_max;
}

static void variable_name(char name[NAME_SIZE], const char *flag)
{
    size_t used = (size_t)snprintf(name, NAME_SIZE, "ZRASTER_");
    for (; *flag && used < NAME_SIZE - 1; flag++)
        name[used++] = *flag == '-' ? '_' : (char)toupper((unsigned char)*flag);
    name[used] = '\0';
}

static bool is_address(const char *text)
{
    struct addrinfo hints = {.ai_flags = AI_NUMERICHOST}, *address = NULL;
    const int failure = *text ? getaddrinfo(text, NULL, &hints, &address) : EAI_NONAME;
    if (failure == 0) freeaddrinfo(address);
    return failure == 0 || failure == EAI_MEMORY; /* then listening reports the lack of memory */
}

static bool parse_number(const char *text, uint64_t *out)
{
    uint64_t value = 0;
    for (const char *p = text; *p; p++) {
        if (*p < '0' || *p > '9') return false;
        if (__builtin_mul_overflow(value, 10u, &value) || __builtin_add_overflow(value, (uint64_t)(*p - '0'), &value))
            return false;
    }
    *out = value;
    return *text != '\0';
}

/* Returns true for a list of origins as browsers send them, scheme://host or scheme://host:port, or "*". */
static bool are_origins(const char *text)
{
    static const char BETWEEN[] = " ,";
    for (const char *at = text + strspn(text, BETWEEN); *at; at += strspn(at, BETWEEN)) {
        const size_t length = strcspn(at, BETWEEN);
        const char *const end = at + length;
        const char *const host = strncmp(at, "http://", 7) == 0    ? at + 7
                                 : strncmp(at, "https://", 8) == 0 ? at + 8
                                                                   : end;
        if (!(length == 1 && *at == '*') && (host == end || memchr(host, '/', (size_t)(end - host)))) return false;
        at = end;
    }
    return true;
}

/* Sets an address, a text, a switch or an instruction set. `name`: the flag or variable as the user wrote it. */
static bool set_text(struct config *config, const struct setting *s, const char *name, const char *value, char *message,
                     size_t message_size)
{
    if (strlen(value) >= CONFIG_TEXT_SIZE) {
        snprintf(message, message_size, "%s: longer than the %d bytes that are allowed", name, CONFIG_TEXT_SIZE - 1);
        return false;
    }
    if (s->kind == ADDRESS && !is_address(value)) {
        snprintf(message, message_size, "%s: '%.100s' is not a numeric IPv4 or IPv6 address", name, value);
        return false;
    }
    if (s->kind == ORIGINS && !are_origins(value)) {
        snprintf(message, message_size,
                 "%s: '%.100s' is no list of origins such as https://example.org: scheme and host, without a path or a "
                 "/ at the end",
                 name, value);
        return false;
    }
    if (s->kind == SWITCH && strcmp(value, "on") != 0 && strcmp(value, "off") != 0) {
        snprintf(message, message_size, "%s: '%.100s' is neither on nor off", name, value);
        return false;
    }
    enum zr_isa isa;
    if (s->kind == ISA && !zr_isa_choose(value, &isa)) {
        char known[NAME_SIZE];
        zr_isa_list(known, sizeof known);
        snprintf(message, message_size, "%s: '%.100s' is no instruction set that this machine has; it has %s", name,
                 value, known);
        return false;
    }
    snprintf((char *)config + s->offset, CONFIG_TEXT_SIZE, "%s", value);
    return true;
}

/* Sets any setting, see set_text. */
static bool set_value(struct config *config, const struct setting *s, const char *name, const char *value,
                      char *message, size_t message_size)
{
    if (s->kind != NUMBER) return set_text(config, s, name, value, message, message_size);
    uint64_t number;
    if (!parse_number(value, &number) || number < s->min || number > s->max) {
        snprintf(message, message_size, "%s: '%.100s' is not a whole number from %" PRIu64 " to %" PRIu64 "%s%s", name,
                 value, s->min, s->max, *s->unit ? " " : "", s->unit);
        return false;
    }
    *number_at(config, s) = number;
    return true;
}

/* Kubernetes sets ZRASTER_PORT=tcp://ADDRESS:PORT in every pod beside a service of the name zraster. */
static bool is_service_link(const char *value)
{
    return strncmp(value, "tcp://", strlen("tcp://")) == 0;
}

static bool read_variables(struct config *config, char *message, size_t message_size)
{
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        char name[NAME_SIZE];
        variable_name(name, SETTINGS[i].flag);
        const char *value = getenv(name);
        /* Compose files pass unset variables as "". */
        if (!value || !*value || (strcmp(SETTINGS[i].flag, "port") == 0 && is_service_link(value))) continue;
        if (!set_value(config, &SETTINGS[i], name, value, message, message_size)) return false;
    }
    return true;
}

static const struct setting *find_setting(const char *name, size_t length)
{
    for (size_t i = 0; i < SETTING_COUNT; i++)
        if (strlen(SETTINGS[i].flag) == length && memcmp(SETTINGS[i].flag, name, length) == 0) return &SETTINGS[i];
    return NULL;
}

/* Finds --help or --version, which override all other arguments. CONFIG_SERVE: neither. */
static enum config_mode find_question(int argc, char *const *argv)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) return CONFIG_HELP;
        if (strcmp(argv[i], "--version") == 0) return CONFIG_VERSION;
    }
    return CONFIG_SERVE;
}

static enum config_mode read_flags(struct config *config, int argc, char *const *argv, char *message,
                                   size_t message_size)
{
    enum config_mode mode = CONFIG_SERVE;
    for (int i = 1; i < argc; i++) {
        const char *argument = argv[i];
        if (strcmp(argument, "--health") == 0) {
            mode = CONFIG_HEALTH;
            continue;
        }
        size_t length = strcspn(argument, "=");
        const struct setting *s =
            strncmp(argument, "--", 2) == 0 && length > 2 ? find_setting(argument + 2, length - 2) : NULL;
        if (!s) {
            snprintf(message, message_size, "unknown argument '%.100s'; --help lists the known ones", argument);
            return CONFIG_WRONG;
        }
        char name[NAME_SIZE];
        snprintf(name, sizeof name, "--%s", s->flag);
        const char *value = argument[length] == '=' ? argument + length + 1 : argv[++i];
        if (!value) {
            snprintf(message, message_size, "%s: a value is missing", name);
            return CONFIG_WRONG;
        }
        if (!set_value(config, s, name, value, message, message_size)) return CONFIG_WRONG;
    }
    return mode;
}

enum config_mode config_read(struct config *config, int argc, char *const *argv, char *message, size_t message_size)
{
    set_defaults(config);
    enum config_mode mode = find_question(argc, argv);
    if (mode != CONFIG_SERVE) return mode;
    if (!read_variables(config, message, message_size)) return CONFIG_WRONG;
    mode = read_flags(config, argc, argv, message, message_size);

    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    uint64_t online = cores < 1 ? 1 : cores > ZR_TEAM_MAX ? ZR_TEAM_MAX : (uint64_t)cores;
    if (config->workers == 0) config->workers = online;
    if (config->threads == 0) config->threads = online;
    if (config->queue == 0) config->queue = QUEUE_PER_WORKER * config->workers;
    return mode;
}

struct zr_limits config_limits(const struct config *config)
{
    struct zr_limits limits = zr_limits_default();
    limits.json_depth_max = (uint32_t)config->json_depth_max;
    limits.window_side_max = (uint32_t)config->window_side_max;
    limits.window_pixels_max = config->window_pixels_max;
    limits.polygon_vertices_max = (uint32_t)config->polygon_vertices_max;
    limits.instances_max = (uint32_t)config->instances_max;
    limits.image_pixels_max = config->image_pixels_max;
    limits.coordinate_max = (float)config->coordinate_max;
    return limits;
}

enum zr_isa config_isa(const struct config *config)
{
    enum zr_isa isa;
    return zr_isa_choose(config->isa, &isa) ? isa : zr_isa_best();
}

void config_print_help(FILE *out)
{
    struct config defaults;
    set_defaults(&defaults);
    fprintf(
        out,
        "zrasterd " ZR_VERSION ": renders the scenes and meshes that clients POST to /v1/render.\n\n"
        "usage: zrasterd [--flag=value | --flag value]...\n\n"
        "  --help, --version\n"
        "  --health    health check of the daemon at --address and --port: exit status 0 if it answers well, else 1\n\n"
        "Each flag has a variable: ZRASTER_BODY_MAX_BYTES for --body-max-bytes. A flag overrides its variable.\n\n");
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        const struct setting *s = &SETTINGS[i];
        fprintf(out, "  --%s=%s\n      %s%s%s\n", s->flag, s->kind != NUMBER ? "TEXT" : "N", s->unit,
                *s->unit ? " " : "", s->help);
        if (s->kind != NUMBER)
            fprintf(out, "      (default: %s)\n", *s->text ? s->text : "none");
        else
            fprintf(out, "      %" PRIu64 " to %" PRIu64 " (default: %" PRIu64 ")\n", s->min, s->max,
                    number_of(&defaults, s));
    }
}

bool config_add_limits(const struct config *config, struct cJSON *object)
{
    for (size_t i = 0; i < SETTING_COUNT; i++) {
        const struct setting *s = &SETTINGS[i];
        if (!s->is_limit) continue;
        char name[NAME_SIZE];
        size_t used = 0;
        for (const char *p = s->flag; *p && used < NAME_SIZE - 1; p++)
            name[used++] = *p == '-' && p[1] ? (char)toupper((unsigned char)*++p) : *p;
        name[used] = '\0';
        if (!cJSON_AddNumberToObject(object, name, (double)number_of(config, s))) return false;
    }
    return true;
}
