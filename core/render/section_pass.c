#include "render/section_pass.h"

#include "base/cancel.h"
#include "base/run.h"

/* Distance of the lines of the hatch in pixels of a window whose smaller side has this many; the root of the side
 * scales it. */
#define HATCH_PIXELS 9.0
#define HATCH_WINDOW 480.0

/* Returns the size of a pixel at the middle of the bounds, in world units. */
static double pixel_size(const struct zr_resolved_view *resolved)
{
    const struct zr_camera *camera = &resolved->camera;
    const struct zr_bounds *bounds = &resolved->bounds;
    const float *p = camera->projection.m;
    const zr_vec4 middle = {0.5f * (bounds->min.x + bounds->max.x), 0.5f * (bounds->min.y + bounds->max.y),
                            0.5f * (bounds->min.z + bounds->max.z), 1.0f};
    const zr_vec4 eye = zr_mat4_apply(&camera->world_to_eye, middle);
    const double w = fabs((double)zr_mat4_row(&camera->projection, 3, eye));
    const double scale = 0.5 * (double)resolved->view->height * fabs((double)p[5]) * (double)zr_eye_scale_of(camera);
    return w > 0.0 && scale > 0.0 ? w / scale : 0.0;
}

static double hatch_pitch(const struct zr_resolved_view *resolved, double diagonal)
{
    const struct zr_view *view = resolved->view;
    const double side = (double)(view->width < view->height ? view->width : view->height);
    const double pitch = HATCH_PIXELS * sqrt(side / HATCH_WINDOW) * pixel_size(resolved);
    const double least = 2e-4 * diagonal; /* keeps texture coordinates small */
    return pitch > least ? pitch : least;
}

/* Copies what outlives the scratch arena. */
static enum zr_status keep(struct zr_arena *arena, const struct zr_sections_cut *cut, struct zr_frame *frame)
{
    struct zr_sections_cut *kept = zr_arena_copy(arena, cut, sizeof *kept);
    if (!kept) return ZR_NO_MEMORY;
    kept->caps = zr_arena_copy(arena, cut->caps, cut->cap_count * sizeof *kept->caps);
    if (cut->warning) kept->warning = zr_arena_copy(arena, cut->warning, strlen(cut->warning) + 1);
    frame->sections = kept;
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_render_sections(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_resolved_view *resolved, struct zr_frame *frame,
                                  const struct zr_scene **drawn)
{
    const struct zr_sections_cut *cut;
    struct zr_section_planes planes;
    *drawn = scene;
    if (scene->sections.count == 0) return ZR_OK;
    const struct zr_run inner = zr_run_in(run, run->scratch);
    enum zr_status status = zr_section_planes_find(scene, resolved, &planes, run->error);
    if (status != ZR_OK) return status;
    const double diagonal = (double)zr_diagonal_of(&resolved->bounds);
    status = zr_sections_make(&inner, scene, &planes, diagonal, hatch_pitch(resolved, diagonal), &cut);
    if (status != ZR_OK) return status;
    *drawn = cut->scene;
    return keep(run->arena, cut, frame);
}

static uint32_t whole_id(const struct zr_sections_cut *cut, uint32_t id)
{
    return id > 0 && id <= cut->id_count ? 1 + cut->ids[id - 1] : id;
}

static void restore_picks(const struct zr_sections_cut *cut, const struct zr_picks *picks)
{
    for (uint32_t i = 0; i < picks->count; i++) {
        struct zr_pick *pick = &picks->at[i];
        pick->at.face_id = whole_id(cut, pick->at.face_id);
        for (uint32_t k = 0; k < pick->behind_count; k++)
            pick->behind[k].face_id = whole_id(cut, pick->behind[k].face_id);
    }
}

static enum zr_status restore_fragments(struct zr_arena *arena, struct zr_frame *frame)
{
    struct zr_pixel_fragments *fragments = &frame->fragments;
    struct zr_pixel_fragment *list = zr_arena_copy(arena, fragments->at, fragments->count * sizeof *list);
    if (!list) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < fragments->count; i++)
        list[i].face_id = whole_id(frame->sections, list[i].face_id);
    fragments->at = list;
    return ZR_OK;
}

enum zr_status zr_render_sections_restore(struct zr_arena *arena, const struct zr_cancel *cancel,
                                          struct zr_frame *frame)
{
    if (!frame->sections) return ZR_OK;
    for (uint32_t y = 0; y < frame->height && frame->face_id; y++) {
        uint32_t *row = frame->face_id + (size_t)y * frame->width;
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        for (uint32_t x = 0; x < frame->width; x++)
            row[x] = whole_id(frame->sections, row[x]);
    }
    restore_picks(frame->sections, &frame->picks);
    return frame->fragments.count > 0 ? restore_fragments(arena, frame) : ZR_OK;
}
