#include "tables.h"

#include <cjson/cJSON.h>
#include <string.h>

#include "library/zraster.h"

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

static void add_channels(struct words *words)
{
    const cJSON *channel;
    cJSON_ArrayForEach(channel, list_of("channels"))
    {
        const char *name = text_of(channel, "name");
        words_add(words, name, strlen(name));
    }
}

const char *tables_extension(const char *name, const char *encoding)
{
    const cJSON *channel, *known;
    cJSON_ArrayForEach(channel, list_of("channels"))
    {
        if (strcmp(text_of(channel, "name"), name) != 0) continue;
        cJSON_ArrayForEach(known, cJSON_GetObjectItemCaseSensitive(channel, "encodings"))
        {
            const char *word = text_of(known, NULL);
            if (!*encoding || strcmp(word, encoding) == 0)
                return strncmp(word, "png", 3) == 0 ? "png" : strcmp(word, "jpeg") == 0 ? "jpg" : word;
        }
    }
    return NULL;
}

void tables_values(struct words *words, enum parameter parameter)
{
    const char *value = parameter_rows[parameter].value;
    if (parameter == PARAMETER_channel)
        add_channels(words);
    else if (parameter == PARAMETER_look)
        tables_looks(words);
    else if (value[0] == '[') {
        words_add(words, "true", 4);
        words_add(words, "false", 5);
    } else if (strcmp(value, "NAME") == 0 || strcmp(value, "COUNT") == 0)
        words_of_help(words, parameter_rows[parameter].help);
}
