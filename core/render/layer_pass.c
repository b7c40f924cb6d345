#include "render/layer_pass.h"

/* All meshes without their lines and points. */
static const struct zr_mesh *faces_alone(struct zr_arena *arena, const struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_alloc(arena, scene->mesh_count, sizeof *meshes);
    for (uint32_t i = 0; meshes && i < scene->mesh_count; i++) {
        meshes[i] = scene->meshes[i];
        meshes[i].line_count = meshes[i].point_count = 0;
    }
    return meshes;
}

/* solid: faces alone, filled, and from both sides. */
static bool see_through_scene(struct zr_arena *arena, const struct zr_scene *scene, bool solid, struct zr_scene *out)
{
    struct zr_material *materials = zr_arena_alloc(arena, scene->material_count, sizeof *materials);
    *out = *scene;
    out->materials = materials;
    if (solid) out->meshes = faces_alone(arena, scene);
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        materials[i] = scene->materials[i];
        materials[i].alpha_mode = ZR_ALPHA_BLEND;
        if (!solid) continue;
        materials[i].double_sided = true;
        materials[i].unfilled = false;
        materials[i].outline = ZR_OUTLINE_NONE;
    }
    return true;
}

enum zr_status zr_layer_pass_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  bool solid, const struct zr_frame *frame, const struct zr_cancel *cancel,
                                  struct zr_layer_pass *out)
{
    const float line_width = scene->picture.line_width + 0.5f;
    if (!see_through_scene(arena, scene, solid, &out->scene)) return ZR_NO_MEMORY;
    const struct zr_pass_desc of = {
        .scene = &out->scene,
        .camera = &frame->camera,
        .window = {frame->width, frame->height, line_width > 1.0f ? (int32_t)line_width : 1, 1.0f},
        .wants = {.layers = true}};
    return zr_pass_make(arena, team, &of, cancel, &out->pass);
}

struct zr_layers *zr_layer_pass_find(const struct zr_layer_pass *pass, uint32_t number, const struct zr_cancel *cancel,
                                     struct zr_tile *tile)
{
    const struct zr_tile_source *tiles = &pass->pass.tiles;
    if (!zr_tile_find_visible(tiles, number, NULL, cancel, tile)) return NULL;
    struct zr_layers *layers = zr_layers_take(tiles->layers);
    if (!layers) return NULL;
    if (tile->is_empty) zr_tile_begin(tile, NULL, 0, 0);
    if (zr_layers_find(tiles, number, ZR_ALPHA_BLEND, cancel, tile, layers)) return layers;
    zr_layers_give(tiles->layers, layers);
    return NULL;
}
