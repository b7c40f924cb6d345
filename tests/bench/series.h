/* series.h - bench: what a clock said, round by round.
 *
 * The two sides of a comparison are timed in turns, so that whatever else happens on
 * the machine happens to both; the median is what counts.
 */
#ifndef ZR_BENCH_SERIES_H
#define ZR_BENCH_SERIES_H

#include <stdbool.h>

enum { SERIES_MAX = 401 };

struct series {
    double ms[SERIES_MAX];
    int count;
};

/* Milliseconds of a clock that only goes forward. */
double now_ms(void);

/* Rounds beyond SERIES_MAX are left out. */
void series_add(struct series *series, double ms);
double series_median(const struct series *series);

/* What so many of a hundred do not exceed; 0 of an empty one. */
double series_percentile(const struct series *series, int percent);

/* Times both sides in turns: a round runs each of them and adds what it took to `series`, of which there are
 * `count`. What rounds add that only warm up is forgotten; then come as many as `asked`, or, where that is 0, as many
 * as fit into some time, odd, and at least 9, or 7 where a round is slow. False as soon as a round says so. */
bool series_run(struct series *series, int count, int asked, bool (*round)(void *context, struct series *series),
                void *context);

#endif
