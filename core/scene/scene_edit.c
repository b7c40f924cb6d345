#include "scene/scene_edit.h"

bool zr_scene_edit_materials(struct zr_arena *arena, const struct zr_scene *scene, zr_material_edit_fn *edit,
                             struct zr_scene *out)
{
    struct zr_material *materials = zr_arena_alloc(arena, scene->material_count, sizeof *materials);
    *out = *scene;
    out->materials = materials;
    if (!materials) return false;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        materials[i] = scene->materials[i];
        edit(&materials[i]);
    }
    return true;
}
