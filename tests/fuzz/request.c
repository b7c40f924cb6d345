/* A whole request, as the daemon goes through it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "cost/cost.h"
#include "fuzz/fuzz.h"
#include "request/compare.h"
#include "request/drawing_file.h"
#include "scene/camera/resolved_view.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "views/views.h"

/* How many corners, over all instances, are drawn; the painter compares them pair by pair. */
enum { CORNERS_MAX = 40000, CORNERS_MAX_PAINTER = 400 };

bool fuzz_accepted;

void fuzz_expect(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "fuzz: not so: %s\n", what);
    abort();
}

static struct zr_limits small_limits(void)
{
    struct zr_limits limits = zr_limits_default();
    limits.window_side_max = FUZZ_SIDE_MAX;
    limits.window_pixels_max = 8 * FUZZ_SIDE_MAX * FUZZ_SIDE_MAX;
    limits.instances_max = 1000;
    limits.image_pixels_max = FUZZ_TEXELS_MAX;
    limits.views_max = 6;
    limits.view_pixels_max = limits.window_pixels_max;
    return limits;
}

static uint64_t corners_of(const struct zr_scene *scene)
{
    uint64_t corners = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        corners += zr_mesh_corners(mesh);
    }
    return corners;
}

static void expect_message(enum zr_status status, const struct zr_error *error)
{
    fuzz_expect(status != ZR_INTERNAL, "no input is the renderer's own fault");
    fuzz_expect(status == ZR_NO_MEMORY || zr_error_held(error) > 0, "a refusal says what is wrong");
    for (size_t i = 0; i < zr_error_held(error); i++)
        fuzz_expect(*error->items[i].detail, "no message is empty");
}

static enum zr_status draw(struct zr_arena *arena, const struct zr_scene *scene,
                           const struct zr_resolved_view *resolved, const struct zr_frame **frame)
{
    struct zr_error error = {0};
    enum zr_status status = zr_render(&(struct zr_run){.arena = arena, .error = &error}, scene, resolved, frame);
    if (status != ZR_OK) expect_message(status, &error);
    return status;
}

/* One of the others, by whatever the corners come to. */
static void compare_algorithms(struct zr_arena *arena, const struct zr_scene *scene,
                               const struct zr_resolved_view *resolved, const struct zr_frame *frame)
{
    const uint64_t corners = corners_of(scene);
    struct zr_scene other = *scene;
    const struct zr_frame *again;
    other.algorithm = (enum zr_algorithm)(corners % ZR_ALGORITHM_COUNT);
    if (other.algorithm == scene->algorithm ||
        (other.algorithm == ZR_ALGORITHM_PAINTER &&
         (corners > CORNERS_MAX_PAINTER || zr_any_is_see_through(scene->materials, scene->material_count) ||
          zr_any_is_xray(scene->materials, scene->material_count) ||
          zr_any_is_glass(scene->materials, scene->material_count))))
        return;
    if (draw(arena, &other, resolved, &again) != ZR_OK) return;
    const size_t pixels = (size_t)scene->views[0].width * scene->views[0].height;
    const struct {
        const char *what;
        const void *one, *two;
        size_t size;
    } channels[] = {{"colour is that of every algorithm", frame->color, again->color, 4},
                    {"window depth is that of every algorithm", frame->window_depth, again->window_depth, 4},
                    {"depth is that of every algorithm", frame->depth, again->depth, 4},
                    {"face ids are those of every algorithm", frame->face_id, again->face_id, 4}};
    for (size_t i = 0; i < sizeof channels / sizeof *channels; i++) {
        fuzz_expect(!channels[i].one == !channels[i].two, channels[i].what);
        fuzz_expect(!channels[i].one || memcmp(channels[i].one, channels[i].two, pixels * channels[i].size) == 0,
                    channels[i].what);
    }
}

/* A small scene on paper, and compared with itself. */
static void measure(struct zr_arena *arena, const struct zr_scene *scene)
{
    static const char *const queries[] = {"", "section=x&page=a3", "projection=first&hidden=false", "section=z:0.3"};
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct zr_error error = {0};
    const struct zr_run run = {.arena = arena, .scratch = &scratch, .error = &error};
    struct zr_drawing_file file;
    struct zr_compare_answer answer;
    enum zr_status status = zr_drawing_file_make(&run, scene, queries[corners_of(scene) % 4], &file);
    if (status != ZR_OK) expect_message(status, &error);
    error = (struct zr_error){0};
    status = zr_compare(&run, scene, scene, "precision=quick", &answer);
    if (status != ZR_OK) expect_message(status, &error);
    fuzz_expect(status != ZR_OK || answer.size > 0, "a comparison has an answer");
    zr_arena_close_scratch(&scratch, arena);
}

static void go_on(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_error error = {0};
    const struct zr_resolved_view *resolved = NULL;
    const struct zr_frame *frame;
    struct zr_answer answer;
    enum zr_status status = zr_resolved_view_find(&(struct zr_run){.arena = arena, .error = &error}, scene, &resolved);
    if (status != ZR_OK) {
        expect_message(status, &error);
        return;
    }
    struct zr_cost cost = zr_scene_cost(scene, resolved);
    fuzz_expect(cost.ms > 0 && cost.ms < HUGE_VAL, "a cost is a number");
    if (corners_of(scene) > (scene->algorithm == ZR_ALGORITHM_PAINTER ? CORNERS_MAX_PAINTER : CORNERS_MAX)) return;
    if (corners_of(scene) <= CORNERS_MAX_PAINTER) measure(arena, scene);
    if (draw(arena, scene, resolved, &frame) != ZR_OK) return;
    compare_algorithms(arena, scene, resolved, frame);
    status = zr_encode(&(struct zr_run){.arena = arena, .error = &error}, scene, frame, &answer);
    if (status != ZR_OK) {
        expect_message(status, &error);
        return;
    }
    fuzz_expect(answer.size > 0 && answer.content_type, "an answer has bytes and a type");
    for (const char *at = answer.warnings; *at; at++)
        fuzz_expect(*at != '\n' && *at != '\r', "warnings are one line");
    fuzz_accepted = true;
}

/* All views of a request; their corners count together. */
static void go_on_with_views(struct zr_arena *arena, struct zr_views *views)
{
    struct zr_error error = {0};
    struct zr_files files;
    struct zr_answer answer;
    enum zr_status status = ZR_OK;
    const uint64_t most = views->scene->algorithm == ZR_ALGORITHM_PAINTER ? CORNERS_MAX_PAINTER : CORNERS_MAX;
    if (corners_of(views->scene) * views->set->count > most) return;
    status = zr_views_plan(&(struct zr_run){.arena = arena, .error = &error}, views);
    if (status == ZR_OK) status = zr_views_draw(&(struct zr_run){.arena = arena, .error = &error}, views, &files);
    if (status == ZR_OK) status = zr_files_answer(arena, &files, views->scene, &answer, &error);
    if (status != ZR_OK) {
        expect_message(status, &error);
        return;
    }
    fuzz_expect(files.count > 0 && answer.size > 0, "several views have files");
    fuzz_accepted = true;
}

void fuzz_request(const struct zr_request *request)
{
    static struct zr_arena arena;
    const struct zr_limits limits = small_limits();
    struct zr_error error = {0};
    struct zr_views views;
    fuzz_accepted = false;
    if (!arena.ceiling) zr_arena_init(&arena, FUZZ_ARENA_BYTES);
    enum zr_status status = zr_views_read(&(struct zr_run){.arena = &arena, .error = &error}, request, &limits, &views);
    if (status != ZR_OK)
        expect_message(status, &error);
    else if (views.set)
        go_on_with_views(&arena, &views);
    else
        go_on(&arena, views.scene);
    zr_arena_reset(&arena, 2 * ZR_ARENA_BLOCK);
}
