/* progress.h - client: a bar on stderr, printed at most 10 times per second. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct progress {
    bool is_shown;
    size_t total, done, failed, skipped;
    double began, printed; /* ms */
};

void progress_show(struct progress *progress, bool is_last);

/* Clears the line of the bar. */
void progress_hide(const struct progress *progress);

#endif
