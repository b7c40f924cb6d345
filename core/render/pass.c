#include "render/pass.h"

#include "base/mutant.h"
#include "geometry/build.h"
#include "render/stage.h"
#include "shade/paint.h"

/* Whether there is a draw of such a material. */
static bool any_draw(const struct zr_geometry *geometry, enum zr_alpha_mode mode)
{
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        if (geometry->draws[i].material->alpha_mode == mode) return true;
    return false;
}

static enum zr_status make_lists(struct zr_arena *arena, const struct zr_geometry *geometry,
                                 zr_visibility_fn *visibility, const struct zr_cancel *cancel, struct zr_pass *pass)
{
    struct zr_tile_source *tiles = &pass->tiles;
    enum zr_status status = ZR_OK;
    if (tiles->any_masked)
        STAGE(zr_visibility_window_fragments(arena, geometry, visibility, ZR_ALPHA_MASK, cancel, &pass->samples,
                                             &pass->masked));
    if (tiles->any_blended)
        STAGE(zr_visibility_window_fragments(arena, geometry, visibility, ZR_ALPHA_BLEND, cancel, &pass->samples,
                                             &pass->blended));
    if (tiles->any_masked) tiles->masked = &pass->masked;
    if (tiles->any_blended) tiles->blended = &pass->blended;
    return status;
}

/* What is blended is seen in colours, or asked for by itself. */
static void find_see_through(struct zr_arena *arena, const struct zr_attribute_wants *wants, struct zr_pass *pass)
{
    struct zr_tile_source *tiles = &pass->tiles;
    tiles->any_masked = any_draw(&pass->geometry, ZR_ALPHA_MASK);
    tiles->any_blended =
        (wants->colors || wants->samples || wants->layers) && any_draw(&pass->geometry, ZR_ALPHA_BLEND);
    pass->layers = (struct zr_layers_pool){.arena = arena, .lock = PTHREAD_MUTEX_INITIALIZER};
    if (tiles->any_masked || tiles->any_blended) tiles->layers = &pass->layers;
}

struct zr_window zr_window_of(const struct zr_scene *scene, uint32_t width, uint32_t height, uint32_t side)
{
    const float wanted = scene->picture.line_width;
    const float line_width = ZR_MUTANT(line_width_rounded_early, wanted, floorf(wanted + 0.5f)) * (float)side;
    return (struct zr_window){width * side, height * side, line_width > 1.0f ? (int32_t)(line_width + 0.5f) : 1,
                              (float)side};
}

/* Masks need the opacity of their textures in every pass. */
static enum zr_status make_textures(struct zr_arena *arena, struct zr_team *team, const struct zr_pass_desc *desc,
                                    const struct zr_cancel *cancel, struct zr_attribute_wants *wants)
{
    const struct zr_scene *scene = desc->scene;
    *wants = desc->wants;
    if (desc->untextured) return ZR_OK;
    if (!wants->colors && !wants->samples && !zr_any_is_masked(scene->materials, scene->material_count)) return ZR_OK;
    return zr_texture_maps_make(arena, team, scene, wants->samples, cancel, &wants->textures);
}

enum zr_status zr_pass_make(struct zr_arena *arena, struct zr_team *team, const struct zr_pass_desc *desc,
                            const struct zr_cancel *cancel, struct zr_pass *pass)
{
    const struct zr_scene *scene = desc->scene;
    const uint32_t width = desc->window.width, height = desc->window.height;
    zr_visibility_fn *window_at_once = zr_visibility_of(scene->algorithm); /* else tile by tile */
    const struct zr_prepaint *payloads = NULL;
    struct zr_attribute_wants wants;
    enum zr_status status = ZR_OK;
    STAGE(make_textures(arena, team, desc, cancel, &wants));
    STAGE(zr_geometry_build(arena, team, scene, desc->camera, &desc->window, cancel, window_at_once, &pass->geometry));
    STAGE(zr_scene_attributes_make(arena, team, scene, desc->camera, &pass->geometry, &wants, cancel, &pass->surfaces));
    if (window_at_once) {
        STAGE(zr_visibility_window(arena, &pass->geometry, window_at_once, width, height, desc->base, cancel,
                                   &pass->samples));
    } else {
        if (wants.colors)
            STAGE(zr_paint_prepare(arena, team, &pass->geometry, &pass->surfaces, (uint64_t)width * height, &payloads));
        STAGE(zr_binned_scene_make(arena, team, &pass->geometry, payloads, width, height, cancel, &pass->visible));
    }
    pass->tiles = (struct zr_tile_source){.scene = scene,
                                          .geometry = &pass->geometry,
                                          .surfaces = &pass->surfaces,
                                          .visible = window_at_once ? NULL : &pass->visible,
                                          .samples = window_at_once ? &pass->samples : NULL,
                                          .isa = zr_team_isa(team)};
    if (status != ZR_OK) return status;
    find_see_through(arena, &wants, pass);
    pass->masked = pass->blended = (struct zr_fragments){.ends = NULL};
    return window_at_once ? make_lists(arena, &pass->geometry, window_at_once, cancel, pass) : ZR_OK;
}

struct zr_counts zr_pass_counts(const struct zr_pass *pass)
{
    struct zr_counts counts = pass->geometry.counts;
    for (int mode = 0; pass->tiles.visible && mode < ZR_ALPHA_COUNT; mode++)
        zr_counts_add(&counts, &pass->visible.sorted[mode].bins.counts);
    counts.masked_tiles = pass->layers.masked_tiles;
    return counts;
}
