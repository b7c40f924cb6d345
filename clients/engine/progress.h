/* progress.h - client: a line on stderr, printed at most 10 times per second: a bar of files, or the views of one file.
 */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct progress {
    bool is_shown; /* progress_is_wanted */
    size_t total, done, failed, skipped;
    double began, printed; /* ms */
};

struct options;

/* Returns true if stderr is a terminal, and the options and NO_COLOR allow a progress line. */
bool progress_is_wanted(const struct options *options);

void progress_show(struct progress *progress, bool is_last);

/* Shows "12 of 36 views" until all are done. Initialize `progress->printed` with the start time, so that
 * requests under 0.1 s show nothing. */
void progress_show_views(struct progress *progress, size_t done, size_t total);

/* Clears the line, if there is one. */
void progress_hide(const struct progress *progress);

#endif
