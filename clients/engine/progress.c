#include "progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "job.h"

enum { BAR = 20, PERIOD_MS = 100 };

/* Writes "[#####.....] 512/1000  86/s  6 s left  2 failed" into `line`. */
static void format(const struct progress *progress, double now, char *line, size_t size)
{
    char bar[BAR + 1];
    const size_t drawn = progress->done - progress->skipped, left = progress->total - progress->done;
    const size_t filled = progress->total ? progress->done * BAR / progress->total : BAR;
    for (size_t i = 0; i < BAR; i++)
        bar[i] = i < filled ? '#' : '.';
    bar[BAR] = '\0';
    const double seconds = (now - progress->began) / 1e3, rate = seconds > 0 ? (double)drawn / seconds : 0;
    size_t used = (size_t)snprintf(line, size, "[%s] %zu/%zu  %.*f/s", bar, progress->done, progress->total,
                                   rate < 10 ? 1 : 0, rate);
    if (left > 0 && rate > 0)
        used += (size_t)snprintf(line + used, size - used, "  %.0f s left", (double)left / rate + 0.5);
    if (progress->skipped) used += (size_t)snprintf(line + used, size - used, "  %zu skipped", progress->skipped);
    if (progress->failed) snprintf(line + used, size - used, "  %zu failed", progress->failed);
}

bool progress_is_wanted(const struct options *options)
{
    const char *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !options->own[OPTION_PLAIN] && !options->own[OPTION_QUIET] && !getenv("NO_COLOR") &&
           !(terminal && strcmp(terminal, "dumb") == 0);
}

void progress_show(struct progress *progress, bool is_last)
{
    const double now = job_clock();
    char line[160];
    if (!progress->is_shown || (!is_last && now - progress->printed < PERIOD_MS)) return;
    progress->printed = now;
    format(progress, now, line, sizeof line);
    fprintf(stderr, "\r%s\033[K%s", line, is_last ? "\n" : "");
    fflush(stderr);
}

void progress_show_views(struct progress *progress, size_t done, size_t total)
{
    const double now = job_clock();
    if (done == total) {
        progress_hide(progress);
        progress->done = 0;
        return;
    }
    if (!progress->is_shown || now - progress->printed < PERIOD_MS) return;
    progress->printed = now;
    progress->done = done;
    fprintf(stderr, "\r%zu of %zu views\033[K", done, total);
    fflush(stderr);
}

void progress_hide(const struct progress *progress)
{
    if (progress->is_shown && progress->done > 0) fputs("\r\033[K", stderr);
}
