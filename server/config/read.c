/* read.c - settings from the file, variables and flags, in this order. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "unknown.h"
#include "value.h"

extern char **environ;

/* Kubernetes sets ZRASTER_PORT=tcp://ADDRESS:PORT in every pod beside a service of the name zraster. */
static const char *variable_of(const struct setting *s)
{
    char name[SETTING_NAME_SIZE];
    setting_variable(name, s->flag);
    const char *value = getenv(name);
    /* Compose files pass unset variables as "". */
    if (!value || !*value || (strcmp(s->flag, "port") == 0 && unknown_is_others(name, strlen(name), value)))
        return NULL;
    return value;
}

static void read_variables(struct config *config, struct faults *faults)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++) {
        const char *value = variable_of(s);
        if (value && !setting_is_file(s))
            value_set(config, s, (struct config_source){CONFIG_VARIABLE, 0}, value, faults);
    }
}

static bool is_variable_of_setting(const char *name, size_t length)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)); i++) {
        char known[SETTING_NAME_SIZE];
        setting_variable(known, s->flag);
        if (strlen(known) == length && memcmp(known, name, length) == 0) return true;
    }
    return false;
}

static void refuse_unknown_variables(struct faults *faults)
{
    enum { PREFIX = sizeof SETTING_VARIABLE - 1 };
    for (char **variable = environ; *variable; variable++) {
        const size_t length = strcspn(*variable, "=");
        const char *value = (*variable)[length] ? *variable + length + 1 : "";
        if (strncmp(*variable, SETTING_VARIABLE, PREFIX) != 0 || is_variable_of_setting(*variable, length) ||
            unknown_is_others(*variable, length, value))
            continue;
        char hint[UNKNOWN_HINT_SIZE];
        unknown_hint(hint, UNKNOWN_VARIABLE, *variable + PREFIX, length - PREFIX);
        faults_add(faults, "%.*s is no variable of a setting; %s", (int)(length < 100 ? length : 100), *variable, hint);
    }
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

/* An argument: a flag that asks for something besides serving, one of a setting with its value, or neither. */
struct argument {
    const char *text;
    size_t length; /* up to the = */
    enum config_mode mode;
    const struct setting *setting;
    const char *value; /* NULL: there is none */
};

static enum config_mode mode_of(const char *text)
{
    return strcmp(text, "--health") == 0         ? CONFIG_HEALTH
           : strcmp(text, "--check-config") == 0 ? CONFIG_CHECK
           : strcmp(text, "--print-config") == 0 ? CONFIG_PRINT
                                                 : CONFIG_SERVE;
}

/* Reads argument *at and moves on. */
static struct argument next_argument(char *const *argv, int *at)
{
    struct argument a = {.text = argv[(*at)++]};
    a.length = strcspn(a.text, "=");
    a.mode = mode_of(a.text);
    if (a.mode == CONFIG_SERVE && strncmp(a.text, "--", 2) == 0) a.setting = setting_find(a.text + 2, a.length - 2);
    if (!a.setting) return a;
    a.value = a.text[a.length] == '=' ? a.text + a.length + 1 : argv[*at];
    if (a.value == argv[*at] && a.value) ++*at;
    return a;
}

/* Finds the file of settings, which is read before all others. */
static void read_file_setting(struct config *config, int argc, char *const *argv, struct faults *faults)
{
    const struct setting *s;
    for (size_t i = 0; (s = setting_at(i)) && !setting_is_file(s);)
        i++;
    const char *value = variable_of(s);
    struct config_source source = {CONFIG_VARIABLE, 0};
    for (int i = 1; i < argc;) {
        const struct argument a = next_argument(argv, &i);
        if (a.setting != s || !a.value) continue;
        value = a.value;
        source.kind = CONFIG_FLAG;
    }
    if (value) value_set(config, s, source, value, faults);
}

static void read_flag(struct config *config, const struct argument *a, struct faults *faults)
{
    char hint[UNKNOWN_HINT_SIZE];
    if (!a->setting) {
        unknown_hint(hint, UNKNOWN_FLAG, a->text, a->length);
        faults_add(faults, "unknown argument '%.*s'; %s", (int)(a->length < 100 ? a->length : 100), a->text, hint);
        return;
    }
    if (!a->value)
        faults_add(faults, "--%s: a value is missing", a->setting->flag);
    else if (!setting_is_file(a->setting))
        value_set(config, a->setting, (struct config_source){CONFIG_FLAG, 0}, a->value, faults);
}

static enum config_mode read_flags(struct config *config, int argc, char *const *argv, struct faults *faults)
{
    enum config_mode mode = CONFIG_SERVE;
    for (int i = 1; i < argc;) {
        const struct argument a = next_argument(argv, &i);
        if (a.mode != CONFIG_SERVE)
            mode = a.mode;
        else
            read_flag(config, &a, faults);
    }
    return mode;
}

enum config_mode config_read(struct config *config, int argc, char *const *argv, char *message, size_t message_size)
{
    struct faults faults;
    faults_begin(&faults, message, message_size);
    value_set_defaults(config);
    enum config_mode mode = find_question(argc, argv);
    if (mode != CONFIG_SERVE) return mode;
    read_file_setting(config, argc, argv, &faults);
    if (*config->config) file_read(config, &faults);
    read_variables(config, &faults);
    refuse_unknown_variables(&faults);
    mode = read_flags(config, argc, argv, &faults);
    faults_end(&faults);
    if (faults.count > 0) return CONFIG_WRONG;
    if (mode != CONFIG_PRINT) value_settle(config);
    return mode;
}
