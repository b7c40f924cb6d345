/* scene_builder.h - scene: builds a scene; used by the readers of all formats.
 *
 *     struct zr_scene_builder builder = zr_scene_builder_open(arena, team, scene);
 *     struct zr_mesh *mesh = zr_scene_builder_meshes(&builder, 1);
 *     ... fill it; zr_scene_builder_close adds missing face_offsets and indices
 *     mesh->material = zr_scene_builder_material(&builder, &material);
 *     zr_scene_builder_place(&builder, instances, 1);
 *     zr_scene_builder_close(&builder);
 *
 * Errors: failed allocations are recorded in the arena.
 */
#ifndef ZR_SCENE_BUILDER_H
#define ZR_SCENE_BUILDER_H

#include "base/arena.h"
#include "base/status.h"
#include "base/warning_list.h"
#include "scene/scene.h"

struct zr_limits;
struct zr_request;
struct zr_scene_builder;
struct zr_team;
struct zr_keeping;     /* input/scene/kept.h */
struct zr_model_scene; /* input/model/model_scene.h */

/* Reads a model file in any format of bare meshes, without a query, into a builder. */
typedef enum zr_status zr_model_read_fn(struct zr_scene_builder *builder, const struct zr_request *request,
                                        const struct zr_limits *limits, struct zr_error *error);

struct zr_scene_builder {
    struct zr_arena *arena;
    struct zr_team *team; /* may be NULL */
    struct zr_scene *scene;
    struct zr_warning_list warnings;
    struct zr_warning_list color_warnings; /* about colours; dropped unless an output has the channel color */
    struct zr_mesh *meshes;
    struct zr_material *materials;
    size_t material_room;
    uint32_t *slots; /* hash table of 2 * material_room material numbers; UINT32_MAX: empty */
    struct zr_image *images;
    size_t image_room;
    struct zr_texture *textures;
    size_t texture_room;
    bool shares_places;                /* meshes may have one position for equal ones: no output tells the difference */
    const struct zr_keeping *keeping;  /* the scene is kept, or changes a kept one; or NULL */
    zr_model_read_fn *read_model;      /* reads the files that a scene names as meshes */
    uint8_t *asset_uses;               /* model file in a scene: flags per asset of the request; otherwise NULL */
    bool *looked;                      /* set if the reader looks for other files of the request; or NULL */
    const void *query_bytes;           /* bytes of the asset that the query uses; NULL: none */
    const char *asset_folder;          /* model file in a scene: folder of its name, with a final slash; or NULL */
    const struct zr_model_scene *file; /* nodes and materials of a bare mesh's own; or NULL */
    const struct zr_scene *asked;      /* its given window, views and sheet replace a scene's; or NULL */
};

/* Starts to build on *scene, which holds the defaults. */
struct zr_scene_builder zr_scene_builder_open(struct zr_arena *arena, struct zr_team *team, struct zr_scene *scene);

/* Allocates all meshes of the scene, empty and with the name "". NULL without memory. */
struct zr_mesh *zr_scene_builder_meshes(struct zr_scene_builder *builder, size_t count);

/* Sets the scene's instances: an array in the arena, not copied. */
void zr_scene_builder_place(struct zr_scene_builder *builder, const struct zr_instance *instances, size_t count);

/* Returns the number of a material, adding it unless an equal one exists. 0 without memory. */
uint32_t zr_scene_builder_material(struct zr_scene_builder *builder, const struct zr_material *material);

/* Adds an image and returns its number. 0 without memory. */
uint32_t zr_scene_builder_image(struct zr_scene_builder *builder, const struct zr_image *image);

/* Returns the number of a texture, adding it unless an equal one exists. 0 without memory. */
uint32_t zr_scene_builder_texture(struct zr_scene_builder *builder, const struct zr_texture *texture);

/* Counts given normals of a mesh, and the zero ones among them, in scene->counts. */
void zr_scene_builder_note_normals(struct zr_scene_builder *builder, uint32_t mesh, const zr_vec3 *normals,
                                   size_t count);

/* Completes the meshes, each once. Makes missing arrays, through which the kernels gather: face_offsets NULL means
 * triangles, indices NULL means that corners use consecutive positions. Moves unused positions. */
void zr_scene_builder_complete(struct zr_scene_builder *builder);

/* Completes the scene; its outputs must be set. Completes the meshes and collects the warnings. */
void zr_scene_builder_close(struct zr_scene_builder *builder);

#endif
