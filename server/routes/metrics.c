#include "routes.h"

#include <stdio.h>
#include <string.h>

#include "metrics/metrics.h"
#include "problem.h"

bool metrics_open(const struct service *service, struct request *request, struct answer *answer)
{
    struct metrics *metrics = service->metrics;
    const bool is_open = request->takes_open_metrics;
    char *text = NULL;
    size_t size = 0;
    if (strcmp(service->config->metrics, "off") == 0) {
        problem_answer(answer, 404, "there are no metrics here; zrasterd has them with --metrics=on");
        return false;
    }
    struct metrics_now now = {.isa = zr_isa_name(zr_team_isa(service->team)),
                              .numbers[METRICS_READY] = !health_busy_with(service, request)};
    FILE *out = metrics ? open_memstream(&text, &size) : NULL;
    if (out) {
        metrics->look(metrics->context, &now);
        metrics_print(out, metrics, &now, is_open ? METRICS_OPEN : METRICS_TEXT);
        answer->is_broken |= fclose(out) != 0;
    }
    answer->status = 200;
    answer->is_broken |= !text;
    if (text)
        answer_body(answer,
                    is_open ? ACCEPT_OPEN_TYPE "; version=1.0.0; charset=utf-8"
                            : "text/plain; version=0.0.4; charset=utf-8",
                    text, size);
    answer_header(answer, "Cache-Control", "no-store");
    answer_vary(answer, "Accept");
    return false;
}
