/* The keys of the root of glTF. */
#include "input/gltf/gltf_file.h"

static const struct zr_json_field fields[] = {
#define PLACE(ID, name) [ID] = {.key = name, .read = zr_json_value_start, .offset = sizeof(const char *) * (ID)}
    PLACE(ZR_GLTF_ASSET, "asset"),
    PLACE(ZR_GLTF_EXTENSIONS, "extensions"),
    PLACE(ZR_GLTF_ACCESSORS, "accessors"),
    PLACE(ZR_GLTF_BUFFER_VIEWS, "bufferViews"),
    PLACE(ZR_GLTF_BUFFERS, "buffers"),
    PLACE(ZR_GLTF_IMAGES, "images"),
    PLACE(ZR_GLTF_MATERIALS, "materials"),
    PLACE(ZR_GLTF_MESHES, "meshes"),
    PLACE(ZR_GLTF_NODES, "nodes"),
    PLACE(ZR_GLTF_SAMPLERS, "samplers"),
    PLACE(ZR_GLTF_SCENE, "scene"),
    PLACE(ZR_GLTF_SCENES, "scenes"),
    PLACE(ZR_GLTF_TEXTURES, "textures"),
    PLACE(ZR_GLTF_ANIMATIONS, "animations"),
    PLACE(ZR_GLTF_CAMERAS, "cameras"),
    PLACE(ZR_GLTF_SKINS, "skins"),
    PLACE(ZR_GLTF_USED, "extensionsUsed"),
    PLACE(ZR_GLTF_REQUIRED, "extensionsRequired"),
#undef PLACE
    {.key = "extras", .read = zr_gltf_ignore}};
const struct zr_json_object zr_gltf_root = ZR_JSON_OBJECT_OF("glTF", fields);

const char *zr_gltf_word(enum zr_gltf_key key)
{
    return fields[key].key;
}

bool zr_gltf_read_list(struct zr_gltf *file, enum zr_gltf_key key, zr_gltf_item_fn *read)
{
    if (!file->places[key]) return true;
    return zr_gltf_read_items(file, file->places[key], ZR_JSON_KEY(NULL, zr_gltf_word(key)), read);
}

bool zr_gltf_check_index(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, enum zr_gltf_key of)
{
    if (number < file->counts[of]) return true;
    return zr_json_bad_index(&file->json, path, (double)number, file->counts[of], zr_gltf_word(of));
}
