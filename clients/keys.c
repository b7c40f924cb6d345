#include "keys.h"

#include <cjson/cJSON.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "library/zraster.h"

enum { DEPTH_MAX = 8, PATH_SIZE = 160, REFERENCE_SIZE = 80 };

static const char prefix[] = "#/$defs/";

static const cJSON *get(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static const char *text_of(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(get(object, key));
    return text ? text : "";
}

/* The definitions of the schema, and the schema that owns them. */
struct keys {
    cJSON *schema;
    const cJSON *all;
};

static struct keys keys_open(void)
{
    struct keys keys = {NULL, NULL};
    zraster *renderer;
    if (zraster_open(NULL, &renderer) != ZRASTER_OK) return keys;
    const char *text = zraster_schema(renderer);
    keys.schema = text ? cJSON_Parse(text) : NULL;
    keys.all = get(keys.schema, "$defs");
    zraster_close(renderer);
    return keys;
}

/* Follows a reference such as "#/$defs/view/properties/preset". */
static const cJSON *follow(const struct keys *keys, const cJSON *schema)
{
    const char *at = text_of(schema, "$ref");
    if (strncmp(at, prefix, sizeof prefix - 1) != 0) return NULL;
    const cJSON *found = keys->all;
    for (at += sizeof prefix - 1; found && *at;) {
        char name[REFERENCE_SIZE];
        const size_t length = strcspn(at, "/");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        found = get(found, name);
        at += length + (at[length] == '/');
    }
    return found;
}

/* ---- values in words ---- */

/* Prints a value of JSON, a string without its quotes. */
static void print_json(const cJSON *value)
{
    char *text = cJSON_PrintUnformatted(value);
    const char *word = cJSON_GetStringValue(value);
    fputs(word ? word : text ? text : "", stdout);
    cJSON_free(text);
}

static void print_values(const cJSON *list)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        if (item != list->child) fputs(", ", stdout);
        print_json(item);
    }
}

static void print_number(const cJSON *schema, const char *noun)
{
    const cJSON *low = get(schema, "minimum"), *above = get(schema, "exclusiveMinimum"), *high = get(schema, "maximum"),
                *below = get(schema, "exclusiveMaximum");
    fputs(noun, stdout);
    if (above)
        printf(" above %g", above->valuedouble);
    else if (low)
        printf(" from %.10g", low->valuedouble);
    if (high) printf("%s to %.10g", above ? "," : "", high->valuedouble);
    if (below) printf(" and below %g", below->valuedouble);
}

static void print_value(const struct keys *keys, const cJSON *schema, int depth);

static void print_list(const struct keys *keys, const cJSON *schema, int depth)
{
    const cJSON *fixed = get(schema, "prefixItems"), *items = get(schema, "items"), *least = get(schema, "minItems"),
                *most = get(schema, "maxItems");
    fputs("list of ", stdout);
    if (fixed)
        printf("%d: ", cJSON_GetArraySize(fixed));
    else if (least && most)
        printf("%g to %g: ", least->valuedouble, most->valuedouble);
    else if (most)
        printf("up to %g: ", most->valuedouble);
    else if (least)
        printf("%g or more: ", least->valuedouble);
    print_value(keys, fixed ? fixed->child : items, depth + 1);
}

static void print_any(const struct keys *keys, const cJSON *list, int depth)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        if (item != list->child) fputs(", or ", stdout);
        print_value(keys, item, depth + 1);
    }
}

static void print_value(const struct keys *keys, const cJSON *schema, int depth)
{
    const cJSON *to = follow(keys, schema), *any = get(schema, "anyOf");
    const char *type = text_of(schema, "type"), *meaning = text_of(to, "description");
    if (!any) any = get(schema, "oneOf");
    if (to && get(to, "properties"))
        printf("object %s", text_of(schema, "$ref") + sizeof prefix - 1);
    else if (to && *meaning && !get(to, "default"))
        printf("%c%.*s", tolower((unsigned char)*meaning), (int)strlen(meaning) - 2, meaning + 1);
    else if (to && depth < DEPTH_MAX)
        print_value(keys, to, depth + 1);
    else if (get(schema, "const"))
        print_json(get(schema, "const"));
    else if (get(schema, "enum"))
        print_values(get(schema, "enum"));
    else if (any && depth < DEPTH_MAX)
        print_any(keys, any, depth);
    else if (strcmp(type, "number") == 0)
        print_number(schema, "number");
    else if (strcmp(type, "integer") == 0)
        print_number(schema, "whole number");
    else if (strcmp(type, "boolean") == 0)
        fputs("true or false", stdout);
    else if (strcmp(type, "array") == 0 && depth < DEPTH_MAX)
        print_list(keys, schema, depth);
    else
        fputs(strcmp(type, "string") == 0 ? "text" : strcmp(type, "object") == 0 ? "object" : "value", stdout);
}

/* ---- places ---- */

/* Returns true if a schema refers to a definition, by itself or through kinds of values. */
static bool refers(const struct keys *keys, const cJSON *schema, const char *name, int depth)
{
    const cJSON *item;
    const char *at = text_of(schema, "$ref");
    if (strncmp(at, prefix, sizeof prefix - 1) == 0) {
        const cJSON *to = follow(keys, schema);
        if (strcmp(at + sizeof prefix - 1, name) == 0) return true;
        if (depth > 0 && !get(to, "properties") && refers(keys, to, name, depth - 1)) return true;
    }
    cJSON_ArrayForEach(item, schema)
    {
        if (cJSON_IsObject(item) || cJSON_IsArray(item))
            if (refers(keys, item, name, depth)) return true;
    }
    return false;
}

/* Writes the path to an object: "/view/fit", "/lights/N". */
static bool write_path(const struct keys *keys, const char *name, int depth, char path[PATH_SIZE])
{
    const cJSON *object, *key;
    if (strcmp(name, "scene") == 0) {
        *path = '\0';
        return true;
    }
    cJSON_ArrayForEach(object, keys->all)
    {
        cJSON_ArrayForEach(key, get(object, "properties"))
        {
            if (depth == 0 || strcmp(object->string, name) == 0 || strcmp(object->string, "views") == 0) continue;
            if (!refers(keys, key, name, DEPTH_MAX) || !write_path(keys, object->string, depth - 1, path)) continue;
            const size_t used = strlen(path);
            const cJSON *to = follow(keys, key);
            const bool is_list = strcmp(text_of(to ? to : key, "type"), "array") == 0;
            snprintf(path + used, PATH_SIZE - used, "/%s%s", key->string, is_list ? "/N" : "");
            return true;
        }
    }
    return false;
}

/* ---- help ---- */

/* Prints a key of an object. False: an earlier object, of another type, has the key with the same description. */
static bool explain(const struct keys *keys, const cJSON *object, const cJSON *key)
{
    const cJSON *default_value = get(key, "default"), *before, *item;
    char path[PATH_SIZE] = "";
    cJSON_ArrayForEach(before, keys->all)
    {
        if (before == object) break;
        const cJSON *same = get(get(before, "properties"), key->string);
        if (same && strcmp(text_of(same, "description"), text_of(key, "description")) == 0) return false;
    }
    printf("%s: key of ", key->string);
    bool is_first = true;
    cJSON_ArrayForEach(item, keys->all)
    {
        const cJSON *same = get(get(item, "properties"), key->string);
        if (!same || strcmp(text_of(same, "description"), text_of(key, "description")) != 0) continue;
        printf("%s%s", is_first ? "" : ", ", item->string);
        if (write_path(keys, item->string, DEPTH_MAX, path)) printf(" (%s/%s)", path, key->string);
        is_first = false;
    }
    printf("\n    %s\n    Value: ", text_of(key, "description"));
    print_value(keys, key, 0);
    if (default_value) {
        fputs(". Default: ", stdout);
        print_json(default_value);
    }
    bool is_required = false;
    cJSON_ArrayForEach(item, get(object, "required"))
    {
        is_required |= strcmp(item->valuestring, key->string) == 0;
    }
    puts(is_required ? ". Required." : ".");
    return true;
}

static bool list_object(const struct keys *keys, const cJSON *object)
{
    const cJSON *key;
    char path[PATH_SIZE] = "";
    if (!get(object, "properties")) return false;
    printf("Keys of %s", object->string);
    if (write_path(keys, object->string, DEPTH_MAX, path) && *path) printf(" (%s)", path);
    puts(":");
    cJSON_ArrayForEach(key, get(object, "properties")) printf("  %-24s %s\n", key->string, text_of(key, "description"));
    return true;
}

/* Lists the keys of each type of an object. */
static bool list_types(const struct keys *keys, const cJSON *object)
{
    const cJSON *type;
    bool any = false;
    cJSON_ArrayForEach(type, get(object, "oneOf")) any |= list_object(keys, follow(keys, type));
    return any;
}

bool keys_explain(const char *name)
{
    struct keys keys = keys_open();
    const char *end = strpbrk(name, "./"), *key = end ? end + 1 : name;
    const size_t length = end ? (size_t)(end - name) : 0;
    const cJSON *object;
    bool any = false;
    cJSON_ArrayForEach(object, keys.all)
    {
        const cJSON *found = get(get(object, "properties"), key);
        const bool is_here = !end || (strlen(object->string) == length && memcmp(object->string, name, length) == 0);
        if (found && is_here) any |= explain(&keys, object, found) || end;
    }
    if (!end) {
        object = get(keys.all, name);
        any |= list_object(&keys, object) || list_types(&keys, object);
    }
    cJSON_Delete(keys.schema);
    return any;
}

void keys_offer(struct near_word *near)
{
    static char best[REFERENCE_SIZE];
    struct keys keys = keys_open();
    const cJSON *object, *key;
    const char *before = near->best;
    cJSON_ArrayForEach(object, keys.all)
    {
        if (get(object, "properties")) near_offer(near, object->string);
        cJSON_ArrayForEach(key, get(object, "properties")) near_offer(near, key->string);
    }
    if (near->best != before) {
        snprintf(best, sizeof best, "%s", near->best);
        near->best = best;
    }
    cJSON_Delete(keys.schema);
}
