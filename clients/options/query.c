#include "query.h"

#include <ctype.h>
#include <string.h>

#include "files/bytes.h"
#include "parameters.h"

static void add_escaped(struct bytes *query, const char *text)
{
    for (; *text; text++)
        bytes_print(query, isalnum((unsigned char)*text) || strchr("-._~,", *text) ? "%c" : "%%%02X",
                    (unsigned char)*text);
}

void query_add(struct bytes *query, const char *name, const char *text)
{
    bytes_print(query, "%s%s=", query->size ? "&" : "", name);
    add_escaped(query, text);
}

void query_take_drawing(struct options *options, struct bytes *query)
{
    static const enum parameter taken[] = {PARAMETER_scale, PARAMETER_projection, PARAMETER_section, PARAMETER_title,
                                           PARAMETER_dpi};
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        const char **text = &options->parameters[taken[i]];
        if (*text) query_add(query, parameter_rows[taken[i]].name, *text);
        *text = NULL;
    }
}

/* Returns the name of a file without its folder; NULL for standard input. */
static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strcmp(path, "-") == 0 ? NULL : slash ? slash + 1 : path;
}

char *query_make(const struct options *options, const char *path, bool is_scene)
{
    struct bytes query = {.data = NULL};
    bytes_print(&query, "%s", "");
    for (size_t i = 0; i < PARAMETER_COUNT; i++) {
        const char *text = options->parameters[i];
        if (i == PARAMETER_title && !text && options->parameters[PARAMETER_annotate] && !is_scene) text = name_of(path);
        if (!text || i == PARAMETER_strict) continue;
        if (is_scene && (parameter_rows[i].of_mesh || text == options->completed)) continue;
        query_add(&query, parameter_rows[i].name, text);
    }
    return query.data;
}
