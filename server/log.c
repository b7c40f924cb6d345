#include "log.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cjson/cJSON.h>

#include "text.h"

enum { FIELD_SIZE = 513 };

static cJSON *new_line(const char *level)
{
    struct timespec now;
    struct tm parts;
    char day[32], moment[48];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &parts);
    strftime(day, sizeof day, "%Y-%m-%dT%H:%M:%S", &parts);
    snprintf(moment, sizeof moment, "%s.%03ldZ", day, now.tv_nsec / 1000000);
    cJSON *line = cJSON_CreateObject();
    cJSON_AddStringToObject(line, "time", moment);
    cJSON_AddStringToObject(line, "level", level);
    return line;
}

static void add_text(cJSON *line, const char *name, const char *text)
{
    char clean[FIELD_SIZE];
    if (!text || !*text) return;
    text_to_utf8(clean, sizeof clean, text);
    cJSON_AddStringToObject(line, name, clean);
}

static void add_ms(cJSON *line, const char *name, double ms)
{
    if (ms >= 0) cJSON_AddNumberToObject(line, name, round(ms * 1000.0) / 1000.0);
}

/* A line that cannot be made or written is lost: a log never holds up an answer. */
static void write_line(cJSON *line)
{
    char *text = cJSON_PrintUnformatted(line);
    cJSON_Delete(line);
    if (!text) return;
    size_t length = strlen(text);
    text[length] = '\n'; /* over the final zero: one write, whole lines */
    (void)!write(STDERR_FILENO, text, length + 1);
    free(text);
}

void log_request(const struct log_request *request)
{
    int status = request->status;
    cJSON *line = new_line(status >= 500 ? "error" : status >= 400 || request->aborted ? "warn" : "info");
    add_text(line, "requestId", request->id);
    add_text(line, "remote", request->remote);
    add_text(line, "method", request->method);
    add_text(line, "path", request->path);
    add_text(line, "query", request->query);
    cJSON_AddNumberToObject(line, "status", status);
    if (request->aborted) cJSON_AddTrueToObject(line, "aborted");
    cJSON_AddNumberToObject(line, "bytesIn", (double)request->bytes_in);
    cJSON_AddNumberToObject(line, "bytesOut", (double)request->bytes_out);
    add_ms(line, "totalMs", request->total_ms);
    add_ms(line, "parseMs", request->times.parse_ms);
    add_ms(line, "queueMs", request->times.queue_ms);
    add_ms(line, "renderMs", request->times.render_ms);
    add_ms(line, "encodeMs", request->times.encode_ms);
    add_ms(line, "foreseenMs", request->times.foreseen_ms);
    add_text(line, "traceparent", request->traceparent);
    add_text(line, "detail", request->detail);
    write_line(line);
}

void log_event(const char *level, const char *event, const char *detail)
{
    cJSON *line = new_line(level);
    add_text(line, "event", event);
    add_text(line, "detail", detail);
    write_line(line);
}

bool log_is_traceparent(const char *text)
{
    static const char FORM[] = "xx-xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx-xxxxxxxxxxxxxxxx-xx";
    if (strlen(text) != sizeof FORM - 1) return false;
    for (size_t i = 0; i < sizeof FORM - 1; i++) {
        bool hex = (text[i] >= '0' && text[i] <= '9') || (text[i] >= 'a' && text[i] <= 'f');
        if (FORM[i] == 'x' ? !hex : text[i] != '-') return false;
    }
    /* Version ff and ids of zeros only are invalid. */
    return strncmp(text, "ff", 2) != 0 && strspn(text + 3, "0") < 32 && strspn(text + 36, "0") < 16;
}
