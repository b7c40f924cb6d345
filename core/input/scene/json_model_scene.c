#include "input/scene/json_model_scene.h"

#include <stdio.h>
#include <string.h>

#include "base/matrix.h"
#include "input/text/text.h"
#include "scene/camera/camera.h"
#include "scene/picture.h"

/* Returns the file's material, overridden by the values of the query. */
static struct zr_parsed_material put_query(const struct zr_parsed_material *material,
                                           const struct zr_parsed_material *query)
{
    const uint64_t factors = UINT64_C(1) << ZR_MATERIAL_METALLIC | UINT64_C(1) << ZR_MATERIAL_ROUGHNESS;
    struct zr_parsed_material out = *material;
    if (!query) return out;
    out.keys |= query->keys & factors;
    if (zr_json_gives(query->keys, ZR_MATERIAL_BASE_COLOR)) {
        out.base_color = query->base_color;
        out.has_linear_color = false;
    }
    if (zr_json_gives(query->keys, ZR_MATERIAL_METALLIC)) out.metallic = query->metallic;
    if (zr_json_gives(query->keys, ZR_MATERIAL_ROUGHNESS)) out.roughness = query->roughness;
    return out;
}

/* True if the look lights surfaces. Only such looks draw unlit materials as unlit. */
static bool lights_surfaces(const struct zr_look *look)
{
    return look->shades_by_mesh || look->material.shading == ZR_SHADING_PBR;
}

/* With "colors": "materials", the picture shows the file's base colours. */
static bool replaces_materials(const struct zr_parsed_scene *root)
{
    return root->scene->look->is_material && !root->keeps_materials && root->scene->parts.colors != ZR_COLORS_MATERIALS;
}

/* True if an alphaMode other than OPAQUE may apply to the material. */
static bool uses_alpha(const struct zr_parsed_scene *root, const struct zr_parsed_material *material)
{
    return material->blends || material->face_style.alpha_mode > (int)ZR_ALPHA_OPAQUE ||
           root->face_style.alpha_mode > (int)ZR_ALPHA_OPAQUE;
}

static void take_look(const struct zr_parsed_scene *root, struct zr_parsed_material *material)
{
    const uint64_t maps = UINT64_C(1) << ZR_MATERIAL_NORMAL_TEXTURE | UINT64_C(1) << ZR_MATERIAL_OCCLUSION_TEXTURE;
    const zr_vec4 look = root->scene->look->material.base_color;
    const float alpha = zr_json_gives(material->keys, ZR_MATERIAL_BASE_COLOR) ? material->base_color.w : 1.0f;
    material->keys = (material->keys & maps) | UINT64_C(1) << ZR_MATERIAL_BASE_COLOR;
    material->base_color = (zr_vec4){look.x, look.y, look.z, alpha};
    material->has_linear_color = false;
    material->finish = (struct zr_finish){0};
    material->face_style.shading = ZR_UNSET;
    material->is_alpha_only = uses_alpha(root, material);
    for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++) {
        const bool is_of_shape = slot == ZR_TEXTURE_NORMAL || slot == ZR_TEXTURE_OCCLUSION;
        const bool is_alpha = slot == ZR_TEXTURE_BASE_COLOR && material->is_alpha_only;
        if (!is_of_shape && !is_alpha) material->textures[slot].number = 0;
    }
}

void zr_model_scene_fit_colors(const struct zr_parsed_scene *root, struct zr_mesh *mesh)
{
    if (mesh->scale || !replaces_materials(root)) return;
    mesh->colors = NULL;
    mesh->face_colors = NULL;
}

void zr_model_scene_fit_look(const struct zr_parsed_scene *root, struct zr_parsed_material *material)
{
    if (replaces_materials(root)) take_look(root, material);
    if (!lights_surfaces(root->scene->look)) material->face_style.shading = ZR_UNSET;
}

/* Makes one material of a mesh. `style` has the keys that override the material, and the mesh's number for warnings. */
static uint32_t make(struct zr_parsed_scene *root, const struct zr_model_scene *file, const struct zr_mesh *mesh,
                     size_t material, const struct zr_style *style)
{
    const struct zr_style of = {
        .material = material, .face_style = style->face_style, .is_open = true, .number = style->number};
    return zr_parsed_make_mesh_material(root, &of, mesh, mesh->normal_count > 0 || mesh->colors, file->blends_colors);
}

/* Adds the usage flags of the file's materials to the query's material, whose keys override all of them. */
static void note_uses(struct zr_parsed_material *query, const struct zr_parsed_material *all, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        query->is_used |= all[i].is_used;
        query->is_masked |= all[i].is_masked;
        query->is_blended |= all[i].is_blended;
        query->shadings |= all[i].shadings;
    }
}

/* Makes the materials of a mesh with a material per face: each once, in the order of the faces. */
static void make_faces(struct zr_parsed_scene *root, const struct zr_model_scene *file, const uint32_t *materials,
                       const struct zr_style *style, struct zr_mesh *mesh)
{
    const size_t count = (size_t)file->material_count + 1;
    uint32_t *made = zr_arena_alloc(root->json.arena, count, sizeof *made);
    uint32_t *out = zr_arena_alloc(root->json.arena, mesh->face_count, sizeof *out);
    if (!made || !out) return;
    memset(made, 0xFF, count * sizeof *made);
    for (uint32_t face = 0; face < mesh->face_count && zr_arena_ok(root->json.arena); face++) {
        const uint32_t of = materials[face] == ZR_MODEL_MATERIAL_NONE ? file->material_count : materials[face];
        if (made[of] == UINT32_MAX) made[of] = make(root, file, mesh, of, style);
        out[face] = made[of];
    }
    mesh->face_materials = out;
}

void zr_model_scene_make_mesh(struct zr_parsed_scene *root, const struct zr_model_scene *file, uint32_t which,
                              const struct zr_style *style, struct zr_mesh *mesh)
{
    const uint32_t of = file->mesh_materials[which];
    mesh->material = make(root, file, mesh, of == ZR_MODEL_MATERIAL_NONE ? file->material_count : of, style);
    if (file->face_materials && file->face_materials[which])
        make_faces(root, file, file->face_materials[which], style, mesh);
}

void zr_model_scene_make_materials(struct zr_parsed_scene *root, const struct zr_model_scene *file)
{
    struct zr_scene *scene = root->scene;
    struct zr_parsed_material *const own = root->materials;
    const size_t own_count = root->material_count; /* 0 or 1: the query's material */
    struct zr_parsed_material *all = zr_arena_alloc(root->json.arena, (size_t)file->material_count + 1, sizeof *all);
    struct zr_face_style over = root->face_style;
    if (!all) return;
    if (own_count > 0) over = zr_face_style_merge(&own->face_style, &root->face_style);
    for (uint32_t i = 0; i < file->material_count; i++) {
        struct zr_parsed_material fitted = file->materials[i];
        zr_model_scene_fit_look(root, &fitted);
        all[i] = put_query(&fitted, own_count > 0 ? own : NULL);
    }
    if (own_count > 0) all[file->material_count] = *own;
    root->materials = all;
    root->material_count = file->material_count + own_count;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const struct zr_style style = {.face_style = over, .number = i};
        zr_model_scene_fit_colors(root, &root->builder->meshes[i]);
        zr_model_scene_make_mesh(root, file, i, &style, &root->builder->meshes[i]);
    }
    if (own_count > 0) note_uses(own, all, file->material_count + 1);
    root->materials = own;
    root->material_count = own_count;
}

void zr_parsed_drop_maps(struct zr_parsed_scene *root)
{
    if (root->scene->picture->is_linear) return;
    for (uint32_t i = 0; i < root->scene->material_count; i++)
        for (int slot = 0; slot < ZR_TEXTURE_SLOTS; slot++)
            if (slot != ZR_TEXTURE_BASE_COLOR) root->builder->materials[i].textures[slot] = 0;
}

/* ---- cameras ---- */

/* Removes the scale: makes the axes unit vectors. */
static zr_mat4 unscale(const zr_mat4 *matrix)
{
    zr_mat4 out = *matrix;
    for (int column = 0; column < 3; column++) {
        float *axis = &out.m[4 * column];
        const zr_vec3 unit = zr_vec3_normalize((zr_vec3){axis[0], axis[1], axis[2]});
        axis[0] = unit.x;
        axis[1] = unit.y;
        axis[2] = unit.z;
    }
    return out;
}

/* Sets the pose as the key cameraToWorld does, bit by bit, unless the matrix has several scales. */
static bool set_pose_by_matrix(struct zr_view *view, const zr_mat4 *camera_to_world)
{
    const zr_mat4 pose = zr_pose_matrix_scale(camera_to_world) == 0.0 ? unscale(camera_to_world) : *camera_to_world;
    view->pose = ZR_POSE_MATRIX;
    if (!zr_mat4_invert(&pose, &view->world_to_camera)) return false;
    zr_pose_remove_scale(&view->world_to_camera);
    return true;
}

/* Views with a projection of their own replace those by a matrix. Others keep the pixels of earlier versions. */
static bool set_pose(struct zr_view *view, const struct zr_model_camera *camera, const zr_mat4 *up, bool is_matrix)
{
    const zr_mat4 turned = zr_mat4_mul(up, &camera->camera_to_world), pose = unscale(&turned);
    const struct zr_matrix matrix = zr_matrix_of(&pose);
    struct zr_matrix inverse;
    if (is_matrix) return set_pose_by_matrix(view, &turned);
    if (!zr_matrix_invert(&matrix, &inverse)) return false;
    for (int i = 0; i < 16; i++)
        view->world_to_camera.m[i] = (float)inverse.m[i];
    view->pose = ZR_POSE_MATRIX;
    return true;
}

static void set_projection(struct zr_view *view, const struct zr_model_camera *camera)
{
    view->projection = camera->is_perspective ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    view->yfov_radians = camera->yfov_radians;
    view->xfov_radians = 0.0f;
    view->xmag = camera->xmag;
    view->ymag = camera->ymag;
}

/* Keeps the planes that the view gives. */
static void set_planes(const struct zr_parsed_scene *root, struct zr_view *view, const struct zr_model_camera *camera)
{
    if (!root->gives_znear) {
        view->has_znear = true;
        view->znear = camera->znear;
    }
    if (!root->gives_zfar) {
        view->has_zfar = camera->has_zfar;
        view->zfar = camera->zfar;
    }
}

bool zr_model_scene_use_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                               const struct zr_model_scene *file, const char *camera, const zr_mat4 *up)
{
    struct zr_view *view = &root->scene->views[0];
    const struct zr_model_camera *found = file ? zr_model_scene_find_camera(file, camera) : NULL;
    const struct zr_quote quote = zr_quote(camera, strlen(camera));
    if (!file || file->camera_count == 0) return zr_json_fault(&root->json, path, "the file has no cameras");
    if (!found)
        return zr_json_fault(&root->json, path, "the file has no camera %s; its cameras: %s", quote.text,
                             zr_model_scene_cameras(file).text);
    if (found->fault)
        return zr_json_fault(&root->json, path, "the camera %s cannot be used: %s", quote.text, found->fault);
    if (!set_pose(view, found, up, root->gives_projection))
        return zr_json_fault(&root->json, path, "the camera %s has no axes", quote.text);
    if (!root->gives_projection) set_projection(view, found);
    if (view->projection != ZR_PROJECTION_MATRIX) set_planes(root, view, found);
    return !(view->has_znear && view->has_zfar && !(view->znear < view->zfar)) ||
           zr_json_fault(&root->json, path, "the camera %s then has zfar %.9g and znear %.9g", quote.text,
                         (double)view->zfar, (double)view->znear);
}

/* ---- lights ---- */

static zr_vec3 transform(const zr_mat4 *matrix, zr_vec3 v)
{
    const float *m = matrix->m;
    return (zr_vec3){(m[0] * v.x + m[4] * v.y) + m[8] * v.z, (m[1] * v.x + m[5] * v.y) + m[9] * v.z,
                     (m[2] * v.x + m[6] * v.y) + m[10] * v.z};
}

void zr_model_scene_use_lights(struct zr_parsed_scene *root, const struct zr_model_scene *file, const zr_mat4 *up)
{
    const uint32_t count = file ? file->light_count : 0;
    struct zr_light *lights = zr_arena_alloc(root->json.arena, count, sizeof *lights);
    struct zr_parsed_light_colors *colors = zr_arena_zero(root->json.arena, count, sizeof *colors);
    if (file) zr_warning_list_append(root->json.arena, &root->builder->color_warnings, &file->light_warnings);
    if (count == 0)
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings,
                            "the parameter fileLights has no effect: the file has no lights");
    if (!lights || !colors || count == 0) return;
    for (uint32_t i = 0; i < count; i++) {
        lights[i] = file->lights[i];
        lights[i].direction = transform(up, lights[i].direction);
        lights[i].position = transform(up, lights[i].position);
        colors[i] = (struct zr_parsed_light_colors){.color = lights[i].color, .intensity = 1.0f};
    }
    root->lights = lights;
    root->light_colors = colors;
    root->light_count = count;
    root->keys |= UINT64_C(1) << ZR_SCENE_LIGHTS;
}

/* ---- animations ---- */

void zr_model_scene_refuse_animation(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                     const struct zr_model_scene *file, const char *wanted)
{
    if (!file || file->animation_count == 0)
        zr_json_fault(&root->json, path, "the file has no animations");
    else
        zr_json_fault(&root->json, path, "the file has no animation %s; its animations: %s",
                      zr_quote(wanted, strlen(wanted)).text, zr_model_scene_animations(file).text);
}
