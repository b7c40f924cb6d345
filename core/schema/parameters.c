#include "schema/parameters.h"

#include <stdio.h>
#include <string.h>

#include "input/query/parameter_values.h"
#include "input/query/parameters.h"
#include "input/text/number.h"
#include "parameter_rows.h"
#include "scene/encodings.h"
#include "scene/looks.h"
#include "scene/shadings.h"
#include "schema/schema.h"

enum { TEXT_SIZE = 1024 };

static const struct row {
    const char *name, *pointer;
    bool is_of_mesh;
    enum zr_parameter_kind kind;
    const char *help;
} rows[] = {
#define ANY                                   false
#define MESH                                  true
#define ROW(name, pointer, scope, kind, help) {#name, pointer, scope, ZR_PARAMETER_##kind, help},
    ZR_PARAMETER_ROWS(ROW)
#undef ROW
#undef ANY
#undef MESH
};
enum { ROWS = sizeof rows / sizeof *rows };

static bool is(const struct row *row, const char *name)
{
    return strcmp(row->name, name) == 0;
}

static bool is_list(const struct row *row)
{
    return row->kind == ZR_PARAMETER_VECTOR || row->kind == ZR_PARAMETER_PARTS || row->kind == ZR_PARAMETER_PRESETS ||
           row->kind == ZR_PARAMETER_WORDS || row->kind == ZR_PARAMETER_PLANES || is(row, "channel");
}

static bool is_number(const struct row *row)
{
    switch (row->kind) {
    case ZR_PARAMETER_COUNT:
    case ZR_PARAMETER_WHOLE:
    case ZR_PARAMETER_NUMBER:
    case ZR_PARAMETER_DEGREES:
    case ZR_PARAMETER_PIXELS:
    case ZR_PARAMETER_SECONDS:
    case ZR_PARAMETER_UNITS:
    case ZR_PARAMETER_SIDE:
    case ZR_PARAMETER_PIXEL:
        return true;
    default:
        return false;
    }
}

/* Returns the words that a parameter takes: presets, or those of its key or of the first key of its object. NULL: none.
 */
static const struct zr_names *words_of(const struct row *row)
{
    const struct zr_json_field *field = zr_parameter_field(row->pointer);
    if (row->kind == ZR_PARAMETER_PRESETS) return &zr_preset_names;
    if (row->kind == ZR_PARAMETER_WORDS) return &zr_annotation_names;
    if (row->kind == ZR_PARAMETER_NAME_OR_FALSE) return field->object->fields[0].words;
    return field->words;
}

/* ---- schemas ---- */

/* Names and pinned versions of looks. */
static void print_looks(struct zr_print *print)
{
    for (int i = 0; i < zr_look_count; i++) {
        if (i == 0 || strcmp(zr_looks[i - 1].name, zr_looks[i].name) != 0)
            zr_print_string(print, NULL, zr_looks[i].name);
        zr_print_string(print, NULL, zr_look_pin_of(&zr_looks[i]).text);
    }
}

static void print_words(struct zr_print *print, const struct row *row)
{
    const struct zr_names *words = words_of(row);
    zr_print_begin(print, "enum", '[');
    if (is(row, "look")) print_looks(print);
    for (int i = 0; words && i < words->count; i++)
        if (row->kind == ZR_PARAMETER_COUNT)
            zr_print_json(print, NULL, words->words[i]);
        else
            zr_print_string(print, NULL, words->words[i]);
    if (row->kind == ZR_PARAMETER_NAME_OR_FALSE) zr_print_string(print, NULL, "false");
    zr_print_end(print, ']');
}

/* A word, or the name of an environment's image. */
static void print_word_or_file(struct zr_print *print, const struct row *row)
{
    zr_print_begin(print, "anyOf", '[');
    zr_print_begin(print, NULL, '{');
    print_words(print, row);
    zr_print_end(print, '}');
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "pattern", "[.]hdr$|^sha256:");
    zr_print_end(print, '}');
    zr_print_end(print, ']');
}

static void print_range(struct zr_print *print, const char *type, double low, double high)
{
    zr_print_string(print, "type", type);
    zr_print_double(print, "minimum", low);
    zr_print_double(print, "maximum", high);
}

static void print_items(struct zr_print *print, const struct row *row)
{
    zr_print_string(print, "type", "array");
    zr_print_begin(print, "items", '{');
    zr_print_string(print, "type", row->kind == ZR_PARAMETER_VECTOR ? "number" : "string");
    if (row->kind == ZR_PARAMETER_PRESETS || row->kind == ZR_PARAMETER_WORDS || is(row, "channel"))
        print_words(print, row);
    if (row->kind == ZR_PARAMETER_PLANES)
        zr_print_string(print, "pattern", "^[xyz](:[0-9.e+-]+(:(far|positive|negative))?)?$");
    zr_print_end(print, '}');
    zr_print_count(print, "minItems", row->kind == ZR_PARAMETER_VECTOR ? 3 : 1);
    if (row->kind == ZR_PARAMETER_VECTOR) zr_print_count(print, "maxItems", 3);
}

/* Prints the default that the help ends with, "(default: 640)", if it is a value. */
static void print_default(struct zr_print *print, const struct row *row)
{
    static const char before[] = "(default: ";
    const char *found = strstr(row->help, before);
    char text[32];
    double number;
    if (!found) return;
    const size_t length = strcspn(found += sizeof before - 1, ")");
    if (length >= sizeof text || memchr(found, ' ', length)) return;
    snprintf(text, sizeof text, "%.*s", (int)length, found);
    const bool has_number = zr_number_read(text, text + length, &number) == text + length;
    if (is_number(row) ? has_number : row->kind == ZR_PARAMETER_BOOL)
        zr_print_json(print, "default", text);
    else if (!is_number(row))
        zr_print_string(print, "default", text);
}

static void print_schema(struct zr_print *print, const struct row *row, const struct zr_limits *limits)
{
    const struct zr_json_field *field = zr_parameter_field(row->pointer);
    zr_print_begin(print, "schema", '{');
    if (is_list(row))
        print_items(print, row);
    else if (row->kind == ZR_PARAMETER_BOOL)
        zr_print_string(print, "type", "boolean");
    else if (row->kind == ZR_PARAMETER_SIDE)
        print_range(print, "integer", 1, limits->window_side_max);
    else if (row->kind == ZR_PARAMETER_PIXEL)
        print_range(print, "integer", 0, UINT32_MAX);
    else if (row->kind == ZR_PARAMETER_WHOLE)
        print_range(print, "integer", field->low, field->high);
    else if (row->kind == ZR_PARAMETER_UNITS)
        zr_print_members(print, ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0}));
    else if (row->kind == ZR_PARAMETER_COUNT) {
        zr_print_string(print, "type", "integer");
        print_words(print, row);
    } else if (is_number(row))
        print_range(print, "number", field->low, field->high);
    else {
        zr_print_string(print, "type", "string");
        if (row->kind == ZR_PARAMETER_NAME_OR_FALSE)
            print_word_or_file(print, row);
        else if (words_of(row) || is(row, "look"))
            print_words(print, row);
    }
    print_default(print, row);
    zr_print_end(print, '}');
}

static void print_row(struct zr_print *print, const struct row *row, const struct zr_limits *limits)
{
    char text[TEXT_SIZE];
    const char *help = is(row, "look") ? "name of a look; NAME@VERSION pins a version (default: studio)" : row->help;
    snprintf(text, sizeof text, "%c%s.%s", zr_schema_first_letter(help), help + 1,
             row->is_of_mesh ? " For models, not for scenes." : "");
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "name", row->name);
    zr_print_string(print, "in", "query");
    zr_print_string(print, "description", text);
    if (is_list(row)) {
        zr_print_string(print, "style", "form");
        zr_print_bool(print, "explode", false);
    }
    print_schema(print, row, limits);
    zr_print_end(print, '}');
}

void zr_parameters_print(struct zr_print *print, const struct zr_limits *limits)
{
    zr_print_begin(print, "parameters", '[');
    for (size_t i = 0; i < ROWS; i++)
        print_row(print, &rows[i], limits);
    zr_print_end(print, ']');
}
