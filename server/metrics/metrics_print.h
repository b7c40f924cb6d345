/* metrics_print.h - all metrics as text: Prometheus' text format 0.0.4, or OpenMetrics 1.0. */
#ifndef ZRASTERD_METRICS_PRINT_H
#define ZRASTERD_METRICS_PRINT_H

#include <stdio.h>

#include "metrics.h"

enum metrics_form { METRICS_TEXT, METRICS_OPEN };

/* Series that have counted nothing are left out if they have labels of requests. */
void metrics_print(FILE *out, const struct metrics *metrics, const struct metrics_now *now, enum metrics_form form);

#endif
