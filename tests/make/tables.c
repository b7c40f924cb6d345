/* zraster-tables: prints the rows of the tables that the contract describes, "KIND NAME" a line: parameter, types (of a
 * body), channel, look, encoding, shading, algorithm, light, key.
 *
 * Keys are those that readers name: each object is given an unknown key, and the message lists the known ones. */
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "core.h"
#include "format_rows.h"
#include "input/scene/json_objects.h"
#include "input/scene/outputs.h"
#include "input/text/names.h"
#include "parameter_rows.h"
#include "render_request.h"
#include "scene/looks.h"
#include "scene/output.h"

enum { TEXT_SIZE = 1024, DEPTH_MAX = 6 };

static const char unknown[] = "qqqqqqqqqq", names_begin[] = "known here: ";

static bool ends_with(const char *text, const char *end)
{
    return strlen(text) >= strlen(end) && strcmp(text + strlen(text) - strlen(end), end) == 0;
}

/* The names in the message about the unknown key of an object between these texts; false: no object may be there. */
static bool ask(const char *before, const char *after, char names[ZR_DETAIL_SIZE])
{
    char text[2 * TEXT_SIZE];
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    snprintf(text, sizeof text, "%s{\"%s\":1}%s", before, unknown, after);
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
    zr_arena_init(&arena, (size_t)1 << 24);
    zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene);
    zr_arena_free(&arena);
    for (size_t i = 0; i < error.count && i < ZR_ERROR_ITEMS; i++) {
        const char *found = strstr(error.items[i].detail, names_begin);
        if (!found || !ends_with(error.items[i].pointer, unknown)) continue;
        snprintf(names, ZR_DETAIL_SIZE, "%s", found + strlen(names_begin));
        return true;
    }
    return false;
}

/* Prints the keys of an object, and those of the objects and lists of objects in it. */
static void print_keys(const char *before, const char *after, int depth)
{
    char names[ZR_DETAIL_SIZE], *rest = names;
    if (depth == DEPTH_MAX || !ask(before, after, names)) return;
    for (char *name; (name = strsep(&rest, ",")) != NULL;) {
        char inner[TEXT_SIZE], outer[TEXT_SIZE];
        name += strspn(name, " ");
        printf("key %s\n", name);
        for (int is_list = 0; is_list < 2; is_list++) {
            const int a = snprintf(inner, sizeof inner, "%s{\"%s\":%s", before, name, is_list ? "[" : "");
            const int b = snprintf(outer, sizeof outer, "%s}%s", is_list ? "]" : "", after);
            if (a < TEXT_SIZE && b < TEXT_SIZE) print_keys(inner, outer, depth + 1);
        }
    }
}

static void print_names(const char *kind, const struct zr_names *names)
{
    for (int i = 0; i < names->count; i++)
        printf("%s %s\n", kind, names->words[i]);
}

int main(void)
{
#define PRINT_PARAMETER(name, ...)           printf("parameter " #name "\n");
#define PRINT_FORMAT(ID, ending, types, ...) printf("types " types "\n");
    ZR_PARAMETER_ROWS(PRINT_PARAMETER)
    ZR_FORMAT_ROWS(PRINT_FORMAT)
    for (int i = 0; i < ZR_CHANNEL_COUNT; i++)
        printf("channel %s\n", zr_channel_rows[i].name);
    for (int i = 0; i < zr_look_count; i++)
        printf("look %s\n", zr_looks[i].name);
    print_names("encoding", &zr_encoding_names);
    print_names("shading", &zr_shading_names);
    print_names("algorithm", &zr_algorithm_names);
    print_names("light", zr_json_object_light.fields[0].words);
    print_keys("", "", 0);
    return 0;
}
