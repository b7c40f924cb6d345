#include "values.h"

#include <ctype.h>
#include <string.h>

enum { DEPTH_MAX = 8, REFERENCE_SIZE = 80 };

static const char prefix[] = "#/$defs/";

const cJSON *values_member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

const char *values_text(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(values_member(object, key));
    return text ? text : "";
}

const char *values_name(const cJSON *schema)
{
    const char *at = values_text(schema, "$ref");
    return strncmp(at, prefix, sizeof prefix - 1) == 0 ? at + sizeof prefix - 1 : NULL;
}

const cJSON *values_follow(const cJSON *all, const cJSON *schema)
{
    const char *at = values_name(schema);
    const cJSON *found = at ? all : NULL;
    while (found && *at) {
        char name[REFERENCE_SIZE];
        const size_t length = strcspn(at, "/");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        found = values_member(found, name);
        at += length + (at[length] == '/');
    }
    return found;
}

void values_print_json(const struct values *values, const cJSON *value)
{
    char *text = cJSON_PrintUnformatted(value);
    const char *word = cJSON_GetStringValue(value),
               *quote = values->quote && (word || cJSON_IsArray(value)) ? values->quote : "";
    fprintf(values->out, "%s%s%s", quote, word ? word : text ? text : "", quote);
    cJSON_free(text);
}

static void print_list_of_values(const struct values *values, const cJSON *list)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        if (item != list->child) fputs(", ", values->out);
        values_print_json(values, item);
    }
}

/* Prints a number in full, but from 1e12 on as a power of ten. */
static void print_bound(const struct values *values, const char *word, double number)
{
    fprintf(values->out, number < 1e12 && number > -1e12 ? "%s%.10g" : "%s%.3g", word, number);
}

static void print_number(const struct values *values, const cJSON *schema, const char *noun)
{
    const cJSON *low = values_member(schema, "minimum"), *above = values_member(schema, "exclusiveMinimum"),
                *high = values_member(schema, "maximum"), *below = values_member(schema, "exclusiveMaximum");
    fputs(noun, values->out);
    if (above)
        fprintf(values->out, " above %g", above->valuedouble);
    else if (low)
        print_bound(values, " from ", low->valuedouble);
    if (high) print_bound(values, above ? ", to " : " to ", high->valuedouble);
    if (below) fprintf(values->out, " and below %g", below->valuedouble);
}

static void print_value(const struct values *values, const cJSON *schema, int depth);

static void print_list(const struct values *values, const cJSON *schema, int depth)
{
    const cJSON *fixed = values_member(schema, "prefixItems"), *items = values_member(schema, "items"),
                *least = values_member(schema, "minItems"), *most = values_member(schema, "maxItems");
    fputs("list of ", values->out);
    if (fixed)
        fprintf(values->out, "%d: ", cJSON_GetArraySize(fixed));
    else if (least && most && least->valuedouble == most->valuedouble)
        fprintf(values->out, "%g: ", most->valuedouble);
    else if (least && most)
        fprintf(values->out, "%g to %g: ", least->valuedouble, most->valuedouble);
    else if (most)
        fprintf(values->out, "up to %g: ", most->valuedouble);
    else if (least)
        fprintf(values->out, "%g or more: ", least->valuedouble);
    print_value(values, fixed ? fixed->child : items, depth + 1);
}

static void print_any(const struct values *values, const cJSON *list, int depth)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        if (item != list->child) fputs(", or ", values->out);
        print_value(values, item, depth + 1);
    }
}

static void print_value(const struct values *values, const cJSON *schema, int depth)
{
    const cJSON *to = values_follow(values->all, schema), *any = values_member(schema, "anyOf");
    const char *type = values_text(schema, "type"), *meaning = values_text(to, "description");
    FILE *out = values->out;
    if (!any) any = values_member(schema, "oneOf");
    if (to && values->refer)
        values->refer(values, values_name(schema));
    else if (to && values_member(to, "properties"))
        fprintf(out, "object %s", values_name(schema));
    else if (to && *meaning && !values_member(to, "default"))
        fprintf(out, "%c%.*s", tolower((unsigned char)*meaning), (int)strlen(meaning) - 2, meaning + 1);
    else if (to && depth < DEPTH_MAX)
        print_value(values, to, depth + 1);
    else if (values_member(schema, "const"))
        values_print_json(values, values_member(schema, "const"));
    else if (values_member(schema, "enum"))
        print_list_of_values(values, values_member(schema, "enum"));
    else if (any && depth < DEPTH_MAX)
        print_any(values, any, depth);
    else if (strcmp(type, "number") == 0)
        print_number(values, schema, "number");
    else if (strcmp(type, "integer") == 0)
        print_number(values, schema, "whole number");
    else if (strcmp(type, "boolean") == 0)
        fputs("true or false", out);
    else if (strcmp(type, "array") == 0 && depth < DEPTH_MAX)
        print_list(values, schema, depth);
    else
        fputs(strcmp(type, "string") == 0 ? "text" : strcmp(type, "object") == 0 ? "object" : "value", out);
}

void values_print(const struct values *values, const cJSON *schema)
{
    print_value(values, schema, 0);
}

/* ---- places ---- */

/* Returns true if a schema refers to a definition, by itself or through kinds of values. */
static bool refers(const cJSON *all, const cJSON *schema, const char *name, int depth)
{
    const cJSON *item;
    const char *at = values_name(schema);
    if (at) {
        const cJSON *to = values_follow(all, schema);
        if (strcmp(at, name) == 0) return true;
        if (depth > 0 && !values_member(to, "properties") && refers(all, to, name, depth - 1)) return true;
    }
    cJSON_ArrayForEach(item, schema)
    {
        if (cJSON_IsObject(item) || cJSON_IsArray(item))
            if (refers(all, item, name, depth)) return true;
    }
    return false;
}

/* True if the values of a key are lists, or lists and words. */
static bool is_list(const cJSON *schema)
{
    const cJSON *item;
    bool found = strcmp(values_text(schema, "type"), "array") == 0;
    cJSON_ArrayForEach(item, values_member(schema, "anyOf"))
    {
        if (values_member(item, "$ref")) return false;
        found |= strcmp(values_text(item, "type"), "array") == 0;
    }
    return found;
}

/* Writes the path to an object: "/view/fit", "/lights/N". */
static bool write_path(const cJSON *all, const char *name, int depth, char path[VALUES_PATH_SIZE])
{
    const cJSON *object, *key;
    if (strcmp(name, "scene") == 0) {
        *path = '\0';
        return true;
    }
    cJSON_ArrayForEach(object, all)
    {
        cJSON_ArrayForEach(key, values_member(object, "properties"))
        {
            if (depth == 0 || strcmp(object->string, name) == 0 || strcmp(object->string, "views") == 0) continue;
            if (!refers(all, key, name, DEPTH_MAX) || !write_path(all, object->string, depth - 1, path)) continue;
            const size_t used = strlen(path);
            const cJSON *to = values_follow(all, key);
            snprintf(path + used, VALUES_PATH_SIZE - used, "/%s%s", key->string, is_list(to ? to : key) ? "/N" : "");
            return true;
        }
    }
    return false;
}

int values_places(const cJSON *all, const char *name)
{
    const cJSON *object, *key;
    int count = 0;
    cJSON_ArrayForEach(object, all)
    {
        cJSON_ArrayForEach(key, values_member(object, "properties"))
        {
            count += strcmp(object->string, "views") != 0 && refers(all, key, name, DEPTH_MAX);
        }
    }
    return count;
}

bool values_path(const cJSON *all, const char *name, char path[VALUES_PATH_SIZE])
{
    return write_path(all, name, DEPTH_MAX, path);
}
