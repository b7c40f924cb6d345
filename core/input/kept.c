#include "input/kept.h"

#include <string.h>

void zr_kept_save_bare(struct zr_kept *kept, const struct zr_scene_builder *builder)
{
    kept->bare = *builder;
    kept->bare_counts = builder->scene->counts;
    kept->bare_origin = builder->scene->origin;
    kept->bare_file = builder->scene->file;
    kept->mesh_count = builder->scene->mesh_count;
    kept->image_count = builder->scene->image_count;
    kept->texture_count = builder->scene->texture_count;
    kept->bare.meshes = zr_arena_copy(builder->arena, builder->meshes, kept->mesh_count * sizeof *builder->meshes);
}

bool zr_kept_load_bare(const struct zr_kept *kept, struct zr_scene_builder *builder)
{
    struct zr_mesh *meshes = zr_scene_builder_meshes(builder, kept->mesh_count);
    if (!meshes) return false;
    memcpy(meshes, kept->bare.meshes, kept->mesh_count * sizeof *meshes);
    zr_warning_list_append(builder->arena, &builder->warnings, &kept->bare.warnings);
    zr_warning_list_append(builder->arena, &builder->color_warnings, &kept->bare.color_warnings);
    builder->scene->counts = kept->bare_counts;
    builder->scene->origin = kept->bare_origin;
    builder->scene->file = kept->bare_file;
    builder->file = kept->bare.file;
    builder->scene->images = kept->bare.images;
    builder->scene->image_count = kept->image_count;
    builder->scene->textures = kept->bare.textures;
    builder->scene->texture_count = kept->texture_count;
    return zr_arena_ok(builder->arena);
}
