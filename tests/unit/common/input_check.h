/* input_check.h - tests: one request read, and what came of it. */
#ifndef ZR_TESTS_INPUT_CHECK_H
#define ZR_TESTS_INPUT_CHECK_H

#include "base/run.h"
#include "core.h"
#include "guarded.h"
#include "render_request.h"
#include "scene/scene.h"
#include "support/cmocka_all.h"

struct reading {
    struct zr_arena arena;
    struct guarded body;
    const struct zr_scene *scene; /* NULL where it failed */
    enum zr_status status;
    struct zr_error error;
};

/* Of the reading that ended last, for the next: a block that is made anew takes a hundred times as long as a small text
 * under AddressSanitizer. */
static struct zr_arena input_spare;

/* Reads `request`, its bytes moved to a guard page. End with reading_free. */
static inline struct reading *read_by_team(struct zr_team *team, struct zr_request request, const void *bytes,
                                           size_t size, struct zr_limits limits, size_t ceiling)
{
    struct reading *reading = calloc(1, sizeof *reading);
    assert_non_null(reading);
    reading->arena = input_spare;
    reading->arena.ceiling = ceiling;
    input_spare = (struct zr_arena){0};
    reading->body = guarded_copy(bytes, size);
    request.bytes = reading->body.bytes;
    request.size = size;
    reading->status = zr_scene_read(&(struct zr_run){.arena = &reading->arena, .team = team, .error = &reading->error},
                                    &request, &limits, &reading->scene);
    return reading;
}

static inline struct reading *read_request(struct zr_request request, const void *bytes, size_t size,
                                           struct zr_limits limits, size_t ceiling)
{
    return read_by_team(NULL, request, bytes, size, limits, ceiling);
}

static inline struct reading *read_bytes(enum zr_format format, const void *bytes, size_t size)
{
    return read_request((struct zr_request){.format = format}, bytes, size, zr_limits_default(), (size_t)1 << 28);
}

static inline struct reading *read_text(enum zr_format format, const char *text)
{
    return read_bytes(format, text, strlen(text));
}

/* Reads a text with one part. */
static inline struct reading *read_with_part(enum zr_format format, struct zr_request request,
                                             const struct zr_asset *part, const char *text)
{
    request.format = format;
    request.assets = part;
    request.asset_count = 1;
    return read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
}

static inline void reading_free(struct reading *reading)
{
    zr_arena_free(&input_spare);
    zr_arena_reset(&reading->arena, ZR_ARENA_BLOCK);
    input_spare = reading->arena;
    guarded_free(&reading->body);
    free(reading);
}

/* The first complaint must have this pointer, and this text in its detail. */
static inline void assert_complaint(const struct reading *reading, enum zr_status status, const char *pointer,
                                    const char *detail)
{
    assert_int_equal(reading->status, status);
    assert_int_equal(reading->error.status, status);
    assert_true(reading->error.count > 0);
    assert_null(reading->scene);
    assert_string_equal(reading->error.items[0].pointer, pointer);
    if (!strstr(reading->error.items[0].detail, detail))
        fail_msg("detail '%s' does not say '%s'", reading->error.items[0].detail, detail);
}

static inline void assert_read(const struct reading *reading)
{
    if (reading->status != ZR_OK) fail_msg("%s: %s", reading->error.items[0].pointer, reading->error.items[0].detail);
    assert_non_null(reading->scene);
    assert_int_equal(reading->error.count, 0);
}

static inline void assert_origin(const struct reading *reading, double x, double y, double z)
{
    assert_read(reading);
    const double *origin = reading->scene->origin;
    assert_non_null(origin);
    if (origin[0] != x || origin[1] != y || origin[2] != z)
        fail_msg("%.17g %.17g %.17g", origin[0], origin[1], origin[2]);
}

/* Reads a text that must be refused. */
static inline void refuses(enum zr_format format, const char *text, enum zr_status status, const char *pointer,
                           const char *detail)
{
    struct reading *reading = read_text(format, text);
    assert_complaint(reading, status, pointer, detail);
    reading_free(reading);
}

/* Reads under every memory ceiling up to the first that is enough, which it returns: each
 * smaller one must give ZR_NO_MEMORY and name itself. 0: none below `most` is. */
static inline size_t smallest_ceiling(struct zr_request request, const void *bytes, size_t size, size_t most)
{
    for (size_t ceiling = 0; ceiling < most; ceiling += 64) {
        struct reading *reading = read_request(request, bytes, size, zr_limits_default(), ceiling);
        char detail[32];
        snprintf(detail, sizeof detail, "the %zu bytes", ceiling);
        bool enough = reading->status == ZR_OK;
        if (!enough) assert_complaint(reading, ZR_NO_MEMORY, "", detail);
        reading_free(reading);
        if (enough) return ceiling;
    }
    return 0;
}

#endif
