#include "parts.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>

#include "clock.h"

enum { HEAD_SIZE = 4096 };

/* Random, since files may have any bytes. */
static void choose_boundary(struct stream *stream)
{
    uint64_t random[2];
    if (getrandom(random, sizeof random, 0) != sizeof random) random[0] = random[1] = (uint64_t)clock_us();
    snprintf(stream->boundary, sizeof stream->boundary, "%016" PRIx64 "%016" PRIx64, random[0], random[1]);
}

/* Without a line end, which begins the next part. */
static bool add_delimiter(struct stream *stream)
{
    return stream_write(stream, "--", 2) && stream_write(stream, stream->boundary, strlen(stream->boundary));
}

void parts_begin(struct stream *stream, struct answer *answer)
{
    choose_boundary(stream);
    answer->status = 200;
    answer_header(answer, "Content-Type", PARTS_TYPE "; boundary=%s", stream->boundary);
    stream_begin(stream, answer);
    add_delimiter(stream);
}

bool parts_add(struct stream *stream, const struct part *part)
{
    char head[HEAD_SIZE];
    int used = snprintf(head, sizeof head, "\r\nContent-Type: %s\r\nContent-Length: %zu\r\n", part->type, part->size);
    if (part->name)
        used += snprintf(head + used, sizeof head - (size_t)used,
                         "Content-Disposition: attachment; filename=\"%s\"\r\n", part->name);
    if (*part->warnings)
        used += snprintf(head + used, sizeof head - (size_t)used, "Zraster-Warnings: %s\r\n", part->warnings);
    used += snprintf(head + used, sizeof head - (size_t)used, "\r\n");
    return stream_write(stream, head, (size_t)used) && stream_write(stream, part->bytes, part->size) &&
           stream_write(stream, "\r\n", 2) && add_delimiter(stream);
}

void parts_end(struct stream *stream, const struct answer *problem)
{
    if (problem->status == 0) {
        stream_write(stream, "--\r\n", 4);
        stream_finish(stream, STREAM_WHOLE);
        return;
    }
    const struct part part = {NULL, "application/problem+json", "", problem->bytes, problem->size};
    if (!problem->is_broken) parts_add(stream, &part);
    stream_finish(stream, STREAM_BROKEN);
}
