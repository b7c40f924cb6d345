/* kept_check.h - tests: keeps a scene and changes it. */
#ifndef ZR_TESTS_KEPT_CHECK_H
#define ZR_TESTS_KEPT_CHECK_H

#include "base/run.h"
#include "guarded.h"
#include "input_check.h"
#include "request/change.h"

struct keeping {
    struct zr_arena arena, other;
    struct zr_kept *kept;
    const struct zr_scene *scene; /* result of the last change */
};

/* Keeps the scene of a request, then frees the request's body. Free the result by keeping_free. */
static inline struct keeping *keep(struct zr_request request, const void *bytes, size_t size)
{
    const struct zr_limits limits = zr_limits_default();
    struct keeping *keeping = calloc(1, sizeof *keeping);
    struct zr_error error = {.count = 0};
    struct guarded body = guarded_copy(bytes, size);
    assert_non_null(keeping);
    request.bytes = body.bytes;
    request.size = size;
    zr_arena_init(&keeping->arena, (size_t)1 << 28);
    zr_arena_init(&keeping->other, (size_t)1 << 28);
    if (zr_scene_keep(&(struct zr_run){.arena = &keeping->arena, .error = &error}, &request, &limits, &keeping->kept) !=
        ZR_OK)
        fail_msg("%s: %s", error.items[0].pointer, error.items[0].detail);
    guarded_free(&body);
    return keeping;
}

/* Changes the kept scene, and frees the scene of the previous change. */
static inline enum zr_status keeping_change(struct keeping *keeping, struct zr_request change)
{
    struct zr_error error = {.count = 0};
    zr_arena_reset(&keeping->other, 0);
    return zr_scene_change(&(struct zr_run){.arena = &keeping->other, .error = &error}, keeping->kept, &change,
                           &keeping->scene);
}

static inline void keeping_free(struct keeping *keeping)
{
    zr_arena_free(&keeping->other);
    zr_arena_free(&keeping->arena);
    free(keeping);
}

#endif
