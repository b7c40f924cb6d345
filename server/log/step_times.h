/* step_times.h - duration of each step of a request. */
#ifndef ZRASTERD_STEP_TIMES_H
#define ZRASTERD_STEP_TIMES_H

/* In ms. predicted_ms: predicted processor time of render and encode. Below 0: the step was not reached. */
struct step_times {
    double parse_ms, queue_ms, render_ms, encode_ms, predicted_ms;
};
#define NO_STEP_TIMES ((struct step_times){-1, -1, -1, -1, -1})

#endif
