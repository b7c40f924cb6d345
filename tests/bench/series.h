/* series.h - bench: what a clock said, round by round.
 *
 * The two sides of a comparison are timed in turns, so that whatever else happens on
 * the machine happens to both; the median is what counts.
 */
#ifndef ZR_BENCH_SERIES_H
#define ZR_BENCH_SERIES_H

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

/* How many rounds to time where one takes `round_ms`: `asked`, or, where that is 0, as many as fit into some
 * time, odd, and at least 9, or 7 where a round is slow. */
int series_rounds(int asked, double round_ms);

#endif
