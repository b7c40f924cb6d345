/* Reads meshes of glTF: each primitive becomes a mesh of the scene. */
#include "input/gltf/gltf_parts.h"

/* ---- primitives ---- */

struct given_primitive {
    struct zr_gltf_primitive primitive;
    const char *attributes, *extensions; /* places, or NULL */
};

enum { ATTRIBUTES, INDICES, MATERIAL, MODE, TARGETS, EXTENSIONS };
#define AT(member) offsetof(struct given_primitive, member)
static const struct zr_json_field fields[] = {
    [ATTRIBUTES] = {"attributes", zr_json_value_start, AT(attributes), .required = true,
                    .text = "accessors of the vertices"},
    [INDICES] = {.key = "indices", .read = zr_gltf_index, .offset = AT(primitive.indices)},
    [MATERIAL] = {.key = "material", .read = zr_gltf_index, .offset = AT(primitive.material)},
    [MODE] = {.key = "mode", .read = zr_json_whole, .offset = AT(primitive.mode)},
    [TARGETS] = {.key = "targets", .read = zr_json_value_start, .offset = AT(primitive.targets)},
    [EXTENSIONS] = {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore}};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("primitive", fields);

static void read_primitive(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    const uint32_t none = ZR_GLTF_NONE;
    struct given_primitive given = {
        .primitive = {
            .attributes = ZR_GLTF_NO_ATTRIBUTES, .indices = none, .material = none, .mode = ZR_GLTF_TRIANGLES}};
    struct zr_gltf_use *of = &file->uses[file->use];
    struct zr_mesh *mesh = &file->builder->meshes[of->first + of->count];
    (void)number;
    if (zr_json_stops(&file->json)) return;
    zr_gltf_fields(file, json, path, &object, &given);
    if (!given.attributes) return;
    zr_gltf_read_attributes(file, ZR_JSON_KEY(path, fields[ATTRIBUTES].key), given.attributes,
                            &given.primitive.attributes);
    if (given.extensions &&
        !zr_gltf_open_draco(file, ZR_JSON_KEY(path, fields[EXTENSIONS].key), given.extensions, &given.primitive))
        return;
    if (given.primitive.material != none &&
        !zr_gltf_find_material(file, ZR_JSON_KEY(path, fields[MATERIAL].key), given.primitive.material))
        return;
    const bool is_made = zr_gltf_make_primitive(file, path, &given.primitive, mesh, of->first + of->count);
    zr_gltf_close_draco(file, &given.primitive);
    if (!is_made) {
        *mesh = (struct zr_mesh){.name = mesh->name};
        return;
    }
    file->mesh_materials[of->first + of->count++] = given.primitive.material;
}

/* ---- meshes ---- */

struct given_mesh {
    const char *name, *primitives, *weights; /* the last two are places */
};
enum { PRIMITIVES, NAME, WEIGHTS };
#define AT(member) offsetof(struct given_mesh, member)
static const struct zr_json_field mesh_fields[] = {
    [PRIMITIVES] = {"primitives", zr_json_value_start, AT(primitives), .required = true, .text = "list of primitives"},
    [NAME] = {.key = "name", .read = zr_json_string, .offset = AT(name)},
    [WEIGHTS] = {.key = "weights", .read = zr_json_value_start, .offset = AT(weights)},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object mesh_object = ZR_JSON_OBJECT_OF("mesh", mesh_fields);

static void count_mesh(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_mesh given = {"", NULL, NULL};
    size_t count = 0;
    zr_gltf_fields(file, json, path, &mesh_object, &given);
    if (!given.primitives || file->first_uses[number] == ZR_GLTF_NONE) return;
    struct zr_json there = zr_json_at(json, given.primitives);
    if (!zr_json_count(&there, ZR_JSON_KEY(path, mesh_fields[PRIMITIVES].key), &count)) return;
    for (uint32_t i = file->first_uses[number]; i != ZR_GLTF_NONE; i = file->uses[i].next)
        file->primitives += count;
}

/* Makes the primitives of one use of the mesh. */
static void read_use(struct zr_gltf *file, const struct zr_json_path *path, const struct given_mesh *given,
                     uint32_t number)
{
    struct zr_gltf_use *use = &file->uses[number];
    struct zr_json there = zr_json_at(&file->json, given->primitives);
    file->use = number;
    file->weights = use->weights ? use->weights : given->weights;
    use->first = file->next_mesh;
    zr_json_enter(&there, '[');
    for (uint32_t k = 0; zr_json_any_item(&there); k++) {
        file->builder->meshes[use->first + use->count].name = given->name;
        read_primitive(file, &there, ZR_JSON_ITEM(path, k), k);
    }
    file->next_mesh = use->first + use->count;
}

static void read_mesh(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_mesh given = {"", NULL, NULL};
    if (file->first_uses[number] == ZR_GLTF_NONE || zr_json_stops(&file->json)) {
        zr_json_skip(json);
        return;
    }
    const struct zr_gltf_note before = file->unknown; /* count_mesh has counted the unknown keys */
    zr_gltf_fields(file, json, path, &mesh_object, &given);
    file->unknown = before;
    for (uint32_t i = file->first_uses[number]; i != ZR_GLTF_NONE && !zr_json_stops(&file->json);
         i = file->uses[i].next)
        read_use(file, ZR_JSON_KEY(path, mesh_fields[PRIMITIVES].key), &given, i);
}

bool zr_gltf_read_meshes(struct zr_gltf *file)
{
    struct zr_json *json = &file->json;
    if (!zr_gltf_read_list(file, ZR_GLTF_MESHES, count_mesh) || json->error->count > 0) return false;
    if (file->primitives > json->limits->instances_max)
        return zr_json_fault(json, ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_MESHES)),
                             "%llu primitives are drawn; %u are allowed", (unsigned long long)file->primitives,
                             json->limits->instances_max);
    file->mesh_materials = zr_arena_alloc(json->arena, (size_t)file->primitives, sizeof *file->mesh_materials);
    file->moves = zr_arena_zero(json->arena, (size_t)file->primitives + 1, sizeof *file->moves);
    if (!zr_scene_builder_meshes(file->builder, (size_t)file->primitives + 1) || !file->mesh_materials || !file->moves)
        return false;
    file->made->mesh_materials = file->mesh_materials;
    zr_gltf_read_images_ahead(file);
    zr_gltf_read_list(file, ZR_GLTF_MESHES, read_mesh);
    file->builder->scene->mesh_count = file->next_mesh;
    return json->error->count == 0 && !zr_json_stops(&file->json);
}
