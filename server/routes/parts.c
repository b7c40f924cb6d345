#include "parts.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "clock.h"
#include "form.h"

enum { HEAD_SIZE = 4096, OUTPUTS_MAX = 64 /* pairs of channel and encoding */ };

/* Random, since files may have any bytes. */
static void choose_boundary(char boundary[STREAM_BOUNDARY_SIZE])
{
    uint64_t random[2];
    if (getrandom(random, sizeof random, 0) != sizeof random) random[0] = random[1] = (uint64_t)clock_us();
    snprintf(boundary, STREAM_BOUNDARY_SIZE, "%016" PRIx64 "%016" PRIx64, random[0], random[1]);
}

static const char *type_of(bool is_form)
{
    return is_form ? ACCEPT_FORM_TYPE : ACCEPT_MIXED_TYPE;
}

/* Writes the header of a part, with the line end after the delimiter before it. Returns its length. */
static size_t print_head(char head[HEAD_SIZE], bool is_form, const struct part *part)
{
    int used = snprintf(head, HEAD_SIZE, "\r\nContent-Type: %s\r\nContent-Length: %zu\r\n", part->type, part->size);
    if (part->name && is_form) {
        const char *dot = part->is_twin ? NULL : strrchr(part->name, '.');
        used += snprintf(head + used, HEAD_SIZE - (size_t)used,
                         "Content-Disposition: form-data; name=\"%.*s\"; filename=\"%s\"\r\n",
                         dot ? (int)(dot - part->name) : -1, part->name, part->name);
    } else if (part->name) {
        used += snprintf(head + used, HEAD_SIZE - (size_t)used, "Content-Disposition: attachment; filename=\"%s\"\r\n",
                         part->name);
    }
    if (*part->warnings)
        used += snprintf(head + used, HEAD_SIZE - (size_t)used, "Zraster-Warnings: %s\r\n", part->warnings);
    return (size_t)(used + snprintf(head + used, HEAD_SIZE - (size_t)used, "\r\n"));
}

static size_t length_of_stem(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot ? (size_t)(dot - name) : strlen(name);
}

/* Outputs of one view stand side by side. */
bool parts_have_twin(const struct zr_files *files, uint32_t number)
{
    const uint32_t reach = OUTPUTS_MAX, first = number > reach ? number - reach : 0;
    const char *name = files->entries[number].name;
    const size_t length = length_of_stem(name);
    for (uint32_t i = first; i < files->count && i <= number + reach; i++) {
        const char *other = files->entries[i].name;
        if (i != number && length_of_stem(other) == length && memcmp(name, other, length) == 0) return true;
    }
    return false;
}

/* ---- a stream ---- */

/* Without a line end, which begins the next part. */
static bool add_delimiter(struct stream *stream)
{
    return stream_write(stream, "--", 2) && stream_write(stream, stream->boundary, strlen(stream->boundary));
}

void parts_begin(struct stream *stream, enum accept_parts parts, struct answer *answer)
{
    choose_boundary(stream->boundary);
    stream->is_form = parts == ACCEPT_FORM;
    answer->status = 200;
    answer_header(answer, "Content-Type", "%s; boundary=%s", type_of(stream->is_form), stream->boundary);
    stream_begin(stream, answer);
    add_delimiter(stream);
}

bool parts_add(struct stream *stream, const struct part *part)
{
    char head[HEAD_SIZE];
    const size_t length = print_head(head, stream->is_form, part);
    return stream_write(stream, head, length) && stream_write(stream, part->bytes, part->size) &&
           stream_write(stream, "\r\n", 2) && add_delimiter(stream);
}

void parts_end(struct stream *stream, const struct answer *problem)
{
    if (problem->status == 0) {
        stream_write(stream, "--\r\n", 4);
        stream_finish(stream, STREAM_WHOLE);
        return;
    }
    const struct part part = {NULL, false, "application/problem+json", "", problem->bytes, problem->size};
    if (!problem->is_broken) parts_add(stream, &part);
    stream_finish(stream, STREAM_BROKEN);
}

/* ---- in one piece ---- */

/* Bytes so far; `to` is NULL while they are only counted. */
struct pen {
    char *to;
    size_t size;
};

static void put(struct pen *pen, const void *bytes, size_t size)
{
    if (pen->to) memcpy(pen->to + pen->size, bytes, size);
    pen->size += size;
}

static void put_delimiter(struct pen *pen, const char *boundary)
{
    put(pen, "--", 2);
    put(pen, boundary, strlen(boundary));
}

static void put_files(struct pen *pen, bool is_form, const char *boundary, const struct zr_files *files)
{
    char head[HEAD_SIZE];
    put_delimiter(pen, boundary);
    for (uint32_t i = 0; i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        const struct part part = {entry->name, parts_have_twin(files, i), files->types[i], "", entry->bytes, entry->size};
        put(pen, head, print_head(head, is_form, &part));
        put(pen, part.bytes, part.size);
        put(pen, "\r\n", 2);
        put_delimiter(pen, boundary);
    }
    put(pen, "--\r\n", 4);
}

void parts_answer(struct answer *answer, enum accept_parts parts, const struct zr_files *files)
{
    const bool is_form = parts == ACCEPT_FORM;
    char boundary[STREAM_BOUNDARY_SIZE], type[80];
    struct pen count = {0};
    choose_boundary(boundary);
    put_files(&count, is_form, boundary, files);
    struct pen pen = {.to = malloc(count.size)};
    if (!pen.to) {
        answer_to_no_memory(answer);
        return;
    }
    put_files(&pen, is_form, boundary, files);
    snprintf(type, sizeof type, "%s; boundary=%s", type_of(is_form), boundary);
    answer->status = 200;
    answer_body(answer, type, pen.to, pen.size);
}

void form_answer(struct answer *answer, enum accept_parts parts, const struct form_file *files, size_t count)
{
    struct zr_zip_entry entries[FORM_FILES_MAX];
    const char *types[FORM_FILES_MAX];
    const struct zr_files all = {.count = (uint32_t)count, .entries = entries, .types = types};
    for (size_t i = 0; i < count; i++) {
        entries[i] = (struct zr_zip_entry){.name = files[i].name, .bytes = files[i].bytes, .size = files[i].size};
        types[i] = files[i].type;
    }
    parts_answer(answer, parts, &all);
}
