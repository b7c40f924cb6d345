#include "log.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "log_text.h"
#include "log_writer.h"

/* Built once per request on the thread that serves all connections: without a tree and without malloc. */
struct line {
    size_t used;
    char bytes[LOG_LINE_SIZE];
};

/* Omits text that does not fit. */
__attribute__((format(printf, 2, 3))) static void add(struct line *line, const char *format, ...)
{
    size_t room = sizeof line->bytes - line->used;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line->bytes + line->used, room, format, arguments);
    va_end(arguments);
    if (length > 0 && (size_t)length < room) line->used += (size_t)length;
}

static void begin_line(struct line *line, const char *level)
{
    struct timespec now;
    struct tm parts;
    char day[32];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &parts);
    strftime(day, sizeof day, "%Y-%m-%dT%H:%M:%S", &parts);
    line->used = 0;
    add(line, "{\"time\":\"%s.%03ldZ\",\"level\":\"%s\"", day, now.tv_nsec / 1000000, level);
}

static void add_text(struct line *line, const char *name, const char *text)
{
    char escaped[LOG_TEXT_ESCAPED_SIZE];
    if (!text || !*text) return;
    log_text_escape(escaped, text);
    add(line, ",\"%s\":\"%s\"", name, escaped);
}

static void add_query(struct line *line, const char *query)
{
    char shown[LOG_TEXT_SIZE];
    log_text_redact(shown, sizeof shown, query);
    add_text(line, "query", shown);
}

static void add_trace(struct line *line, const struct trace *trace)
{
    if (!trace || !*trace->id) return;
    add_text(line, "traceparent", trace->given);
    add_text(line, "traceId", trace->id);
    add_text(line, "spanId", trace->span);
    add_text(line, "parentSpanId", trace->parent);
    add(line, ",\"sampled\":%s", trace->is_sampled ? "true" : "false");
}

static void add_ms(struct line *line, const char *name, double ms)
{
    if (!(ms >= 0 && ms < 1e12)) return;
    int64_t us = llround(ms * 1000.0);
    add(line, ",\"%s\":%" PRId64 ".%03d", name, us / 1000, (int)(us % 1000));
}

static void put_line(struct line *line)
{
    add(line, "}\n");
    log_writer_put(line->bytes, line->used);
}

/* Writes a line, after a notice about lines that were lost before it. */
static void write_line(struct line *line)
{
    const uint64_t lost = log_writer_take_lost();
    if (lost > 0) {
        struct line notice;
        char detail[96];
        snprintf(detail, sizeof detail, "%" PRIu64 " lines were lost, because the log was not read fast enough", lost);
        begin_line(&notice, "warn");
        add_text(&notice, "event", "log-lost");
        add_text(&notice, "detail", detail);
        put_line(&notice);
    }
    put_line(line);
}

void log_request(const struct log_request *request)
{
    struct line line;
    int status = request->status;
    begin_line(&line, status >= 500 ? "error" : status >= 400 || request->aborted ? "warn" : "info");
    add_text(&line, "requestId", request->id);
    add_text(&line, "client", request->client);
    add_text(&line, "remote", request->remote);
    add_text(&line, "method", request->method);
    add_text(&line, "route", request->route);
    add_text(&line, "path", request->path);
    if (request->query) add_query(&line, request->query);
    add(&line, ",\"status\":%d%s", status, request->aborted ? ",\"aborted\":true" : "");
    add_text(&line, "refused", refusal_word(request->refusal));
    add(&line, ",\"bytesIn\":%" PRIu64 ",\"bytesOut\":%" PRIu64, request->bytes_in, request->bytes_out);
    add_ms(&line, "totalMs", request->total_ms);
    add_ms(&line, "parseMs", request->times.parse_ms);
    add_ms(&line, "queueMs", request->times.queue_ms);
    add_ms(&line, "renderMs", request->times.render_ms);
    add_ms(&line, "encodeMs", request->times.encode_ms);
    add_ms(&line, "predictedMs", request->times.predicted_ms);
    add_text(&line, "look", request->look);
    if (request->warnings) add(&line, ",\"warnings\":%zu", request->warnings);
    add_trace(&line, request->trace);
    add_text(&line, "detail", request->detail);
    write_line(&line);
}

void log_event(const char *level, const char *event, const char *detail)
{
    struct line line;
    begin_line(&line, level);
    add_text(&line, "event", event);
    add_text(&line, "detail", detail);
    write_line(&line);
}
