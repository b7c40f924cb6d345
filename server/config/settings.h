/* settings.h - the table of settings, which gives each its flag, default, unit, bounds and help line. */
#ifndef ZRASTERD_SETTINGS_H
#define ZRASTERD_SETTINGS_H

#include "config.h"

#define SETTING_VARIABLE "ZRASTER_"

enum { SETTING_NAME_SIZE = 64 };

/* value.c checks the values of each kind. */
enum setting_kind {
    TEXT,
    SECRET, /* a text that is never shown */
    ADDRESS,
    ISA,
    ORIGINS,
    SWITCH,
    NETWORKS,
    CLIENT_HEADER,
    FOLDER, /* "": none */
    NUMBER
};

struct setting {
    const char *flag;
    enum setting_kind kind;
    size_t offset; /* in struct config, of a uint64_t for NUMBER and of CONFIG_TEXT_SIZE bytes for all others */
    bool is_limit; /* shown by /v1/limits */
    uint64_t initial, min, max;
    const char *text; /* default of all kinds but NUMBER */
    const char *unit; /* "" if the name includes it */
    const char *help;
};

/* NULL after the last. */
const struct setting *setting_at(size_t index);

/* Finds a setting by the name of its flag without --. NULL: there is none. */
const struct setting *setting_find(const char *name, size_t length);

/* Returns true for --config, the file that has the others. */
bool setting_is_file(const struct setting *setting);

struct config_source *setting_source(struct config *config, const struct setting *setting);

/* Writes the variable of a flag: ZRASTER_BODY_MAX_BYTES for body-max-bytes. */
void setting_variable(char name[SETTING_NAME_SIZE], const char *flag);

#endif
