#include "mcp_files.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/neighbours.h"
#include "mcp/near.h"

static bool is_below(const char *root, const char *path)
{
    const size_t length = strcmp(root, "/") == 0 ? 0 : strlen(root);
    return strncmp(path, root, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

/* The message is the same for files and missing files, so it reveals no names outside the root. */
static bool refuse_outside(const char *given, struct mcp_faults *faults)
{
    return mcp_fault(faults, "/model/path", "'%.200s' is no file below the folder that this server reads (--root)",
                     given);
}

/* ---- names of a folder ---- */

enum { LISTED_MAX = 24 };

/* The first names of models and folders in alphabetical order, and the name that is nearest to a wrong one. */
struct listing {
    char names[LISTED_MAX][NAME_MAX + 2];
    size_t listed, total;
    struct near_word near;
    char best[NAME_MAX + 1];
};

static void list_name(struct listing *listing, const char *name, const char *mark)
{
    size_t at = listing->listed;
    listing->total++;
    while (at > 0 && strcmp(name, listing->names[at - 1]) < 0)
        at--;
    if (at == LISTED_MAX) return;
    if (listing->listed < LISTED_MAX) listing->listed++;
    memmove(listing->names[at + 1], listing->names[at], (listing->listed - at - 1) * sizeof *listing->names);
    snprintf(listing->names[at], sizeof *listing->names, "%s%s", name, mark);
}

static void list_near(struct listing *listing, const char *name)
{
    const char *const before = listing->near.best;
    near_offer(&listing->near, name);
    if (listing->near.best == before) return;
    snprintf(listing->best, sizeof listing->best, "%s", listing->near.best);
    listing->near.best = listing->best;
}

/* Returns true if a name of a folder is a link out of the root. */
static bool leads_out(const char *root, const char *folder, const char *name)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path) return true;
    char *real = realpath(path, NULL);
    const bool is_out = !real || !is_below(root, real);
    free(real);
    return is_out;
}

/* Lists a folder, whose path is real. `word`: the name that was looked for, or NULL. */
static void list_folder(struct listing *listing, const char *root, const char *folder, const char *word)
{
    DIR *entries = opendir(folder);
    *listing = (struct listing){.near = {.word = word}};
    for (const struct dirent *entry; entries && (entry = readdir(entries)) != NULL;) {
        const char *name = entry->d_name;
        struct stat status;
        if (*name == '.' || fstatat(dirfd(entries), name, &status, 0) != 0) continue;
        const bool is_folder = S_ISDIR(status.st_mode);
        if (!is_folder && !(S_ISREG(status.st_mode) && input_has_ending(name))) continue;
        if (entry->d_type != DT_REG && leads_out(root, folder, name)) continue;
        list_name(listing, name, is_folder ? "/" : "");
        if (word && !is_folder) list_near(listing, name);
    }
    if (entries) closedir(entries);
}

/* Writes "the folder has 3 models and folders: a.obj, b.stl, parts/". Names that have no room are left out. */
static void describe_listing(const struct listing *listing, char *text, size_t size)
{
    enum { ROOM_OF_MORE = 8 };
    size_t used = (size_t)snprintf(text, size, "; the folder has %zu model%s", listing->total,
                                   listing->total == 1 ? " or folder" : "s and folders");
    for (size_t i = 0; i < listing->total; i++) {
        const char *name = i < listing->listed ? listing->names[i] : NULL;
        const bool has_room = name && strlen(name) + ROOM_OF_MORE < size - used;
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : ": ", has_room ? name : "...");
        if (!has_room) return;
    }
}

/* Cuts the last part off a path, and returns its name. */
static const char *cut_name(char *path)
{
    char *end = path + strlen(path);
    while (end > path && end[-1] == '/')
        *--end = '\0';
    while (end > path && end[-1] != '/')
        end--;
    if (end > path) end[-1] = '\0';
    return end;
}

/* Finds the nearest folder above a path that names nothing. Returns its real path; NULL: no memory. `path` is cut. */
static char *find_folder(const char *root, char *path)
{
    for (;;) {
        struct stat status;
        char *folder = realpath(*path ? path : "/", NULL);
        const bool is_found =
            folder && (!is_below(root, folder) || (stat(folder, &status) == 0 && S_ISDIR(status.st_mode)));
        if (is_found || !*path) return folder;
        free(folder);
        cut_name(path);
    }
}

/* Refuses a path that names nothing, with the names of the nearest folder that is there. */
static bool refuse_missing(const char *root, char *path, const char *given, int why, struct mcp_faults *faults)
{
    char names[MCP_DETAIL_SIZE / 2] = "", name[NAME_MAX + 1];
    snprintf(name, sizeof name, "%s", cut_name(path));
    char *folder = find_folder(root, path);
    if (!folder || !is_below(root, folder)) {
        free(folder);
        return refuse_outside(given, faults);
    }
    struct listing listing;
    list_folder(&listing, root, folder, name);
    free(folder);
    describe_listing(&listing, names, sizeof names);
    return mcp_fault(faults, "/model/path", "'%.200s' cannot be read: %s%s%.200s%s%s", given, strerror(why),
                     listing.near.best ? " (did you mean " : "", listing.best, listing.near.best ? "?)" : "", names);
}

/* Refuses a folder, or a file that is no regular one. */
static bool refuse_folder(const char *root, const char *path, const char *given, struct mcp_faults *faults)
{
    char names[MCP_DETAIL_SIZE / 2] = "";
    struct listing listing;
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
        list_folder(&listing, root, path, NULL);
        describe_listing(&listing, names, sizeof names);
    }
    return mcp_fault(faults, "/model/path", "'%.200s' is no file%s", given, names);
}

/* ---- the model ---- */

/* Finds the path of the model, and checks that it is a file below the root. */
static bool find_model(const char *root, const char *given, char path[PATH_MAX], struct mcp_faults *faults)
{
    struct stat status;
    const int length = given[0] == '/' ? snprintf(path, PATH_MAX, "%s", given)
                                       : snprintf(path, PATH_MAX, "%s/%s", strcmp(root, "/") ? root : "", given);
    if (length >= PATH_MAX) return mcp_fault(faults, "/model/path", "the path is too long");
    char *real = realpath(path, NULL);
    if (!real) return refuse_missing(root, path, given, errno, faults);
    const bool is_inside = is_below(root, real), is_file = stat(real, &status) == 0 && S_ISREG(status.st_mode);
    const bool is_taken =
        !is_inside ? refuse_outside(given, faults) : is_file || refuse_folder(root, real, given, faults);
    free(real);
    return is_taken;
}

bool mcp_files_read(struct input *input, const char *root, const struct mcp_draw *draw, struct mcp_faults *faults)
{
    char path[PATH_MAX];
    struct bytes lines = {.data = NULL};
    *input = (struct input){.type = "application/json", .is_known = true, .is_scene = true};
    input->body = (struct bytes){.data = (char *)(uintptr_t)draw->scene, .size = draw->scene_size};
    if (draw->path) {
        if (!find_model(root, draw->path, path, faults)) return false;
    } else if (snprintf(path, PATH_MAX, "%s/scene.json", strcmp(root, "/") ? root : "") >= PATH_MAX) {
        return false;
    }
    input->path = path;
    if (draw->file) {
        input->parts[0].name = strdup(draw->file_name);
        input->parts[0].bytes = (struct bytes){.data = (char *)(uintptr_t)draw->file, .size = draw->file_size};
        input->part_count = 1;
        if (!input->parts[0].name) return false;
    }
    const bool is_read = neighbours_read(input, root, &lines);
    if (!is_read) mcp_fault(faults, "", "%s", bytes_text(&lines));
    bytes_free(&lines);
    input->path = NULL;
    return is_read;
}

void mcp_files_free(struct input *input, const struct mcp_draw *draw)
{
    input->body = (struct bytes){.data = NULL}; /* the scene and the model are the handler's */
    if (draw->file && input->part_count > 0) input->parts[0].bytes = (struct bytes){.data = NULL};
    input_free(input);
}
