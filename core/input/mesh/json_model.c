#include "input/mesh/parsed_mesh.h"

#include <stdio.h>
#include <string.h>

#include "core.h"
#include "input/json/json_array.h"
#include "input/json/json_matrix.h"
#include "input/model/kept_mesh.h"
#include "input/scene/json_model_scene.h"
#include "input/text/text.h"
#include "render_request.h"

struct zr_model {
    struct zr_scene scene; /* meshes, images, textures, counts, origin and instances as read */
    struct zr_scene_builder builder;
};

enum { INSTANCES_PER_CANCEL_CHECK = 1 << 14 };

/* ---- reading ---- */

/* Repeats the faults of a file at `path`, with their paths in the file. */
static bool report(struct zr_json *json, const struct zr_json_path *path, const struct zr_error *faults)
{
    if (faults->status == ZR_CANCELLED || faults->status == ZR_INTERNAL) {
        zr_error_add(json->error, faults->status, NULL, "%s", faults->items[0].detail);
        return false;
    }
    for (size_t i = 0; i < zr_error_held(faults); i++)
        zr_json_fault(json, path, "%s%s%s", faults->items[i].pointer, *faults->items[i].pointer ? ": " : "",
                      faults->items[i].detail);
    return false;
}

/* Counts the pixels of the file's images with those of the scene. */
static void count_pixels(struct zr_parsed_scene *root, const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->image_count; i++)
        root->images.pixels += (uint64_t)scene->images[i].width * scene->images[i].height;
}

/* Returns the folder of a name, with a final slash; NULL if it has none. */
static const char *folder_of(struct zr_arena *arena, const char *name)
{
    const char *slash = strrchr(name, '/');
    const size_t length = slash ? (size_t)(slash - name) + 1 : 0;
    char *folder = length > 0 ? zr_arena_alloc(arena, length + 1, 1) : NULL;
    if (!folder) return NULL;
    memcpy(folder, name, length);
    folder[length] = '\0';
    return folder;
}

/* Finds a stored asset among the kept files, without reading its bytes. Allocates their memory, as reading them does.
 */
static bool find_stored(struct zr_parsed_scene *root, const struct zr_bytes_name *given, struct zr_mesh_file *file,
                        struct zr_request *request)
{
    const struct zr_stored *stored = &root->assets.stored;
    const char *name = given->asset && !given->uri ? zr_stored_name(given->asset) : NULL;
    if (!name || !stored->look || !request->meshes.hash) return false;
    if (stored->look(stored->context, name, &request->size) != ZR_OK) return false;
    void *bytes = zr_arena_alloc(root->json.arena, request->size, 1);
    file->is_stored = true;
    for (size_t i = 0; i < sizeof file->hashes->bytes; i++)
        file->hashes[0].bytes[i] = (unsigned char)(16 * zr_hex_digit(name[2 * i]) + zr_hex_digit(name[2 * i + 1]));
    if (bytes && zr_mesh_file_find(file)) return true;
    if (bytes) zr_arena_trim(root->json.arena, bytes, request->size, 0, 1);
    return false;
}

/* Finds the file among the kept ones, or reads it. `path` leads to its name. */
static bool read_file(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_bytes_name *name,
                      struct zr_model *model)
{
    struct zr_json *json = &root->json;
    struct zr_request request = {.format = ZR_FORMAT_UNKNOWN,
                                 .assets = root->assets.items,
                                 .asset_count = root->assets.count,
                                 .stored = root->assets.stored,
                                 .images = root->images.kept,
                                 .texts = root->assets.texts,
                                 .meshes = root->assets.meshes,
                                 .cancel = json->cancel,
                                 .quick = root->assets.quick};
    struct zr_limits limits = *json->limits;
    struct zr_mesh_file file = {
        .builder = &model->builder, .request = &request, .limits = &limits, .assets = &root->assets.hash};
    struct zr_parsed_bytes bytes;
    struct zr_error faults = {0};
    limits.image_pixels_max -= root->images.pixels;
    bool is_kept = find_stored(root, name, &file, &request);
    if (!is_kept) {
        if (!zr_parsed_read_named(json, path, name, &bytes)) return false;
        request.bytes = bytes.bytes;
        request.size = bytes.size;
    }
    if (!zr_json_has_time(json, request.size)) return false;
    is_kept = is_kept || (!file.is_stored && zr_mesh_file_find(&file));
    const enum zr_status status = is_kept ? ZR_OK : zr_mesh_file_read(&file, root->builder->read_model, &faults);
    if (status != ZR_OK)
        return status != ZR_NO_MEMORY &&
               report(json, ZR_JSON_KEY(path, name->asset ? ZR_BYTES_ASSET : ZR_BYTES_URI), &faults);
    if (model->scene.mesh_count == 0)
        return zr_json_fault(json, ZR_JSON_KEY(path, name->asset ? ZR_BYTES_ASSET : ZR_BYTES_URI),
                             "the file has no meshes");
    count_pixels(root, &model->scene);
    zr_scene_builder_complete(&model->builder);
    return zr_arena_ok(json->arena);
}

/* Without nodes in the file, each of its meshes has the identity. A far scene adds the origin later (place_far). */
static bool place(struct zr_model *model, bool is_far)
{
    struct zr_scene *scene = &model->scene;
    const struct zr_model_scene *file = model->builder.file;
    scene->instance_count = file ? file->instance_count : scene->mesh_count;
    struct zr_instance *all = zr_arena_alloc(model->builder.arena, scene->instance_count, sizeof *all);
    scene->instances = all;
    for (uint32_t i = 0; all && i < scene->instance_count; i++) {
        all[i] = file ? file->instances[i] : (struct zr_instance){.mesh = i, .object_to_world = zr_mat4_identity()};
        if (!scene->origin || is_far) continue;
        const zr_mat4 origin =
            zr_mat4_of_pose((zr_vec3){(float)scene->origin[0], (float)scene->origin[1], (float)scene->origin[2]},
                            (zr_vec4){0, 0, 0, 1}, (zr_vec3){1, 1, 1});
        all[i].object_to_world = zr_mat4_mul(&origin, &all[i].object_to_world);
    }
    return all != NULL;
}

struct zr_model *zr_model_read(struct zr_parsed_scene *root, const struct zr_json_path *path,
                               const struct zr_bytes_name *name)
{
    struct zr_json *json = &root->json;
    struct zr_model *model = zr_arena_zero(json->arena, 1, sizeof *model);
    if (!model) return NULL;
    model->builder = zr_scene_builder_open(json->arena, json->team, &model->scene);
    model->builder.asset_uses = root->assets.uses;
    model->builder.asset_folder = name->asset ? folder_of(json->arena, name->asset) : NULL;
    return read_file(root, path, name, model) && place(model, json->far != NULL) ? model : NULL;
}

const double *zr_model_origin(const struct zr_model *model)
{
    return model->scene.origin;
}

/* ---- making ---- */

/* Returns the scene's number of mesh `part` of the file that is mesh `listed` of the list. */
static uint32_t number_of(const struct zr_parsed_scene *root, uint32_t listed, uint32_t part)
{
    return part == 0 ? listed : root->model_firsts[listed] + part - 1;
}

/* Adds the file's images and textures to the scene. Returns a table from the file's texture numbers plus 1 to the
 * scene's texture numbers plus 1; 0 maps to 0. */
static uint32_t *add_textures(struct zr_parsed_scene *root, const struct zr_model *model)
{
    const struct zr_scene *from = &model->scene;
    uint32_t *images = zr_arena_alloc(root->json.arena, from->image_count, sizeof *images);
    uint32_t *numbers = zr_arena_zero(root->json.arena, (size_t)from->texture_count + 1, sizeof *numbers);
    if (!images || !numbers) return NULL;
    for (uint32_t i = 0; i < from->image_count; i++)
        images[i] = zr_scene_builder_image(root->builder, &from->images[i]);
    for (uint32_t i = 0; i < from->texture_count; i++) {
        struct zr_texture texture = from->textures[i];
        texture.image = images[texture.image];
        numbers[i + 1] = zr_scene_builder_texture(root->builder, &texture) + 1;
    }
    return numbers;
}

/* Returns the file's materials with the scene's numbers of textures. */
static struct zr_parsed_material *take_materials(struct zr_parsed_scene *root, const struct zr_model *model)
{
    const struct zr_model_scene *file = model->builder.file;
    const uint32_t count = file ? file->material_count : 0;
    struct zr_parsed_material *all = zr_arena_alloc(root->json.arena, count, sizeof *all);
    const uint32_t *numbers = add_textures(root, model);
    if (!all || !numbers) return NULL;
    for (uint32_t i = 0; i < count; i++) {
        all[i] = file->materials[i];
        for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
            all[i].textures[slot].number = numbers[all[i].textures[slot].number];
        zr_model_scene_fit_look(root, &all[i]);
    }
    return all;
}

/* Makes the material of a mesh if its file has none or the scene gives one. */
static void make_plain(struct zr_parsed_scene *root, const struct zr_style *style, struct zr_mesh *mesh)
{
    const bool blends = style->material == root->material_count;
    mesh->material = zr_parsed_make_mesh_material(root, style, mesh, mesh->normal_count > 0 || mesh->colors, blends);
}

/* Makes the material of one of the file's meshes: the scene's, else the file's, else the look's. */
static void make_material(struct zr_parsed_scene *root, const struct zr_model_scene *file, uint32_t which,
                          const struct zr_style *style, struct zr_parsed_material *own, struct zr_mesh *mesh)
{
    struct zr_parsed_material *const listed = root->materials;
    const size_t listed_count = root->material_count;
    if (style->material < listed_count || !file || !file->mesh_materials) {
        make_plain(root, style, mesh);
        return;
    }
    root->materials = own;
    root->material_count = file->material_count;
    zr_model_scene_make_mesh(root, file, which, style, mesh);
    root->materials = listed;
    root->material_count = listed_count;
}

static void count_normals(struct zr_scene *scene, const struct zr_read_counts *more, uint32_t mesh)
{
    if (scene->counts.zero_normals == 0 && more->zero_normals > 0) scene->counts.zero_normals_mesh = mesh;
    scene->counts.normals += more->normals;
    scene->counts.zero_normals += more->zero_normals;
}

/* Repeats the file's warnings with the mesh's number. */
static void repeat_warnings(struct zr_parsed_scene *root, const struct zr_warning_list *from, uint32_t number,
                            struct zr_warning_list *list)
{
    for (size_t i = 0; i < from->count; i++)
        zr_warning_list_add(root->json.arena, list, "mesh %u: %s", number, from->texts[i]);
}

bool zr_model_make(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                   const struct zr_style *style, struct zr_mesh *meshes)
{
    const struct zr_model *model = given->model;
    const struct zr_scene *from = &model->scene;
    struct zr_parsed_material *own = take_materials(root, model);
    bool has_points = false;
    for (uint32_t i = 0; own && i < from->mesh_count; i++) {
        struct zr_mesh *mesh = &meshes[number_of(root, style->number, i)];
        *mesh = model->builder.meshes[i];
        if (i == 0 && given->name) mesh->name = given->name;
        if (mesh->point_count > 0) {
            has_points = true;
            mesh->point_size = given->point_size;
            mesh->points_are_round = given->point_shape == ZR_POINT_ROUND;
        }
        if (mesh->face_count > 0)
            zr_parsed_check_texcoords(root, path, style->material, mesh->texcoords != NULL, mesh->texcoords != NULL);
        if (root->json.error->count > 0) return true;
        zr_model_scene_fit_colors(root, mesh);
        make_material(root, model->builder.file, i, style, own, mesh);
    }
    if (root->meshes.count == 1 && !root->nodes) root->scene->file.unit = from->file.unit; /* nothing scales it */
    count_normals(root->scene, &from->counts, style->number);
    repeat_warnings(root, &model->builder.warnings, style->number, &root->builder->warnings);
    repeat_warnings(root, &model->builder.color_warnings, style->number, &root->builder->color_warnings);
    return has_points;
}

/* ---- placing ---- */

uint32_t zr_parsed_number_models(struct zr_parsed_scene *root, uint32_t first)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    uint64_t more = 0;
    bool any = false;
    for (size_t i = 0; i < root->meshes.count; i++)
        if (given[i].model) {
            any = true;
            more += given[i].model->scene.mesh_count - 1;
        }
    if (!any) return 0;
    uint32_t *firsts = zr_arena_alloc(root->json.arena, root->meshes.count, sizeof *firsts);
    uint32_t *owners = zr_arena_alloc(root->json.arena, first + (size_t)more, sizeof *owners); /* one per mesh read */
    if (!firsts || !owners) return 0;
    for (uint32_t i = 0; i < first; i++)
        owners[i] = i;
    uint32_t next = first;
    for (uint32_t i = 0; i < root->meshes.count; i++) {
        firsts[i] = next;
        for (uint32_t k = 1; given[i].model && k < given[i].model->scene.mesh_count; k++)
            owners[next++] = i;
    }
    root->model_firsts = firsts;
    root->scene->mesh_owners = owners;
    return next - first;
}

/* Joins the names of a node of the scene and one of the file: "robot/wheel". Either may be NULL. */
static const char *join_names(struct zr_arena *arena, const char *node, const char *of_file)
{
    if (!node || !of_file) return node ? node : of_file;
    const size_t size = strlen(node) + strlen(of_file) + 2;
    char *name = zr_arena_alloc(arena, size, 1);
    if (name) snprintf(name, size, "%s/%s", node, of_file);
    return name;
}

static const struct zr_model *model_of(const struct zr_parsed_scene *root, const struct zr_instance *instance)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    return instance->mesh < root->meshes.count ? given[instance->mesh].model : NULL;
}

void zr_parsed_use_model_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                const struct zr_instance *instances, uint32_t count)
{
    const struct zr_model_scene *file = NULL;
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_model *model = model_of(root, &instances[i]);
        if (!model || !model->builder.file) continue;
        if (!file || file->camera_count == 0) file = model->builder.file; /* for the message */
        if (!zr_model_scene_find_camera(model->builder.file, root->camera)) continue;
        zr_model_scene_use_camera(root, path, model->builder.file, root->camera, &instances[i].object_to_world);
        return;
    }
    if (file)
        zr_model_scene_use_camera(root, path, file, root->camera, NULL); /* reports the names of the cameras */
    else if (root->json.error->count == 0)                               /* files with faults may have cameras */
        zr_json_fault(&root->json, path, "no mesh of the scene is a file with cameras");
}

static bool count_instances(struct zr_parsed_scene *root, const struct zr_json_path *path,
                            const struct zr_instance *instances, uint32_t *count)
{
    uint64_t total = 0;
    for (uint32_t i = 0; i < *count; i++) {
        const struct zr_model *model = model_of(root, &instances[i]);
        total += model ? model->scene.instance_count : 1;
    }
    if (total > root->json.limits->instances_max)
        return zr_json_fault(&root->json, path, "%llu instances with those of model files; %u are allowed",
                             (unsigned long long)total, root->json.limits->instances_max);
    *count = (uint32_t)total;
    return true;
}

struct zr_instance *zr_parsed_place_models(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                           struct zr_instance *instances, uint32_t *count)
{
    const uint32_t given = *count;
    if (!root->model_firsts || !instances) return instances;
    if (!count_instances(root, path, instances, count)) return NULL;
    struct zr_instance *all = zr_arena_alloc(root->json.arena, *count, sizeof *all), *next = all;
    for (uint32_t i = 0; all && i < given && zr_arena_ok(root->json.arena); i++) {
        const struct zr_instance *one = &instances[i];
        const struct zr_model *model = model_of(root, one);
        if (i % INSTANCES_PER_CANCEL_CHECK == 0) zr_json_look(&root->json);
        if (zr_json_stops(&root->json)) return NULL;
        if (!model) *next++ = *one;
        for (uint32_t k = 0; model && k < model->scene.instance_count; k++) {
            const struct zr_instance *part = &model->scene.instances[k];
            *next++ =
                (struct zr_instance){.mesh = number_of(root, one->mesh, part->mesh),
                                     .object_to_world = zr_mat4_mul(&one->object_to_world, &part->object_to_world),
                                     .node = join_names(root->json.arena, one->node, part->node)};
        }
    }
    return zr_arena_ok(root->json.arena) ? all : NULL;
}
