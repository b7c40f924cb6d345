#include "render/trace.h"

#include <stdio.h>

#include "base/run.h"
#include "geometry/build.h"
#include "raster/textbook/algorithms.h"
#include "raster/textbook/trace.h"
#include "render/pass.h"
#include "render/stage.h"
#include "scene/algorithm.h"
#include "scene/output.h"

#define WORD(ID, word) word,
static const char *const words[] = {ZR_ALGORITHMS(WORD)};
#undef WORD

static bool make_samples(struct zr_arena *arena, const struct zr_window *window, struct zr_trace *trace,
                         struct zr_samples *samples)
{
    const size_t pixels = (size_t)window->width * window->height;
    *samples = (struct zr_samples){.width = window->width,
                                   .height = window->height,
                                   .depth = zr_arena_alloc(arena, pixels, sizeof *samples->depth),
                                   .owner = zr_arena_zero(arena, pixels, sizeof *samples->owner),
                                   .trace = trace};
    for (size_t i = 0; zr_arena_ok(arena) && i < pixels; i++)
        samples->depth[i] = 1.0f;
    return zr_arena_ok(arena);
}

struct pointer {
    char text[24];
};

static struct pointer pointer_of_output(const struct zr_frame *frame)
{
    struct pointer pointer;
    const struct zr_output *output = zr_view_output(frame->view, ZR_CHANNEL_TRACE);
    snprintf(pointer.text, sizeof pointer.text, "/outputs/%u", (unsigned)(output - frame->view->outputs));
    return pointer;
}

static enum zr_status refuse_primitives(const struct zr_frame *frame, uint32_t count, struct zr_error *error)
{
    return zr_error_add(error, ZR_BAD_SCENE, pointer_of_output(frame).text,
                        "the channel trace is limited to %d primitives in the window; these are %u: faces, lines and "
                        "points, and pieces of clipped ones",
                        ZR_TRACE_PRIMITIVES_MAX, (unsigned)count);
}

/* Names the bound that was passed. */
static enum zr_status refuse_steps(const struct zr_frame *frame, const struct zr_trace *trace, struct zr_error *error)
{
    const bool has_many_steps = trace->steps > ZR_TRACE_STEPS_MAX;
    return zr_error_add(error, ZR_BAD_SCENE, pointer_of_output(frame).text,
                        "the channel trace is limited to %d %s, and this scene takes more: show fewer or simpler faces",
                        has_many_steps ? ZR_TRACE_STEPS_MAX : ZR_TRACE_VALUES_MAX, has_many_steps ? "steps" : "values");
}

/* Runs the algorithm. A trace that raised its own flag is beyond its bounds, or without memory. */
static enum zr_status record(const struct zr_run *run, const struct zr_geometry *geometry, enum zr_algorithm algorithm,
                             struct zr_samples *samples)
{
    zr_visibility_fn *window_at_once = zr_visibility_of(algorithm);
    struct zr_trace *trace = samples->trace;
    const struct zr_run recorded = {.arena = run->scratch, .cancel = &trace->cancel};
    const enum zr_status status = (window_at_once ? window_at_once : zr_plain_halfspace)(&recorded, geometry, samples);
    zr_trace_close(trace);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(trace->arena)) return ZR_NO_MEMORY;
    return trace->is_beyond ? ZR_OK : status;
}

enum zr_status zr_trace_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const struct zr_window window = zr_window_of(scene, frame->width, frame->height, 1);
    struct zr_geometry *geometry = zr_arena_alloc(run->scratch, 1, sizeof *geometry);
    struct zr_trace *trace = zr_arena_zero(run->arena, 1, sizeof *trace);
    struct zr_primitives primitives = {.count = 0};
    struct zr_samples samples;
    enum zr_status status = ZR_OK;
    if (!geometry || !trace || !make_samples(run->scratch, &window, trace, &samples)) return ZR_NO_MEMORY;
    trace->arena = run->arena;
    trace->cancel.parent = run->cancel;
    STAGE(zr_geometry_build(&inner, scene, &frame->camera, &window, true, geometry));
    STAGE(zr_primitives_make(run->scratch, geometry, &samples, run->cancel, &primitives));
    if (status == ZR_OK && primitives.count > ZR_TRACE_PRIMITIVES_MAX)
        return refuse_primitives(frame, primitives.count, run->error);
    if (status == ZR_OK) zr_trace_open(trace, words[scene->algorithm], geometry, &primitives);
    STAGE(record(run, geometry, scene->algorithm, &samples));
    if (status == ZR_OK && trace->is_beyond) return refuse_steps(frame, trace, run->error);
    frame->trace = trace;
    return status;
}
