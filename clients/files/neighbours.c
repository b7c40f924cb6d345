#include "neighbours.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "engine/interruption.h"

/* LOOKUPS_MAX: largest number of names that are looked up per input. */
enum { LOOKUPS_MAX = 4096, SERVER_NAME_MAX = 128 };
static const unsigned long long bytes_max = 2ull << 30;

struct search {
    struct input *input;
    char *root, *folder; /* absolute paths without symbolic links */
    size_t lookups;
    unsigned long long bytes;
    size_t outside, excess; /* counts of files that are not read */
    char first_outside[256], first_excess[256];
    bool has_memory;
};

/* ---- paths ---- */

static int hex(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if ((c | 32) >= 'a' && (c | 32) <= 'f') return (c | 32) - 'a' + 10;
    return -1;
}

/* Decodes escapes such as %20, and makes slashes of backslashes. `out` has room for the name. */
static void decode(const char *name, char *out)
{
    for (; *name; name++) {
        const int high = *name == '%' ? hex(name[1]) : -1, low = high >= 0 ? hex(name[2]) : -1;
        *out = low >= 0 && high + low > 0 ? (char)(16 * high + low) : *name;
        if (low >= 0 && high + low > 0) name += 2;
        if (*out == '\\') *out = '/';
        out++;
    }
    *out = '\0';
}

static bool is_absolute(const char *path)
{
    return path[0] == '/' || (path[0] && path[1] == ':');
}

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* True if a path without links is the root or below it. */
static bool is_below(const struct search *search, const char *path)
{
    const size_t length = strlen(search->root);
    if (strcmp(search->root, "/") == 0) return true;
    return strncmp(path, search->root, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

/* Appends the entry of a folder that differs from `part` in case alone, if there is only one. */
static bool append_ignoring_case(const struct search *search, char path[PATH_MAX], const char *part, size_t length)
{
    char *real = realpath(path, NULL);
    DIR *folder = real && is_below(search, real) ? opendir(real) : NULL;
    char found[NAME_MAX + 1] = "";
    size_t count = 0;
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        if (strlen(entry->d_name) == length && strncasecmp(entry->d_name, part, length) == 0 && count++ == 0)
            snprintf(found, sizeof found, "%s", entry->d_name);
    if (folder) closedir(folder);
    free(real);
    const size_t used = strlen(path);
    if (count != 1 || used + length + 2 > PATH_MAX) return false;
    snprintf(path + used, PATH_MAX - used, "/%s", found);
    return true;
}

/* Walks a relative path from the search's folder. Looks up missing parts without regard to case.
 * False if there is no such file. */
static bool walk(const struct search *search, const char *relative, char path[PATH_MAX])
{
    struct stat status;
    if (snprintf(path, PATH_MAX, "%s", search->folder) >= PATH_MAX) return false;
    for (const char *part = relative; *part; part += strspn(part, "/")) {
        const size_t length = strcspn(part, "/"), used = strlen(path);
        if (length > NAME_MAX || used + length + 2 > PATH_MAX) return false;
        if (length > 0 && !(length == 1 && *part == '.')) {
            snprintf(path + used, PATH_MAX - used, "/%.*s", (int)length, part);
            if (stat(path, &status) != 0) {
                path[used] = '\0';
                if (!append_ignoring_case(search, path, part, length)) return false;
            }
        }
        part += length;
    }
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* ---- files ---- */

static void note(size_t *count, char first[256], const char *name)
{
    if ((*count)++ > 0) return;
    snprintf(first, 256, "%.255s", name);
    for (char *at = first; *at; at++)
        if ((unsigned char)*at < ' ') *at = '?';
}

/* Returns the part of this name, or NULL. One that --part gives overrides a neighbour. */
static const struct input_part *find_part(const struct input *input, const char *name)
{
    for (size_t i = 0; i < input->part_count; i++)
        if (strcmp(input->parts[i].name, name) == 0) return &input->parts[i];
    return NULL;
}

/* Removes parts "." and "x/.." of a path whose file exists. */
static void tidy(char *path)
{
    char *out = path;
    for (const char *at = path; *at; at += strspn(at, "/")) {
        const size_t length = strcspn(at, "/");
        const bool is_up = length == 2 && memcmp(at, "..", 2) == 0;
        char *before = out;
        while (before > path && before[-1] != '/')
            before--;
        const bool ends_up = out - before == 2 && memcmp(before, "..", 2) == 0;
        if (is_up && out > path && !ends_up) {
            out = before > path ? before - 1 : before;
        } else if (length > 0 && !(length == 1 && *at == '.')) {
            if (out > path) *out++ = '/';
            memmove(out, at, length);
            out += length;
        }
        at += length;
    }
    *out = '\0';
}

/* Adds a file to the parts. `path`: as walk made it. */
static void add_file(struct search *search, const char *path, const char *name)
{
    struct input *input = search->input;
    struct stat status;
    char *real = realpath(path, NULL), relative[PATH_MAX];
    snprintf(relative, sizeof relative, "%s", path + strlen(search->folder) + (strcmp(search->folder, "/") != 0));
    tidy(relative);
    const char *as = strlen(relative) > SERVER_NAME_MAX ? last_part(relative) : relative;
    if (real && !is_below(search, real)) {
        note(&search->outside, search->first_outside, name);
    } else if (real && !find_part(input, as) && stat(real, &status) == 0 && S_ISREG(status.st_mode)) {
        const bool fits = search->bytes + (unsigned long long)status.st_size <= bytes_max;
        struct input_part *part = fits && input->part_count < INPUT_PARTS_MAX ? &input->parts[input->part_count] : NULL;
        if (!part)
            note(&search->excess, search->first_excess, name);
        else if (!bytes_read(&part->bytes, real))
            bytes_free(&part->bytes);
        else if ((part->name = strdup(as)) != NULL) {
            part->is_neighbour = true;
            search->bytes += part->bytes.size;
            input->part_count++;
        } else
            search->has_memory = false;
    }
    free(real);
}

/* Finds the path of a file by its name in a file of the folder `from`, which ends with a slash or is empty. */
static bool find_path(const struct search *search, const char *from, const char *name, char path[PATH_MAX])
{
    char plain[PATH_MAX], relative[2 * PATH_MAX];
    decode(name, plain);
    const char *base = last_part(plain);
    const char *const tries[] = {name, plain, base, base};
    for (size_t i = 0; i < 4; i++) {
        const bool is_twice = (i == 1 && strcmp(name, plain) == 0) || (i == 3 && !*from);
        if (is_twice || !*tries[i] || is_absolute(tries[i])) continue;
        snprintf(relative, sizeof relative, "%s%s", i == 3 ? "" : from, tries[i]);
        if (walk(search, relative, path)) return true;
    }
    return false;
}

/* Returns true if the decoded name is an absolute path. */
static bool decodes_to_absolute(const char *name)
{
    char plain[PATH_MAX];
    decode(name, plain);
    return is_absolute(plain);
}

/* Looks for a file by its name in a file of the folder `from`. */
static void find(struct search *search, const char *from, const char *name)
{
    char path[PATH_MAX];
    const struct input_part *given = find_part(search->input, name);
    if (strlen(name) >= PATH_MAX || (given && !given->is_neighbour)) return;
    if (find_path(search, from, name, path))
        add_file(search, path, name);
    else if (decodes_to_absolute(name))
        note(&search->outside, search->first_outside, name);
}

static void find_all(struct search *search, const char *from, const struct bytes *bytes, const char *type)
{
    char few[4096], *names = few;
    const size_t room = zraster_references(bytes_text(bytes), bytes->size, type, few, sizeof few);
    if (room > sizeof few && !(names = malloc(room))) {
        search->has_memory = false;
        return;
    }
    if (room > sizeof few) zraster_references(bytes_text(bytes), bytes->size, type, names, room);
    const char *last = "";
    for (const char *name = names; name < names + room && !interrupted(); name += strlen(name) + 1) {
        if (strcmp(name, last) == 0) continue;
        last = name;
        if (search->lookups++ < LOOKUPS_MAX)
            find(search, from, name);
        else
            note(&search->excess, search->first_excess, name);
    }
    if (names != few) free(names);
}

/* ---- interface ---- */

static void warn(struct input *input, size_t count, const char *first, const char *why)
{
    if (count == 1)
        bytes_print(&input->warnings, "a referenced file is not read (%s): %s\n", why, first);
    else if (count > 1)
        bytes_print(&input->warnings, "%zu referenced files are not read (%s); the first is %s\n", count, why, first);
}

static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) return realpath(".", NULL);
    char *folder = strndup(path, (size_t)(slash - path) + 1), *real = folder ? realpath(folder, NULL) : NULL;
    free(folder);
    return real;
}

static void search_all(struct search *search)
{
    struct input *input = search->input;
    const size_t own = input->part_count;
    find_all(search, "", &input->body, input->is_known ? input->type : NULL);
    for (size_t i = own; i < input->part_count && !interrupted(); i++) {
        const char *name = input->parts[i].name, *slash = strrchr(name, '/'), *dot = strrchr(name, '.');
        char from[PATH_MAX];
        snprintf(from, sizeof from, "%.*s", slash ? (int)(slash - name) + 1 : 0, name);
        const struct bytes bytes = input->parts[i].bytes;
        if (dot) find_all(search, from, &bytes, dot + 1);
    }
    warn(input, search->outside, search->first_outside, "outside of the folder of the file or --root");
    warn(input, search->excess, search->first_excess, "beyond the limits of number or size");
}

/* Sets the folders; NULL if they cannot be resolved. close_search frees them. */
static void open_search(struct search *search, const char *path, const char *root)
{
    search->folder = strcmp(path, "-") == 0 ? realpath(root, NULL) : folder_of(path);
    search->root = root ? realpath(root, NULL) : search->folder ? strdup(search->folder) : NULL;
}

static void close_search(struct search *search)
{
    free(search->folder);
    free(search->root);
}

bool neighbours_read(struct input *input, const char *root, struct bytes *faults)
{
    struct search search = {.input = input, .has_memory = true};
    struct stat status;
    const bool is_pipe = strcmp(input->path, "-") == 0;
    if (is_pipe && !root) return true;
    if (root && (stat(root, &status) != 0 || !S_ISDIR(status.st_mode))) {
        bytes_print(faults, "--root %s: there is no such folder", root);
        return false;
    }
    open_search(&search, input->path, root);
    if (search.folder && search.root) search_all(&search);
    close_search(&search);
    if (!search.has_memory) bytes_print(faults, "out of memory");
    return search.has_memory;
}

bool neighbours_explain(const struct input *input, const char *root, const char *name, struct bytes *out)
{
    struct search search = {.folder = NULL};
    char path[PATH_MAX], *real = NULL;
    const bool is_pipe = strcmp(input->path, "-") == 0;
    if (is_pipe && !root) return bytes_print(out, "; standard input has no folder, --root gives one");
    if (strlen(name) >= PATH_MAX) return true;
    open_search(&search, input->path, root);
    const bool is_found = search.folder && search.root && find_path(&search, "", name, path);
    if (is_found) real = realpath(path, NULL);
    const char *of = is_pipe ? "folder " : "folder of ", *whose = is_pipe ? root : input->path;
    const bool is_outside = is_found ? real && !is_below(&search, real) : decodes_to_absolute(name);
    close_search(&search);
    free(real);
    if (is_outside) return bytes_print(out, "; its file is outside of the %s%s or --root", of, whose);
    return is_found || bytes_print(out, "; the %s%s has no such file", of, whose);
}
