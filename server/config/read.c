/* read.c - settings from flags and variables. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "value.h"

enum { NAME_SIZE = 64, QUEUE_PER_WORKER = 256 };

static void variable_name(char name[NAME_SIZE], const char *flag)
{
    size_t used = (size_t)snprintf(name, NAME_SIZE, "ZRASTER_");
    for (; *flag && used < NAME_SIZE - 1; flag++)
        name[used++] = *flag == '-' ? '_' : (char)toupper((unsigned char)*flag);
    name[used] = '\0';
}

/* Kubernetes sets ZRASTER_PORT=tcp://ADDRESS:PORT in every pod beside a service of the name zraster. */
static bool is_service_link(const char *value)
{
    return strncmp(value, "tcp://", strlen("tcp://")) == 0;
}

static bool read_variables(struct config *config, char *message, size_t message_size)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++) {
        char name[NAME_SIZE];
        variable_name(name, s->flag);
        const char *value = getenv(name);
        /* Compose files pass unset variables as "". */
        if (!value || !*value || (strcmp(s->flag, "port") == 0 && is_service_link(value))) continue;
        if (!value_set(config, s, name, value, message, message_size)) return false;
    }
    return true;
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
            strncmp(argument, "--", 2) == 0 && length > 2 ? setting_find(argument + 2, length - 2) : NULL;
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
        if (!value_set(config, s, name, value, message, message_size)) return CONFIG_WRONG;
    }
    return mode;
}

enum config_mode config_read(struct config *config, int argc, char *const *argv, char *message, size_t message_size)
{
    value_set_defaults(config);
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
