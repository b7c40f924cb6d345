#include "options.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "format_rows.h"
#include "scene/shadings.h"

enum { EXIT_USAGE = 2, SIZE_DIGITS = 7 };

int options_wrong(const char *what, const char *which)
{
    fprintf(stderr, "zraster: %s%s%s\nzraster --help shows how it is used.\n", what, *which ? ": " : "", which);
    return EXIT_USAGE;
}

/* Reports an unknown option by its name only, since its value may be a secret. */
static int unknown(const char *flag)
{
    char name[64];
    if (strncmp(flag, "--token", strlen("--token")) == 0)
        return options_wrong("a token on the command line is seen by all who may list processes; --token-file FILE or "
                             "the variable ZRASTER_TOKEN gives it",
                             "");
    snprintf(name, sizeof name, "%.*s", (int)strcspn(flag, "="), flag);
    return options_wrong("unknown option", name);
}

/* ---- parameters ---- */

enum { ANY, MESH };
#define KIND(ID, placeholder) static const char VALUE_##ID[] = placeholder;
ZR_PARAMETER_KINDS(KIND)
#undef KIND
#define PARAMETER(name, pointer, of, kind, help) {#name, of == MESH, VALUE_##kind, help},
const struct parameter options_parameters[OPTIONS_PARAMETERS] = {ZR_PARAMETER_ROWS(PARAMETER)};
#undef PARAMETER

void options_flag_of(const char *name, size_t length, char flag[OPTIONS_FLAG_SIZE])
{
    size_t used = 0;
    flag[used++] = '-';
    flag[used++] = '-';
    for (size_t i = 0; i < length && used + 2 < OPTIONS_FLAG_SIZE; i++) {
        if (isupper((unsigned char)name[i])) flag[used++] = '-';
        flag[used++] = (char)tolower((unsigned char)name[i]);
    }
    flag[used] = '\0';
}

static const char **parameter_slot(struct options *o, const char *name)
{
    for (size_t i = 0; i < OPTIONS_PARAMETERS; i++)
        if (strcmp(options_parameters[i].name, name) == 0) return &o->parameters[i];
    return NULL;
}

/* Returns the member of `options` that a flag of `length` characters sets, or NULL. */
static const char **slot_of(struct options *o, const char *flag, size_t length)
{
    const struct {
        const char *flag;
        const char **slot;
    } table[] = {{"-o", &o->out},
                 {"--size", &o->size},
                 {"--type", &o->type},
                 {"--server", &o->server},
                 {"--token-file", &o->token_file}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strlen(table[i].flag) == length && strncmp(flag, table[i].flag, length) == 0) return table[i].slot;
    for (size_t i = 0; i < OPTIONS_PARAMETERS; i++) {
        char known[OPTIONS_FLAG_SIZE];
        options_flag_of(options_parameters[i].name, strlen(options_parameters[i].name), known);
        if (strlen(known) == length && strncmp(flag, known, length) == 0) return &o->parameters[i];
    }
    return NULL;
}

/* Returns true if the slot is a parameter that is true or false. */
static bool is_boolean(const struct options *o, const char **slot)
{
    for (size_t i = 0; i < OPTIONS_PARAMETERS; i++)
        if (slot == &o->parameters[i]) return options_parameters[i].value[0] == '[';
    return false;
}

static bool is_truth(const char *text)
{
    static const char *const words[] = {"true", "false", "1", "0"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(text, words[i]) == 0) return true;
    return false;
}

static bool is_option(const char *text)
{
    return strncmp(text, "--", 2) == 0 || strcmp(text, "-o") == 0;
}

/* Reads --name VALUE or --name=VALUE at arguments[*at] and moves *at to its last argument. A boolean takes the next
 * argument only if that is a boolean value: it may be the file. */
static int read_option(int count, char **arguments, int *at, struct options *options)
{
    const char *flag = arguments[*at], *equals = strchr(flag, '=');
    const char **slot = slot_of(options, flag, equals ? (size_t)(equals - flag) : strlen(flag));
    if (!slot) return unknown(flag);
    if (!equals && is_boolean(options, slot) && (*at + 1 >= count || !is_truth(arguments[*at + 1]))) {
        *slot = "true";
        return 0;
    }
    const char *value = equals ? equals + 1 : *at + 1 < count ? arguments[++*at] : "";
    if (*value == '\0' || (!equals && is_option(value))) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(flag, "="), flag);
        return options_wrong("a value is missing behind", name);
    }
    *slot = value;
    return 0;
}

/* ---- checks ---- */

#define FORMAT(ID, suffix, media_types, has_view, ...) {suffix, media_types, has_view},
static const struct {
    const char *suffix, *media_types; /* the first media type is sent */
    bool has_view;
} formats[] = {ZR_FORMAT_ROWS(FORMAT)};
enum { FORMATS = sizeof formats / sizeof formats[0] };

static size_t count_digits(const char *text)
{
    return strspn(text, "0123456789");
}

static bool read_size(struct options *options)
{
    const char *width = options->size, *height = width + count_digits(width) + 1;
    const size_t width_digits = count_digits(width);
    if (width_digits < 1 || width_digits > SIZE_DIGITS || width[width_digits] != 'x') return false;
    const size_t height_digits = count_digits(height);
    if (height_digits < 1 || height_digits > SIZE_DIGITS || height[height_digits] != '\0') return false;
    snprintf(options->width, sizeof options->width, "%.*s", (int)width_digits, width);
    snprintf(options->height, sizeof options->height, "%s", height);
    *parameter_slot(options, "width") = options->width;
    *parameter_slot(options, "height") = options->height;
    return true;
}

/* Finds the type by --type or the file's ending. Otherwise the daemon detects it from the bytes. */
static int find_content_type(struct options *options)
{
    static char known[128], wrong[160];
    const char *slash = strrchr(options->file, '/'), *dot = strrchr(slash ? slash : options->file, '.');
    const char *type = options->type ? options->type : dot ? dot + 1 : "";
    for (size_t i = 0; i < FORMATS; i++) {
        if (strcasecmp(type, formats[i].suffix) != 0) continue;
        snprintf(known, sizeof known, "%.*s", (int)strcspn(formats[i].media_types, " "), formats[i].media_types);
        options->content_type = known;
        options->has_view = formats[i].has_view;
        return 0;
    }
    options->content_type = "application/octet-stream";
    if (!options->type) return 0;
    for (size_t i = 0, used = 0; i < FORMATS && used < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", formats[i].suffix);
    snprintf(wrong, sizeof wrong, "--type takes one of %s, not", known);
    return options_wrong(wrong, options->type);
}

/* Refuses options that are keys of scenes. */
static int check_scene(const struct options *options)
{
    static char wrong[128];
    const char *flag = options->size ? "--size" : NULL;
    char known[OPTIONS_FLAG_SIZE];
    if (!options->has_view) return 0;
    for (size_t i = 0; i < OPTIONS_PARAMETERS && !flag; i++)
        if (options_parameters[i].of_mesh && options->parameters[i]) {
            options_flag_of(options_parameters[i].name, strlen(options_parameters[i].name), known);
            flag = known;
        }
    if (!flag) return 0;
    snprintf(wrong, sizeof wrong,
             "%s is for meshes, ending with" OPTIONS_MESHES "; a JSON scene has keys of its own for that", flag);
    return options_wrong(wrong, "");
}

int options_read(int count, char **arguments, struct options *options)
{
    bool only_files = false;
    int wrong = 0;
    for (int i = 0; i < count && !wrong; i++) {
        const char *argument = arguments[i];
        if (!only_files && strcmp(argument, "--") == 0)
            only_files = true;
        else if (!only_files && argument[0] == '-' && argument[1] != '\0')
            wrong = read_option(count, arguments, &i, options);
        else if (options->file)
            wrong = options_wrong("one file at a time; there is a second one", argument);
        else
            options->file = argument;
    }
    if (!wrong && !options->file) wrong = options_wrong("which file? usage: zraster render FILE", "");
    if (!wrong && options->size && !read_size(options))
        wrong = options_wrong("--size takes WIDTHxHEIGHT, such as 800x600, not", options->size);
    if (!wrong) wrong = find_content_type(options);
    return wrong ? wrong : check_scene(options);
}
