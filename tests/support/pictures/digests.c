#include "support/pictures/digests.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "scene/output.h"
#include "support/cmocka_all.h"
#include "support/files.h"

static char *text;
static size_t text_size;

FILE *digests_open(void)
{
    FILE *rows = open_memstream(&text, &text_size);
    assert_non_null(rows);
    return rows;
}

static uint32_t hash_of(const uint32_t *words, size_t count)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ words[i]) * 0x100000001b3u;
    return (uint32_t)(hash ^ hash >> 32);
}

void digests_add(FILE *rows, const char *name, const struct zr_frame *frame)
{
    const size_t pixels = (size_t)frame->width * frame->height;
    fprintf(rows, "%s %" PRIu32 "x%" PRIu32, name, frame->width, frame->height);
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (frame->channels[c])
            fprintf(rows, " %s:%08" PRIx32, zr_channel_rows[c].name,
                    hash_of(frame->channels[c], pixels * zr_channel_rows[c].words));
    fputc('\n', rows);
}

static void write_file(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

/* The rows of `text` that `committed` lacks. */
static size_t print_others(const char *committed)
{
    size_t others = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        const char *found = strstr(committed, line);
        if (found && (found == committed || found[-1] == '\n') && found[strlen(line)] == '\n') continue;
        print_error("drawn now: %s\n", line);
        others++;
    }
    return others;
}

void digests_check(FILE *rows, const char *path)
{
    const char *wish = getenv("DIGESTS");
    assert_int_equal(fclose(rows), 0);
    if (path && wish && strcmp(wish, "write") == 0) write_file(path);
    char *committed = path ? file_read(path, &(size_t){0}) : NULL;
    if (path && !committed) fail_msg("%s: not there; tests run from the project's top folder", path);
    if (path && strcmp(text, committed) != 0) fail_msg("%s: %zu rows are others now", path, print_others(committed));
    free(committed);
    free(text);
}
