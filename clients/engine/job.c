#include "job.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "files/neighbours.h"
#include "files/say.h"
#include "interruption.h"
#include "options/parameters.h"

double job_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec / 1e6;
}

static unsigned number_at(const unsigned char *at)
{
    return (unsigned)at[0] << 24 | (unsigned)at[1] << 16 | (unsigned)at[2] << 8 | at[3];
}

/* Copies the facts of an answer that the line of the job shows. */
static void copy_facts(struct job *job, const struct answer *answer)
{
    memcpy(job->look, answer->look, sizeof job->look);
    job->bytes = answer->file.size;
    if (answer->file.size < 24 || strcmp(answer->file.type, "image/png") != 0) return;
    job->width = number_at((const unsigned char *)answer->file.data + 16);
    job->height = number_at((const unsigned char *)answer->file.data + 20);
}

static void move(struct bytes *out, struct bytes *from)
{
    bytes_free(out);
    *out = *from;
    *from = (struct bytes){.data = NULL};
}

void job_draw(const struct engine *engine, struct job *job, struct answer *answer)
{
    struct input input;
    const double begin = job_clock();
    *answer = (struct answer){.status = STATUS_FAILED};
    const bool is_read = input_read(&input, job->target.file, job->options, &job->faults) &&
                         neighbours_read(&input, job->options->own[OPTION_ROOT], &job->faults);
    const double middle = job_clock();
    job->read_ms = middle - begin;
    if (is_read) {
        engine_draw(engine, &input, job->options, answer);
        move(&job->warnings, &answer->warnings);
        move(&job->faults, &answer->faults);
        job->status = answer->status;
    } else
        job->status = answer->status = interrupted()    ? STATUS_INTERRUPTED
                                       : input.is_usage ? STATUS_USAGE
                                                        : STATUS_FAILED;
    job->draw_ms = job_clock() - middle;
    input_free(&input);
    if (answer->status == STATUS_DONE) copy_facts(job, answer);
}

void job_save(struct job *job, const struct answer *answer)
{
    const double begin = job_clock();
    const bool no_clobber = job->options->own[OPTION_NO_CLOBBER] != NULL;
    job->status = output_save(&job->target, answer, no_clobber, &job->names, &job->faults);
    job->save_ms = job_clock() - begin;
}

void job_run(const struct engine *engine, struct job *job)
{
    struct answer answer;
    job->status = output_check(&job->target, job->options->parameters[PARAMETER_encoding], &job->faults);
    if (job->status != STATUS_DONE) return;
    job_draw(engine, job, &answer);
    if (job->status == STATUS_DONE) job_save(job, &answer);
    answer_free(&answer);
}

void job_print(FILE *out, const struct job *job)
{
    const char *name = bytes_text(&job->names), *end = name + job->names.size;
    if (name == end) say_text(out, job->target.file, strlen(job->target.file)); /* shown, not saved */
    for (; name < end; name += strlen(name) + 1) {
        if (name != bytes_text(&job->names)) fputs(", ", out);
        say_text(out, name, strlen(name));
    }
    if (job->width)
        fprintf(out, "  %ux%u", job->width, job->height);
    else
        fprintf(out, "  %zu bytes", job->bytes);
    fprintf(out, "  %.*s  %.0f ms", (int)strcspn(job->look, "@"), job->look,
            job->read_ms + job->draw_ms + job->save_ms);
    if (job->options->own[OPTION_VERBOSE])
        fprintf(out, " (reading %.1f, drawing %.1f, saving %.1f)", job->read_ms, job->draw_ms, job->save_ms);
    fputc('\n', out);
}

void job_free(struct job *job)
{
    bytes_free(&job->faults);
    bytes_free(&job->warnings);
    bytes_free(&job->names);
}
