/* job.h - client: one file, from reading to saving. */
#ifndef JOB_H
#define JOB_H

#include <stdio.h>

#include "engine.h"
#include "files/output.h"

struct job {
    struct target target;
    const struct options *options;
    size_t line; /* of the list of a batch; 0: an argument */
    /* results */
    int status;                    /* exit status of this file */
    bool is_skipped;               /* --resume */
    struct bytes faults, warnings; /* lines */
    struct bytes names;            /* of outputs, each with a final zero */
    char look[64];
    unsigned width, height; /* of a PNG; else 0 */
    size_t bytes;           /* of the answer */
    double read_ms, draw_ms, save_ms;
};

/* Reads, draws and saves. Thread-safe. */
void job_run(const struct engine *engine, struct job *job);

/* Reads and draws. The caller frees the answer in every case. */
void job_draw(const struct engine *engine, struct job *job, struct answer *answer);

/* Saves the answer of a job that was drawn. */
void job_save(struct job *job, const struct answer *answer);

/* Prints the line of a job that is done: "part.png  640x480  studio  41 ms". */
void job_print(FILE *out, const struct job *job);

void job_free(struct job *job);

double job_clock(void); /* ms */

#endif
