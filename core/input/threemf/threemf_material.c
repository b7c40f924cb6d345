/* Materials of 3MF: one per texture that a placed mesh uses. */
#include "input/images/image_list.h"
#include "input/threemf/threemf_file.h"
#include "scene/texture.h"

struct making {
    struct zr_threemf *file;
    struct zr_image_list images;
    struct zr_threemf_list materials; /* struct zr_parsed_material */
};

static enum zr_status unpack(struct making *making, struct zr_threemf_resource *texture, struct zr_reason *reason)
{
    const char *bytes;
    if (texture->unpacked) return ZR_OK;
    const enum zr_status status = zr_zip_read(texture->image, making->file->arena, &bytes, reason);
    if (status == ZR_OK) texture->unpacked = bytes;
    return status;
}

static struct zr_parsed_bytes bytes_of(const struct zr_threemf_resource *texture)
{
    return (struct zr_parsed_bytes){.bytes = texture->unpacked, .size = (size_t)texture->image->size};
}

/* Reads the image of a texture. False without one, or after a fault. */
static bool read_image(struct making *making, struct zr_threemf_resource *texture, uint32_t *number)
{
    struct zr_threemf *file = making->file;
    struct zr_reason reason = {""};
    file->part = texture->part;
    if (!texture->image) {
        zr_threemf_note(file, ZR_THREEMF_NOTE_IMAGE, texture->at, (struct zr_xml_text){"", 0});
        return false;
    }
    const enum zr_status status = unpack(making, texture, &reason);
    if (*reason.text) zr_error_add(file->error, status, NULL, "%s", reason.text);
    if (status != ZR_OK) return false;
    const struct zr_parsed_bytes bytes = bytes_of(texture);
    if (zr_is_cancelled(file->cancel) || !zr_arena_ok(file->arena)) return false;
    if (zr_image_list_add(&making->images, &bytes, number, &reason) == ZR_OK) return true;
    if (*reason.text) zr_threemf_fault(file, texture->at, "texture %u: %s", texture->id, reason.text);
    return false;
}

static void make_material(struct making *making, struct zr_threemf_resource *texture)
{
    struct zr_threemf *file = making->file;
    struct zr_texture of = {.wrap_s = (enum zr_wrap)texture->wrap_s,
                            .wrap_t = (enum zr_wrap)texture->wrap_t,
                            .magnify = (enum zr_filter)texture->filter,
                            .minify = texture->filter == ZR_FILTER_NEAREST ? ZR_FILTER_NEAREST
                                                                           : ZR_FILTER_LINEAR_MIPMAP_LINEAR,
                            .is_color = true,
                            .rows = {{1, 0, 0}, {0, -1, 1}}}; /* v points up */
    texture->has_material = true;
    if (!read_image(making, texture, &of.image)) return;
    if (making->images.builder->scene->texture_count >= ZR_TEXTURES_MAX) {
        zr_threemf_fault(file, texture->at, "more than %d textures", ZR_TEXTURES_MAX);
        return;
    }
    struct zr_parsed_material *material = zr_threemf_list_add(file->arena, &making->materials, sizeof *material);
    if (!material) return;
    *material = (struct zr_parsed_material){.name = "",
                                            .keys = UINT64_C(1) << ZR_MATERIAL_BASE_COLOR,
                                            .base_color = {1, 1, 1, 1},
                                            .face_style = zr_face_style_unset};
    material->textures[ZR_TEXTURE_BASE_COLOR] =
        (struct zr_parsed_texture){.is_given = true,
                                   .scale = {1, 1},
                                   .strength = 1,
                                   .number = 1 + zr_scene_builder_texture(making->images.builder, &of)};
    if (!zr_image_list_is_opaque(&making->images, of.image)) {
        material->blends = true;
        if (texture->is_over) zr_threemf_note(file, ZR_THREEMF_NOTE_OVER, texture->at, (struct zr_xml_text){"", 0});
    }
    texture->material = making->materials.count - 1;
}

enum { FACES_AT_ONCE = 1 << 14 };

/* Lists the images of the textures of faces for decoding. Drops faults, which number_faces reports. */
static void list_images(struct making *making, const uint32_t *textures, uint32_t faces)
{
    struct zr_reason dropped;
    for (uint32_t i = 0; i < faces; i++) {
        if (i % FACES_AT_ONCE == 0 && zr_is_cancelled(making->file->cancel)) return;
        if (textures[i] == ZR_THREEMF_NONE) continue;
        struct zr_threemf_resource *texture = &zr_threemf_resources(making->file)[textures[i]];
        if (texture->is_listed || making->images.ahead_count == ZR_AHEAD_MAX) continue;
        texture->is_listed = true;
        if (!texture->image || unpack(making, texture, &dropped) != ZR_OK) continue;
        const struct zr_parsed_bytes bytes = bytes_of(texture);
        zr_image_list_expect(&making->images, &bytes);
    }
}

/* Turns the textures of faces into materials. True if all faces have the same material, *first. */
static bool number_faces(struct making *making, uint32_t *textures, uint32_t faces, uint32_t *first)
{
    bool is_one = true;
    *first = ZR_MODEL_MATERIAL_NONE;
    for (uint32_t i = 0; i < faces; i++) {
        if (i % FACES_AT_ONCE == 0 && zr_is_cancelled(making->file->cancel)) return false;
        if (textures[i] != ZR_THREEMF_NONE) {
            struct zr_threemf_resource *texture = &zr_threemf_resources(making->file)[textures[i]];
            if (!texture->has_material) make_material(making, texture);
            textures[i] = texture->material;
        }
        if (i == 0) *first = textures[i];
        is_one = is_one && textures[i] == *first;
    }
    return is_one;
}

bool zr_threemf_make_materials(struct zr_threemf *file, struct zr_scene_builder *builder,
                               const struct zr_request *request, struct zr_model_scene *scene, uint32_t count,
                               uint32_t **textures)
{
    struct making making = {.file = file};
    bool is_any = false;
    for (uint32_t i = 0; i < count; i++)
        is_any = is_any || textures[i];
    if (!is_any) return true;
    making.images = zr_image_list_of(builder, request, file->limits);
    uint32_t *of_meshes = zr_arena_alloc(file->arena, count, sizeof *of_meshes);
    if (!of_meshes) return false;
    for (uint32_t i = 0; i < count; i++)
        if (textures[i]) list_images(&making, textures[i], builder->meshes[i].face_count);
    zr_image_list_decode(&making.images);
    for (uint32_t i = 0; i < count; i++) {
        of_meshes[i] = ZR_MODEL_MATERIAL_NONE;
        if (textures[i] && number_faces(&making, textures[i], builder->meshes[i].face_count, &of_meshes[i]))
            textures[i] = NULL;
    }
    scene->material_count = making.materials.count;
    scene->materials = making.materials.items;
    scene->mesh_materials = of_meshes;
    scene->face_materials = (const uint32_t *const *)textures;
    scene->blends_colors = true;
    return file->error->count == 0 && !zr_is_cancelled(file->cancel);
}
