#include "input/file_parts.h"

#include <string.h>

#include "input/json_scene.h"

/* Returns the part of a path behind its last slash or backslash. */
static const char *last_part(const char *path)
{
    const char *part = path;
    for (; *path; path++)
        if (*path == '/' || *path == '\\') part = path + 1;
    return part;
}

const struct zr_asset *zr_file_part_find(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name)
{
    (void)arena;
    for (int step = 0; step < 2; step++)
        for (size_t i = 0; i < assets->count; i++) {
            const char *other = assets->items[i].name;
            if (step == 0 ? strcmp(other, name) != 0 : strcmp(last_part(other), last_part(name)) != 0) continue;
            assets->uses[i] |= ZR_USED;
            return &assets->items[i];
        }
    return NULL;
}
