#include "metrics.h"

#include <dirent.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core.h"
#include "scene/looks.h"

enum type { COUNTER, GAUGE, HISTOGRAM, INFO };

struct printer {
    FILE *out;
    const struct metrics *metrics;
    struct metrics_now now;
    enum metrics_form form;
    const struct family *family;
};

struct family {
    const char *name; /* without _total and _info */
    enum type type;
    const char *unit; /* "": none */
    const char *help;
    void (*print)(const struct printer *printer); /* NULL: one number */
    size_t of;                                    /* enum metrics_number; or the offset of what `print` prints */
};

/* ---- samples ---- */

/* Bounds are numbers with a point in OpenMetrics. */
static void print_bound(FILE *out, double bound)
{
    if (bound == floor(bound))
        fprintf(out, "%.1f", bound);
    else
        fprintf(out, "%g", bound);
}

/* Prints "NAME_total{labels} value" of a counter, and "NAME{labels} value" of a gauge. `labels` may be "". */
static void print_sample(const struct printer *p, const char *labels, double value)
{
    const enum type type = p->family->type;
    const char *ending = type == COUNTER ? "_total" : type == INFO ? "_info" : "";
    fprintf(p->out, "%s%s%s%s%s %.15g\n", p->family->name, ending, *labels ? "{" : "", labels, *labels ? "}" : "",
            value);
}

__attribute__((format(printf, 3, 4))) static void print_labelled(const struct printer *p, double value,
                                                                 const char *format, ...)
{
    char labels[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(labels, sizeof labels, format, arguments);
    va_end(arguments);
    print_sample(p, labels, value);
}

static void print_histogram(const struct printer *p, const char *labels, const struct histogram *histogram,
                            const struct histogram_bounds *bounds)
{
    uint64_t below = 0;
    const char *comma = *labels ? "," : "";
    for (size_t i = 0; i <= bounds->count; i++) {
        below += histogram->buckets[i];
        fprintf(p->out, "%s_bucket{%s%sle=\"", p->family->name, labels, comma);
        if (i < bounds->count)
            print_bound(p->out, bounds->values[i]);
        else
            fputs("+Inf", p->out);
        fprintf(p->out, "\"} %" PRIu64 "\n", below);
    }
    const char *open = *labels ? "{" : "", *close = *labels ? "}" : "";
    fprintf(p->out, "%s_sum%s%s%s %.15g\n", p->family->name, open, labels, close, histogram->sum);
    fprintf(p->out, "%s_count%s%s%s %" PRIu64 "\n", p->family->name, open, labels, close, below);
}

static const char *route_word(const struct metrics *metrics, size_t route)
{
    return route ? metrics->routes[route] : "none";
}

/* ---- families of requests ---- */

static void print_requests(const struct printer *p)
{
    const struct metrics *m = p->metrics;
    for (size_t route = 0; route < m->route_count; route++)
        for (size_t method = 0; method < METRICS_METHODS; method++)
            for (size_t status = 0; status < METRICS_STATUSES; status++) {
                const uint64_t count = m->requests[route][method][status];
                char number[16] = "other";
                if (count == 0) continue;
                if (metrics_statuses[status] >= 0) snprintf(number, sizeof number, "%d", metrics_statuses[status]);
                print_labelled(p, (double)count, "route=\"%s\",method=\"%s\",status=\"%s\"", route_word(m, route),
                               metrics_methods[method], number);
            }
}

static void print_durations(const struct printer *p)
{
    char labels[128];
    for (size_t route = 0; route < p->metrics->route_count; route++) {
        if (histogram_count(&p->metrics->durations[route]) == 0) continue;
        snprintf(labels, sizeof labels, "route=\"%s\"", route_word(p->metrics, route));
        print_histogram(p, labels, &p->metrics->durations[route], &histogram_seconds);
    }
}

static void print_steps(const struct printer *p)
{
    char labels[64];
    for (enum metrics_step step = METRICS_PARSE; step < METRICS_STEPS; step++) {
        snprintf(labels, sizeof labels, "step=\"%s\"", metrics_steps[step]);
        print_histogram(p, labels, &p->metrics->steps[step], &histogram_seconds);
    }
}

/* Prints a histogram of struct metrics. */
static void print_bytes(const struct printer *p)
{
    const void *histogram = (const char *)p->metrics + p->family->of;
    print_histogram(p, "", histogram, &histogram_bytes);
}

static void print_pictures(const struct printer *p)
{
    for (int i = 0; i < zr_look_count && i < METRICS_LOOKS; i++)
        if (p->metrics->pictures[i])
            print_labelled(p, (double)p->metrics->pictures[i], "look=\"%s\"", zr_look_pin_of(&zr_looks[i]).text);
}

static void print_refusals(const struct printer *p)
{
    for (enum refusal i = REFUSAL_DRAINING; i < REFUSALS; i++)
        print_labelled(p, (double)p->metrics->refusals[i], "reason=\"%s\"", refusal_word(i));
}

static void print_aborts(const struct printer *p)
{
    for (enum metrics_abort i = METRICS_CLIENT_LEFT; i < METRICS_ABORTS; i++)
        print_labelled(p, (double)p->metrics->aborts[i], "reason=\"%s\"", metrics_aborts[i]);
}

/* ---- families of the daemon ---- */

static void print_build(const struct printer *p)
{
    print_labelled(p, 1, "version=\"" ZR_VERSION "\",isa=\"%s\",rules=\"%d\"", p->now.isa, ZR_RULES);
}

static void print_queues(const struct printer *p)
{
    print_labelled(p, (double)p->now.waiting[QUEUE_SMALL], "queue=\"small\"");
    print_labelled(p, (double)p->now.waiting[QUEUE_LARGE], "queue=\"large\"");
}

static void print_connections(const struct printer *p)
{
    static const char *const words[PHASES] = {
        [PHASE_IDLE] = "idle", [PHASE_HEADER] = "header", [PHASE_BODY] = "body",
        [PHASE_WORK] = "work", [PHASE_WRITE] = "write",   [PHASE_REFUSED] = "refused"};
    for (int i = 0; i < PHASES; i++)
        print_labelled(p, (double)p->now.connections[i], "phase=\"%s\"", words[i]);
}

/* Prints a number of struct kept_state for each table of kept values. */
static void print_kept(const struct printer *p)
{
    for (enum kept_table i = KEPT_IMAGES; i < KEPT_TABLES; i++) {
        uint64_t value;
        memcpy(&value, (const char *)&p->now.kept[i] + p->family->of, sizeof value);
        print_labelled(p, (double)value, "kind=\"%s\"", kept_word(i));
    }
}

/* ---- this process, as the kernel describes it ---- */

/* Counts the open files, without the one that lists them. */
static double count_files(void)
{
    DIR *folder = opendir("/proc/self/fd");
    double count = -1;
    if (!folder) return -1;
    for (const struct dirent *entry; (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

static void read_memory(double numbers[METRICS_NUMBERS])
{
    unsigned long pages, resident;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file) return;
    if (fscanf(file, "%lu %lu", &pages, &resident) == 2) {
        const double page = (double)sysconf(_SC_PAGESIZE);
        numbers[METRICS_VIRTUAL] = page * (double)pages;
        numbers[METRICS_RESIDENT] = page * (double)resident;
    }
    fclose(file);
}

static double seconds_of(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

/* Leaves -1 where the kernel has no answer. */
static void look_at_process(double numbers[METRICS_NUMBERS])
{
    struct rusage usage;
    struct rlimit limit;
    numbers[METRICS_CPU_S] = numbers[METRICS_RESIDENT] = numbers[METRICS_VIRTUAL] = numbers[METRICS_MAX_FILES] = -1;
    numbers[METRICS_OPEN_FILES] = count_files();
    read_memory(numbers);
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        numbers[METRICS_CPU_S] = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        numbers[METRICS_MAX_FILES] = (double)limit.rlim_cur;
}

/* ---- the table ---- */

static const struct family FAMILIES[] = {
    {"zraster_build", INFO, "", "Version, instruction set, and version of the rules.", print_build, 0},
    {"zraster_ready", GAUGE, "", "1 if the daemon accepts work, as /readyz.", NULL, METRICS_READY},
    {"zraster_http_requests", COUNTER, "", "Requests; status 0: no answer was sent.", print_requests, 0},
    {"zraster_http_request_duration_seconds", HISTOGRAM, "seconds",
     "Time from the request line to the end of the answer.", print_durations, 0},
    {"zraster_http_request_step_seconds", HISTOGRAM, "seconds", "Time of a step of the requests that reached it.",
     print_steps, 0},
    {"zraster_http_request_body_bytes", HISTOGRAM, "bytes", "Size of the bodies of requests.", print_bytes,
     offsetof(struct metrics, bodies)},
    {"zraster_http_answer_body_bytes", HISTOGRAM, "bytes",
     "Size of the bodies of answers, up to the last byte that was read.", print_bytes,
     offsetof(struct metrics, answers)},
    {"zraster_http_requests_in_progress", GAUGE, "", "Requests whose header is complete and whose answer is not.", NULL,
     METRICS_IN_PROGRESS},
    {"zraster_http_refused", COUNTER, "", "Requests refused by 503 or 429.", print_refusals, 0},
    {"zraster_http_aborted", COUNTER, "", "Requests whose answer did not arrive whole.", print_aborts, 0},
    {"zraster_http_timeouts", COUNTER, "", "Requests whose work took longer than renderTimeoutMs (504).", NULL,
     METRICS_TIMEOUTS},
    {"zraster_http_connections", GAUGE, "", "Open connections.", print_connections, 0},
    {"zraster_http_connections_limit", GAUGE, "", "Connections that may be open, maxConnections.", NULL,
     METRICS_CONNECTIONS_MAX},
    {"zraster_pictures", COUNTER, "", "Answers with pictures, by their look.", print_pictures, 0},
    {"zraster_picture_warnings", COUNTER, "", "Warnings of pictures.", NULL, METRICS_WARNINGS},
    {"zraster_shared_answers", COUNTER, "", "Requests answered by the work on an equal request under way.", NULL,
     METRICS_SHARED_ANSWERS},
    {"zraster_queue_length", GAUGE, "", "Requests that wait for a worker.", print_queues, 0},
    {"zraster_workers", GAUGE, "", "Workers, without the thread for one small request beside them.", NULL,
     METRICS_WORKERS},
    {"zraster_workers_busy", GAUGE, "", "Workers at work.", NULL, METRICS_BUSY},
    {"zraster_streams", GAUGE, "", "Answers that are streamed.", NULL, METRICS_STREAMS},
    {"zraster_render_memory_bytes", GAUGE, "bytes", "Memory that the last requests of all workers used.", NULL,
     METRICS_RENDER_BYTES},
    {"zraster_answer_memory_bytes", GAUGE, "bytes", "Memory of answers and streams that wait for their readers.", NULL,
     METRICS_ANSWER_BYTES},
    {"zraster_answer_memory_limit_bytes", GAUGE, "bytes", "Memory that these may take, answerMemoryBytes.", NULL,
     METRICS_ANSWER_BYTES_MAX},
    {"zraster_memory_limit_bytes", GAUGE, "bytes",
     "Limit of the memory of the control group; without one, memory of the machine.", NULL, METRICS_MEMORY_MAX},
    {"zraster_assets_bytes", GAUGE, "bytes", "Size of the stored assets, in blocks of 4096.", NULL,
     METRICS_ASSET_BYTES},
    {"zraster_assets_limit_bytes", GAUGE, "bytes", "Size that they may have, assetsMaxBytes.", NULL,
     METRICS_ASSET_BYTES_MAX},
    {"zraster_upload_memory_bytes", GAUGE, "bytes", "Memory of the bodies of requests.", NULL, METRICS_UPLOAD_BYTES},
    {"zraster_kept_hits", COUNTER, "", "Kept values that were used again.", print_kept,
     offsetof(struct kept_state, hits)},
    {"zraster_kept_misses", COUNTER, "", "Values that were computed, since none was kept.", print_kept,
     offsetof(struct kept_state, misses)},
    {"zraster_kept_dropped", COUNTER, "", "Kept values that were dropped to make room for others.", print_kept,
     offsetof(struct kept_state, dropped)},
    {"zraster_kept_entries", GAUGE, "", "Kept values.", print_kept, offsetof(struct kept_state, count)},
    {"zraster_kept_bytes", GAUGE, "bytes", "Memory of kept values.", print_kept, offsetof(struct kept_state, bytes)},
    {"zraster_log_lines_lost", COUNTER, "", "Lines that were lost, because the log was not read fast enough.", NULL,
     METRICS_LOST_LINES},
    {"process_cpu_seconds", COUNTER, "seconds", "Processor time of the daemon.", NULL, METRICS_CPU_S},
    {"process_resident_memory_bytes", GAUGE, "bytes", "Resident memory.", NULL, METRICS_RESIDENT},
    {"process_virtual_memory_bytes", GAUGE, "bytes", "Virtual memory.", NULL, METRICS_VIRTUAL},
    {"process_open_fds", GAUGE, "", "Open files.", NULL, METRICS_OPEN_FILES},
    {"process_max_fds", GAUGE, "", "Files that may be open.", NULL, METRICS_MAX_FILES},
    {"process_start_time_seconds", GAUGE, "seconds", "Start of the daemon, in seconds since 1970.", NULL,
     METRICS_START_S},
};

/* Prints the lines above the samples. In the text format, a counter's name has its ending, and an info is a gauge. */
static void print_head(const struct printer *p)
{
    const struct family *family = p->family;
    static const char *const words[] = {"counter", "gauge", "histogram", "info"};
    const bool is_open = p->form == METRICS_OPEN;
    const char *ending = is_open ? "" : family->type == COUNTER ? "_total" : family->type == INFO ? "_info" : "";
    const char *type = !is_open && family->type == INFO ? "gauge" : words[family->type];
    fprintf(p->out, "# HELP %s%s %s\n# TYPE %s%s %s\n", family->name, ending, family->help, family->name, ending, type);
    if (is_open && *family->unit) fprintf(p->out, "# UNIT %s %s\n", family->name, family->unit);
}

void metrics_print(FILE *out, const struct metrics *metrics, const struct metrics_now *now, enum metrics_form form)
{
    struct printer printer = {.out = out, .metrics = metrics, .now = *now, .form = form};
    double *numbers = printer.now.numbers;
    numbers[METRICS_WARNINGS] = (double)metrics->warnings;
    numbers[METRICS_TIMEOUTS] = (double)metrics->timeouts;
    numbers[METRICS_START_S] = metrics->start_s;
    look_at_process(numbers);
    for (const struct family *family = FAMILIES; family < FAMILIES + sizeof FAMILIES / sizeof *FAMILIES; family++) {
        if (!family->print && numbers[family->of] < 0) continue; /* not available from the kernel */
        printer.family = family;
        print_head(&printer);
        if (family->print)
            family->print(&printer);
        else
            print_sample(&printer, "", numbers[family->of]);
    }
    if (form == METRICS_OPEN) fputs("# EOF\n", out);
}
