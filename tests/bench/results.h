/* results.h - bench: the table, for people and for programs. */
#ifndef ZR_BENCH_RESULTS_H
#define ZR_BENCH_RESULTS_H

#include <stdbool.h>
#include <stdio.h>

/* What has to hold beside the time, at most: bytes of ours over theirs, or memory that was needed over what the
 * arrays of the scene take. */
enum row_side { ROW_TIME_ONLY, ROW_BYTES, ROW_MEMORY };

/* A bar: what has to be reached, and what we aim at; 0: none. */
struct bar {
    double must, goal;
};

enum { ROW_NAME_SIZE = 96 };

/* Ratios are theirs over ours: higher is better. Plain bytes, so that it goes through a pipe. */
struct row {
    char work[ROW_NAME_SIZE];
    double ours_ms, theirs_ms; /* theirs 0: nothing to be compared with */
    struct bar bar;
    enum row_side side;
    double side_ratio;
    struct bar side_bar;
    bool wrong;        /* the pictures differ: the times mean nothing */
    char note[80];     /* what else to say of it; may be empty */
    const char *table; /* its heading; results_add tells it */
};

struct results {
    const char *processor, *isa; /* what it was measured on, for the file */
    int cores;
    char renderer[ROW_NAME_SIZE];
    const char *table; /* the heading that was printed last; NULL: none yet */
    struct row *rows;
    int count, room;
    bool failed; /* something could not run */
};

void results_free(struct results *results);

/* Prints a heading, where it is not the one under which rows stand already. It must stay as long as the results. */
void results_begin_table(struct results *results, const char *heading);
void results_add(struct results *results, const struct row *row);

/* What heads the whole table: how to read it. */
void results_print_legend(void);

/* A line of the table as soon as it is known. */
void results_print_row(const struct row *row);

/* How many rows reach what. */
void results_print_summary(const struct results *results);

/* {"processor", "cores", "isa", "renderer", "rows": [{"table": heading, "work", "ours_ms", "theirs_ms", "ratio",
 * "must", "goal", "mark", "note"}]}, and in rows that have them "bytes_ratio" or "memory_ratio", with "_must" and
 * "_goal", which are at most. Null: nothing to be compared with, or no bar. Directories on the way are made. False,
 * explained on stderr. */
bool results_write(const struct results *results, const char *path);

/* Ends with 1 where a picture is wrong or something could not run. */
int results_status(const struct results *results);

#endif
