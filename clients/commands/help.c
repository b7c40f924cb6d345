/* help.c - client: `zraster help` and `zraster looks`, from the rows of commands, options and parameters. */
#include "help.h"

#include <stdio.h>
#include <string.h>

#include "drawing_rows.h"
#include "keys.h"
#include "options/parameters.h"
#include "tables.h"

#define COUNTED(...) +1

enum { COLUMN = 32 }; /* after the longest option with its placeholder */

static const char head[] = "Usage: zraster [render] FILE... [-o OUTPUT] [OPTION]...\n"
                           "Renders 3D scenes and models to pictures, depth maps and ids. No GPU, display or server is "
                           "needed.\n"
                           "\n"
                           "  zraster part.stl                              write part.png\n"
                           "  zraster part.stl out.png -s 800x600           choose name and size\n"
                           "  zraster part.stl --look technical --show      draw in the terminal\n"
                           "  zraster scene.json -c color,depth -o out/     write out/scene.png and "
                           "out/scene.depth.npy\n"
                           "  zraster batch parts -o pictures               draw all files of a folder\n"
                           "  cat part.stl | zraster - > part.png\n";

static void print_commands(FILE *out)
{
    fputs("Commands: ", out);
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        fprintf(out, "%s%s", i ? ", " : "", commands[i].name);
    fputs(". \"zraster help COMMAND\" explains one.\n", out);
}

int help_short(void)
{
    fputs(head, stderr);
    print_commands(stderr);
    return STATUS_USAGE;
}

static void print_row(char letter, const char *flag, const char *value, const char *help, const char *more)
{
    char shown[3] = "  ";
    if (letter) snprintf(shown, sizeof shown, "-%c", letter);
    const int used = printf("  %s%s %s%s%s", shown, letter ? "," : " ", flag, value ? " " : "", value ? value : "");
    printf("%*s%s%s\n", used < COLUMN ? COLUMN - used : 1, "", help, more);
}

static void print_options(const struct command *command, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++) {
        const struct option_row *row = &option_rows[i];
        char flag[FLAG_SIZE];
        snprintf(flag, sizeof flag, "--%s", row->name);
        if (strchr(row->commands, command->letter)) print_row(row->letter, flag, row->value, row->help, "");
    }
}

/* Prints the parameters of `zraster drawing`: those of drawings with their own help. */
static void print_drawing_parameters(const struct command *command)
{
#define DRAWING(name, placeholder, values, help, otherwise) {#name, placeholder, help " (default: " otherwise ")"},
    static const struct {
        const char *name, *value, *help;
    } rows[] = {ZR_DRAWING_ROWS(DRAWING)};
    enum { ROWS = sizeof rows / sizeof *rows };
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        const struct parameter_row *p = &parameter_rows[i];
        char flag[FLAG_SIZE];
        size_t own = 0;
        if (!options_has_parameter(command, (enum parameter)i)) continue;
        while (own < ROWS && strcmp(rows[own].name, p->name) != 0)
            own++;
        options_flag_of(p->name, strlen(p->name), flag);
        print_row(0, flag, own < ROWS ? rows[own].value : p->value, own < ROWS ? rows[own].help : p->help, "");
    }
}

/* Prints the parameters that a command has; the names of the looks come before the help of `look`. */
static void print_parameters(const struct command *command)
{
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        const struct parameter_row *p = &parameter_rows[i];
        char flag[FLAG_SIZE], names[WORDS_SIZE] = "";
        if (i == PARAMETER_channel && command->run == command_info) continue;
        options_flag_of(p->name, strlen(p->name), flag);
        if (p->of_mesh && !parameter_rows[i - 1].of_mesh) puts("\nModels (a scene has keys for these):");
        if (i == PARAMETER_look) {
            struct words words = {.count = 0};
            tables_looks(&words);
            for (size_t k = 0, used = 0; k < words.count && used < sizeof names; k++)
                used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", k ? ", " : "", words.list[k]);
        }
        print_row(parameter_letter((enum parameter)i), flag, p->value, i == PARAMETER_look ? names : p->help,
                  i == PARAMETER_look ? p->help : "");
    }
}

static void print_end(void)
{
    puts(
        "\n--name=value is the same as --name value. Without its value, [BOOL] is true. Arguments after -- are files.\n"
        "Pictures, arrays and JSON go to files or standard output, all else goes to standard error.\n"
        "\nExit status: 0 done; 1 some file failed; 2 wrong command line; 3 warnings with --strict; 4 compare: "
        "pictures or models differ; 130 interrupted.");
}

void help_print(const struct command *command)
{
    const size_t general = 0 OUTPUT_OPTION_ROWS(COUNTED) DRAWING_OPTION_ROWS(COUNTED);
    const bool is_drawing = strchr(DRAWING_COMMANDS, command->letter) != NULL;
    if (command == &commands[0]) {
        fputs(head, stdout);
        puts("\nCommands:");
        for (size_t i = 0; i < COMMAND_COUNT; i++)
            printf("  %-9s %s\n", commands[i].name, commands[i].summary);
    } else
        printf("Usage: zraster %s%s%s\n%s\n", command->name, *command->arguments ? " " : "", command->arguments,
               command->summary);
    if (strchr("ribcdw", command->letter)) puts("\nOutput:");
    print_options(command, 0, general);
    if (is_drawing) {
        puts("\nPicture:");
        print_parameters(command);
    }
    if (command->run == command_drawing) print_drawing_parameters(command);
    puts("\nGeneral:");
    print_options(command, general, OPTION_COUNT);
    print_end();
}

int command_help(struct options *options)
{
    const char *name = options->file_count ? options->files[0] : "render";
    if (strcmp(name, "completion") == 0 && options->file_count == 2 && help_complete(options->files[1])) return 0;
    struct near_word near = {.word = name};
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        near_offer(&near, commands[i].name);
        if (strcmp(name, commands[i].name) != 0) continue;
        help_print(&commands[i]);
        return 0;
    }
    if (keys_explain(name)) return 0;
    keys_offer(&near);
    if (near.best) return options_wrong("there is no command, key or word %s; did you mean %s?", name, near.best);
    return options_wrong(
        "there is no command, key or word %s; \"zraster help\" lists all commands, \"zraster help scene\" "
        "all keys of a scene",
        name);
}

int command_looks(struct options *options)
{
    struct words words = {.count = 0};
    if (options->file_count) return options_wrong("looks accepts no file; --look NAME chooses a look");
    tables_looks(&words);
    for (size_t i = 0; i < words.count; i++)
        puts(words.list[i]);
    return 0;
}
