/* zraster-reference TEMPLATES OUT: writes the reference pages of the manual, OUT/NAME.md from TEMPLATES/NAME.md. A line
 * "@object view" of a template becomes the table of that object's keys; likewise @values, @parameters, @index,
 * @channels, @looks, @formats, @commands and @options. Each object of a scene is on one page. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "lists.h"
#include "schema/parameters.h"
#include "schema/schema.h"

enum { MEMORY = 64 << 20, PAGES_MAX = 64, OBJECTS_MAX = 128, NAME_SIZE = 64, PATH_SIZE = 1024 };

static struct place {
    char object[NAME_SIZE], page[NAME_SIZE];
} places[OBJECTS_MAX];
static size_t place_count;

static const char *page_of(const char *object)
{
    for (size_t i = 0; i < place_count; i++)
        if (strcmp(places[i].object, object) == 0) return places[i].page;
    return NULL;
}

static void fail(const char *what, const char *name)
{
    fprintf(stderr, "error: %s: %s\n", name, what);
    exit(1);
}

/* Reads a directive, "@word argument". False for any other line. */
static bool read_directive(const char *line, char word[NAME_SIZE], char argument[NAME_SIZE])
{
    *argument = '\0';
    return sscanf(line, "@%63[a-z] %63s", word, argument) >= 1;
}

/* Notes the page of each object in a template. */
static void scan(const char *path, const char *page)
{
    char line[PATH_SIZE], word[NAME_SIZE], argument[NAME_SIZE];
    FILE *in = fopen(path, "r");
    if (!in) fail("cannot be read", path);
    while (fgets(line, sizeof line, in)) {
        if (!read_directive(line, word, argument) || strcmp(word, "object") != 0) continue;
        if (page_of(argument) || place_count == OBJECTS_MAX) fail("is on two pages", argument);
        struct place *place = &places[place_count++];
        snprintf(place->object, sizeof place->object, "%s", argument);
        snprintf(place->page, sizeof place->page, "%s", page);
    }
    fclose(in);
}

static void print_directive(const struct tables *tables, const char *word, const char *argument)
{
    static const struct {
        const char *word;
        void (*print)(const struct tables *);
    } lists[] = {{"values", tables_print_values},    {"parameters", tables_print_parameters},
                 {"index", tables_print_index},      {"channels", lists_print_channels},
                 {"looks", lists_print_looks},       {"formats", lists_print_formats},
                 {"commands", lists_print_commands}, {"options", lists_print_options}};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (strcmp(word, lists[i].word) == 0) {
            lists[i].print(tables);
            return;
        }
    if (strcmp(word, "object") != 0) fail("is no directive", word);
    if (!tables_print_object(tables, argument)) fail("is no object", argument);
}

static void write_page(struct tables *tables, const char *from, const char *to)
{
    char line[PATH_SIZE], word[NAME_SIZE], argument[NAME_SIZE];
    FILE *in = fopen(from, "r"), *out = fopen(to, "w");
    if (!in || !out) fail("cannot be opened", in ? to : from);
    tables->values.out = out;
    while (fgets(line, sizeof line, in))
        if (read_directive(line, word, argument))
            print_directive(tables, word, argument);
        else
            fputs(line, out);
    fclose(in);
    if (fclose(out) != 0) fail("cannot be written", to);
}

static cJSON *parse(struct zr_buffer *text)
{
    cJSON *made = cJSON_ParseWithLength((const char *)text->bytes, text->size);
    if (!made) fail("cannot be read", "schema");
    return made;
}

/* Makes the schema of a scene and of parameters. */
static cJSON *make_schema(void)
{
    struct zr_arena arena;
    const struct zr_limits limits = zr_limits_default();
    zr_arena_init(&arena, MEMORY);
    struct zr_buffer text = {.arena = &arena}, rows = {.arena = &arena};
    if (!zr_schema_print(&text, &limits, NULL, NULL)) fail("no memory", "schema");
    struct zr_print print = {.out = &rows};
    zr_print_begin(&print, NULL, '{');
    zr_parameters_print(&print, &limits);
    zr_print_end(&print, '}');
    cJSON *schema = parse(&text), *parameters = parse(&rows);
    cJSON_AddItemToObject(schema, "parameters", cJSON_DetachItemFromObject(parameters, "parameters"));
    cJSON_Delete(parameters);
    zr_arena_free(&arena);
    return schema;
}

int main(int argc, char **argv)
{
    char names[PAGES_MAX][NAME_SIZE], from[PATH_SIZE], to[PATH_SIZE];
    size_t count = 0;
    DIR *folder = argc == 3 ? opendir(argv[1]) : NULL;
    if (!folder) {
        fputs("usage: zraster-reference TEMPLATES OUT\n", stderr);
        return 2;
    }
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        const size_t length = strlen(entry->d_name);
        if (length <= 3 || length >= NAME_SIZE || strcmp(entry->d_name + length - 3, ".md") != 0) continue;
        if (count == PAGES_MAX) fail("too many pages", argv[1]);
        snprintf(names[count++], NAME_SIZE, "%.*s", (int)length - 3, entry->d_name);
    }
    closedir(folder);
    for (size_t i = 0; i < count; i++) {
        snprintf(from, sizeof from, "%s/%s.md", argv[1], names[i]);
        scan(from, names[i]);
    }
    for (size_t i = 0; i < zr_schema_object_count; i++)
        if (!page_of(zr_schema_objects[i]->name)) fail("is on no page", zr_schema_objects[i]->name);
    cJSON *schema = make_schema();
    struct tables tables = {.values = {.all = values_member(schema, "$defs"), .quote = "`"},
                            .page_of = page_of,
                            .parameters = values_member(schema, "parameters")};
    tables_link(&tables);
    for (size_t i = 0; i < count; i++) {
        snprintf(from, sizeof from, "%s/%s.md", argv[1], names[i]);
        snprintf(to, sizeof to, "%s/%s.md", argv[2], names[i]);
        write_page(&tables, from, to);
    }
    cJSON_Delete(schema);
    return 0;
}
