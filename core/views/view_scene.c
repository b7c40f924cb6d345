#include "views/view_scene.h"

#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "request/change.h"
#include "scene/output.h"

void zr_view_name(const struct zr_view_set *set, uint32_t number, char name[ZR_VIEW_NAME_SIZE])
{
    const char *given = set->kind == ZR_VIEW_SET_LIST ? set->items[number].name : NULL;
    if (given)
        snprintf(name, ZR_VIEW_NAME_SIZE, "%s", given);
    else
        snprintf(name, ZR_VIEW_NAME_SIZE, "%04u", number + 1);
}

/* True if the fault is of a key that the view of a list gives, not of one of the scene. */
static bool is_of_item(const struct zr_view_item *item, const char *pointer)
{
    const size_t length = *pointer ? strcspn(pointer + 1, "/") : 0;
    if (length == 0 || strcmp(pointer, "/name") == 0) return true;
    for (const char *const *name = item->key_names; name && *name; name++)
        if (strlen(*name) == length && memcmp(*name, pointer + 1, length) == 0) return true;
    return false;
}

enum zr_status zr_view_report(const struct zr_views *views, uint32_t number, enum zr_status status,
                              const struct zr_error *faults, struct zr_error *error)
{
    const struct zr_sheet *sheet = &views->scene->sheet;
    const bool is_list = views->set->kind == ZR_VIEW_SET_LIST,
               is_of_sheet = sheet->is_on && sheet->layout != ZR_SHEET_VIEWS;
    const char *pointer = zr_view_set_pointer(views->set);
    char at[ZR_POINTER_SIZE], name[ZR_VIEW_NAME_SIZE];
    zr_view_name(views->set, number, name);
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        const struct zr_error_item *fault = &faults->items[i];
        if (!is_list) {
            zr_error_add(error, status, pointer, "%s", fault->detail);
        } else if (is_of_sheet) {
            zr_error_add(error, status, *fault->pointer ? fault->pointer : "/sheet", "in the view %s: %s", name,
                         fault->detail);
        } else if (is_of_item(&views->set->items[number], fault->pointer)) {
            snprintf(at, sizeof at, "%s/%u%.120s", pointer, number, fault->pointer);
            zr_error_add(error, status, at, "%s", fault->detail);
        } else {
            zr_error_add(error, status, fault->pointer, "in the view %s: %s", name, fault->detail);
        }
    }
    return status;
}

/* Views of a sheet need the pixels of their colours, which are encoded together later. The sheet has the info of its
 * first view; the others drop theirs if they have colours. */
static void make_outputs_plain(struct zr_arena *arena, uint32_t number, struct zr_view *view)
{
    const bool has_info = number == 0 || !zr_view_wants(view, ZR_CHANNEL_COLOR);
    struct zr_output *outputs = zr_arena_copy(arena, view->outputs, view->output_count * sizeof *outputs);
    uint32_t count = 0;
    for (uint32_t i = 0; outputs && i < view->output_count; i++) {
        if (outputs[i].channel == ZR_CHANNEL_INFO && !has_info) continue;
        outputs[count] = outputs[i];
        if (outputs[i].channel == ZR_CHANNEL_COLOR)
            outputs[count] = (struct zr_output){.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
        count++;
    }
    if (!outputs) return;
    view->outputs = outputs;
    view->output_count = count;
}

bool zr_view_shares_parts(const struct zr_view_set *set, uint32_t number)
{
    static const char *const harmless[] = {"view",     "window", "background", "sections",
                                           "annotate", "title",  "dimensions"}; /* change no part */
    enum { COUNT = sizeof harmless / sizeof *harmless };
    if (zr_view_set_is_animation(set)) return false;
    if (set->kind != ZR_VIEW_SET_LIST || !set->items[number].keys) return true;
    for (const char *const *key = set->items[number].key_names; *key; key++) {
        int i = 0;
        while (i < COUNT && strcmp(*key, harmless[i]) != 0)
            i++;
        if (i == COUNT) return false;
    }
    return true;
}

static bool has_window_of(const struct zr_scene *a, const struct zr_scene *b)
{
    return a->views[0].width == b->views[0].width && a->views[0].height == b->views[0].height;
}

enum zr_status zr_view_scene(const struct zr_run *run, const struct zr_views *views, uint32_t number,
                             const struct zr_scene **scene)
{
    const struct zr_view_set *set = views->set;
    const struct zr_scene *changed = views->scene;
    if (set->kind == ZR_VIEW_SET_LIST && set->items[number].keys) {
        const struct zr_request change = {
            .bytes = set->items[number].keys, .size = set->items[number].keys_size, .cancel = run->cancel};
        struct zr_error faults = {0};
        const struct zr_run reading = zr_run_reporting(run, &faults);
        const enum zr_status status = zr_scene_change(&reading, views->kept, &change, &changed);
        if (status != ZR_OK) return zr_view_report(views, number, status, &faults, run->error);
    }
    if (zr_view_set_is_animation(set)) {
        struct zr_error faults = {0};
        const struct zr_run reading = zr_run_reporting(run, &faults);
        const enum zr_status status = zr_scene_frame(&reading, views->kept, number, &changed);
        if (status != ZR_OK) return zr_view_report(views, number, status, &faults, run->error);
    }
    struct zr_scene *made = zr_arena_copy(run->arena, changed, sizeof *made);
    if (!made) return ZR_NO_MEMORY;
    made->sheet = views->scene->sheet;
    if (made->sheet.is_on && !has_window_of(made, views->scene)) {
        struct zr_error fault = {0};
        zr_error_add(&fault, ZR_BAD_SCENE, "/window", "the views of a sheet have one size, which follows from its own");
        return zr_view_report(views, number, ZR_BAD_SCENE, &fault, run->error);
    }
    made->view_set = NULL;
    made->tables = views->tables;
    if (zr_view_shares_parts(set, number)) made->known_parts = views->known_parts;
    if (changed == views->scene && views->bounds.valid) {
        made->has_box = true;
        made->box_min = views->bounds.min;
        made->box_max = views->bounds.max;
    }
    if (made->sheet.is_on) {
        made->views[0].width = (uint32_t)views->layout.width;
        made->views[0].height = (uint32_t)views->layout.height;
        make_outputs_plain(run->arena, number, &made->views[0]);
    }
    zr_view_set_pose(made, set, number, &views->camera, &made->views[0]);
    *scene = made;
    return ZR_OK;
}
