#include "answer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include "text.h"

const char *answer_reason(int http_status)
{
    switch (http_status) {
    case 200:
        return "OK";
    case 202:
        return "Accepted";
    case 204:
        return "No Content";
    case 400:
        return "Bad Request";
    case 401:
        return "Unauthorized";
    case 403:
        return "Forbidden";
    case 404:
        return "Not Found";
    case 405:
        return "Method Not Allowed";
    case 408:
        return "Request Timeout";
    case 413:
        return "Content Too Large";
    case 414:
        return "URI Too Long";
    case 415:
        return "Unsupported Media Type";
    case 417:
        return "Expectation Failed";
    case 422:
        return "Unprocessable Content";
    case 429:
        return "Too Many Requests";
    case 431:
        return "Request Header Fields Too Large";
    case 501:
        return "Not Implemented";
    case 503:
        return "Service Unavailable";
    case 504:
        return "Gateway Timeout";
    case 505:
        return "HTTP Version Not Supported";
    case 507:
        return "Insufficient Storage";
    default:
        return "Internal Server Error";
    }
}

#define NO_MEMORY "out of memory"

void answer_to_no_memory(struct answer *answer)
{
    answer_free(answer);
    answer->status = 503;
    answer->refusal = REFUSAL_MEMORY;
    answer->is_broken = true;
    snprintf(answer->detail, sizeof answer->detail, NO_MEMORY);
}

static void send_no_memory(int socket_fd)
{
    static const char BODY[] = "{\"type\":\"about:blank\",\"title\":\"Service Unavailable\",\"status\":503,"
                               "\"detail\":\"" NO_MEMORY "\"}";
    char text[512];
    int length = snprintf(text, sizeof text,
                          "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nRetry-After: 1\r\n"
                          "Content-Type: application/problem+json\r\nContent-Length: %zu\r\n"
                          "X-Content-Type-Options: nosniff\r\nCache-Control: no-store\r\n\r\n%s",
                          sizeof BODY - 1, BODY);
    (void)!send(socket_fd, text, (size_t)length, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void answer_header(struct answer *answer, const char *name, const char *format, ...)
{
    char *value = NULL;
    va_list arguments;
    va_start(arguments, format);
    int length = vasprintf(&value, format, arguments);
    va_end(arguments);
    if (length < 0 || answer->header_count == ANSWER_HEADERS_MAX) {
        if (length >= 0) free(value);
        answer->is_broken = true;
        return;
    }
    answer->headers[answer->header_count++] = (struct answer_header){name, value};
}

/* Returns header_count if there is none. */
static size_t place_of(const struct answer *answer, const char *name)
{
    size_t i = 0;
    while (i < answer->header_count && strcasecmp(answer->headers[i].name, name) != 0)
        i++;
    return i;
}

const char *answer_find(const struct answer *answer, const char *name)
{
    const size_t place = place_of(answer, name);
    return place < answer->header_count ? answer->headers[place].value : NULL;
}

void answer_vary(struct answer *answer, const char *name)
{
    const char *before = answer_find(answer, "Vary");
    char *joined = NULL;
    if (!before) {
        answer_header(answer, "Vary", "%s", name);
    } else if (!text_has_item(before, name, strlen(name))) {
        if (asprintf(&joined, "%s, %s", before, name) < 0) {
            answer->is_broken = true;
            return;
        }
        struct answer_header *header = &answer->headers[place_of(answer, "Vary")];
        free(header->value);
        header->value = joined;
    }
}

void answer_body(struct answer *answer, const char *content_type, char *bytes, size_t size)
{
    answer_drop_bytes(answer);
    answer->bytes = bytes;
    answer->size = size;
    answer_header(answer, "Content-Type", "%s", content_type);
}

void answer_copy(struct answer *answer, const char *content_type, const void *bytes, size_t size)
{
    char *copy = malloc(size ? size : 1);
    if (!copy) {
        answer_to_no_memory(answer);
        return;
    }
    memcpy(copy, bytes, size);
    answer->status = 200;
    answer_body(answer, content_type, copy, size);
}

/* ---- shared bytes ---- */

struct answer_bytes {
    size_t users;
    char *bytes; /* malloc'd */
};

static void release_shared(struct answer *answer)
{
    struct answer_bytes *shared = answer->shared;
    answer->shared = NULL;
    if (--shared->users > 0) return;
    free(shared->bytes);
    free(shared);
}

/* Gives the bytes of the answer their count of users. */
static bool begin_sharing(struct answer *answer)
{
    if (answer->shared || !answer->bytes) return true;
    struct answer_bytes *shared = answer->release ? NULL : malloc(sizeof *shared);
    if (!shared) return false;
    *shared = (struct answer_bytes){1, answer->bytes};
    answer->shared = shared;
    answer->release = release_shared;
    return true;
}

bool answer_share(struct answer *answer, struct answer *other)
{
    if (!begin_sharing(answer)) return false;
    *other = (struct answer){.status = answer->status,
                             .bytes = answer->bytes,
                             .size = answer->size,
                             .is_unsized = answer->is_unsized,
                             .release = answer->release,
                             .shared = answer->shared,
                             .warnings = answer->warnings};
    if (other->shared) other->shared->users++;
    for (size_t i = 0; i < answer->header_count; i++)
        if (strcasecmp(answer->headers[i].name, "Server-Timing") != 0)
            answer_header(other, answer->headers[i].name, "%s", answer->headers[i].value);
    return true;
}

void answer_send(const struct answer *answer, int socket_fd)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = answer->is_broken ? NULL : open_memstream(&text, &length);
    if (!out) {
        send_no_memory(socket_fd);
        return;
    }
    fprintf(out, "HTTP/1.1 %d %s\r\nConnection: close\r\n", answer->status, answer_reason(answer->status));
    if (!answer->is_unsized) fprintf(out, "Content-Length: %zu\r\n", answer->size);
    for (size_t i = 0; i < answer->header_count; i++)
        fprintf(out, "%s: %s\r\n", answer->headers[i].name, answer->headers[i].value);
    fputs("\r\n", out);
    if (answer->bytes && answer->size > 0) fwrite(answer->bytes, 1, answer->size, out);
    const bool is_whole = !ferror(out);
    if (fclose(out) == 0 && is_whole)
        (void)!send(socket_fd, text, length, MSG_NOSIGNAL | MSG_DONTWAIT);
    else
        send_no_memory(socket_fd);
    free(text);
}

void answer_file(struct answer *answer, const char *content_type, int file, size_t size)
{
    answer_body(answer, content_type, NULL, size);
    answer->file = file;
}

void answer_drop_bytes(struct answer *answer)
{
    if (answer->release)
        answer->release(answer);
    else
        free(answer->bytes);
    answer->release = NULL;
    answer->bytes = NULL;
    if (answer->file > 0) close(answer->file);
    answer->file = 0;
}

void answer_free(struct answer *answer)
{
    answer_drop_bytes(answer);
    for (size_t i = 0; i < answer->header_count; i++)
        free(answer->headers[i].value);
    *answer = (struct answer){0};
}
