/* watch.c - client: `zraster watch`: draws a file again whenever it, or a file that it refers to, changes. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "engine/interruption.h"
#include "files/neighbours.h"
#include "files/say.h"
#include "render.h"

enum { PERIOD_MS = 100, PATIENCE = 5 /* periods */ };

/* The version of a file; all 0: it does not exist. */
struct version {
    struct timespec time;
    ino_t node;
    off_t size;
};

static struct version version_of(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) return (struct version){.size = 0};
    return (struct version){status.st_mtim, status.st_ino, status.st_size};
}

static bool is_same(const struct version *a, const struct version *b)
{
    return a->time.tv_sec == b->time.tv_sec && a->time.tv_nsec == b->time.tv_nsec && a->node == b->node &&
           a->size == b->size;
}

static void pause_ms(long ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
}

/* Checks the files of parts: no change of the watched file mends them. */
static int check_parts(const struct options *options)
{
    for (size_t i = 0; i < options->part_count; i++)
        if (access(strchr(options->parts[i], '=') + 1, R_OK) != 0) {
            say("--part %s: %s", options->parts[i], strerror(errno));
            return STATUS_FAILED;
        }
    return 0;
}

/* Reports once that the file cannot be read. Editors remove it for a moment while they save it. */
static void report_absence(const char *path, int *absent)
{
    const int why = access(path, R_OK) == 0 ? 0 : errno;
    *absent = why ? *absent + 1 : 0;
    if (*absent == PATIENCE) say("%s: %s; watch waits for it", path, strerror(why));
}

/* ---- files that the file refers to ---- */

struct watched {
    char *path;
    struct version drawn;
};

struct watch {
    const struct options *options;
    size_t count;
    struct watched *files; /* the file, those of --part, and those that it refers to or has referred to */
};

static void add(struct watch *watch, const char *folder, const char *name)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s%s", folder, name) >= (int)sizeof path) return;
    for (size_t i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0) return;
    struct watched *files = realloc(watch->files, (watch->count + 1) * sizeof *files);
    if (!files) return;
    watch->files = files;
    files[watch->count] = (struct watched){.path = strdup(path)};
    if (files[watch->count].path) watch->count++;
}

/* Adds the files that the file refers to now. Faults are those of drawing, which reports them. */
static void add_neighbours(struct watch *watch)
{
    const struct options *options = watch->options;
    struct input input;
    struct bytes faults = {.data = NULL};
    if (input_read(&input, options->files[0], options, &faults))
        neighbours_read(&input, options->own[OPTION_ROOT], &faults);
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%.*s", (int)(output_base(options->files[0]) - options->files[0]), options->files[0]);
    for (size_t i = 0; i < input.part_count; i++)
        if (input.parts[i].is_neighbour) add(watch, folder, input.parts[i].name);
    bytes_free(&faults);
    input_free(&input);
}

static void open_watch(struct watch *watch, const struct options *options)
{
    *watch = (struct watch){.options = options};
    add(watch, "", options->files[0]);
    for (size_t i = 0; i < options->part_count; i++)
        add(watch, "", strchr(options->parts[i], '=') + 1);
    for (size_t i = 0; i < watch->count; i++)
        watch->files[i].drawn.size = -1; /* not drawn yet */
}

static void close_watch(struct watch *watch)
{
    for (size_t i = 0; i < watch->count; i++)
        free(watch->files[i].path);
    free(watch->files);
}

/* Returns true if a file changed. A file of 0 bytes is about to be written. */
static bool has_changed(const struct watch *watch)
{
    bool changed = false;
    for (size_t i = 0; i < watch->count; i++) {
        const struct version now = version_of(watch->files[i].path);
        if (is_same(&now, &watch->files[i].drawn)) continue;
        if (now.size <= 0) return false;
        changed = true;
    }
    return changed;
}

/* Notes the versions before they are drawn: a change meanwhile is drawn next. */
static void note_versions(struct watch *watch)
{
    add_neighbours(watch);
    for (size_t i = 0; i < watch->count; i++)
        watch->files[i].drawn = version_of(watch->files[i].path);
}

/* Draws the file whenever it or a file that it refers to changes, until a signal. A wrong command line ends the loop,
 * unless the file was drawn before. */
static int run(const struct engine *engine, struct watch *watch)
{
    const char *path = watch->options->files[0];
    bool was_drawn = false;
    int absent = 0;
    while (!interrupted()) {
        report_absence(path, &absent);
        if (!absent && has_changed(watch)) {
            note_versions(watch);
            const int status = render_draw(engine, watch->options);
            if (status == STATUS_USAGE && !was_drawn) return status;
            was_drawn = was_drawn || status == STATUS_DONE;
        }
        pause_ms(PERIOD_MS);
    }
    return STATUS_INTERRUPTED;
}

int command_watch(struct options *options)
{
    struct engine engine;
    if (options->file_count == 2 && !options->own[OPTION_OUTPUT] && output_is_name(options->files[1]))
        options->own[OPTION_OUTPUT] = options->files[--options->file_count];
    if (options->file_count != 1 || strcmp(options->files[0], "-") == 0)
        return options_wrong("watch needs one file: \"zraster watch part.stl -o part.png\"");
    const char *path = options->files[0];
    output_set_encoding(options);
    int status = input_check_type(options);
    if (status == 0 && access(path, R_OK) != 0) status = options_wrong("%s: there is no such file to watch", path);
    if (status == 0) status = check_parts(options);
    if (status == 0) status = engine_open(&engine, options, options_threads(options), 1);
    if (status != 0) return status;
    struct watch watch;
    open_watch(&watch, options);
    status = run(&engine, &watch);
    close_watch(&watch);
    engine_close(&engine);
    return status;
}
