/* Warns of contents of a glTF file that the picture lacks or changes. */
#include "input/gltf/gltf_file.h"

static void warn_of(struct zr_gltf *file, struct zr_warning_list *list, const struct zr_gltf_note *note,
                    const char *one, const char *many)
{
    if (note->count == 1)
        zr_warning_list_add(file->json.arena, list, "%s: %s", note->first, one);
    else if (note->count > 1)
        zr_warning_list_add(file->json.arena, list, "%u %s, the first is %s", note->count, many, note->first);
}

uint32_t zr_gltf_count_unplaced(const struct zr_gltf *file)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < file->counts[ZR_GLTF_MESHES]; i++)
        count += file->first_uses[i] == ZR_GLTF_NONE;
    return count;
}

void zr_gltf_warn(struct zr_gltf *file)
{
    struct zr_scene_builder *builder = file->builder;
    struct zr_warning_list *all = &builder->warnings, *colors = &builder->color_warnings;
    struct zr_arena *arena = file->json.arena;
    const uint32_t unplaced = zr_gltf_count_unplaced(file);
    if (file->counts[ZR_GLTF_ANIMATIONS] > 0 && !file->animation)
        zr_warning_list_add(arena, all, "left out: animations of the file");
    if (file->unread_extensions > 0)
        zr_warning_list_add(arena, all, "drawn without the extension%s %s", file->unread_extensions > 1 ? "s" : "",
                            file->extensions.text);
    if (unplaced > 0)
        zr_warning_list_add(arena, all, "%u of %u meshes are placed by no node of the scene and are not drawn",
                            unplaced, file->counts[ZR_GLTF_MESHES]);
    warn_of(file, all, &file->unknown, "this key is not known", "keys are not known");
    warn_of(file, all, &file->child_roots, "a child, drawn without its parents, which the scene does not list",
            "nodes of the scene are children of others, and are drawn without them unless the scene lists them, too");
    warn_of(file, all, &file->second_parents, "a child of another node, too, which alone places it",
            "children have a parent before, which alone places them");
    warn_of(file, all, &file->no_rotation, "a quaternion of the length 0, taken as no rotation",
            "quaternions have the length 0 and are taken as no rotation");
    warn_of(file, all, &file->unread_channels, "targets a property that is not read",
            "channels target properties that are not read");
    warn_of(file, all, &file->zero_strides, "0, taken as elements without gaps",
            "strides are 0 and are taken as elements without gaps");
    warn_of(file, all, &file->holes, "a position is not finite: its faces, lines and points are left out",
            "positions are not finite: their faces, lines and points are left out");
    warn_of(file, all, &file->short_buffers, "more than there are bytes; those that are used are there",
            "buffers have fewer bytes than their byteLength; those that are used are there");
    warn_of(file, all, &file->other_counts, "not the count of the compressed data, which is drawn",
            "accessors have not the count of the compressed data, which is drawn");
    warn_of(file, all, &file->not_finite, "an element is not finite, and taken as 0",
            "elements of attributes are not finite and are taken as 0");
    warn_of(file, colors, &file->wide_texcoords, "VEC3, of which the first two numbers are read",
            "sets of texture coordinates are VEC3, of which the first two numbers are read");
    warn_of(file, all, &file->bad_cameras, "this camera cannot be used, and is left out",
            "cameras cannot be used and are left out");
    warn_of(file, all, &file->no_positions, "without POSITION, and not drawn", "primitives are without POSITION");
    warn_of(file, all, &file->not_compressed, "neither compressed nor in a bufferView: it is 0",
            "attributes are neither compressed nor in a bufferView, and are 0");
    warn_of(file, all, &file->not_drawn, "compressed, but no attribute of its primitive, and not drawn",
            "compressed attributes are not those of their primitives, and are not drawn");
    warn_of(file, all, &file->empty, "too few corners to draw", "primitives have too few corners to draw");
    warn_of(file, all, &file->left_over, "the last corners make no whole primitive",
            "primitives have corners that are left over");
    warn_of(file, colors, &file->no_texcoords, "without the texture coordinates of its material: they are 0, 0",
            "primitives lack texture coordinates of their materials, which are 0, 0");
    warn_of(file, colors, &file->missing_images, "no part of the request has this name: the image is not drawn",
            "images are no parts of the request and are not drawn");
    warn_of(file, colors, &file->third_sets, "a third set of texture coordinates in its material, and not drawn",
            "textures have a third set of texture coordinates in their materials, and are not drawn");
    warn_of(file, colors, &file->no_source, "without a source, and not drawn", "textures are without a source");
    warn_of(file, colors, &file->specular_textures, "drawn without its textures",
            "materials are drawn without the textures of KHR_materials_specular");
    warn_of(file, colors, &file->undrawn_textures, "this texture is not drawn",
            "textures of extensions of materials are not drawn");
    warn_of(file, colors, &file->gloss_textures, "drawn without its specularGlossinessTexture",
            "materials are drawn without their specularGlossinessTexture");
    warn_of(file, colors, &file->clamped, "beyond its range, and clamped",
            "factors are beyond their ranges and are clamped");
    warn_of(file, &file->made->light_warnings, &file->bad_lights, "this light cannot be used, and is left out",
            "lights cannot be used and are left out");
    warn_of(file, &file->made->light_warnings, &file->clamped_spots,
            "its cone angles are beyond their ranges, and clamped",
            "spot lights have cone angles beyond their ranges, which are clamped");
    if (!file->has_fallbacks) zr_parsed_warn_of_unused_assets(&file->assets, builder);
}
