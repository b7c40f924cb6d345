#include "options.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "endings.h"
#include "files/bytes.h"
#include "files/say.h"
#include "memory.h"
#include "parameter_kinds.h"
#include "parameters.h"
#include "scene/encodings.h"
#include "scene/shadings.h"
#include "words.h"

enum { SIZE_DIGITS = 7, SHARD_DIGITS = 7 };

int options_wrong(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say_list(format, arguments);
    va_end(arguments);
    return STATUS_USAGE;
}

/* ---- the tables ---- */

#define COMMAND(name, letter, arguments, summary) {#name, letter, arguments, summary, command_##name},
const struct command commands[COMMAND_COUNT] = {COMMAND_ROWS(COMMAND)};

#define OPTION(ID, name, letter, value, of, help) {name, letter, value, of, help},
const struct option_row option_rows[OPTION_COUNT] = {OPTION_ROWS(OPTION)};

enum { ANY, MESH };
#define KIND(ID, placeholder) static const char VALUE_##ID[] = placeholder;
ZR_PARAMETER_KINDS(KIND)
#define PARAMETER(name, pointer, of, kind, help) {#name, pointer, of == MESH, VALUE_##kind, help},
_Static_assert((int)PARAMETER_COUNT <= PARAMETERS_MAX, "struct options has room for each");
const struct parameter_row parameter_rows[PARAMETER_COUNT] = {ZR_PARAMETER_ROWS(PARAMETER)};

char parameter_letter(enum parameter parameter)
{
#define LETTER(name, letter) [PARAMETER_##name] = letter,
    static const char letters[PARAMETER_COUNT] = {LETTER_ROWS(LETTER)};
    return letters[parameter];
}

void options_flag_of(const char *name, size_t length, char flag[FLAG_SIZE])
{
    size_t used = 0;
    flag[used++] = '-';
    flag[used++] = '-';
    for (size_t i = 0; i < length && used + 2 < FLAG_SIZE; i++) {
        if (isupper((unsigned char)name[i])) flag[used++] = '-';
        flag[used++] = (char)tolower((unsigned char)name[i]);
    }
    flag[used] = '\0';
}

static void flag_of(size_t parameter, char flag[FLAG_SIZE])
{
    options_flag_of(parameter_rows[parameter].name, strlen(parameter_rows[parameter].name), flag);
}

bool options_set(struct options *options, const char *name, const char *value)
{
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        if (strcmp(parameter_rows[i].name, name) == 0) {
            options->parameters[i] = value;
            return true;
        }
    return false;
}

/* ---- one option ---- */

/* An option that was found: its slot, and its row or parameter. */
struct found {
    const char **slot;
    const struct option_row *row;
    const struct parameter_row *parameter;
};

/* Finds an option by "--name", or by its letter if that is not 0. */
static struct found find(struct options *o, const char *flag, size_t length, char letter)
{
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = &option_rows[i];
        const bool is_name = length == strlen(row->name) + 2 && strncmp(flag, "--", 2) == 0 &&
                             strncmp(flag + 2, row->name, length - 2) == 0;
        if (letter ? row->letter == letter : is_name) return (struct found){&o->own[i], row, NULL};
    }
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        char known[FLAG_SIZE];
        flag_of(i, known);
        const bool is_name = strlen(known) == length && strncmp(flag, known, length) == 0;
        if (letter ? parameter_letter((enum parameter)i) == letter : is_name)
            return (struct found){&o->parameters[i], NULL, &parameter_rows[i]};
    }
    return (struct found){NULL, NULL, NULL};
}

/* Reports an unknown option by its name only, since its value may be a secret. */
static int unknown(const char *flag, size_t length)
{
    static char best[FLAG_SIZE]; /* near.best points here */
    char name[FLAG_SIZE + 1], known[FLAG_SIZE];
    if (strncmp(flag, "--token", strlen("--token")) == 0)
        return options_wrong("a token on the command line is visible to all users of this machine; give it with "
                             "--token-file FILE or the variable ZRASTER_TOKEN");
    snprintf(name, sizeof name, "%.*s", (int)length, flag);
    if (strcasecmp(name, "-w") == 0) return options_wrong("unknown option -w; did you mean -W (width)?");
    char wanted[FLAG_SIZE + 2];
    snprintf(wanted, sizeof wanted, "%s%s", flag[1] == '-' ? "" : "-", name);
    struct near_word near = {.word = wanted};
    for (size_t i = 0; i < OPTION_COUNT + PARAMETER_COUNT; i++) {
        if (i < OPTION_COUNT)
            snprintf(known, sizeof known, "--%s", option_rows[i].name);
        else
            flag_of(i - OPTION_COUNT, known);
        near_offer(&near, known);
        if (near.best == known) near.best = strcpy(best, known);
    }
    if (near.best) return options_wrong("unknown option %s; did you mean %s?", name, near.best);
    return options_wrong("unknown option %s; \"zraster help\" lists all options", name);
}

static bool is_truth(const char *text)
{
    static const char *const words[] = {"true", "false", "1", "0"};
    for (size_t i = 0; text && i < sizeof words / sizeof *words; i++)
        if (strcmp(text, words[i]) == 0) return true;
    return false;
}

/* Returns true for a word that people write behind an option to turn it on or off, unless a file has that name. */
static bool is_switch_word(const char *text)
{
    static const char *const words[] = {"on", "off", "yes", "no", "true", "false", "1", "0"};
    for (size_t i = 0; text && i < sizeof words / sizeof *words; i++)
        if (strcasecmp(text, words[i]) == 0) return access(text, F_OK) != 0;
    return false;
}

/* Returns true for "--name", and for "-x" that is no number. */
static bool is_option(const char *text)
{
    return text[0] == '-' && (text[1] == '-' || isalpha((unsigned char)text[1]));
}

/* Returns true for "-x", "-y" and "-z", which are no options. */
static bool is_axis(const char *text)
{
    return text[0] == '-' && text[1] >= 'x' && text[1] <= 'z' && text[2] == '\0';
}

static int missing(const struct found *found, const char *flag, size_t length)
{
    const char *value = found->row ? found->row->value : found->parameter->value;
    const bool is_color = strcmp(value, "COLOR") == 0;
    return options_wrong("a value is missing after %.*s: %.*s %s%s", (int)length, flag, (int)length, flag, value,
                         is_color ? "; the shell reads # as a comment: quote '#ff6347'" : "");
}

static int store(struct options *options, const struct found *found, const char *value)
{
    if (found->row == &option_rows[OPTION_PART]) {
        const char *equals = strchr(value, '=');
        if (!equals || equals == value || !equals[1])
            return options_wrong("--part accepts NAME=FILE, such as --part wood=wood.png, not %s", value);
        if (options->part_count == PARTS_MAX) return options_wrong("--part: at most %d parts are allowed", PARTS_MAX);
        options->parts[options->part_count++] = value;
    }
    *found->slot = value;
    return 0;
}

/* Reads --name VALUE, --name=VALUE, -x VALUE or -xVALUE at arguments[*at] and moves *at to its last argument. A
 * boolean parameter uses the next argument only if that is true or false: it may be the file. */
static int read_option(int count, const char **arguments, int *at, struct options *options)
{
    const char *flag = arguments[*at];
    size_t length = strcspn(flag, "=");
    const char *inside = flag[length] ? flag + length + 1 : NULL;
    struct found found = find(options, flag, length, 0);
    if (!found.slot && flag[1] != '-') {
        char dashed[FLAG_SIZE];
        snprintf(dashed, sizeof dashed, "-%.*s", (int)length, flag);
        if (length > 2 && find(options, dashed, length + 1, 0).slot)
            return options_wrong("unknown option %.*s; did you mean %s?", (int)length, flag, dashed);
        found = find(options, flag, 0, flag[1]);
        if (flag[2] && flag[2] != '=') inside = flag + 2;
        length = found.slot ? 2 : length;
    }
    if (!found.slot) return unknown(flag, length);
    const char *next = *at + 1 < count ? arguments[*at + 1] : NULL;
    if (found.row && !found.row->value) {
        if (!inside && is_switch_word(next)) inside = next;
        if (inside) return options_wrong("%.*s has no value; leave out %s", (int)length, flag, inside);
        return store(options, &found, "true");
    }
    const bool is_boolean = found.parameter && found.parameter->value[0] == '[';
    if (is_boolean && !inside && !is_truth(next)) {
        if (is_switch_word(next))
            return options_wrong("%.*s accepts true, false or nothing, not %s", (int)length, flag, next);
        return store(options, &found, "true");
    }
    const char *value = inside ? inside : next ? arguments[++*at] : "";
    const bool may_be_axis = found.parameter && strcmp(found.parameter->value, "AXIS") == 0;
    if (*value == '\0' || (!inside && is_option(value) && !(may_be_axis && is_axis(value))))
        return missing(&found, flag, length);
    return store(options, &found, value);
}

/* ---- checks ---- */

static size_t count_digits(const char *text)
{
    return strspn(text, "0123456789");
}

/* Reads WxH or N. */
static int read_size(struct options *options)
{
    const char *size = options->own[OPTION_SIZE];
    if (!size) return 0;
    const size_t width = count_digits(size), height = size[width] ? count_digits(size + width + 1) : width;
    const char *second = size[width] ? size + width + 1 : size;
    if (width < 1 || width > SIZE_DIGITS || height < 1 || height > SIZE_DIGITS || second[height] ||
        (size[width] && size[width] != 'x'))
        return options_wrong("--size accepts WIDTHxHEIGHT, such as 800x600, or one number for a square, not %s", size);
    if (options->parameters[PARAMETER_width] || options->parameters[PARAMETER_height])
        return options_wrong("--size and %s both set the window; leave one out",
                             options->parameters[PARAMETER_width] ? "--width" : "--height");
    snprintf(options->width, sizeof options->width, "%.*s", (int)width, size);
    snprintf(options->height, sizeof options->height, "%s", second);
    options->parameters[PARAMETER_width] = options->width;
    options->parameters[PARAMETER_height] = options->height;
    return 0;
}

/* Completes a width or height alone to 4:3, for models; a scene keeps its own. The renderer reports texts that are no
 * numbers. */
static void complete_size(struct options *options)
{
    const char *width = options->parameters[PARAMETER_width], *height = options->parameters[PARAMETER_height];
    const char *one = width ? width : height;
    if (!one || (width && height) || strlen(one) > SIZE_DIGITS || one[count_digits(one)]) return;
    const int side = atoi(one), other = width ? side * 3 / 4 : side * 4 / 3;
    snprintf(options->width, sizeof options->width, "%d", other > 0 ? other : 1);
    options->completed = options->width;
    options->parameters[width ? PARAMETER_height : PARAMETER_width] = options->completed;
}

static int check_channels(const struct options *options)
{
    const char *list = options->parameters[PARAMETER_channel];
    for (const char *at = list; at && *at; at += strcspn(at, ","), at += *at == ',') {
        const size_t length = strcspn(at, ",");
        for (const char *other = list; length && other < at; other += strcspn(other, ",") + 1)
            if (strcspn(other, ",") == length && strncmp(other, at, length) == 0)
                return options_wrong("--channel: %.*s is given twice", (int)length, at);
    }
    return 0;
}

/* Checks I/N, with I below N. */
static int check_shard(const struct options *options)
{
    const char *shard = options->own[OPTION_SHARD];
    if (!shard) return 0;
    const size_t first = count_digits(shard), second = shard[first] == '/' ? count_digits(shard + first + 1) : 0;
    const bool are_numbers =
        first >= 1 && first <= SHARD_DIGITS && second >= 1 && second <= SHARD_DIGITS && !shard[first + 1 + second];
    const struct shard read = are_numbers ? options_shard(options) : (struct shard){0};
    if (read.index < read.count) return 0;
    return options_wrong("--shard accepts I/N, the shard I of N, from 0/N to N-1/N, such as 0/4 or 3/4, not %s", shard);
}

static int check_values(struct options *options)
{
    const char *strict = options->parameters[PARAMETER_strict], *threads = options->own[OPTION_THREADS];
    const char *server = options->own[OPTION_SERVER], *most = options->own[OPTION_MAX_FILE_BYTES];
    if (strict && !is_truth(strict)) return options_wrong("--strict accepts true, false or nothing, not %s", strict);
    if (threads && (threads[count_digits(threads)] || atoi(threads) < 1 || atoi(threads) > THREADS_MAX))
        return options_wrong("--threads accepts a number from 1 to %d, not %s", THREADS_MAX, threads);
    if (most && (most[count_digits(most)] || !*most || strlen(most) > 18))
        return options_wrong("--max-file-bytes accepts a number of bytes, not %s", most);
    size_t memory;
    if (options->own[OPTION_MEMORY] && !memory_read(options->own[OPTION_MEMORY], (size_t)1 << 40, &memory))
        return options_wrong(
            "--memory accepts a size from 1M on, such as 8G or 512M, or a share of what the system can spare, such "
            "as 50%%, not %s",
            options->own[OPTION_MEMORY]);
    if (most) bytes_set_most(strtoull(most, NULL, 10));
    if (!server && getenv("ZRASTER_SERVER") && *getenv("ZRASTER_SERVER"))
        options->own[OPTION_SERVER] = getenv("ZRASTER_SERVER");
    if (options->own[OPTION_SERVER] && options->own[OPTION_MEMORY])
        return options_wrong("--memory limits drawing on this machine, but %s draws: its own limit holds",
                             options->own[OPTION_SERVER]);
    int wrong = check_channels(options);
    if (!wrong) wrong = check_shard(options);
    if (!wrong) wrong = read_size(options);
    if (!wrong) complete_size(options);
    return wrong;
}

bool options_has_parameter(const struct command *command, enum parameter parameter)
{
#define HAS(name) [PARAMETER_##name] = true,
    static const bool of_drawings[PARAMETER_COUNT] = {DRAWING_PARAMETER_ROWS(HAS)};
    return strchr(DRAWING_COMMANDS, command->letter) || (command->run == command_drawing && of_drawings[parameter]);
}

/* Refuses options of other commands. */
static int check_commands(const struct options *options)
{
    const struct command *command = options->command;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = &option_rows[i];
        if (!options->own[i] || strchr(row->commands, command->letter)) continue;
        const struct command *other = commands;
        while (other->letter != row->commands[0])
            other++;
        return options_wrong("--%s is no option of \"zraster %s\"; \"zraster %s\" has it", row->name, command->name,
                             other->name);
    }
    char flag[FLAG_SIZE];
    for (size_t i = 0; i < PARAMETER_COUNT; i++)
        if (options->parameters[i] && !options_has_parameter(command, (enum parameter)i)) {
            flag_of(i, flag);
            return options_wrong("%s is no option of \"zraster %s\"; \"zraster render\" has it", flag, command->name);
        }
    return 0;
}

bool options_strict(const struct options *options)
{
    const char *strict = options->parameters[PARAMETER_strict];
    return strict && (strcmp(strict, "true") == 0 || strcmp(strict, "1") == 0);
}

unsigned options_threads(const struct options *options)
{
    return options->own[OPTION_THREADS] ? (unsigned)atoi(options->own[OPTION_THREADS]) : 0;
}

struct shard options_shard(const struct options *options)
{
    const char *shard = options->own[OPTION_SHARD];
    if (!shard) return (struct shard){0, 1};
    return (struct shard){(size_t)atol(shard), (size_t)atol(strchr(shard, '/') + 1)};
}

/* Sets the command. Returns the number of arguments that name it: 1, or 0 for the default. */
static int take_command(int count, const char **arguments, struct options *options)
{
    options->command = &commands[0];
    for (size_t i = 0; count > 0 && i < COMMAND_COUNT; i++)
        if (strcmp(arguments[0], commands[i].name) == 0) {
            options->command = &commands[i];
            return 1;
        }
    return 0;
}

int options_read(int count, const char **arguments, struct options *options)
{
    bool only_files = false;
    int wrong = 0;
    *options = (struct options){.files = arguments};
    for (int i = take_command(count, arguments, options); i < count && !wrong; i++) {
        const char *argument = arguments[i];
        if (!only_files && strcmp(argument, "--") == 0)
            only_files = true;
        else if (!only_files && argument[0] == '-' && argument[1] != '\0')
            wrong = read_option(count, arguments, &i, options);
        else if (*argument)
            options->files[options->file_count++] = argument;
        else
            wrong = options_wrong("an argument is empty; a file is expected there, such as \"zraster part.stl\"");
    }
    if (wrong || options->own[OPTION_HELP] || options->own[OPTION_VERSION]) return wrong;
    wrong = check_commands(options);
    return wrong ? wrong : check_values(options);
}
