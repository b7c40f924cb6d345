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

bool zr_scene_drop_colors(struct zr_arena *arena, struct zr_scene *scene)
{
    struct zr_mesh *meshes = zr_arena_copy(arena, scene->meshes, scene->mesh_count * sizeof *meshes);
    if (!meshes) return false;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        meshes[i].colors = meshes[i].face_colors = NULL;
    scene->meshes = meshes;
    return true;
}
