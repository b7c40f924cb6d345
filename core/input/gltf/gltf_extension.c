/* Checks the names of the extensions that a glTF file uses and requires, and reads objects of extensions. */
#include "input/gltf/gltf_extensions.h"

#include <string.h>

#include "input/text/text.h"

/* Extensions that are read. */
static const char *const known[] = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",   "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",       "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_dispersion",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",    "KHR_materials_transmission",
    "KHR_materials_unlit",        "KHR_materials_volume",      "KHR_mesh_quantization",
    "KHR_meshopt_compression",    "KHR_texture_transform"};

/* Beginnings of the names of extensions without which geometry and its place stay the same: a file that requires one is
 * drawn, and a warning names it. */
static const char *const shading[] = {"ADOBE_materials_",
                                      "EXT_lights_",
                                      "EXT_materials_",
                                      "FB_materials_",
                                      "KHR_audio",
                                      "KHR_lights_",
                                      "KHR_materials_",
                                      "KHR_xmp",
                                      "KHR_animation_pointer",
                                      "KHR_node_hoverability",
                                      "KHR_node_selectability",
                                      "MPEG_audio",
                                      "MSFT_packing_",
                                      "MSFT_screencoverage",
                                      "NV_materials_",
                                      "EXT_texture_procedurals",
                                      "EXT_structural_metadata",
                                      "EXT_mesh_features",
                                      "EXT_instance_features",
                                      "EXT_feature_metadata",
                                      "KHR_interactivity",
                                      "KHR_physics_rigid_bodies",
                                      "KHR_collision_shapes"};

/* Extensions that files often require, with advice for the message. */
static const struct {
    const char *name, *advice;
} unread[] = {{"KHR_texture_basisu", "; export its textures as PNG or JPEG instead of KTX2"}};

static const char *find_advice(const char *name)
{
    for (size_t i = 0; i < sizeof unread / sizeof *unread; i++)
        if (strcmp(unread[i].name, name) == 0) return unread[i].advice;
    return "";
}

static bool is_known(const char *name)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i], name) == 0) return true;
    return false;
}

static bool only_shades(const char *name)
{
    for (size_t i = 0; i < sizeof shading / sizeof *shading; i++)
        if (strncmp(shading[i], name, strlen(shading[i])) == 0) return true;
    return false;
}

/* Adds the name of a used extension to the warning, unless it is read. */
static void note_used(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    const char *name;
    (void)number;
    if (!zr_json_string(json, path, &name) || is_known(name)) return;
    file->unread_extensions++;
    zr_names_text_add(&file->extensions, zr_quote(name, strlen(name)).text);
}

static void check_required(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    const char *name;
    (void)number;
    if (!zr_json_string(json, path, &name)) return;
    if (strcmp(name, ZR_GLTF_DRACO) == 0) file->requires_draco = true;
    if (!is_known(name) && !only_shades(name))
        zr_json_fault(json, path, "the file requires the extension %s, which is not read%s",
                      zr_quote(name, strlen(name)).text, find_advice(name));
}

void zr_gltf_check_extensions(struct zr_gltf *file)
{
    zr_gltf_read_list(file, ZR_GLTF_REQUIRED, check_required);
    zr_gltf_read_list(file, ZR_GLTF_USED, note_used);
}

/* ---- objects ---- */

bool zr_gltf_find_extension(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions,
                            const char *name, const char **place)
{
    const struct zr_json_field field = {.key = name, .read = zr_json_value_start, .offset = 0};
    const struct zr_json_object object = {.name = "extensions", .count = 1, .fields = &field, .is_open = true};
    return zr_gltf_fields_at(file, extensions, path, &object, place);
}
