#include "streamed.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <unistd.h>

#include "support/cmocka_all.h"

enum { SILENCE_MS = 30000, BLOCK = 1 << 16 };

struct streamed streamed_begin(const struct daemon *daemon, const char *scene, int buffer)
{
    char head[512];
    struct streamed streamed = {.fd = client_connect(daemon)};
    assert_true(streamed.fd >= 0);
    if (buffer > 0) assert_int_equal(setsockopt(streamed.fd, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer), 0);
    const int length =
        snprintf(head, sizeof head,
                 "POST /v1/render HTTP/1.1\r\nHost: a\r\nAccept: application/zip;q=0.5, multipart/mixed\r\n" JSON_TYPE
                 "\r\nContent-Length: %zu\r\n\r\n",
                 strlen(scene));
    assert_true(client_write(streamed.fd, head, (size_t)length));
    assert_true(client_write(streamed.fd, scene, strlen(scene)));
    return streamed;
}

static bool is_last_chunk(const struct streamed *s)
{
    static const char LAST[] = "\r\n0\r\n\r\n";
    const size_t length = sizeof LAST - 1;
    return s->size >= length && memcmp(s->bytes + s->size - length, LAST, length) == 0;
}

bool streamed_read(struct streamed *streamed)
{
    struct pollfd polled = {.fd = streamed->fd, .events = POLLIN};
    if (streamed->has_ended || poll(&polled, 1, SILENCE_MS) <= 0) return false;
    if (streamed->capacity < streamed->size + BLOCK + 1) {
        streamed->capacity = 2 * streamed->size + BLOCK + 1;
        streamed->bytes = realloc(streamed->bytes, streamed->capacity);
        assert_non_null(streamed->bytes);
    }
    const ssize_t count = recv(streamed->fd, streamed->bytes + streamed->size, BLOCK, 0);
    if (count > 0) streamed->size += (size_t)count;
    streamed->bytes[streamed->size] = '\0';
    streamed->has_ended = count <= 0 || is_last_chunk(streamed);
    streamed->status = raw_status(streamed->bytes);
    return count > 0;
}

void streamed_read_all(struct streamed *streamed)
{
    while (streamed_read(streamed))
        assert_int_equal(streamed->status, 200);
    assert_true(streamed->has_ended);
}

void streamed_end(struct streamed *streamed)
{
    free(streamed->bytes);
    close(streamed->fd);
    *streamed = (struct streamed){.fd = -1};
}

/* ---- parts ---- */

/* Copies the bytes of chunks, as far as they are there. */
static void take_chunks(struct streamed_parts *parts, const char *at, const char *end)
{
    for (;;) {
        char *behind = NULL;
        const char *line_end = memchr(at, '\n', (size_t)(end - at));
        if (!line_end) return;
        const size_t size = strtoul(at, &behind, 16);
        assert_true(behind > at);
        at = line_end + 1;
        parts->is_whole = size == 0;
        if (size == 0) return;
        const size_t here = (size_t)(end - at) < size ? (size_t)(end - at) : size;
        memcpy(parts->body + parts->size, at, here);
        parts->size += here;
        if ((size_t)(end - at) < size + 2) return;
        assert_memory_equal(at + size, "\r\n", 2);
        at += size + 2;
    }
}

struct streamed_parts streamed_parts(const struct streamed *streamed)
{
    struct streamed_parts parts = {.body = malloc(streamed->size + 1)};
    char delimiter[96];
    assert_non_null(parts.body);
    const char *head_end = strstr(streamed->bytes, "\r\n\r\n");
    const char *type = strstr(streamed->bytes, "Content-Type: multipart/mixed; boundary=");
    assert_int_equal(streamed->status, 200);
    assert_true(head_end && type && type < head_end);
    assert_non_null(strstr(streamed->bytes, "Vary: Accept\r\n"));
    assert_int_equal(sscanf(strchr(type, '='), "=%79[0-9a-f]", parts.boundary), 1);
    take_chunks(&parts, head_end + 4, streamed->bytes + streamed->size);
    parts.body[parts.size] = '\0';
    snprintf(delimiter, sizeof delimiter, "--%s", parts.boundary);
    parts.at = strlen(delimiter);
    assert_true(parts.size >= parts.at && memcmp(parts.body, delimiter, parts.at) == 0);
    return parts;
}

static void read_header(const char *head, const char *before, char *out, size_t size)
{
    const char *at = strstr(head, before);
    out[0] = '\0';
    if (at) snprintf(out, size, "%.*s", (int)strcspn(at + strlen(before), "\"\r"), at + strlen(before));
}

bool streamed_next(struct streamed_parts *parts, struct streamed_part *part)
{
    char head[2048], size[32], delimiter[96];
    const char *begin = parts->body + parts->at, *end = strstr(begin, "\r\n\r\n");
    if (strncmp(begin, "\r\n", 2) != 0 || !end) return false;
    snprintf(head, sizeof head, "%.*s\r\n", (int)(end - begin), begin);
    read_header(head, "\r\nContent-Type: ", part->type, sizeof part->type);
    read_header(head, "\r\nContent-Disposition: attachment; filename=\"", part->name, sizeof part->name);
    read_header(head, "\r\nContent-Length: ", size, sizeof size);
    part->bytes = end + 4;
    part->size = strtoul(size, NULL, 10);
    const size_t length = (size_t)snprintf(delimiter, sizeof delimiter, "\r\n--%s", parts->boundary);
    if (parts->size - (size_t)(part->bytes - parts->body) < part->size + length) return false;
    assert_memory_equal(part->bytes + part->size, delimiter, length);
    parts->at = (size_t)(part->bytes - parts->body) + part->size + length;
    return true;
}

bool streamed_is_final(const struct streamed_parts *parts)
{
    return parts->size - parts->at == 4 && memcmp(parts->body + parts->at, "--\r\n", 4) == 0 && parts->is_whole;
}

void streamed_read_part(struct streamed *streamed)
{
    struct streamed_part part;
    for (bool is_there = false; !is_there;) {
        assert_true(streamed_read(streamed));
        if (!strstr(streamed->bytes, "Content-Length")) continue;
        struct streamed_parts parts = streamed_parts(streamed);
        is_there = streamed_next(&parts, &part);
        free(parts.body);
    }
}
