/* completion.c - client: completion of bash, zsh and fish, from the rows of commands, options and parameters. */
#include <stdio.h>
#include <string.h>

#include "help.h"
#include "options/endings.h"
#include "options/parameters.h"
#include "tables.h"

/* An option as shells complete it. */
struct completed {
    char letter;
    char name[FLAG_SIZE]; /* without dashes */
    const char *value, *help;
    struct words words; /* its values; none: a number or a file */
    bool takes_file;
};

static void visit(void (*print)(const struct completed *))
{
    struct completed option;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const struct option_row *row = &option_rows[i];
        option = (struct completed){.letter = row->letter, .value = row->value, .help = row->help};
        snprintf(option.name, sizeof option.name, "%s", row->name);
        option.takes_file = row->value && (strstr(row->value, "FILE") || strstr(row->value, "DIR"));
        if (i == OPTION_TYPE)
            for (const char *at = OPTIONS_TYPES; *at; at += strcspn(at, " "))
                if (*at == ' ') at++, words_add(&option.words, at, strcspn(at, " "));
        print(&option);
    }
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        const struct parameter_row *p = &parameter_rows[i];
        char flag[FLAG_SIZE];
        option = (struct completed){.letter = parameter_letter((enum parameter)i), .value = p->value, .help = p->help};
        options_flag_of(p->name, strlen(p->name), flag);
        snprintf(option.name, sizeof option.name, "%s", flag + 2);
        if (i == PARAMETER_look) option.help = "appearance";
        tables_values(&option.words, p);
        print(&option);
    }
}

static void print_words(const struct words *words, const char *between)
{
    for (size_t i = 0; i < words->count; i++)
        printf("%s%s", i ? between : "", words->list[i]);
}

static void print_commands(const char *between)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        printf("%s%s", i ? between : "", commands[i].name);
}

/* ---- bash ---- */

static void bash_values(const struct completed *option)
{
    if (!option->words.count && !option->takes_file) return;
    printf("    --%s", option->name);
    if (option->letter) printf("|-%c", option->letter);
    if (option->takes_file)
        fputs(") COMPREPLY=($(compgen -f -- \"$cur\")); return ;;\n", stdout);
    else {
        fputs(") COMPREPLY=($(compgen -W '", stdout);
        print_words(&option->words, " ");
        fputs("' -- \"$cur\")); return ;;\n", stdout);
    }
}

static void bash_name(const struct completed *option)
{
    printf(" --%s", option->name);
}

static void print_bash(void)
{
    fputs("# bash completion of zraster\n_zraster() {\n    local cur=${COMP_WORDS[COMP_CWORD]} "
          "prev=${COMP_WORDS[COMP_CWORD-1]}\n    case $prev in\n",
          stdout);
    visit(bash_values);
    fputs("    esac\n    case $cur in\n    -*) COMPREPLY=($(compgen -W '", stdout);
    visit(bash_name);
    fputs("' -- \"$cur\")); return ;;\n    esac\n    COMPREPLY=()\n    [ \"$COMP_CWORD\" = 1 ] && COMPREPLY=($(compgen "
          "-W '",
          stdout);
    print_commands(" ");
    fputs("' -- \"$cur\"))\n    local file\n    while IFS= read -r file; do\n        case $file in\n        *.png",
          stdout);
    for (const char *at = OPTIONS_TYPES; *at; at++)
        fputs(*at == ' ' ? "|*." : (char[]){*at, '\0'}, stdout);
    fputs(") COMPREPLY+=(\"$file\") ;;\n        *) [ -d \"$file\" ] && COMPREPLY+=(\"$file\") ;;\n        esac\n"
          "    done < <(compgen -f -- \"$cur\")\n}\ncomplete -o filenames -F _zraster zraster\n",
          stdout);
}

/* ---- zsh ---- */

/* Prints a text within single quotes and brackets of _arguments. */
static void zsh_text(const char *text)
{
    for (; *text; text++)
        if (*text == '\'')
            fputs("'\\''", stdout);
        else
            printf(strchr("[]:\\", *text) ? "\\%c" : "%c", *text);
}

static void zsh_option(const struct completed *option)
{
    fputs("    ", stdout);
    if (option->letter) printf("'(-%c --%s)'{-%c,--%s}", option->letter, option->name, option->letter, option->name);
    printf(option->letter ? "'[" : "'--%s[", option->name);
    zsh_text(option->help);
    fputs("]", stdout);
    if (option->value) {
        fputs(option->value[0] == '[' ? "::" : ":", stdout);
        zsh_text(option->value);
        fputs(option->words.count ? ":(" : option->takes_file ? ":_files" : ": ", stdout);
        print_words(&option->words, " ");
        if (option->words.count) fputs(")", stdout);
    }
    fputs("' \\\n", stdout);
}

static void print_zsh(void)
{
    fputs("#compdef zraster\n_arguments -s \\\n", stdout);
    visit(zsh_option);
    fputs("    '1: :_alternative \"commands:command:(", stdout);
    print_commands(" ");
    fputs(")\" \"files:file:_files\"' '*:file:_files'\n", stdout);
}

/* ---- fish ---- */

static void fish_option(const struct completed *option)
{
    printf("complete -c zraster -l %s", option->name);
    if (option->letter) printf(" -s %c", option->letter);
    if (option->value && option->value[0] != '[') fputs(option->takes_file ? " -r -F" : " -x", stdout);
    if (option->words.count) {
        fputs(" -a '", stdout);
        print_words(&option->words, " ");
        fputs("'", stdout);
    }
    fputs(" -d '", stdout);
    for (const char *at = option->help; *at; at++)
        printf(strchr("'\\", *at) ? "\\%c" : "%c", *at);
    fputs("'\n", stdout);
}

static void print_fish(void)
{
    puts("# fish completion of zraster");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        printf("complete -c zraster -n __fish_use_subcommand -a %s -d '%s'\n", commands[i].name, commands[i].summary);
    visit(fish_option);
}

bool help_complete(const char *shell)
{
    if (strcmp(shell, "bash") == 0)
        print_bash();
    else if (strcmp(shell, "zsh") == 0)
        print_zsh();
    else if (strcmp(shell, "fish") == 0)
        print_fish();
    else
        return false;
    return true;
}
