/* part_texts.h - tests: a text that several threads read in parts of any size is the scene, or has the faults, that it
 * is or has as one part. A test defines the size of a reader's parts as `part_bytes` and includes the reader. */
#ifndef ZR_TESTS_PART_TEXTS_H
#define ZR_TESTS_PART_TEXTS_H

#include "by_teams.h"
#include "input/formats/formats.h"
#include "input/formats/input.h"
#include "mutate.h"
#include "support/sanitized.h"

enum { TEXTS = IS_THREAD_SANITIZED ? 200 : IS_SANITIZED ? 1000 : 4000, PIECES_MOST = 60 };

static size_t part_bytes;

static inline void check_text(enum zr_format format, const struct text *text, size_t *good)
{
    part_bytes = SIZE_MAX / 2;
    struct reading *whole = read_by(NULL, format, text);
    part_bytes = 1 + below(below(2) ? 40 : 400);
    struct reading *parts = read_by(teams[below(TEAMS)], format, text);
    assert_same_reading(whole, parts);
    *good += whole->status == ZR_OK;
    reading_free(whole);
    reading_free(parts);
}

/* Texts of `begin`, any pieces and `end`; two of three are spoilt here and there. */
static inline void check_texts(enum zr_format format, const char *begin, const char *const *pieces, size_t piece_count,
                               const char *end)
{
    size_t good = 0;
    for (int i = 0; i < TEXTS; i++) {
        struct text text = {0};
        put(&text, begin, strlen(begin));
        for (size_t count = below(PIECES_MOST); count > 0; count--) {
            const char *piece = pieces[below(piece_count)];
            put(&text, piece, strlen(piece));
        }
        put(&text, end, strlen(end));
        if (i % 3) mutate(&text);
        check_text(format, &text, &good);
        drop(&text);
    }
    assert_in_range(good, TEXTS / 10, TEXTS - TEXTS / 10);
}

/* zr_scene_read would say so whatever the reader says. */
static inline void check_cancelled(enum zr_format format, const struct text *text)
{
    struct zr_cancel cancel = {.raised = true};
    const struct zr_request request = {.format = format, .bytes = text->bytes, .size = text->size, .cancel = &cancel};
    const struct zr_limits limits = zr_limits_default();
    part_bytes = 1 << 10;
    for (int i = 0; i < 2; i++) {
        struct zr_arena arena;
        struct zr_scene scene = {.mesh_count = 0};
        struct zr_error error = {.count = 0};
        zr_arena_init(&arena, CEILING);
        struct zr_scene_builder builder = zr_scene_builder_open(&arena, i ? teams[1] : NULL, &scene);
        assert_int_equal(zr_format_rows[format].read(&builder, &request, &limits, &error), ZR_CANCELLED);
        zr_arena_free(&arena);
    }
}

#endif
