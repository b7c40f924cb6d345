/* watch.c - client: `zraster watch`: draws a file again whenever it changes. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "render.h"
#include "show.h"

enum { PERIOD_MS = 100 };

/* A file at one time; all 0: it is not there. */
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

static void draw(const struct engine *engine, const struct options *options)
{
    struct job job = {.target = output_target(options->files[0], options->own[OPTION_OUTPUT]), .options = options};
    if (options->own[OPTION_SHOW])
        show_run(engine, &job);
    else
        job_run(engine, &job);
    render_report(&job);
    job_free(&job);
}

int command_watch(struct options *options)
{
    struct engine engine;
    if (options->file_count == 2 && !options->own[OPTION_OUTPUT] && output_is_name(options->files[1]))
        options->own[OPTION_OUTPUT] = options->files[--options->file_count];
    if (options->file_count != 1 || strcmp(options->files[0], "-") == 0)
        return options_wrong("watch takes one file: \"zraster watch part.stl -o part.png\"");
    const char *path = options->files[0];
    int status = input_check_type(options);
    if (status == 0 && access(path, R_OK) != 0) status = options_wrong("%s: there is no such file to watch", path);
    if (status == 0) status = engine_open(&engine, options, options_threads(options));
    if (status != 0) return status;
    struct version drawn = {.size = -1};
    while (!engine_interrupted()) {
        const struct version now = version_of(path);
        if (!is_same(&now, &drawn) && now.size > 0) { /* a file of 0 bytes is about to be written */
            drawn = now;
            draw(&engine, options);
        }
        pause_ms(PERIOD_MS);
    }
    engine_close(&engine);
    return STATUS_INTERRUPTED;
}
