#include "lists.h"

#include <string.h>

#include "input/scene/outputs.h"
#include "markdown.h"
#include "options/command_rows.h"
#include "options/endings.h"
#include "parameter_rows.h"
#include "scene/looks.h"

void lists_print_channels(const struct tables *tables)
{
    static const char *const values[] = {"4 bytes", "float32", "uint32", "–"};
    FILE *out = tables->values.out;
    fputs("| channel | values per pixel | encodings | spaces | meaning |\n|---|---|---|---|---|\n", out);
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++) {
        const struct zr_channel_row *row = &zr_channel_rows[c];
        markdown_begin_row(out, "channel", row->name);
        fprintf(out, "`%s` | ", row->name);
        if (row->words > 1) fprintf(out, "%u × ", row->words);
        fprintf(out, "%s | ", values[row->values]);
        for (int i = 0; i < row->encoding_count; i++)
            fprintf(out, "%s`%s`", i ? ", " : "", zr_encoding_names.words[row->encodings[i]]);
        fputs(" | ", out);
        for (int i = 0; i < row->space_count; i++)
            fprintf(out, "%s`%s`", i ? ", " : "", zr_space_names.words[i]);
        if (row->space_count == 0) fputs("–", out);
        markdown_end_row(out, row->text);
    }
}

void lists_print_looks(const struct tables *tables)
{
    FILE *out = tables->values.out;
    fputs("| look | versions | purpose |\n|---|---|---|\n", out);
    for (int i = 0; i < zr_look_count;) {
        const struct zr_look *look = &zr_looks[i];
        markdown_begin_row(out, "look", look->name);
        fprintf(out, "`%s` | ", look->name);
        for (int k = i; i < zr_look_count && strcmp(zr_looks[i].name, look->name) == 0; i++)
            fprintf(out, "%s`%s`", i > k ? ", " : "", zr_look_pin_of(&zr_looks[i]).text);
        markdown_end_row(out, look->text);
    }
}

/* ---- the command ---- */

/* Ends a row with cells for the arguments or the value, if there are any, and for the meaning. */
static void end_row_of_client(FILE *out, const char *arguments, const char *meaning)
{
    fputs(" | ", out);
    if (arguments && *arguments) markdown_code(out, arguments);
    markdown_end_row(out, meaning);
}

void lists_print_commands(const struct tables *tables)
{
    static const struct {
        const char *name, *arguments, *summary;
    } rows[] = {
#define ROW(name, letter, arguments, summary) {#name, arguments, summary},
        COMMAND_ROWS(ROW)
#undef ROW
    };
    FILE *out = tables->values.out;
    fputs("| command | arguments | meaning |\n|---|---|---|\n", out);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        markdown_begin_row(out, "command", rows[i].name);
        fprintf(out, "`%s`", rows[i].name);
        end_row_of_client(out, rows[i].arguments, rows[i].summary);
    }
}

void lists_print_options(const struct tables *tables)
{
    static const struct {
        const char *name, *value, *help;
        char letter;
    } rows[] = {
#define ROW(ID, name, letter, value, commands, help) {name, value, help, letter},
        OPTION_ROWS(ROW)
#undef ROW
    };
    FILE *out = tables->values.out;
    fputs("| option | value | meaning |\n|---|---|---|\n", out);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        markdown_begin_row(out, "option", rows[i].name);
        if (rows[i].letter) fprintf(out, "`-%c`, ", rows[i].letter);
        fprintf(out, "`--%s`", rows[i].name);
        end_row_of_client(out, rows[i].value, rows[i].help);
    }
}

void lists_print_formats(const struct tables *tables)
{
    static const struct {
        const char *ending, *types, *text;
        bool is_z_up;
    } rows[] = {
#define ROW(ID, ending, types, is_scene, is_binary, is_separate, is_z_up, text) {ending, types, text, is_z_up},
        ZR_FORMAT_ROWS(ROW)
#undef ROW
    };
    FILE *out = tables->values.out;
    fputs("| ending | format | content types | up |\n|---|---|---|---|\n", out);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        fprintf(out, "| `.%s` | ", rows[i].ending);
        markdown_sentence(out, rows[i].text);
        fputs(" | ", out);
        for (const char *type = rows[i].types; *type;) {
            const size_t length = strcspn(type, " ");
            fprintf(out, "%s`%.*s`", type > rows[i].types ? ", " : "", (int)length, type);
            type += length + (type[length] == ' ');
        }
        fprintf(out, " | %s |\n", rows[i].is_z_up ? "z" : "y");
    }
}
