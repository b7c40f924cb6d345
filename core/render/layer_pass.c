#include "render/layer_pass.h"

#include "base/run.h"
#include "scene/scene_edit.h"

/* Copies the meshes without their lines and points. */
static const struct zr_mesh *faces_alone(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_alloc(arena, scene->mesh_count, sizeof *meshes);
    for (uint32_t i = 0; meshes && i < scene->mesh_count; i++) {
        meshes[i] = scene->meshes[i];
        meshes[i].line_count = meshes[i].point_count = 0;
    }
    return meshes;
}

static void make_see_through(struct zr_material *material)
{
    if (!material->is_hidden) material->alpha_mode = ZR_ALPHA_BLEND;
}

static void make_double_sided(struct zr_material *material)
{
    make_see_through(material);
    if (!material->is_hidden) material->double_sided = true;
}

/* Makes faces filled and double-sided. */
static void make_solid(struct zr_material *material)
{
    if (material->is_hidden) return;
    make_double_sided(material);
    material->unfilled = false;
    material->outline = ZR_OUTLINE_NONE;
}

static bool see_through_scene(struct zr_arena *arena, const struct zr_scene *scene, enum zr_layer_kind kind,
                              struct zr_scene *out)
{
    static void (*const edits[])(struct zr_material *) = {make_see_through, make_double_sided, make_solid};
    if (!zr_scene_edit_materials(arena, scene, edits[kind], out)) return false;
    if (kind == ZR_LAYERS_SOLID) out->meshes = faces_alone(arena, scene);
    return zr_arena_ok(arena);
}

enum zr_status zr_layer_pass_make(const struct zr_run *run, const struct zr_scene *scene, enum zr_layer_kind kind,
                                  const struct zr_frame *frame, struct zr_layer_pass *out)
{
    if (!see_through_scene(run->arena, scene, kind, &out->scene)) return ZR_NO_MEMORY;
    const struct zr_pass_desc desc = {.scene = &out->scene,
                                      .camera = &frame->camera,
                                      .window = zr_window_of(scene, frame->width, frame->height, 1),
                                      .wants = {.layers = true}};
    return zr_pass_make(run, &desc, &out->pass);
}

struct zr_layers *zr_layer_pass_find(const struct zr_layer_pass *pass, uint32_t number, const struct zr_cancel *cancel,
                                     struct zr_tile *tile)
{
    const struct zr_tile_source *tiles = &pass->pass.tiles;
    if (!zr_tile_find_visible(tiles, number, cancel, tile)) return NULL;
    struct zr_layers *layers = zr_layers_take(tiles->layers);
    if (!layers) return NULL;
    if (tile->is_empty) zr_tile_begin(tile, NULL, 0, 0);
    if (zr_layers_find(tiles, number, ZR_ALPHA_BLEND, cancel, tile, layers)) return layers;
    zr_layers_give(tiles->layers, layers);
    return NULL;
}
