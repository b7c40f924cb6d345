/* Rehearses the reading of materials to find the images that are decoded ahead.
 *
 * How:   in a rehearsal, a copy of the reader reads the materials of the drawn primitives in the order of the meshes,
 *        and lists their images. Faults and counts of the rehearsal are dropped. The later reading reports them.
 * Exact: scene, faults, warnings and memory are the same for every team (image_ahead.h). */
#include "input/gltf/gltf_parts.h"

struct given_primitive {
    uint32_t material;
};
static const struct zr_json_field primitive_fields[] = {
    {.key = "material", .read = zr_gltf_index, .offset = offsetof(struct given_primitive, material)}};
static const struct zr_json_object primitive_object = ZR_JSON_OBJECT_OF("primitive", primitive_fields);

struct given_mesh {
    const char *primitives; /* place */
};
static const struct zr_json_field mesh_fields[] = {
    {.key = "primitives", .read = zr_json_value_start, .offset = offsetof(struct given_mesh, primitives)}};
static const struct zr_json_object mesh_object = ZR_JSON_OBJECT_OF("mesh", mesh_fields);

static void list_primitive(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_primitive given = {ZR_GLTF_NONE};
    (void)number;
    zr_gltf_fields(file, json, path, &primitive_object, &given);
    if (given.material >= file->counts[ZR_GLTF_MATERIALS] || file->listing->has_material[given.material]) return;
    file->listing->has_material[given.material] = true;
    zr_gltf_list_images_of(file, given.material);
}

static void list_mesh(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_mesh given = {NULL};
    if (file->first_uses[number] == ZR_GLTF_NONE) {
        zr_json_skip(json);
        return;
    }
    zr_gltf_fields(file, json, path, &mesh_object, &given);
    if (given.primitives)
        zr_gltf_read_items(file, given.primitives, ZR_JSON_KEY(path, mesh_fields[0].key), list_primitive);
}

/* Buffers and views that the rehearsal refused are read again, which reports their faults. */
static void forget_refusals(struct zr_gltf *file)
{
    for (uint32_t i = 0; i < file->counts[ZR_GLTF_BUFFERS]; i++)
        if (file->buffers[i].state == ZR_GLTF_REFUSED) file->buffers[i].state = ZR_GLTF_UNREAD;
    for (uint32_t i = 0; i < file->counts[ZR_GLTF_BUFFER_VIEWS]; i++)
        if (file->views[i].state == ZR_GLTF_REFUSED) file->views[i].state = ZR_GLTF_UNREAD;
}

void zr_gltf_read_images_ahead(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    struct zr_error faults = {.count = 0};
    if (file->counts[ZR_GLTF_IMAGES] < 2 || file->counts[ZR_GLTF_MATERIALS] == 0) return;
    struct zr_gltf *rehearsal = zr_arena_copy(arena, file, sizeof *file);
    struct zr_gltf_listing listing = {
        &file->decoded, zr_arena_zero(arena, file->counts[ZR_GLTF_MATERIALS], sizeof *listing.has_material)};
    if (!rehearsal || !listing.has_material) return;
    rehearsal->json.error = &faults;
    rehearsal->listing = &listing;
    zr_gltf_read_list(rehearsal, ZR_GLTF_MESHES, list_mesh);
    file->assets = rehearsal->assets; /* keeps the names that the rehearsal sorted */
    forget_refusals(file);
    if (!zr_json_stops(&file->json)) zr_image_list_decode(&file->decoded);
}
