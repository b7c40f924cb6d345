#include "keys.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#include "api/zraster.h"
#include "options/values.h"
#include "tables.h"

enum { NAME_SIZE = 80, DEPTH_MAX = 8 };

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
    keys.all = values_member(keys.schema, "$defs");
    zraster_close(renderer);
    return keys;
}

/* ---- help ---- */

/* Prints a key of an object. False: an earlier object, of another type, has the key with the same description. */
static bool explain(const struct keys *keys, const cJSON *object, const cJSON *key)
{
    const cJSON *default_value = values_member(key, "default"), *before, *item;
    const struct values values = {.all = keys->all, .out = stdout};
    char path[VALUES_PATH_SIZE] = "";
    cJSON_ArrayForEach(before, keys->all)
    {
        if (before == object) break;
        const cJSON *same = values_member(values_member(before, "properties"), key->string);
        if (same && strcmp(values_text(same, "description"), values_text(key, "description")) == 0) return false;
    }
    printf("%s: key of ", key->string);
    bool is_first = true;
    cJSON_ArrayForEach(item, keys->all)
    {
        const cJSON *same = values_member(values_member(item, "properties"), key->string);
        if (!same || strcmp(values_text(same, "description"), values_text(key, "description")) != 0) continue;
        printf("%s%s", is_first ? "" : ", ", item->string);
        if (values_path(keys->all, item->string, path)) printf(" (%s/%s)", path, key->string);
        is_first = false;
    }
    printf("\n    %s\n    Value: ", values_text(key, "description"));
    values_print(&values, key);
    if (default_value) {
        fputs(". Default: ", stdout);
        values_print_json(&values, default_value);
    }
    bool is_required = false;
    cJSON_ArrayForEach(item, values_member(object, "required"))
    {
        is_required |= strcmp(item->valuestring, key->string) == 0;
    }
    puts(is_required ? ". Required." : ".");
    return true;
}

static bool list_object(const struct keys *keys, const cJSON *object)
{
    const cJSON *key;
    char path[VALUES_PATH_SIZE] = "";
    if (!values_member(object, "properties")) return false;
    printf("Keys of %s", object->string);
    if (values_path(keys->all, object->string, path) && *path) printf(" (%s)", path);
    puts(":");
    cJSON_ArrayForEach(key, values_member(object, "properties"))
        printf("  %-24s %s\n", key->string, values_text(key, "description"));
    return true;
}

/* Lists the keys of each type of an object. */
static bool list_types(const struct keys *keys, const cJSON *object)
{
    const cJSON *type;
    bool any = false;
    cJSON_ArrayForEach(type, values_member(object, "oneOf")) any |= list_object(keys, values_follow(keys->all, type));
    return any;
}

/* ---- words that keys accept ---- */

/* Returns true if a word is among the values of a schema, not counting those of objects in it. */
static bool accepts(const struct keys *keys, const cJSON *schema, const char *word, int depth)
{
    static const char *const lists[] = {"enum", "anyOf", "oneOf", "prefixItems"};
    const cJSON *to = values_follow(keys->all, schema), *items = values_member(schema, "items"), *item;
    if (depth == 0) return false;
    if (strcmp(values_text(schema, "const"), word) == 0) return true;
    if (to && !values_member(to, "properties") && accepts(keys, to, word, depth - 1)) return true;
    if (items && accepts(keys, items, word, depth - 1)) return true;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        cJSON_ArrayForEach(item, values_member(schema, lists[i]))
        {
            if (cJSON_IsString(item) ? strcmp(item->valuestring, word) == 0 : accepts(keys, item, word, depth - 1))
                return true;
        }
    return false;
}

/* Prints the places of all keys that accept a word. */
static bool explain_word(const struct keys *keys, const char *word)
{
    const cJSON *object, *key;
    char path[VALUES_PATH_SIZE] = "";
    bool any = false;
    cJSON_ArrayForEach(object, keys->all)
    {
        cJSON_ArrayForEach(key, values_member(object, "properties"))
        {
            if (!accepts(keys, key, word, DEPTH_MAX) || !values_path(keys->all, object->string, path)) continue;
            if (!any) printf("%s: value of", word);
            printf("%s %s (%s/%s)", any ? "," : "", key->string, path, key->string);
            any = true;
        }
    }
    if (any) puts("");
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
        const cJSON *found = values_member(values_member(object, "properties"), key);
        const bool is_here = !end || (strlen(object->string) == length && memcmp(object->string, name, length) == 0);
        if (found && is_here) any |= explain(&keys, object, found) || end;
    }
    if (!end) {
        object = values_member(keys.all, name);
        any |= list_object(&keys, object) || list_types(&keys, object);
        any |= tables_explain(name);
        any |= explain_word(&keys, name);
    }
    cJSON_Delete(keys.schema);
    return any;
}

void keys_offer(struct near_word *near)
{
    static char best[NAME_SIZE];
    struct keys keys = keys_open();
    const cJSON *object, *key;
    const char *before = near->best;
    cJSON_ArrayForEach(object, keys.all)
    {
        if (values_member(object, "properties")) near_offer(near, object->string);
        cJSON_ArrayForEach(key, values_member(object, "properties")) near_offer(near, key->string);
    }
    tables_offer(near);
    if (near->best != before) {
        snprintf(best, sizeof best, "%s", near->best);
        near->best = best;
    }
    cJSON_Delete(keys.schema);
}
