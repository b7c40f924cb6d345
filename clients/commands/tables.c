#include "tables.h"

#include <cjson/cJSON.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "api/zraster.h"
#include "options/parameters.h"

static cJSON *tables;

void tables_open(void)
{
    zraster *renderer;
    if (tables || zraster_open(NULL, &renderer) != ZRASTER_OK) return;
    tables = cJSON_Parse(zraster_tables(renderer));
    zraster_close(renderer);
}

void tables_close(void)
{
    cJSON_Delete(tables);
    tables = NULL;
}

static const cJSON *list_of(const char *name)
{
    tables_open();
    return cJSON_GetObjectItemCaseSensitive(tables, name);
}

static const char *text_of(const cJSON *item, const char *key)
{
    const char *text = cJSON_GetStringValue(key ? cJSON_GetObjectItemCaseSensitive(item, key) : item);
    return text ? text : "";
}

/* Returns the item of a list that has this name. */
static const cJSON *find(const char *list, const char *name)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list_of(list)) if (strcmp(text_of(item, "name"), name) == 0) return item;
    return NULL;
}

/* Versions of a look are adjacent; its name is added once. */
void tables_looks(struct words *words)
{
    const cJSON *look;
    cJSON_ArrayForEach(look, list_of("looks"))
    {
        const char *pin = text_of(look, NULL), *last = words->count > 0 ? words->list[words->count - 1] : "";
        const size_t length = strcspn(pin, "@");
        if (strlen(last) != length || strncmp(last, pin, length) != 0) words_add(words, pin, length);
    }
}

static void add_names(struct words *words, const char *list)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list_of(list))
    {
        const char *name = text_of(item, "name");
        words_add(words, name, strlen(name));
    }
}

const char *tables_extension(const char *name, const char *encoding)
{
    const cJSON *known;
    cJSON_ArrayForEach(known, cJSON_GetObjectItemCaseSensitive(find("channels", name), "encodings"))
    {
        const char *word = text_of(known, NULL);
        if (!*encoding || strcmp(word, encoding) == 0) return text_of(find("encodings", word), "suffix");
    }
    return NULL;
}

/* ---- words with their meaning ---- */

/* Prints the encodings of a channel, or the versions of a look. */
static void print_list(const char *title, const cJSON *list, const char *pins_of)
{
    const cJSON *item;
    const char *before = title;
    cJSON_ArrayForEach(item, list)
    {
        const char *text = text_of(item, NULL);
        const size_t length = strcspn(text, "@");
        if (pins_of && (strlen(pins_of) != length || strncmp(text, pins_of, length) != 0)) continue;
        printf("%s%s", before, text);
        before = ", ";
    }
    if (before != title) putchar('.');
}

static void print_word(const cJSON *word)
{
    const char *name = text_of(word, "name"), *kind = text_of(word, "kind"), *text = text_of(word, "text");
    printf("%s: %s\n    %c%s.", name, kind, toupper((unsigned char)*text), text + (*text != '\0'));
    if (strcmp(kind, "channel") == 0)
        print_list(" Encodings: ", cJSON_GetObjectItemCaseSensitive(find("channels", name), "encodings"), NULL);
    if (strcmp(kind, "look") == 0) print_list(" Versions: ", list_of("looks"), name);
    putchar('\n');
}

static bool is_kind(const char *kind, const char *name)
{
    const size_t length = strlen(kind);
    return strncmp(name, kind, length) == 0 && (!name[length] || strcmp(name + length, "s") == 0);
}

/* A look may have a version: "studio@1". */
static bool is_named(const cJSON *word, const char *name)
{
    const char *known = text_of(word, "name");
    const size_t length = strlen(known);
    const cJSON *pin;
    if (strncmp(known, name, length) != 0) return false;
    if (name[length] == '@' && strcmp(text_of(word, "kind"), "look") == 0)
        cJSON_ArrayForEach(pin, list_of("looks")) if (strcmp(text_of(pin, NULL), name) == 0) return true;
    return !name[length];
}

bool tables_explain(const char *name)
{
    const cJSON *word;
    bool any = false;
    cJSON_ArrayForEach(word, list_of("words"))
    {
        if (is_named(word, name))
            print_word(word);
        else if (is_kind(text_of(word, "kind"), name))
            printf("  %-14s %s\n", text_of(word, "name"), text_of(word, "text"));
        else
            continue;
        any = true;
    }
    return any;
}

void tables_offer(struct near_word *near)
{
    const cJSON *word;
    cJSON_ArrayForEach(word, list_of("words")) near_offer(near, text_of(word, "name"));
}

void tables_values(struct words *words, const struct parameter_row *parameter)
{
    const char *value = parameter->value;
    if (parameter == &parameter_rows[PARAMETER_channel])
        add_names(words, "channels");
    else if (parameter == &parameter_rows[PARAMETER_encoding])
        add_names(words, "encodings");
    else if (parameter == &parameter_rows[PARAMETER_look])
        tables_looks(words);
    else if (value[0] == '[') {
        words_add(words, "true", 4);
        words_add(words, "false", 5);
    } else if (strcmp(value, "NAME") == 0 || strcmp(value, "COUNT") == 0)
        words_of_help(words, parameter->help);
}
