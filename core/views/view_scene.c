#include "views/view_scene.h"

#include <stdio.h>
#include <string.h>

#include "change.h"

void zr_view_name(const struct zr_view_set *set, uint32_t number, char name[ZR_VIEW_NAME_SIZE])
{
    const char *given = set->kind == ZR_VIEW_SET_LIST ? set->items[number].name : NULL;
    if (given)
        snprintf(name, ZR_VIEW_NAME_SIZE, "%s", given);
    else
        snprintf(name, ZR_VIEW_NAME_SIZE, "%04u", number + 1);
}

enum zr_status zr_view_report(const struct zr_views *views, uint32_t number, enum zr_status status,
                              const struct zr_error *faults, struct zr_error *error)
{
    const bool is_list = views->set->kind == ZR_VIEW_SET_LIST;
    const char *pointer = zr_view_set_pointer(views->set);
    char at[ZR_POINTER_SIZE];
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        if (is_list)
            snprintf(at, sizeof at, "%s/%u%.120s", pointer, number, faults->items[i].pointer);
        else
            snprintf(at, sizeof at, "%s", pointer);
        zr_error_add(error, status, at, "%s", faults->items[i].detail);
    }
    return status;
}

enum zr_status zr_view_scene(const struct zr_views *views, uint32_t number, struct zr_arena *arena,
                             struct zr_team *team, const struct zr_cancel *cancel, const struct zr_scene **scene,
                             struct zr_error *error)
{
    const struct zr_view_set *set = views->set;
    const struct zr_scene *changed = views->scene;
    if (set->kind == ZR_VIEW_SET_LIST && set->items[number].keys) {
        const struct zr_request change = {
            .bytes = set->items[number].keys, .size = set->items[number].keys_size, .cancel = cancel};
        struct zr_error faults = {0};
        const enum zr_status status = zr_scene_change(arena, team, views->kept, &change, &changed, &faults);
        if (status != ZR_OK) return zr_view_report(views, number, status, &faults, error);
    }
    struct zr_scene *made = zr_arena_copy(arena, changed, sizeof *made);
    if (!made) return ZR_NO_MEMORY;
    made->view_set = NULL;
    made->tables = views->tables;
    if (changed == views->scene && views->bounds.valid) {
        made->has_box = true;
        made->box_min = views->bounds.min;
        made->box_max = views->bounds.max;
    }
    zr_view_set_pose(made, set, number, &views->camera, &made->views[0]);
    *scene = made;
    return ZR_OK;
}
