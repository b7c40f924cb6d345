/* step_times.h - how long each step of a request took. */
#ifndef ZRASTERD_STEP_TIMES_H
#define ZRASTERD_STEP_TIMES_H

/* In milliseconds; predicted_ms is the processor time of render and encode that was predicted. Below 0: it
 * did not come to that. */
struct step_times {
    double parse_ms, queue_ms, render_ms, encode_ms, predicted_ms;
};
#define NO_STEP_TIMES ((struct step_times){-1, -1, -1, -1, -1})

#endif
