/* scene_builder.h - scene: what readers of every format make a scene with.
 *
 *     struct zr_scene_builder builder = zr_scene_builder_open(arena, team, scene);
 *     struct zr_mesh *mesh = zr_scene_builder_meshes(&builder, 1);
 *     ... fill it; what is open of it, zr_scene_builder_close fills in
 *     mesh->material = zr_scene_builder_material(&builder, &material);
 *     zr_scene_builder_place(&builder, instances, 1);
 *     zr_scene_builder_close(&builder);
 *
 * Failures to allocate are in the arena.
 */
#ifndef ZR_SCENE_BUILDER_H
#define ZR_SCENE_BUILDER_H

#include "base/arena.h"
#include "base/warning_list.h"
#include "scene/scene.h"

struct zr_team;

struct zr_scene_builder {
    struct zr_arena *arena;
    struct zr_team *team; /* may be NULL */
    struct zr_scene *scene;
    struct zr_warning_list warnings;
    struct zr_warning_list color_warnings; /* about colours: of no interest where no output shows any */
    struct zr_mesh *meshes;
    struct zr_material *materials;
    size_t material_room;
    uint32_t *slots; /* 2 * material_room: numbers of materials, by what they are; UINT32_MAX where there is none */
    struct zr_image *images;
    size_t image_room;
    struct zr_texture *textures;
    size_t texture_room;
};

/* Over what *scene already has: the defaults. */
struct zr_scene_builder zr_scene_builder_open(struct zr_arena *arena, struct zr_team *team, struct zr_scene *scene);

/* All meshes of the scene, to be filled: empty, without a name. NULL where there is no memory. */
struct zr_mesh *zr_scene_builder_meshes(struct zr_scene_builder *builder, size_t count);

/* What places the meshes: an array in the arena. */
void zr_scene_builder_place(struct zr_scene_builder *builder, const struct zr_instance *instances, size_t count);

/* The number of a material: the same for all that are equal. 0 where there is no memory. */
uint32_t zr_scene_builder_material(struct zr_scene_builder *builder, const struct zr_material *material);

/* The number of one more image. 0 where there is no memory. */
uint32_t zr_scene_builder_image(struct zr_scene_builder *builder, const struct zr_image *image);

/* The number of a texture: the same for all that are equal. 0 where there is no memory. */
uint32_t zr_scene_builder_texture(struct zr_scene_builder *builder, const struct zr_texture *texture);

/* Counts normals of a mesh that were given, and those that are zero. */
void zr_scene_builder_note_normals(struct zr_scene_builder *builder, uint32_t mesh, const zr_vec3 *normals,
                                   size_t count);

/* The scene, whose outputs are known by now, has all that was made. Meshes may have face_offsets NULL: triangles; and
 * indices NULL: each corner of a face is the next position. Both become arrays here, since the kernels gather through
 * them. */
void zr_scene_builder_close(struct zr_scene_builder *builder);

#endif
