/* server/metrics/: counts agree with what is counted, and the number of series is bounded whatever clients send. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metrics/metrics.h"
#include "scene/looks.h"
#include "support/tests.h"

static const char RENDER[] = "/v1/render";

static char *print(const struct metrics *metrics, enum metrics_form form)
{
    const struct metrics_now now = {.isa = "scalar", .numbers[METRICS_READY] = 1};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    metrics_print(out, metrics, &now, form);
    assert_int_equal(fclose(out), 0);
    return text;
}

static size_t count_lines(const char *text)
{
    size_t count = 0;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

TEST(values_fall_into_the_first_bucket_whose_bound_is_not_below_them)
{
    struct histogram histogram = {.sum = 0};
    const double values[] = {0, 0.001, 0.0011, 30, 31};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        histogram_add(&histogram, &histogram_seconds, values[i]);
    assert_int_equal(histogram.buckets[0], 2);
    assert_int_equal(histogram.buckets[1], 1);
    assert_int_equal(histogram.buckets[histogram_seconds.count - 1], 1);
    assert_int_equal(histogram.buckets[histogram_seconds.count], 1);
    assert_int_equal(histogram_count(&histogram), 5);
    assert_true(histogram.sum == 0 + 0.001 + 0.0011 + 30 + 31);
}

TEST(a_request_is_counted_by_its_labels_and_in_both_forms)
{
    struct metrics *metrics = metrics_create();
    metrics_count(metrics, &(struct log_request){.route = RENDER,
                                                 .method = "POST",
                                                 .status = 200,
                                                 .look = "studio@1",
                                                 .warnings = 2,
                                                 .bytes_in = 100,
                                                 .bytes_out = 5000,
                                                 .total_ms = 12,
                                                 .times = {1, 0, 9, 2, 10}});
    metrics_count(metrics, &(struct log_request){
                               .method = "BREW", .status = 503, .refusal = REFUSAL_QUEUE, .times = NO_STEP_TIMES});
    metrics_count(metrics,
                  &(struct log_request){.status = 0, .aborted = true, .was_slow = true, .times = NO_STEP_TIMES});
    char *text = print(metrics, METRICS_TEXT), *open = print(metrics, METRICS_OPEN);
    static const char *const lines[] = {
        "zraster_http_requests_total{route=\"/v1/render\",method=\"POST\",status=\"200\"} 1\n",
        "zraster_http_requests_total{route=\"none\",method=\"other\",status=\"503\"} 1\n",
        "zraster_http_requests_total{route=\"none\",method=\"other\",status=\"0\"} 1\n",
        "zraster_http_refused_total{reason=\"queue\"} 1\n",
        "zraster_http_aborted_total{reason=\"slow_reader\"} 1\n",
        "zraster_pictures_total{look=\"studio@1\"} 1\n",
        "zraster_picture_warnings_total 2\n",
        "zraster_http_request_duration_seconds_bucket{route=\"/v1/render\",le=\"0.01\"} 0\n",
        "zraster_http_request_duration_seconds_bucket{route=\"/v1/render\",le=\"0.025\"} 1\n",
        "zraster_http_request_step_seconds_count{step=\"render\"} 1\n",
        "zraster_http_answer_body_bytes_sum 5000\n",
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        assert_non_null(strstr(text, lines[i]));
        assert_non_null(strstr(open, lines[i]));
    }
    assert_non_null(strstr(text, "# TYPE zraster_http_requests_total counter\n"));
    assert_non_null(strstr(open, "# TYPE zraster_http_requests counter\n"));
    assert_null(strstr(text, "# UNIT"));
    assert_string_equal(open + strlen(open) - 6, "# EOF\n");
    free(text);
    free(open);
    metrics_free(metrics);
}

/* Routes are addresses of a table: more of them than it can have. All else is text of clients. */
TEST(series_are_bounded_whatever_comes)
{
    enum { SERIES = 200, ROUTES = 3 * METRICS_ROUTES };
    static char routes[ROUTES][8];
    struct metrics *metrics = metrics_create();
    for (int i = 0; i < ROUTES; i++)
        for (int status = -1; status < 600; status++) {
            char word[16];
            snprintf(word, sizeof word, "%d@%d", i, status);
            metrics_count(
                metrics,
                &(struct log_request){
                    .route = routes[i], .method = word, .look = word, .status = status, .times = NO_STEP_TIMES});
        }
    char *text = print(metrics, METRICS_TEXT);
    const size_t buckets = HISTOGRAM_BOUNDS_MAX + 3;
    assert_in_range(count_lines(text), METRICS_ROUTES,
                    METRICS_ROUTES * METRICS_METHODS * METRICS_STATUSES + METRICS_ROUTES * buckets + SERIES);
    free(text);
    metrics_free(metrics);
}

TEST(the_tables_have_room_for_all_looks)
{
    assert_in_range(zr_look_count, 1, METRICS_LOOKS);
}

RUN_TESTS(NULL, NULL)
