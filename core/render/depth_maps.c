#include "render/depth_maps.h"

#include "base/run.h"
#include "effects/ground.h"
#include "effects/shadow_maps.h"
#include "render/pass.h"
#include "render/stage.h"
#include "scene/picture.h"
#include "scene/scene_edit.h"

static void edit_material(struct zr_material *material)
{
    material->double_sided = true;
    material->outline = ZR_OUTLINE_NONE;
}

/* Draws depths along the camera's axis in a square window. Uncovered pixels are INFINITY; row 0 is on top. */
static enum zr_status draw_depths(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_camera *camera, uint32_t side, const float **depths)
{
    struct zr_pass *pass = zr_arena_zero(run->arena, 1, sizeof *pass);
    struct zr_frame *frame = zr_arena_zero(run->arena, 1, sizeof *frame);
    struct zr_scene edited;
    if (!pass || !frame || !zr_scene_edit_materials(run->arena, scene, edit_material, &edited)) return ZR_NO_MEMORY;
    edited.algorithm = ZR_ALGORITHM_HALFSPACE;
    const struct zr_pass_desc desc = {.scene = &edited, .camera = camera, .window = {side, side, 1, 0.0f}};
    frame->width = frame->height = side;
    frame->camera = *camera;
    frame->depth = zr_arena_alloc(run->arena, (size_t)side * side, sizeof *frame->depth);
    frame->spans = zr_arena_alloc(run->arena, side, sizeof *frame->spans);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    *depths = frame->depth;
    const struct zr_arena_step step = zr_arena_open_step(run->arena);
    enum zr_status status = ZR_OK;
    STAGE(zr_pass_make(run, &desc, pass));
    STAGE(zr_tiles_draw(run, &pass->tiles, frame));
    zr_arena_close_step(run->arena, &step);
    return status;
}

enum zr_status zr_ground_map_draw(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  struct zr_ground *ground, struct zr_ground_frame *frame)
{
    struct zr_ground_view view;
    const float *heights = NULL;
    *ground = (struct zr_ground){.light = NULL};
    if (!zr_ground_view_find(scene, camera, bounds, &view)) return ZR_OK;
    const enum zr_status status = draw_depths(run, scene, &view.below, ZR_GROUND_SIDE, &heights);
    if (status != ZR_OK) return status;
    *frame = view.frame;
    *ground = zr_ground_make(run, heights, view.half_size, zr_diagonal_of(bounds), view.height);
    return ground->light ? ZR_OK : ZR_NO_MEMORY;
}

static bool any_casts_shadows(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (zr_light_casts_shadows(&scene->lights[i])) return true;
    return false;
}

enum zr_status zr_shadow_maps_draw(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_camera *camera, const struct zr_bounds *bounds,
                                   const struct zr_shadow_map **maps)
{
    *maps = NULL;
    if (!any_casts_shadows(scene) || !(zr_diagonal_of(bounds) > 0.0f)) return ZR_OK;
    struct zr_shadow_map *out = zr_arena_zero(run->arena, scene->light_count, sizeof *out);
    if (!out) return ZR_NO_MEMORY;
    *maps = out;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct zr_light *light = &scene->lights[i];
        struct zr_camera along;
        const float *depths = NULL;
        if (!zr_light_casts_shadows(light) || !zr_light_camera(scene, light, camera, bounds, &along)) continue;
        const enum zr_status status = draw_depths(run, scene, &along, ZR_SHADOW_SIDE, &depths);
        if (status != ZR_OK) return status;
        out[i] = zr_shadow_map_make(run->arena, light, camera, bounds, &along, depths);
        if (!out[i].depths) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}
