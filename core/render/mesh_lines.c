#include "render/mesh_lines.h"

#include "base/cancel.h"
#include "base/run.h"
#include "lines/ink.h"
#include "lines/line_sheet.h"
#include "render/stage.h"
#include "scene/picture.h"
#include "scene/scene_edit.h"

static void draw_both_sides(struct zr_material *material)
{
    material->double_sided = true;
}

/* Returns the scene whose lines are found: hidden lines are those of culled faces, too. NULL without memory. */
static const struct zr_scene *scene_of_lines(struct zr_arena *arena, const struct zr_scene *scene)
{
    if (!scene->picture->edges.has_hidden) return scene;
    struct zr_scene *edited = zr_arena_alloc(arena, 1, sizeof *edited);
    return edited && zr_scene_edit_materials(arena, scene, draw_both_sides, edited) ? edited : NULL;
}

static struct zr_drawing_desc desc_of(const struct zr_scene *scene, const struct zr_frame *frame)
{
    const struct zr_edges *edges = &scene->picture->edges;
    return (struct zr_drawing_desc){
        .scene = scene,
        .camera = &frame->camera,
        .bounds = &frame->bounds,
        .width = frame->width,
        .height = frame->height,
        .rule = {.crease_degrees = edges->crease_degrees, .ignores_normals = edges->ignores_normals},
        .has_hidden = edges->has_hidden};
}

enum zr_status zr_mesh_lines_draw(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame)
{
    const struct zr_edges *edges = &scene->picture->edges;
    const uint32_t width = frame->width, height = frame->height;
    const struct zr_scene *drawn = scene_of_lines(run->arena, scene);
    const struct zr_drawing_desc desc = desc_of(drawn ? drawn : scene, frame);
    const float w = zr_stroke_width(edges->width, width, height);
    float *opacity = zr_arena_alloc(run->arena, (size_t)width * height, sizeof *opacity);
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct zr_drawing drawing;
    enum zr_status status = drawn && opacity ? ZR_OK : ZR_NO_MEMORY;
    STAGE(zr_drawing_make(&inner, &desc, &drawing));
    STAGE(zr_strokes_draw(&inner, &drawing.polylines, w, width, height, opacity));
    zr_arena_close_scratch(&scratch, run->arena);
    if (status == ZR_OK) zr_ink_lay(run, opacity, edges->color, width, height, frame->color);
    return status == ZR_OK && zr_is_cancelled(run->cancel) ? ZR_CANCELLED : status;
}

enum zr_status zr_mesh_lines_keep(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const struct zr_scene *drawn = scene_of_lines(run->scratch, scene);
    const struct zr_drawing_desc desc = desc_of(drawn ? drawn : scene, frame);
    struct zr_line_sheet *lines = zr_arena_alloc(run->arena, 1, sizeof *lines);
    struct zr_drawing drawing;
    enum zr_status status = drawn && lines ? ZR_OK : ZR_NO_MEMORY;
    STAGE(zr_drawing_make(&inner, &desc, &drawing));
    STAGE(zr_line_sheet_make(run, &desc, &drawing, lines));
    frame->lines = lines;
    return status;
}
