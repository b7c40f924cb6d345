#include "value.h"

#include <inttypes.h>
#include <netdb.h>
#include <string.h>
#include <unistd.h>

#include "gate/forwarded.h"

enum { LIST_SIZE = 64, QUEUE_PER_WORKER = 256 };

uint64_t value_number(const struct config *config, const struct setting *setting)
{
    return *(const uint64_t *)(const void *)((const char *)config + setting->offset);
}

const char *value_text(const struct config *config, const struct setting *setting)
{
    return (const char *)config + setting->offset;
}

static void store_number(struct config *config, const struct setting *setting, uint64_t number)
{
    *(uint64_t *)(void *)((char *)config + setting->offset) = number;
}

void value_set_defaults(struct config *config)
{
    const struct setting *s;
    *config = (struct config){0};
    for (size_t i = 0; (s = setting_at(i)); i++) {
        if (s->kind != NUMBER)
            snprintf((char *)config + s->offset, CONFIG_TEXT_SIZE, "%s", s->text);
        else
            store_number(config, s, s->initial);
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

static bool is_any(const char *text)
{
    (void)text;
    return true;
}

static bool is_address(const char *text)
{
    struct addrinfo hints = {.ai_flags = AI_NUMERICHOST}, *address = NULL;
    const int failure = *text ? getaddrinfo(text, NULL, &hints, &address) : EAI_NONAME;
    if (failure == 0) freeaddrinfo(address);
    return failure == 0 || failure == EAI_MEMORY; /* then listening reports the lack of memory */
}

static bool is_switch(const char *text)
{
    return strcmp(text, "on") == 0 || strcmp(text, "off") == 0;
}

static bool is_isa(const char *text)
{
    enum zr_isa isa;
    return zr_isa_choose(text, &isa);
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

static bool are_networks(const char *text)
{
    struct networks networks;
    return networks_parse(&networks, text);
}

static bool is_client_header(const char *text)
{
    enum forwarded_form form;
    return forwarded_form_parse(&form, text);
}

/* The check of each kind, and the complaint about a wrong value. */
static const struct {
    bool (*is_right)(const char *text);
    const char *complaint;
} KINDS[] = {
    [TEXT] = {is_any, ""},
    [SECRET] = {is_any, ""},
    [ADDRESS] = {is_address, "is not a numeric IPv4 or IPv6 address"},
    [ISA] = {is_isa, "is no instruction set that this machine has; it has "}, /* their names follow */
    [ORIGINS] = {are_origins, "is no list of origins such as https://example.org: scheme and host, without a path or a "
                              "/ at the end"},
    [SWITCH] = {is_switch, "is neither on nor off"},
    [NETWORKS] = {are_networks,
                  "is no list of addresses and networks such as 10.0.0.1, 10.0.0.0/8, 2001:db8::/32, "
                  "loopback and private; a network of all addresses (/0) would let each client choose its own"},
    [CLIENT_HEADER] = {is_client_header, "is none of x-forwarded-for, forwarded and none"},
    [FOLDER] = {is_any, ""},
};

static bool has_control(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127) return true;
    return false;
}

/* False: the value is a fault. */
static bool set_text(struct config *config, const struct setting *s, const char *name, const char *value,
                     struct faults *faults)
{
    char known[LIST_SIZE] = "";
    if (s->kind == ISA) zr_isa_list(known, sizeof known);
    if (strlen(value) >= CONFIG_TEXT_SIZE)
        faults_add(faults, "%s: longer than the %d bytes that are allowed", name, CONFIG_TEXT_SIZE - 1);
    else if (has_control(value))
        faults_add(faults, "%s: the value has a control character", name);
    else if (!KINDS[s->kind].is_right(value))
        faults_add(faults, "%s: '%.100s' %s%s", name, value, KINDS[s->kind].complaint, known);
    else
        return snprintf((char *)config + s->offset, CONFIG_TEXT_SIZE, "%s", value) >= 0;
    return false;
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

static bool set_number(struct config *config, const struct setting *s, const char *name, const char *value,
                       struct faults *faults)
{
    uint64_t number;
    if (!parse_number(value, &number) || number < s->min || number > s->max) {
        faults_add(faults, "%s: '%.100s' is not a whole number from %" PRIu64 " to %" PRIu64 "%s%s", name, value,
                   s->min, s->max, *s->unit ? " " : "", s->unit);
        return false;
    }
    store_number(config, s, number);
    return true;
}

void value_place(const struct config *config, const struct setting *s, struct config_source source,
                 char place[VALUE_PLACE_SIZE])
{
    if (source.kind == CONFIG_FILE)
        snprintf(place, VALUE_PLACE_SIZE, "%s:%u: %s", config->config, source.line, s->flag);
    else if (source.kind == CONFIG_VARIABLE)
        setting_variable(place, s->flag);
    else
        snprintf(place, VALUE_PLACE_SIZE, "--%s", s->flag);
}

void value_set(struct config *config, const struct setting *s, struct config_source source, const char *value,
               struct faults *faults)
{
    char place[VALUE_PLACE_SIZE];
    value_place(config, s, source, place);
    if (s->kind == NUMBER ? set_number(config, s, place, value, faults) : set_text(config, s, place, value, faults))
        *setting_source(config, s) = source;
}

void value_settle(struct config *config)
{
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    uint64_t online = cores < 1 ? 1 : cores > ZR_TEAM_MAX ? ZR_TEAM_MAX : (uint64_t)cores;
    if (config->workers == 0) config->workers = online;
    if (config->threads == 0) config->threads = online;
    if (config->queue == 0) config->queue = QUEUE_PER_WORKER * config->workers;
}
