/* results.h - bench: the table, for people and for programs. */
#ifndef ZR_BENCH_RESULTS_H
#define ZR_BENCH_RESULTS_H

#include <stdbool.h>
#include <stdio.h>

/* What has to hold beside the time: ours over theirs, at most. */
enum row_side { ROW_TIME_ONLY, ROW_BYTES, ROW_MEMORY };

/* A bar: what has to be reached, and what we aim at; 0: none. */
struct bar {
    double must, goal;
};

enum { ROW_NAME_SIZE = 96 };

/* A cell. Ratios are theirs over ours: higher is better. Plain bytes, so that it goes through a pipe. */
struct row {
    char work[ROW_NAME_SIZE];
    double ours_ms, theirs_ms; /* theirs 0: nothing to be compared with */
    struct bar bar;
    enum row_side side;
    double side_ratio;
    struct bar side_bar;
    bool wrong;    /* the pictures differ: the times mean nothing */
    char note[80]; /* what else to say of it; may be empty */
};

struct results {
    const char *processor, *isa; /* what it was measured on, for the file */
    int cores;
    char renderer[ROW_NAME_SIZE];
    struct row *rows;
    int count, room;
    bool failed; /* something could not run */
};

void results_free(struct results *results);
void results_add(struct results *results, const struct row *row);

/* A line of the table as soon as it is known; a heading line first where one is due. */
void results_print_heading(const char *title);
void results_print_row(const struct row *row);

/* How many rows reach what. */
void results_print_summary(const struct results *results);

/* {"rows": [...]}; directories on the way are made. False, explained on stderr. */
bool results_write(const struct results *results, const char *path);

/* Ends with 1 where a picture is wrong or something could not run. */
int results_status(const struct results *results);

#endif
