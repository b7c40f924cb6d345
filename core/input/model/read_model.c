#include "input/model/read_model.h"

#include <string.h>

void zr_read_model_save(struct zr_read_model *model, const struct zr_scene_builder *builder)
{
    const struct zr_scene *scene = builder->scene;
    *model = (struct zr_read_model){.builder = *builder,
                                    .mesh_count = scene->mesh_count,
                                    .image_count = scene->image_count,
                                    .texture_count = scene->texture_count,
                                    .counts = scene->counts,
                                    .origin = scene->origin,
                                    .file = scene->file};
    model->builder.meshes = zr_arena_copy(builder->arena, builder->meshes, scene->mesh_count * sizeof *builder->meshes);
}

bool zr_read_model_load(const struct zr_read_model *model, struct zr_scene_builder *builder)
{
    struct zr_scene *scene = builder->scene;
    struct zr_mesh *meshes = zr_scene_builder_meshes(builder, model->mesh_count);
    if (!meshes) return false;
    memcpy(meshes, model->builder.meshes, model->mesh_count * sizeof *meshes);
    zr_warning_list_append(builder->arena, &builder->warnings, &model->builder.warnings);
    zr_warning_list_append(builder->arena, &builder->color_warnings, &model->builder.color_warnings);
    builder->file = model->builder.file;
    scene->counts = model->counts;
    scene->origin = model->origin;
    scene->file = model->file;
    scene->images = model->builder.images;
    scene->image_count = model->image_count;
    scene->textures = model->builder.textures;
    scene->texture_count = model->texture_count;
    return zr_arena_ok(builder->arena);
}
