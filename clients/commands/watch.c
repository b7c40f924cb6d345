/* watch.c - client: `zraster watch`: draws a file again whenever it changes. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "engine/interruption.h"
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

/* Draws the file whenever it changes, until a signal. A wrong command line ends the loop, unless the file was drawn
 * before. */
static int watch(const struct engine *engine, const struct options *options)
{
    const char *path = options->files[0];
    struct version drawn = {.size = -1};
    bool was_drawn = false;
    int absent = 0;
    while (!interrupted()) {
        const struct version now = version_of(path);
        report_absence(path, &absent);
        if (!is_same(&now, &drawn) && now.size > 0 && !absent) { /* a file of 0 bytes is about to be written */
            drawn = now;
            const int status = render_draw(engine, options);
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
    if (status == 0) status = engine_open(&engine, options, options_threads(options));
    if (status != 0) return status;
    status = watch(&engine, options);
    engine_close(&engine);
    return status;
}
