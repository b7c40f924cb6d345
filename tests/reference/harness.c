#include "reference/harness.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/report.h"
#include "reference/subject.h"
#include "shade/frame.h"

enum { FAILURES_MAX = 3, ALONE_MAX = 8 };
static const size_t arena_ceiling = (size_t)4 << 30, arena_keep = (size_t)256 << 20;

bool harness_open(struct harness *harness, const struct reference_backend *backend, int threads, const char *failures)
{
    memset(harness, 0, sizeof *harness);
    zr_arena_init(&harness->arena, arena_ceiling);
    harness->backend = backend;
    harness->failures = failures;
    harness->failures_left = FAILURES_MAX;
    struct reference_error error = {""};
    harness->reference = backend->open(&(struct reference_options){.native = false, .threads = threads}, &error);
    harness->team = zr_team_create(threads > 0 ? threads : 1);
    if (!harness->reference) fprintf(stderr, "no reference: %s\n", error.text);
    if (!harness->team) fprintf(stderr, "no threads\n");
    return harness->reference && harness->team;
}

void harness_close(struct harness *harness)
{
    if (harness->reference) harness->backend->close(harness->reference);
    if (harness->team) zr_team_destroy(harness->team);
    zr_arena_free(&harness->arena);
    drawing_free(&harness->single);
    free(harness->rgba);
    free(harness->depth);
    free(harness->owner);
}

static bool make_room(struct harness *harness, size_t pixels)
{
    if (pixels <= harness->room) return true;
    free(harness->rgba);
    free(harness->depth);
    free(harness->owner);
    harness->rgba = malloc(pixels * 4);
    harness->depth = malloc(pixels * sizeof *harness->depth);
    harness->owner = malloc(pixels * sizeof *harness->owner);
    harness->room = harness->rgba && harness->depth && harness->owner ? pixels : 0;
    return harness->room > 0;
}

static bool draw_and_read(struct harness *harness, struct drawing *drawing, bool smooth)
{
    struct reference_error error = {""};
    struct reference_arrays arrays = drawing_arrays(drawing, smooth);
    if (harness->backend->draw(harness->reference, &arrays, &error) &&
        harness->backend->read(harness->reference, harness->rgba, harness->depth, &error))
        return true;
    fprintf(stderr, "reference: %s\n", error.text);
    return false;
}

/* Who owns a pixel is read from one colour a face; with colours per vertex that
 * takes a picture more. */
static bool reference_render(struct harness *harness, struct drawing *drawing, struct picture *want)
{
    size_t pixels = (size_t)drawing->width * drawing->height;
    struct reference_error error = {""};
    if (drawing->failed || !make_room(harness, pixels)) {
        fprintf(stderr, "out of memory\n");
        return false;
    }
    if (!harness->backend->resize(harness->reference, drawing->width, drawing->height, &error)) {
        fprintf(stderr, "reference: %s\n", error.text);
        return false;
    }
    if (!draw_and_read(harness, drawing, false)) return false;
    for (size_t i = 0; i < pixels; i++)
        harness->owner[i] = drawing_face_number(harness->rgba + i * 4);
    if (drawing->smooth && !draw_and_read(harness, drawing, true)) return false;
    *want = (struct picture){.rgba = harness->rgba, .depth = harness->depth, .owner = harness->owner};
    return true;
}

/* Both pictures stand until the next call; tally->pictures tells whether both
 * sides gave one. */
static enum verdict compare_sides(struct harness *harness, struct drawing *drawing, struct picture *want,
                                  struct picture *got, struct tally *tally)
{
    if (!reference_render(harness, drawing, want)) return VERDICT_UNPROVED;
    zr_arena_reset(&harness->arena, arena_keep);
    const struct zr_frame *frame = subject_render(&harness->arena, harness->team, drawing);
    if (!frame) return VERDICT_DIFFERENT;
    *got = (struct picture){.rgba = frame->color, .depth = frame->window_depth, .owner = frame->face_id};
    tally->pictures++;
    tally->triangles += drawing_triangles(drawing);
    tally->clipped += frame->counts.clipped;
    size_t pixels = (size_t)drawing->width * drawing->height;
    return compare_pictures(want, got, pixels, &tally->comparison) ? VERDICT_DIFFERENT : VERDICT_EQUAL;
}

static void take_face(struct drawing *single, const struct drawing *from, uint32_t face)
{
    uint32_t first = from->face_offsets[face], count = from->face_offsets[face + 1] - first;
    drawing_start(single, from->width, from->height);
    single->smooth = from->smooth;
    single->modelview = from->modelview;
    single->projection = from->projection;
    uint32_t *corners = malloc(count * sizeof *corners);
    if (!corners) return;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = from->indices[first + i];
        corners[i] = drawing_position(single, from->positions[index], from->colors[index]);
    }
    drawing_face(single, corners, count);
    free(corners);
}

static uint32_t find_alone(struct harness *harness, const struct drawing *drawing, uint32_t alone[ALONE_MAX])
{
    enum { FACES_TRIED = 4096 };
    uint32_t found = 0;
    for (uint32_t face = 0; face < drawing->face_count && face < FACES_TRIED && found < ALONE_MAX; face++) {
        struct picture want, got;
        struct tally unused = {0};
        take_face(&harness->single, drawing, face);
        if (compare_sides(harness, &harness->single, &want, &got, &unused) == VERDICT_DIFFERENT)
            alone[found++] = face + 1;
    }
    return found;
}

enum verdict harness_check(struct harness *harness, struct drawing *drawing, const char *label, uint64_t number,
                           struct tally *tally)
{
    struct picture want = {0}, got = {0};
    uint64_t pictures = tally->pictures;
    enum verdict verdict = compare_sides(harness, drawing, &want, &got, tally);
    bool has_both = tally->pictures > pictures;
    if (verdict != VERDICT_DIFFERENT || !has_both || harness->failures_left == 0) return verdict;
    harness->failures_left--;
    uint32_t alone[ALONE_MAX], found = find_alone(harness, drawing, alone);
    struct tally unused = {0};
    if (compare_sides(harness, drawing, &want, &got, &unused) == VERDICT_DIFFERENT)
        report_difference(&(struct report_failure){.directory = harness->failures,
                                                   .label = label,
                                                   .number = number,
                                                   .drawing = drawing,
                                                   .want = &want,
                                                   .got = &got,
                                                   .alone = alone,
                                                   .alone_count = found});
    return verdict;
}

void tally_add(struct tally *sum, const struct tally *more)
{
    sum->pictures += more->pictures;
    sum->triangles += more->triangles;
    sum->clipped += more->clipped;
    compare_add(&sum->comparison, &more->comparison);
}
