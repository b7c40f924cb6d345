#include "input/files/file_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input/files/assets.h"
#include "input/text/text.h"
#include "input/zip/zip_read.h"

/* A name by which an asset is found. `rank`: 0: name of a part; 1: relative name of a ZIP member; 2: name that is also
 * the member's path; 3: path of a member with a relative name. */
struct name {
    const char *text;
    uint32_t asset, rank;
};

/* Both lists are sorted without regard to ASCII case, then by case, then by rank. */
struct zr_file_names {
    size_t count, base_count;
    struct name *all, *bases; /* all: names and paths; bases: last part of each asset's name */
};

/* ---- paths ---- */

/* Returns the text without its last part and the slash before it. */
static char *drop_part(char *begin, char *end)
{
    while (end > begin && end[-1] != '/')
        end--;
    return end - begin > 1 ? end - 1 : end; /* the slash of an absolute path stays */
}

/* True if the last part of the path may be removed by "..". */
static bool has_part(const char *begin, const char *end)
{
    const bool is_up = end - begin >= 2 && end[-1] == '.' && end[-2] == '.' && (end - begin == 2 || end[-3] == '/');
    return end > begin && end[-1] != '/' && !is_up;
}

/* Removes parts "." and "x/.." and doubled slashes. */
static char *drop_dots(char *text, char *end)
{
    char *out = text;
    for (char *at = text; at < end;) {
        char *next = memchr(at, '/', (size_t)(end - at));
        const size_t length = (size_t)((next ? next : end) - at);
        const bool is_dot = length == 1 && *at == '.', is_up = length == 2 && at[0] == '.' && at[1] == '.';
        if (at == text && length == 0) {
            *out++ = '/';
        } else if (is_up && has_part(text, out)) {
            out = drop_part(text, out);
        } else if (length > 0 && !is_dot) {
            if (out > text && out[-1] != '/') *out++ = '/';
            memmove(out, at, length);
            out += length;
        }
        at += length + (next != NULL);
    }
    return out;
}

/* Source of escapes: RFC 3986, section 2.1. Invalid escapes are kept. */
size_t zr_file_path_clean(const char *name, size_t length, char *out)
{
    char *end = out;
    for (size_t i = 0; i < length; i++) {
        const bool is_escape = name[i] == '%' && i + 2 < length && zr_hex_digit(name[i + 1]) >= 0 &&
                               zr_hex_digit(name[i + 2]) >= 0 && (name[i + 1] != '0' || name[i + 2] != '0');
        *end++ = is_escape ? (char)(16 * zr_hex_digit(name[i + 1]) + zr_hex_digit(name[i + 2])) : name[i];
        if (is_escape) i += 2;
        if (end[-1] == '\\') end[-1] = '/';
    }
    end = drop_dots(out, end);
    *end = '\0';
    return (size_t)(end - out);
}

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* ---- the index ---- */

static int lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : (unsigned char)c;
}

/* As strcasecmp, but the same for every locale. */
static int compare_ignoring_case(const char *a, const char *b)
{
    while (*a && lower(*a) == lower(*b)) {
        a++;
        b++;
    }
    return lower(*a) - lower(*b);
}

static int compare_texts(const char *a, const char *b)
{
    const int order = compare_ignoring_case(a, b);
    return order != 0 ? order : strcmp(a, b);
}

static int compare(const void *left, const void *right)
{
    const struct name *a = left, *b = right;
    const int order = compare_texts(a->text, b->text);
    if (order != 0) return order;
    if (a->rank != b->rank) return a->rank < b->rank ? -1 : 1;
    return (a->asset > b->asset) - (a->asset < b->asset);
}

static struct zr_file_names *make_index(const struct zr_parsed_assets *assets, struct zr_arena *arena)
{
    struct zr_file_names *names = zr_arena_zero(arena, 1, sizeof *names);
    if (!names) return NULL;
    names->all = zr_arena_alloc(arena, assets->count, 2 * sizeof *names->all);
    names->bases = zr_arena_alloc(arena, assets->count, sizeof *names->bases);
    for (uint32_t i = 0; names->all && names->bases && i < assets->count; i++) {
        const struct zr_asset *asset = &assets->items[i];
        const char *path = asset->packed ? asset->packed->path : asset->name;
        const bool is_inside = strcmp(path, asset->name) != 0; /* the name is relative to the model's folder */
        names->all[names->count++] = (struct name){asset->name, i, !asset->packed ? 0 : is_inside ? 1 : 2};
        if (is_inside) names->all[names->count++] = (struct name){path, i, 3};
        names->bases[names->base_count++] = (struct name){last_part(asset->name), i, 0};
    }
    if (!zr_arena_ok(arena)) return NULL;
    if (names->count > 0) qsort(names->all, names->count, sizeof *names->all, compare);
    if (names->base_count > 0) qsort(names->bases, names->base_count, sizeof *names->bases, compare);
    return names;
}

/* Returns the first name at or after `text` in the order. */
static size_t lower_bound(const struct name *names, size_t count, const char *text, bool exact)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const int order =
            exact ? compare_texts(names[middle].text, text) : compare_ignoring_case(names[middle].text, text);
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static const struct name *find_exact(const struct name *names, size_t count, const char *text)
{
    const size_t i = lower_bound(names, count, text, true);
    return i < count && strcmp(names[i].text, text) == 0 ? &names[i] : NULL;
}

/* Returns the name that matches, or NULL if none or several do. */
static const struct name *find_only(const struct name *names, size_t count, const char *text, bool exact)
{
    int (*const order)(const char *, const char *) = exact ? strcmp : compare_ignoring_case;
    const size_t i = lower_bound(names, count, text, exact);
    if (i == count || order(names[i].text, text) != 0) return NULL;
    return i + 1 < count && order(names[i + 1].text, text) == 0 ? NULL : &names[i];
}

/* ---- interface ---- */

/* Tries the steps 1 to 3. Sets *path to the clean path that they have reached, else to NULL. */
static const struct name *find_path(const struct zr_file_names *names, struct zr_arena *arena, const char *name,
                                    char **path)
{
    const struct name *found = find_exact(names->all, names->count, name);
    const size_t length = strlen(name);
    *path = found ? NULL : zr_arena_alloc(arena, length + 1, 1);
    if (!*path) return found;
    if (zr_file_path_clean(name, length, *path) == 0) {
        *path = NULL;
        return NULL;
    }
    found = find_exact(names->all, names->count, *path);
    return found ? found : find_only(names->all, names->count, *path, false);
}

/* Tries the steps 1 to 3 with the name below the folder. */
static const struct name *find_below(const struct zr_file_names *names, struct zr_arena *arena, const char *folder,
                                     const char *name)
{
    const size_t size = strlen(folder) + strlen(name) + 1;
    char *joined = zr_arena_alloc(arena, size, 1), *path;
    if (!joined) return NULL;
    snprintf(joined, size, "%s%s", folder, name);
    return find_path(names, arena, joined, &path);
}

static const struct name *find(const struct zr_file_names *names, struct zr_arena *arena, const char *name)
{
    char *path;
    const struct name *found = find_path(names, arena, name, &path);
    if (found || !path) return found;
    const char *base = last_part(path);
    found = find_only(names->bases, names->base_count, base, true);
    return found ? found : find_only(names->bases, names->base_count, base, false);
}

static const struct zr_asset *use_asset(struct zr_parsed_assets *assets, struct zr_arena *arena,
                                        const struct name *name, unsigned use)
{
    if (!name) return NULL;
    const struct zr_asset *asset = &assets->items[name->asset];
    if (assets->uses) assets->uses[name->asset] |= (uint8_t)use;
    return asset->packed ? zr_packed_open(asset->packed, arena) : asset;
}

static bool has_index(struct zr_parsed_assets *assets, struct zr_arena *arena)
{
    if (!assets->names) assets->names = make_index(assets, arena);
    return assets->names != NULL;
}

const struct zr_asset *zr_file_part_find(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name)
{
    if (assets->looked) *assets->looked = true;
    if (!has_index(assets, arena)) return NULL;
    const struct name *found = assets->folder ? find_below(assets->names, arena, assets->folder, name) : NULL;
    return use_asset(assets, arena, found ? found : find(assets->names, arena, name), ZR_USED_BY_GEOMETRY);
}

const struct zr_asset *zr_file_part_named(struct zr_parsed_assets *assets, struct zr_arena *arena, const char *name,
                                          unsigned use)
{
    if (!has_index(assets, arena)) return NULL;
    return use_asset(assets, arena, find_exact(assets->names->all, assets->names->count, name), use);
}
