/* bench.h - bench: what was asked for, and how its parts run and report.
 *
 * Mesa takes its settings from the environment and keeps one context a process, so each
 * measurement runs in a child, which sends its rows back through a pipe. The parent prints and keeps them.
 */
#ifndef ZR_BENCH_BENCH_H
#define ZR_BENCH_BENCH_H

#include <stdbool.h>
#include <stddef.h>

#include "bench/results.h"

struct bench {
    const char *program; /* this one, to be run again */
    const char *models;  /* a directory, with stanford-bunny.obj or without */
    const char *only;    /* rows whose names have this part; NULL: all */
    int rounds;          /* 0: as many as fit */
    bool check_only, list;
    struct results results;
};

/* Whether a row of this name is to be measured. Where names are only listed, prints it and says no. */
bool bench_wants(const struct bench *bench, const char *name);

/* Of a program that stands alone, to be run: those of the folder `alone`, built beside this one. */
void bench_path_of(const struct bench *bench, const char *program, char *path, size_t size);

/* A note of what failed where a measurement cannot go on; returns false. */
bool bench_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Where a child's rows go. */
struct sink {
    int fd;
};
void sink_row(const struct sink *sink, const struct row *row);

/* Runs `work` in a child and takes its rows: into *rows where that is not NULL, else into the table and
 * bench->results. Where it returns false or dies, bench->results has failed, and false is returned. */
bool bench_in_child(struct bench *bench,
                    bool (*work)(const struct bench *bench, void *context, const struct sink *sink), void *context,
                    struct results *rows);

/* The same for a child that only compares. Rows are printed as TAP if they are wrong, or if the bench only compares.
 * *wrong, which may be NULL, receives the wrong ones. */
enum { BENCH_CHECKS_MAX = 16 };
bool bench_check_in_child(struct bench *bench,
                          bool (*work)(const struct bench *bench, void *context, const struct sink *sink),
                          void *context, bool wrong[BENCH_CHECKS_MAX]);

#endif
