/* batch.c - client: `zraster batch`: many files on all cores. */
#include <cjson/cJSON.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/interruption.h"
#include "engine/progress.h"
#include "engine/report.h"
#include "files/file_list.h"
#include "files/resume.h"
#include "files/say.h"
#include "tables.h"

struct batch {
    const struct options *options;
    struct engine engine;
    struct file_list list;
    struct resume resume;
    pthread_mutex_t lock; /* guards the members below */
    size_t next;
    struct progress progress;
};

/* ---- reports ---- */

static void add_lines(cJSON *object, const char *key, const struct bytes *lines)
{
    cJSON *list = cJSON_AddArrayToObject(object, key);
    const char *line = bytes_text(lines);
    for (size_t length; *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        char *text = strndup(line, length);
        cJSON_AddItemToArray(list, cJSON_CreateString(text ? text : ""));
        free(text);
    }
}

static void print_json(const struct job *job)
{
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "file", job->target.file);
    cJSON_AddStringToObject(object, "status", job->is_skipped ? "skipped" : job->status ? "failed" : "done");
    cJSON *outputs = cJSON_AddArrayToObject(object, "outputs");
    for (size_t at = 0; at < job->names.size; at += strlen(job->names.data + at) + 1)
        cJSON_AddItemToArray(outputs, cJSON_CreateString(job->names.data + at));
    if (job->status == STATUS_DONE && !job->is_skipped) {
        cJSON_AddNumberToObject(object, "ms", (double)(long)((job->read_ms + job->draw_ms + job->save_ms) * 10) / 10);
        cJSON_AddStringToObject(object, "look", job->look);
    }
    add_lines(object, "warnings", &job->warnings);
    add_lines(object, "errors", &job->faults);
    char *text = cJSON_PrintUnformatted(object);
    if (text) puts(text);
    fflush(stdout);
    cJSON_free(text);
    cJSON_Delete(object);
}

static void report(struct batch *batch, const struct job *job)
{
    const bool is_quiet = batch->options->own[OPTION_QUIET];
    struct progress *progress = &batch->progress;
    progress->done++;
    progress->failed += job->status != STATUS_DONE;
    progress->skipped += job->is_skipped;
    if (batch->options->own[OPTION_JSON]) print_json(job);
    const bool is_line = !progress->is_shown && !batch->options->own[OPTION_JSON] && !is_quiet;
    if (job->warnings.size && job->status == STATUS_DONE && !is_quiet) {
        progress_hide(progress);
        report_warnings(stderr, job->target.file, &job->warnings);
    }
    if (is_line && job->status != STATUS_DONE) {
        say_text(stderr, job->target.file, strlen(job->target.file));
        fputs("  failed\n", stderr);
    } else if (is_line && !job->is_skipped)
        job_print(stderr, job);
    progress_show(progress, false);
}

/* Reports the faults of a job. A job with options of its own is named with its line. */
static void report_job(const struct batch *batch, const struct job *job)
{
    struct bytes name = {.data = NULL};
    bytes_print(&name, "%s", job->target.file);
    if (job->options != batch->options) bytes_print(&name, " (line %zu)", job->line);
    report_faults(stderr, bytes_text(&name), &job->faults);
    bytes_free(&name);
}

static int summarize(struct batch *batch)
{
    const struct progress *progress = &batch->progress;
    int status = STATUS_DONE;
    size_t done = 0;
    progress_show(&batch->progress, true);
    for (size_t i = 0; i < batch->list.count; i++) {
        const struct job *job = &batch->list.jobs[i];
        if (i >= batch->next || job->status == STATUS_INTERRUPTED) continue;
        if (job->status == STATUS_DONE) {
            done += !job->is_skipped;
            continue;
        }
        if (status != STATUS_FAILED) status = job->status == STATUS_WARNED ? STATUS_WARNED : STATUS_FAILED;
        report_job(batch, job);
    }
    if (interrupted()) status = STATUS_INTERRUPTED;
    if (status == STATUS_DONE && (batch->options->own[OPTION_QUIET] || progress->is_shown)) return status;
    fprintf(stderr, "%zu drawn, %zu skipped, %zu failed%s\n", done, progress->skipped, progress->failed,
            interrupted() ? "; interrupted: --resume draws the rest" : "");
    return status;
}

/* ---- work ---- */

static void make_folders(const struct target *target)
{
    char *path = target->out ? NULL : output_name(target, "color", "");
    if (path) output_make_folders(path);
    free(path);
}

static void *work(void *context)
{
    struct batch *batch = context;
    for (;;) {
        pthread_mutex_lock(&batch->lock);
        struct job *job = batch->next < batch->list.count && !interrupted() ? &batch->list.jobs[batch->next++] : NULL;
        pthread_mutex_unlock(&batch->lock);
        if (!job) return NULL;
        job->is_skipped =
            batch->options->own[OPTION_RESUME] && resume_has_all(&batch->resume, job, job->options != batch->options);
        if (!job->is_skipped) {
            make_folders(&job->target);
            job_run(&batch->engine, job);
        }
        pthread_mutex_lock(&batch->lock);
        if (job->status != STATUS_INTERRUPTED) report(batch, job);
        pthread_mutex_unlock(&batch->lock);
    }
}

static size_t count_threads(const struct options *options)
{
    cpu_set_t set;
    const size_t wanted = options_threads(options);
    if (wanted) return wanted;
    const int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count < THREADS_MAX ? (size_t)count : THREADS_MAX;
}

/* Runs `count` threads, each of which draws files of its own. */
static void run(struct batch *batch, size_t count)
{
    pthread_t threads[THREADS_MAX];
    size_t started = 0;
    while (started + 1 < count && pthread_create(&threads[started], NULL, work, batch) == 0)
        started++;
    work(batch);
    for (size_t i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
}

int command_batch(struct options *options)
{
    static struct batch batch = {.lock = PTHREAD_MUTEX_INITIALIZER};
    batch.options = options;
    if (options->file_count == 0 && !options->own[OPTION_LIST])
        return options_wrong("batch needs files: \"zraster batch FOLDER\", or \"zraster batch -\" with names or JSON "
                             "Lines on standard input");
    const char *folder = options->own[OPTION_OUTPUT];
    if (folder && !output_may_be_folder(folder))
        return options_wrong("several files go to a folder: -o FOLDER/, not -o %s", folder);
    int status = input_check_type(options);
    if (status == 0) status = file_list_make(&batch.list, options);
    if (status == 0) status = resume_open(&batch.resume, options);
    const size_t count = count_threads(options);
    const size_t at_once = count < batch.list.count ? count : batch.list.count > 0 ? batch.list.count : 1;
    if (status == 0)
        status = engine_open(&batch.engine, options, batch.list.count < 2 * count ? (unsigned)count : 1, at_once);
    if (status != 0) return status;
    batch.progress = (struct progress){.total = batch.list.count, .began = job_clock()};
    batch.progress.is_shown = progress_is_wanted(options);
    if (options->own[OPTION_RESUME]) tables_open(); /* before threads share them */
    run(&batch, at_once);
    status = summarize(&batch);
    for (size_t i = 0; i < batch.list.count; i++)
        job_free(&batch.list.jobs[i]);
    engine_close(&batch.engine);
    return status;
}
