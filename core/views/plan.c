/* Checks all views of a request and predicts their cost, before any is drawn. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "base/run.h"
#include "input/scene/kept.h"
#include "request/change.h"
#include "scene/output.h"
#include "scene/scene.h"
#include "views/still_camera.h"
#include "views/view_scene.h"

enum { SAMPLED = 16 }; /* views whose cost is predicted, besides the first; all of a list */

struct zr_views zr_views_of_kept(const struct zr_kept *kept)
{
    const struct zr_scene *scene = zr_kept_scene(kept);
    return (struct zr_views){.scene = scene, .set = scene->view_set, .kept = kept};
}

enum zr_status zr_views_read(const struct zr_run *run, const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_views *views)
{
    struct zr_kept *kept = NULL;
    const enum zr_status status = zr_scene_keep_for_views(run, request, limits, &kept);
    if (status == ZR_OK) *views = zr_views_of_kept(kept);
    return status;
}

/* Adds the cost of `times` equal views. Memory is that of the largest. */
static void add_cost(struct zr_cost *sum, const struct zr_cost *cost, double times)
{
    sum->ms += times * cost->ms;
    for (int i = 0; i < ZR_COST_KINDS; i++)
        sum->counts[i] += times * cost->counts[i];
    sum->mesh_bytes = fmax(sum->mesh_bytes, cost->mesh_bytes);
    if (cost->window_bytes <= sum->window_bytes) return;
    sum->window_bytes = cost->window_bytes;
    sum->lamp_map_bytes = cost->lamp_map_bytes;
    sum->lamp_maps = cost->lamp_maps;
}

static double count_objects(const char *text, size_t size)
{
    double count = 0.0;
    for (const char *at = text, *const end = text + size; (at = memchr(at, '{', (size_t)(end - at))); at++)
        count += 1.0;
    return count;
}

/* Returns the size of the JSON text of a file of glTF, which ends before the binary chunk. */
static size_t json_size(const struct zr_kept *kept)
{
    enum { LENGTH = 12, CHUNK = 20 };
    const unsigned char *bytes = (const unsigned char *)kept->body;
    if (kept->body_size < CHUNK || memcmp(bytes, "glTF", 4) != 0) return kept->body_size;
    const size_t size = CHUNK + ((size_t)bytes[LENGTH] | (size_t)bytes[LENGTH + 1] << 8 |
                                 (size_t)bytes[LENGTH + 2] << 16 | (size_t)bytes[LENGTH + 3] << 24);
    return size < kept->body_size ? size : kept->body_size;
}

struct zr_cost zr_views_foretell(const struct zr_views *views)
{
    enum { READS = 2 };
    const struct zr_kept *kept = views->kept;
    struct zr_cost cost = {.ms = 0.0};
    double objects = 0.0;
    if (!zr_view_set_is_animation(views->set)) return cost;
    if (kept->body) objects += count_objects(kept->body, json_size(kept));
    for (size_t i = 0; i < kept->key_count; i++)
        objects += count_objects(kept->keys[i].value, kept->keys[i].size);
    zr_cost_add(&cost, ZR_COST_FRAME_OBJECT, READS * objects * (double)views->set->count);
    return cost;
}

static uint64_t pixels_of(const struct zr_view *view)
{
    uint64_t words = 0;
    for (uint32_t i = 0; i < view->output_count; i++)
        words += zr_channel_rows[view->outputs[i].channel].words;
    return words * view->width * view->height;
}

static enum zr_status plan_view(const struct zr_run *run, struct zr_views *views, uint32_t number, double times,
                                uint64_t *pixels)
{
    const struct zr_scene *scene;
    const struct zr_resolved_view *resolved;
    struct zr_error faults = {0};
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const struct zr_run finding = zr_run_reporting(&inner, &faults);
    enum zr_status status = zr_view_scene(&inner, views, number, &scene);
    if (status != ZR_OK) return status;
    const struct zr_view *view = &scene->views[0];
    *pixels += pixels_of(view);
    if (number == 0) {
        views->width = view->width;
        views->height = view->height;
    }
    views->has_one_window &= view->width == views->width && view->height == views->height;
    status = zr_resolved_view_find(&finding, scene, &resolved);
    if (status != ZR_OK) return zr_view_report(views, number, status, &faults, run->error);
    struct zr_cost cost = zr_scene_cost(scene, resolved);
    if ((zr_view_wants(view, ZR_CHANNEL_INFO) || zr_view_notes_holes(view)) && zr_view_shares_parts(views->set, number)) {
        if (views->shares_parts) { /* part of an earlier view's cost */
            zr_cost_remove(&cost, ZR_COST_FACT);
            zr_cost_remove(&cost, ZR_COST_INFO);
            zr_cost_remove(&cost, ZR_COST_FEATURE);
        }
        views->shares_parts = true;
    }
    add_cost(&views->cost, &cost, times);
    return ZR_OK;
}

/* Views of one name would write the same files. Compares each pair: up to 8 million short names, some 20 ms. */
static enum zr_status check_names(const struct zr_views *views, struct zr_arena *scratch, struct zr_error *error)
{
    const struct zr_view_set *set = views->set;
    char(*names)[ZR_VIEW_NAME_SIZE] = zr_arena_alloc(scratch, set->count, sizeof *names);
    if (!names) return ZR_NO_MEMORY;
    for (uint32_t i = 0; set->kind == ZR_VIEW_SET_LIST && i < set->count; i++) {
        zr_view_name(set, i, names[i]);
        for (uint32_t k = 0; k < i; k++) {
            if (strcmp(names[i], names[k]) != 0) continue;
            struct zr_error fault = {0};
            zr_error_add(&fault, ZR_BAD_SCENE, set->items[i].keys ? "/name" : NULL,
                         "the name %s, as view %" PRIu32 " has: the files would have one name; \"name\" gives another",
                         names[i], k);
            return zr_view_report(views, i, ZR_BAD_SCENE, &fault, error);
        }
    }
    return ZR_OK;
}

/* Finds the scale at which the orthographic views of a sheet fit. */
static enum zr_status fit_sheet(const struct zr_run *run, struct zr_views *views)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    struct zr_shared_camera most = {.xmag = 0.0f};
    enum zr_status status = ZR_OK;
    for (uint32_t i = 0; status == ZR_OK && i < views->set->count; i++) {
        const struct zr_scene *scene;
        const struct zr_resolved_view *resolved;
        struct zr_error faults = {0};
        const struct zr_run finding = zr_run_reporting(&inner, &faults);
        zr_arena_reset(run->scratch, SIZE_MAX);
        status = zr_view_scene(&inner, views, i, &scene);
        if (status != ZR_OK || !zr_view_has_sheet_scale(&scene->views[0])) continue;
        status = zr_resolved_view_find(&finding, scene, &resolved);
        if (status != ZR_OK) return zr_view_report(views, i, status, &faults, run->error);
        most.xmag = fmaxf(most.xmag, 1.0f / resolved->camera.projection.m[0]);
        most.ymag = fmaxf(most.ymag, 1.0f / resolved->camera.projection.m[5]);
    }
    views->camera = most;
    return status;
}

/* Finds the camera of a turntable or an orbit, for the window of its views. */
static enum zr_status fit_camera(const struct zr_run *run, struct zr_views *views)
{
    struct zr_scene *scene = zr_arena_copy(run->scratch, views->scene, sizeof *scene);
    if (!scene) return ZR_NO_MEMORY;
    if (scene->sheet.is_on) {
        scene->views[0].width = (uint32_t)views->layout.width;
        scene->views[0].height = (uint32_t)views->layout.height;
    }
    return zr_view_set_fit(run, scene, views->set, &views->camera);
}

static enum zr_status lay_out_sheet(struct zr_views *views, struct zr_error *error)
{
    const struct zr_view *window = &views->scene->views[0];
    if (!views->scene->sheet.is_on) return ZR_OK;
    if (zr_sheet_lay_out(&views->scene->sheet, views->set->count, window->width, window->height, &views->layout))
        return ZR_OK;
    return zr_error_add(
        error, ZR_BAD_SCENE, "/sheet",
        "%" PRIu32 " x %" PRIu32 " pixels have no room for %" PRIu32
        " views of at least 16 x 16 pixels, with margins and captions: give a larger window or fewer views",
        window->width, window->height, views->set->count);
}

static enum zr_status plan(const struct zr_run *run, struct zr_views *views)
{
    const struct zr_view_set *set = views->set;
    const uint64_t most = views->kept->limits.view_pixels_max;
    const uint32_t step =
        set->kind == ZR_VIEW_SET_LIST || set->count <= SAMPLED ? 1 : (set->count + SAMPLED - 1) / SAMPLED;
    const struct zr_run inner = zr_run_in(run, run->scratch);
    uint64_t pixels = 0;
    views->has_one_window = true;
    views->shares_parts = false;
    views->cost = zr_views_foretell(views);
    views->bounds = zr_bounds_of(views->scene, run->team, run->cancel);
    enum zr_status status = check_names(views, run->scratch, run->error);
    if (status == ZR_OK) status = lay_out_sheet(views, run->error);
    /* Windows are equal, but for those of a list: too many pixels are refused before the geometry is walked. */
    if (set->kind != ZR_VIEW_SET_LIST) pixels = set->count * pixels_of(&views->scene->views[0]);
    if (status == ZR_OK && set->kind != ZR_VIEW_SET_LIST && pixels <= most)
        status = zr_view_set_is_animation(set) ? zr_still_camera_find(&inner, views) : fit_camera(run, views);
    if (status == ZR_OK && set->kind == ZR_VIEW_SET_LIST && views->scene->sheet.is_on) status = fit_sheet(run, views);
    for (uint32_t i = 0; status == ZR_OK && i < set->count && pixels <= most; i += i > 0 ? step : 1) {
        uint64_t own = 0;
        zr_arena_reset(run->scratch, SIZE_MAX);
        const double left = (double)(set->count - i), times = i > 0 ? fmin(left, (double)step) : 1.0;
        status = plan_view(run, views, i, times, &own);
        if (set->kind == ZR_VIEW_SET_LIST) pixels += own;
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    }
    if (status == ZR_OK && pixels > most)
        return zr_error_add(run->error, ZR_BAD_SCENE, zr_view_set_pointer(set),
                            "all views together have %s%" PRIu64 " pixels of images, more than the limit of %" PRIu64,
                            set->kind == ZR_VIEW_SET_LIST ? "at least " : "", pixels, most);
    return status;
}

enum zr_status zr_views_plan(const struct zr_run *run, struct zr_views *views)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    struct zr_run planning = *run;
    planning.scratch = &scratch;
    const enum zr_status status = plan(&planning, views);
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
