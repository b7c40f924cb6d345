#include "render/pass.h"

#include "base/mutant.h"
#include "base/run.h"
#include "geometry/build.h"
#include "raster/binned_scene.h"
#include "raster/textbook/whole_window.h"
#include "render/layers/solid_boxes.h"
#include "render/stage.h"
#include "scene/picture.h"
#include "shade/paint.h"

/* Returns true if a draw's material has this alpha mode. */
static bool any_draw(const struct zr_geometry *geometry, enum zr_alpha_mode mode)
{
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        if (zr_draw_mode(&geometry->draws[i]) == mode) return true;
    return false;
}

struct zr_window zr_window_of(const struct zr_scene *scene, uint32_t width, uint32_t height, uint32_t side)
{
    const float wanted = scene->picture->line_width;
    const float line_width = ZR_MUTANT(line_width_rounded_early, wanted, floorf(wanted + 0.5f)) * (float)side;
    return (struct zr_window){width * side, height * side, line_width > 1.0f ? (int32_t)(line_width + 0.5f) : 1,
                              (float)side};
}

/* Decides the modes whose fragments are listed: masked, and blended if colours or the lists themselves are wanted. */
static void find_listed(const struct zr_geometry *geometry, const struct zr_attribute_wants *wants,
                        bool listed[ZR_ALPHA_COUNT])
{
    listed[ZR_ALPHA_OPAQUE] = false;
    listed[ZR_ALPHA_OPERAND] = any_draw(geometry, ZR_ALPHA_OPERAND);
    listed[ZR_ALPHA_MASK] = any_draw(geometry, ZR_ALPHA_MASK);
    listed[ZR_ALPHA_BLEND] = (wants->colors || wants->samples || wants->layers) && any_draw(geometry, ZR_ALPHA_BLEND);
}

static uint64_t samples_in(const struct zr_window *window)
{
    return (uint64_t)window->width * window->height;
}

/* Makes the textures of colours and samples. Masks need their opacity in every pass. */
static enum zr_status make_textures(const struct zr_run *run, const struct zr_pass_desc *desc,
                                    struct zr_attribute_wants *wants)
{
    const struct zr_scene *scene = desc->scene;
    *wants = desc->wants;
    if (desc->untextured) return ZR_OK;
    if (!wants->colors && !wants->samples && !zr_any_is_masked(scene->materials, scene->material_count)) return ZR_OK;
    return zr_texture_maps_make(run, scene, wants->samples, &wants->textures);
}

/* Decides the visibility of the window by the scene's algorithm, or prepares to decide it tile by tile. listed: alpha
 * modes whose fragments will be requested. `base` may be NULL. */
static enum zr_status make_visibility(const struct zr_run *run, const struct zr_pass_desc *desc,
                                      const struct zr_prepaint *prepaints, const bool listed[ZR_ALPHA_COUNT],
                                      struct zr_pass *pass)
{
    const struct zr_geometry *geometry = &pass->geometry;
    zr_visibility_fn *window_at_once = zr_visibility_of(desc->scene->algorithm);
    if (window_at_once) {
        struct zr_whole_window *window = zr_arena_alloc(run->arena, 1, sizeof *window);
        if (!window) return ZR_NO_MEMORY;
        pass->visibility = &window->visibility;
        return zr_whole_window_make(run, geometry, window_at_once, listed, desc->base, window);
    }
    struct zr_binned_scene *binned = zr_arena_alloc(run->arena, 1, sizeof *binned);
    if (!binned) return ZR_NO_MEMORY;
    pass->visibility = &binned->visibility;
    return zr_binned_scene_make(run, geometry, prepaints, geometry->window.width, geometry->window.height, desc->base,
                                binned);
}

enum zr_status zr_pass_make(const struct zr_run *run, const struct zr_pass_desc *desc, struct zr_pass *pass)
{
    const struct zr_scene *scene = desc->scene;
    const bool in_tiles = scene->algorithm == ZR_ALGORITHM_HALFSPACE;
    const struct zr_prepaint *prepaints = NULL;
    bool listed[ZR_ALPHA_COUNT];
    struct zr_attribute_wants wants;
    enum zr_status status = ZR_OK;
    pass->visibility = NULL;
    STAGE(make_textures(run, desc, &wants));
    STAGE(zr_geometry_build(run, scene, desc->camera, &desc->window, !in_tiles, &pass->geometry));
    STAGE(zr_scene_attributes_make(run, scene, desc->camera, &pass->geometry, &wants, &pass->attributes));
    if (in_tiles && wants.colors)
        STAGE(zr_paint_prepare(run, &pass->geometry, &pass->attributes, samples_in(&desc->window), &prepaints));
    if (status == ZR_OK) find_listed(&pass->geometry, &wants, listed);
    STAGE(make_visibility(run, desc, prepaints, listed, pass));
    pass->layers = (struct zr_layers_pool){.arena = run->arena, .lock = PTHREAD_MUTEX_INITIALIZER};
    pass->tiles = (struct zr_tile_source){.scene = scene,
                                          .geometry = &pass->geometry,
                                          .attributes = &pass->attributes,
                                          .visibility = pass->visibility,
                                          .isa = zr_team_isa(run->team)};
    if (status != ZR_OK) return status;
    pass->tiles.any_masked = listed[ZR_ALPHA_MASK];
    pass->tiles.any_blended = listed[ZR_ALPHA_BLEND];
    if (listed[ZR_ALPHA_OPERAND]) STAGE(zr_solid_boxes_make(run, scene->csg, &pass->geometry, &pass->tiles.solids));
    if (listed[ZR_ALPHA_MASK] || listed[ZR_ALPHA_BLEND] || listed[ZR_ALPHA_OPERAND]) pass->tiles.layers = &pass->layers;
    return status;
}

struct zr_counts zr_pass_counts(const struct zr_pass *pass)
{
    struct zr_counts counts = pass->geometry.counts;
    zr_counts_add(&counts, &pass->visibility->counts);
    counts.masked_tiles = pass->layers.masked_tiles;
    return counts;
}
