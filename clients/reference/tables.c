#include "tables.h"

#include <stdlib.h>
#include <string.h>

#include "input/query/parameters.h"
#include "input/scene/json_objects.h"
#include "markdown.h"
#include "parameter_rows.h"
#include "schema/kinds.h"
#include "schema/schema.h"

/* CELL_WORDS: a longer value stands below its table; LIST_WORDS: a longer enumeration stands in a block. */
enum { NAME_SIZE = 160, CELL_WORDS = 15, LIST_WORDS = 20, LINE_SIZE = 100 };

static size_t count_words(const char *text)
{
    size_t count = 0;
    for (; *text; text += strspn(text, " "), text += strcspn(text, " "))
        count += *text != ' ';
    return count;
}

/* ---- links ---- */

/* Prints a link to a key, "view/properties/preset", to an object or to a kind of values. */
static void put_link(const struct values *values, const char *name)
{
    const struct tables *tables = (const struct tables *)values;
    char object[NAME_SIZE];
    snprintf(object, sizeof object, "%.*s", (int)strcspn(name, "/"), name);
    const char *page = tables->page_of(object), *slash = strrchr(name, '/'), *key = slash ? slash + 1 : NULL;
    markdown_link(values->out, key ? key : object, page ? page : "values", object, key);
}

void tables_link(struct tables *tables)
{
    tables->values.refer = put_link;
}

/* ---- keys of an object ---- */

static const struct zr_json_object *find_object(const char *name)
{
    for (size_t i = 0; i < zr_schema_object_count; i++)
        if (strcmp(zr_schema_objects[i]->name, name) == 0) return zr_schema_objects[i];
    return NULL;
}

/* Returns the schema of a key in its object, or in the first of the object's types that has it. */
static const cJSON *find_key(const cJSON *all, const char *object, const char *key)
{
    const cJSON *definition = values_member(all, object), *type;
    const cJSON *found = values_member(values_member(definition, "properties"), key);
    cJSON_ArrayForEach(type, values_member(definition, "oneOf"))
    {
        if (!found) found = values_member(values_member(values_follow(all, type), "properties"), key);
    }
    return found;
}

static void put_types(FILE *out, const struct zr_json_object *object, uint32_t of)
{
    const struct zr_names *types = object->fields[0].words;
    const char *comma = "";
    if (!of) fputs("all", out);
    for (int i = 0; i < types->count; i++) {
        if (!(of >> i & 1u)) continue;
        fprintf(out, "%s%s", comma, types->words[i]);
        comma = ", ";
    }
}

/* Returns the values of a key in words, which the caller frees. The key that names the type has all types. */
static char *describe(const struct tables *tables, const struct zr_json_object *object,
                      const struct zr_json_field *field)
{
    char *text = NULL;
    size_t size = 0;
    struct tables inner = *tables;
    inner.values.out = open_memstream(&text, &size);
    if (!inner.values.out) return NULL;
    const cJSON *schema = find_key(tables->values.all, object->name, field->key);
    if (values_member(schema, "const") && field->words)
        for (int i = 0; i < field->words->count; i++)
            fprintf(inner.values.out, "%s`%s`", i ? ", " : "", field->words->words[i]);
    else
        values_print(&inner.values, schema);
    fclose(inner.values.out);
    return text;
}

static void put_default(const struct tables *tables, const struct zr_json_object *object,
                        const struct zr_json_field *field)
{
    FILE *out = tables->values.out;
    const cJSON *value = values_member(find_key(tables->values.all, object->name, field->key), "default");
    if (field->required || (field->required_of && field->required_of == field->of)) {
        fputs("required", out);
    } else if (field->required_of) {
        fputs("required for ", out);
        put_types(out, object, field->required_of);
    } else if (value) {
        values_print_json(&tables->values, value);
    } else if (field->otherwise) {
        markdown_text(out, field->otherwise);
    }
}

/* Leaves out the types that begin a meaning, as in "spot: ...", which have a column. */
static const char *meaning_of(const struct zr_json_field *field)
{
    const char *types = field->of ? strstr(field->text, ": ") : NULL;
    return types ? types + 2 : field->text;
}

/* Prints the row of a key. Returns its values if they are too long for a cell; the caller frees them. */
static char *put_key(const struct tables *tables, const struct zr_json_object *object,
                     const struct zr_json_field *field, bool is_typed)
{
    FILE *out = tables->values.out;
    char *value = describe(tables, object, field);
    const bool is_long = value && count_words(value) > CELL_WORDS;
    markdown_begin_row(out, object->name, field->key);
    fprintf(out, "`%s` | ", field->key);
    if (is_typed) put_types(out, object, field->of);
    if (is_typed) fputs(" | ", out);
    fputs(is_long ? "see below" : value ? value : "", out);
    if (field->unit) fprintf(out, "; %s", field->unit);
    fputs(" | ", out);
    put_default(tables, object, field);
    markdown_end_row(out, meaning_of(field));
    if (is_long) return value;
    free(value);
    return NULL;
}

bool tables_print_object(const struct tables *tables, const char *name)
{
    const struct zr_json_object *object = find_object(name);
    FILE *out = tables->values.out;
    char path[VALUES_PATH_SIZE];
    char *below[64] = {NULL};
    if (!object) return false;
    const bool is_typed = object->has_types;
    if (values_path(tables->values.all, name, path))
        fprintf(out, *path ? "Place in a scene: `%s`%s.\n\n" : "Place: the whole scene%s%s.\n\n", path,
                values_places(tables->values.all, name) > 1 ? ", among others" : "");
    fprintf(out, "| key | %svalue | default | meaning |\n|---|---|---|---|%s\n", is_typed ? "types | " : "",
            is_typed ? "---|" : "");
    for (size_t i = 0; i < object->count; i++)
        if (object->fields[i].read) below[i] = put_key(tables, object, &object->fields[i], is_typed);
    for (size_t i = 0; i < object->count; i++) {
        if (below[i]) fprintf(out, "\nValues of `%s`: %s.\n", object->fields[i].key, below[i]);
        free(below[i]);
    }
    return true;
}

/* ---- kinds of values ---- */

/* Returns a long list of words in the schema of a kind, or NULL. */
static const cJSON *long_list(const cJSON *schema)
{
    const cJSON *list = values_member(schema, "enum"), *item, *found = NULL;
    if (cJSON_GetArraySize(list) > LIST_WORDS) return list;
    cJSON_ArrayForEach(item, values_member(schema, "anyOf"))
    {
        if (!found) found = long_list(item);
    }
    return found;
}

static void put_block(FILE *out, const cJSON *list)
{
    const cJSON *item;
    size_t used = 0;
    fputs("```text\n", out);
    cJSON_ArrayForEach(item, list)
    {
        const char *word = cJSON_GetStringValue(item);
        if (used + strlen(word) > LINE_SIZE) {
            fputc('\n', out);
            used = 0;
        }
        used += (size_t)fprintf(out, "%s%s", used ? " " : "", word);
    }
    fputs("\n```\n", out);
}

void tables_print_values(const struct tables *tables)
{
    FILE *out = tables->values.out;
    for (size_t i = 0; i < zr_kind_count; i++) {
        const cJSON *schema = values_member(tables->values.all, zr_kind_name(i)), *list = long_list(schema);
        const char *meaning = values_text(schema, "description");
        if (!schema) continue;
        fprintf(out, "%s## %s\n\n", i ? "\n" : "", zr_kind_name(i));
        if (*meaning) {
            markdown_text(out, meaning);
            fputs(list ? "\n\n" : "\n", out);
        }
        if (list) {
            put_block(out, list);
        } else {
            fputs(*meaning ? "Form: " : "", out);
            values_print(&tables->values, schema);
            fputs(".\n", out);
        }
    }
}

/* ---- parameters ---- */

static const struct parameter {
    const char *name, *pointer;
} pointers[] = {
#define POINTER(name, pointer, ...) {#name, pointer},
    ZR_PARAMETER_ROWS(POINTER)
#undef POINTER
};

/* Prints a link to the key that a parameter sets; a dash for keys of queries alone. */
static void put_key_of(const struct tables *tables, const char *pointer)
{
    FILE *out = tables->values.out;
    const struct zr_json_field *field = zr_parameter_field(pointer);
    for (size_t i = 0; i < zr_schema_object_count; i++) {
        const struct zr_json_object *object = zr_schema_objects[i];
        for (size_t k = 0; k < object->count; k++) {
            if (&object->fields[k] != field) continue;
            markdown_link(out, pointer, tables->page_of(object->name), object->name, field->key);
            return;
        }
    }
    fputs("–", out);
}

/* Prints a part of a text for a cell. */
static void put_part(FILE *out, const char *text, size_t length)
{
    char part[512];
    snprintf(part, sizeof part, "%.*s", (int)length, text);
    markdown_text(out, part);
}

/* Prints the two last cells of a row: the default that the meaning ends with, unless the schema has one, and the rest.
 */
static void put_meaning(const struct tables *tables, const char *pointer, const char *text, const char *more,
                        const cJSON *otherwise)
{
    static const char before[] = " (default: ";
    FILE *out = tables->values.out;
    const char *brackets = strstr(text, before), *end = strstr(text, more);
    if (otherwise)
        values_print_json(&tables->values, otherwise);
    else if (brackets)
        put_part(out, brackets + sizeof before - 1, strcspn(brackets + sizeof before - 1, ")"));
    fputs(" | ", out);
    put_key_of(tables, pointer);
    fputs(" | ", out);
    if (brackets) end = brackets;
    const size_t length = end ? (size_t)(end - text) : strlen(text);
    put_part(out, text, length);
    if (length > 0 && text[length - 1] != '.') fputc('.', out);
}

static void put_parameters(const struct tables *tables, bool is_of_models)
{
    static const char more[] = " For models, not for scenes.";
    FILE *out = tables->values.out;
    fputs("| parameter | value | default | sets | meaning |\n|---|---|---|---|---|\n", out);
    for (size_t i = 0; i < sizeof pointers / sizeof *pointers; i++) {
        const cJSON *row = cJSON_GetArrayItem(tables->parameters, (int)i), *schema = values_member(row, "schema");
        const cJSON *otherwise = values_member(schema, "default"), *words = values_member(schema, "enum");
        const char *meaning = values_text(row, "description");
        if ((strstr(meaning, more) != NULL) != is_of_models) continue;
        if (!words) words = values_member(values_member(schema, "items"), "enum");
        markdown_begin_row(out, pointers[i].name, NULL);
        fprintf(out, "`%s` | ", pointers[i].name);
        if (cJSON_GetArraySize(words) > CELL_WORDS)
            fputs(strcmp(pointers[i].name, "look") == 0 ? "name of a [look](looks.md)"
                                                        : "names of [channels](output.md#channels)",
                  out);
        else
            values_print(&tables->values, schema);
        fputs(" | ", out);
        put_meaning(tables, pointers[i].pointer, meaning, more, otherwise);
        fputs(" |\n", out);
    }
}

void tables_print_parameters(const struct tables *tables)
{
    fputs("## For scenes and models\n\n", tables->values.out);
    put_parameters(tables, false);
    fputs("\n## For models\n\nA scene has keys for these.\n\n", tables->values.out);
    put_parameters(tables, true);
}

/* ---- all objects ---- */

void tables_print_index(const struct tables *tables)
{
    FILE *out = tables->values.out;
    fputs("| object | place |\n|---|---|\n", out);
    for (size_t i = 0; i < zr_schema_object_count; i++) {
        const char *name = zr_schema_objects[i]->name;
        char path[VALUES_PATH_SIZE];
        fputs("| ", out);
        put_link(&tables->values, name);
        if (values_path(tables->values.all, name, path) && *path)
            fprintf(out, " | `%s` |\n", path);
        else
            fputs(" | the whole |\n", out);
    }
}
