#include "mcp_files.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "mcp/near.h"
#include "neighbours.h"

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

/* Refuses a path that names nothing, with the nearest name of its folder. */
static bool refuse_missing(const char *root, char *path, const char *given, int why, struct mcp_faults *faults)
{
    char *slash = strrchr(path, '/');
    struct near_word near = {.word = slash + 1};
    char best[NAME_MAX + 1] = "";
    *slash = '\0';
    char *folder = realpath(slash == path ? "/" : path, NULL);
    const bool is_inside = folder && is_below(root, folder);
    DIR *entries = is_inside ? opendir(folder) : NULL;
    for (const struct dirent *entry; entries && (entry = readdir(entries)) != NULL;) {
        const char *const before = near.best;
        if (input_has_ending(entry->d_name)) near_offer(&near, entry->d_name);
        if (near.best == before) continue;
        snprintf(best, sizeof best, "%s", near.best);
        near.best = best;
    }
    if (entries) closedir(entries);
    free(folder);
    if (!is_inside) return refuse_outside(given, faults);
    return mcp_fault(faults, "/model/path", "'%.200s' cannot be read: %s%s%.200s%s", given, strerror(why),
                     near.best ? " (did you mean " : "", best, near.best ? "?)" : "");
}

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
    free(real);
    if (!is_inside) return refuse_outside(given, faults);
    return is_file || mcp_fault(faults, "/model/path", "'%.200s' is no file", given);
}

bool mcp_files_read(struct input *input, const char *root, const struct mcp_draw *draw, struct mcp_faults *faults)
{
    char path[PATH_MAX];
    struct bytes lines = {NULL, 0, 0};
    *input = (struct input){.type = "application/json", .is_known = true, .is_scene = true};
    input->body = (struct bytes){(char *)(uintptr_t)draw->scene, draw->scene_size, 0};
    if (draw->path) {
        if (!find_model(root, draw->path, path, faults)) return false;
    } else if (snprintf(path, PATH_MAX, "%s/scene.json", strcmp(root, "/") ? root : "") >= PATH_MAX) {
        return false;
    }
    input->path = path;
    if (draw->file) {
        input->parts[0].name = strdup(draw->file_name);
        input->parts[0].bytes = (struct bytes){(char *)(uintptr_t)draw->file, draw->file_size, 0};
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
    input->body = (struct bytes){NULL, 0, 0}; /* the scene and the model are the handler's */
    if (draw->file && input->part_count > 0) input->parts[0].bytes = (struct bytes){NULL, 0, 0};
    input_free(input);
}
