/* render.c - client: `zraster render`, the default. */
#include "render.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "engine/progress.h"
#include "engine/report.h"
#include "engine/ticker.h"
#include "help.h"
#include "options/words.h"
#include "show.h"

/* Refuses a first word that is neither a file nor a command, but looks like a command. */
static int check_command(const struct options *options)
{
    const char *word = options->files[0];
    struct near_word near = {.word = word};
    if (strpbrk(word, "./") || strcmp(word, "-") == 0 || access(word, F_OK) == 0) return 0;
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        near_offer(&near, commands[i].name);
    if (near.best) return options_wrong("there is no command or file %s; did you mean %s?", word, near.best);
    return options_wrong("there is no command or file %s; \"zraster help\" lists the commands", word);
}

/* Makes a second file the output: zraster part.stl out.png. */
static int take_output(struct options *options)
{
    const char **out = &options->own[OPTION_OUTPUT];
    if (options->file_count == 2 && !*out && output_is_name(options->files[1])) {
        *out = options->files[1];
        options->file_count = 1;
    }
    if (options->file_count > 1 && options->own[OPTION_SHOW])
        return options_wrong("--show draws one file; leave out %s", options->files[1]);
    if (options->file_count < 2 || (*out && output_is_folder(*out))) return 0;
    if (*out) return options_wrong("several files go to a folder: -o FOLDER/, not -o %s", *out);
    return options_wrong("%s is a second file: -o %s makes it the output; \"zraster batch %s %s\" draws both",
                         options->files[1], options->files[1], options->files[0], options->files[1]);
}

static void report(const struct job *job)
{
    const struct options *options = job->options;
    if (job->status != STATUS_DONE && job->status != STATUS_INTERRUPTED)
        report_of_file(stderr, job->target.file, &job->faults);
    if (job->status == STATUS_DONE && !options->own[OPTION_QUIET]) report_warnings(stderr, NULL, &job->warnings);
    const bool is_pipe = job->target.out && strcmp(job->target.out, "-") == 0;
    const bool is_person = isatty(STDERR_FILENO) && !is_pipe && !options->own[OPTION_QUIET];
    if (job->status == STATUS_DONE && (is_person || options->own[OPTION_VERBOSE])) job_print(stderr, job);
}

/* Progress of one file: views once the first is drawn, seconds before. */
struct showing {
    struct progress views;
    struct ticker seconds;
};

static void show_views(void *context, uint32_t done, uint32_t total)
{
    struct showing *showing = context;
    ticker_end(&showing->seconds);
    progress_show_views(&showing->views, done, total);
}

int render_draw(const struct engine *engine, const struct options *options)
{
    struct job job = {.target = output_target(options->files[0], options->own[OPTION_OUTPUT]), .options = options};
    struct showing *showing = engine->progress ? engine->progress_context : NULL;
    if (showing) ticker_start(&showing->seconds, showing->views.is_shown);
    if (options->own[OPTION_SHOW])
        show_run(engine, &job);
    else
        job_run(engine, &job);
    if (showing) {
        ticker_end(&showing->seconds);
        progress_hide(&showing->views);
    }
    report(&job);
    job_free(&job);
    return job.status;
}

int command_render(struct options *options)
{
    struct engine engine;
    if (options->file_count == 0) return help_short();
    int status = check_command(options);
    if (status == 0) status = take_output(options);
    if (status == 0) status = input_check_type(options);
    if (status == 0 && options->file_count > 1) return command_batch(options);
    output_set_encoding(options);
    bytes_map_large_files();
    if (status == 0) status = engine_open(&engine, options, options_threads(options), 1);
    if (status != 0) return status;
    struct showing showing = {.views = {.is_shown = progress_is_wanted(options), .printed = job_clock()}};
    engine.progress = show_views;
    engine.progress_context = &showing;
    status = render_draw(&engine, options);
    engine_close(&engine);
    return status;
}
