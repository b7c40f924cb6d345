#include "bench/versus/sides.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/run.h"
#include "bench/machine.h"

static const size_t ARENA_BYTES = (size_t)16 << 30;

bool ours_open(struct ours *ours, int threads)
{
    zr_arena_init(&ours->arena, ARENA_BYTES);
    zr_arena_init(&ours->answers, ARENA_BYTES);
    ours->team = zr_team_create_for(threads, machine_isa());
    return ours->team != NULL;
}

void ours_close(struct ours *ours)
{
    zr_team_destroy(ours->team);
    zr_arena_free(&ours->arena);
    zr_arena_free(&ours->answers);
}

void ours_take(struct ours *ours, const struct work *work, const struct variant *variant)
{
    subject_make(&ours->subject, &work->drawing);
    ours->subject.materials[0].uniform_color = variant->shade == WORK_FLAT;
    ours->subject.materials[0].double_sided = !variant->culled;
}

const struct zr_frame *ours_render(struct ours *ours, const struct zr_output *outputs, uint32_t count)
{
    struct zr_scene *scene = &ours->subject.scene;
    struct zr_error error = {.status = ZR_OK};
    const struct zr_frame *frame = NULL;
    scene->views[0].outputs = outputs;
    scene->views[0].output_count = count;
    zr_arena_reset(&ours->arena, ARENA_BYTES);
    enum zr_status status =
        zr_render(&(struct zr_run){.arena = &ours->arena, .team = ours->team, .error = &error}, scene, NULL, &frame);
    if (status == ZR_OK && frame) return frame;
    fprintf(stderr, "zr_render: status %d, %s\n", (int)status, error.count ? error.items[0].detail : "no frame");
    return NULL;
}

const struct zr_frame *ours_draw(struct ours *ours, bool ids)
{
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                               {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
    return ours_render(ours, outputs, ids ? 3 : 2);
}

bool ours_encode(struct ours *ours, const struct zr_frame *frame, struct zr_answer *answer)
{
    struct zr_error error = {.status = ZR_OK};
    zr_arena_reset(&ours->answers, ARENA_BYTES);
    enum zr_status status = zr_encode(&(struct zr_run){.arena = &ours->answers, .team = ours->team, .error = &error},
                                      &ours->subject.scene, frame, answer);
    if (status == ZR_OK) return true;
    fprintf(stderr, "zr_encode: status %d, %s\n", (int)status, error.count ? error.items[0].detail : "");
    return false;
}

static bool complain(const struct reference_error *error)
{
    fprintf(stderr, "reference: %s\n", error->text);
    return false;
}

bool theirs_open(struct theirs *theirs, bool exact, int threads)
{
    struct reference_error error = {""};
    struct reference_options options = {.driver = "llvmpipe", .native = !exact, .threads = threads};
    *theirs = (struct theirs){.reference = reference_open(&options, &error), .exact = exact};
    return theirs->reference || complain(&error);
}

/* Corners of their own for all triangles. */
static bool unshare(struct theirs *theirs, const struct work *work)
{
    const struct drawing *drawing = &work->drawing;
    uint32_t count = work->corner_count;
    zr_vec4 *corners = realloc(theirs->corners, 2 * (size_t)count * sizeof *corners);
    if (!corners) return false;
    for (uint32_t i = 0; i < count; i++) {
        corners[i] = drawing->positions[work->corners[i]];
        corners[count + i] = drawing->colors[work->corners[i - i % 3]];
    }
    theirs->corners = corners;
    theirs->arrays.positions = corners;
    theirs->arrays.front = corners + count;
    theirs->arrays.indices = NULL;
    return true;
}

bool theirs_take(struct theirs *theirs, const struct work *work, const struct variant *variant)
{
    const struct drawing *drawing = &work->drawing;
    struct reference_error error = {""};
    bool only_triangles = drawing->corner_count == 3 * drawing->face_count, flat = variant->shade == WORK_FLAT;
    theirs->batch = (struct reference_batch){.mode = REFERENCE_TRIANGLES,
                                             .count = work->corner_count,
                                             .modelview = &drawing->modelview,
                                             .smooth = !flat,
                                             .first_provokes = flat && only_triangles && !theirs->exact,
                                             .cull = variant->culled};
    theirs->arrays = (struct reference_arrays){.positions = drawing->positions,
                                               .front = drawing->colors,
                                               .indices = work->corners,
                                               .batch_count = 1,
                                               .batches = &theirs->batch,
                                               .projection = drawing->projection,
                                               .background = {0, 0, 0, 1}};
    if (flat && only_triangles && theirs->exact) {
        if (!unshare(theirs, work)) return false;
    } else if (!reference_keep(theirs->reference, &theirs->arrays, drawing->position_count, work->corner_count, &error))
        return complain(&error);
    return reference_resize(theirs->reference, drawing->width, drawing->height, false, &error) || complain(&error);
}

bool theirs_draw(struct theirs *theirs)
{
    struct reference_error error = {""};
    return reference_draw(theirs->reference, &theirs->arrays, &error) || complain(&error);
}
