/* Reads nodes and scenes of glTF, and places meshes. Each node has one parent: the first that names it. */
#include "input/gltf/gltf_extensions.h"

#include <string.h>

#include "base/cancel.h"
#include "input/json/json_matrix.h"

/* ---- nodes ---- */

struct given_node {
    const char *name, *children, *weights, *extensions; /* all but the name are places, or NULL */
    uint32_t mesh, skin, camera;
    zr_mat4 matrix;
    zr_vec3 translation, scale;
    zr_vec4 rotation;
    double exact[3]; /* translation of the node or of its matrix */
};

/* Reads the translation of a node, also in double. `out`: the node. */
static bool read_translation(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct given_node *node = out;
    const double limit = zr_recenter_limit(json->limits);
    const struct zr_json_row row = {3, 3, -limit, limit};
    if (!zr_json_numbers(json, path, row, node->exact, NULL)) return false;
    node->translation = (zr_vec3){(float)node->exact[0], (float)node->exact[1], (float)node->exact[2]};
    return true;
}

/* Reads the matrix of a node, its translation also in double. `out`: the node. */
static bool read_matrix(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct given_node *node = out;
    struct zr_json again = *json;
    double m[16];
    bool rows;
    if (!zr_json_affine(json, path, &node->matrix) || !zr_json_square(&again, path, 4, (double)ZR_MATRIX_MAX, m, &rows))
        return false;
    for (int axis = 0; axis < 3; axis++)
        node->exact[axis] = m[rows ? 4 * axis + 3 : 12 + axis] / m[15];
    return true;
}

enum { NAME, CHILDREN, MESH, SKIN, MATRIX, TRANSLATION, ROTATION, SCALE, CAMERA };
#define AT(member) offsetof(struct given_node, member)
static const struct zr_json_field fields[] = {
    [NAME] = {.key = "name", .read = zr_json_string, .offset = AT(name)},
    [CHILDREN] = {.key = "children", .read = zr_json_value_start, .offset = AT(children)},
    [MESH] = {.key = "mesh", .read = zr_gltf_index, .offset = AT(mesh)},
    [SKIN] = {.key = "skin", .read = zr_gltf_index, .offset = AT(skin)},
    [MATRIX] = {.key = "matrix", .read = read_matrix},
    [TRANSLATION] = {.key = "translation", .read = read_translation},
    [ROTATION] = {.key = "rotation", .read = zr_json_vec4, .offset = AT(rotation)},
    [SCALE] = {.key = "scale", .read = zr_json_vec3, .offset = AT(scale)},
    [CAMERA] = {.key = "camera", .read = zr_gltf_index, .offset = AT(camera)},
    {.key = "weights", .read = zr_json_value_start, .offset = AT(weights)},
    {.key = "extensions", .read = zr_json_value_start, .offset = AT(extensions)},
    {.key = "extras", .read = zr_gltf_ignore}};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("node", fields);

static bool has_length(zr_vec4 q)
{
    return q.x != 0.0f || q.y != 0.0f || q.z != 0.0f || q.w != 0.0f;
}

static zr_mat4 find_local(struct zr_gltf *file, const struct zr_json_path *path, const struct given_node *given)
{
    const uint64_t keys = file->given;
    const bool has_pose =
        zr_json_gives(keys, TRANSLATION) || zr_json_gives(keys, ROTATION) || zr_json_gives(keys, SCALE);
    if (zr_json_gives(keys, MATRIX)) {
        if (has_pose) zr_json_fault(&file->json, path, "two transformations: a matrix, and its parts");
        return given->matrix;
    }
    if (!has_pose) return zr_mat4_identity();
    return zr_mat4_of_pose(given->translation, given->rotation, given->scale);
}

static void read_node(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf_nodes *all = file->nodes;
    struct zr_node *node = &all->nodes[number];
    struct given_node given = {.mesh = ZR_GLTF_NONE,
                               .skin = ZR_GLTF_NONE,
                               .camera = ZR_GLTF_NONE,
                               .matrix = zr_mat4_identity(),
                               .rotation = {0, 0, 0, 1},
                               .scale = {1, 1, 1}};
    size_t children = 0;
    zr_gltf_fields(file, json, path, &object, &given);
    const uint64_t keys = file->given;
    if (!has_length(given.rotation)) {
        zr_gltf_note(&file->no_rotation, ZR_JSON_KEY(path, fields[ROTATION].key));
        given.rotation = (zr_vec4){0, 0, 0, 1};
    }
    *node = (struct zr_node){.local = find_local(file, path, &given), .mesh = ZR_NODE_NO_MESH};
    if (given.mesh != ZR_GLTF_NONE &&
        zr_gltf_check_index(file, ZR_JSON_KEY(path, fields[MESH].key), given.mesh, ZR_GLTF_MESHES)) {
        node->mesh = given.mesh;
        if (given.name && *given.name) node->name = given.name;
    }
    memcpy(all->exact[number], given.exact, sizeof given.exact);
    if (file->poses)
        file->poses[number] = (struct zr_gltf_pose){.translation = given.translation,
                                                    .rotation = given.rotation,
                                                    .scale = given.scale,
                                                    .has_matrix = zr_json_gives(keys, MATRIX)};
    all->skins[number] = given.skin;
    all->names[number] = given.name;
    all->cameras[number] = given.camera;
    if (given.camera != ZR_GLTF_NONE)
        zr_gltf_check_index(file, ZR_JSON_KEY(path, fields[CAMERA].key), given.camera, ZR_GLTF_CAMERAS);
    all->weights[number] = given.weights;
    all->instancing[number] = NULL;
    if (given.extensions)
        zr_gltf_find_extension(file, ZR_JSON_KEY(path, "extensions"), given.extensions, ZR_GLTF_INSTANCING,
                               &all->instancing[number]);
    all->lights[number] =
        given.extensions ? zr_gltf_find_light(file, ZR_JSON_KEY(path, "extensions"), given.extensions) : ZR_GLTF_NONE;
    if (given.skin != ZR_GLTF_NONE)
        zr_gltf_check_index(file, ZR_JSON_KEY(path, fields[SKIN].key), given.skin, ZR_GLTF_SKINS);
    all->places[number] = given.children;
    if (!given.children) return;
    struct zr_json there = zr_json_at(json, given.children);
    if (zr_json_count(&there, ZR_JSON_KEY(path, fields[CHILDREN].key), &children))
        node->child_count = (uint32_t)children;
    else
        all->places[number] = NULL;
}

/* ---- children ---- */

/* Adds a child to a node, unless it has another parent. */
static void read_child(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t parent)
{
    struct zr_gltf_nodes *all = file->nodes;
    struct zr_node *node = &all->nodes[parent];
    uint32_t child = 0;
    if (!zr_json_index(json, path, all->count, "nodes", &child)) return;
    if (all->parents[child] != ZR_GLTF_NONE) {
        zr_gltf_note(&file->second_parents, path);
        return;
    }
    all->parents[child] = parent;
    all->children[node->first_child + node->child_count++] = child;
}

static bool read_children(struct zr_gltf *file)
{
    struct zr_gltf_nodes *all = file->nodes;
    struct zr_arena *arena = file->json.arena;
    for (uint32_t i = 0; i < all->count; i++) {
        all->nodes[i].first_child = all->child_count;
        all->child_count += all->nodes[i].child_count; /* no overflow: each is a value of the text */
    }
    all->children = zr_arena_alloc(arena, all->child_count, sizeof *all->children);
    if (!all->children) return false;
    for (uint32_t i = 0; i < all->count && !zr_json_stops(&file->json); i++) {
        if (!all->places[i]) continue;
        const struct zr_json_path *node = ZR_GLTF_ITEM(ZR_GLTF_NODES, i),
                                  *path = ZR_JSON_KEY(node, fields[CHILDREN].key);
        struct zr_json there = zr_json_at(&file->json, all->places[i]);
        all->nodes[i].child_count = 0;
        zr_json_enter(&there, '[');
        for (size_t k = 0; zr_json_any_item(&there); k++)
            read_child(file, &there, ZR_JSON_ITEM(path, k), i);
    }
    return file->json.error->count == 0;
}

/* ---- the scene ---- */

static void push(struct zr_gltf_nodes *all, uint32_t node)
{
    if (all->is_drawn[node]) return;
    all->is_drawn[node] = true;
    all->stack[all->stacked++] = node;
}

struct given_scene {
    const char *nodes;
};
static const struct zr_json_field scene_fields[] = {
    {.key = "nodes", .read = zr_json_value_start, .offset = offsetof(struct given_scene, nodes)},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
static const struct zr_json_object scene_object = ZR_JSON_OBJECT_OF("scene", scene_fields);

static void read_root(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_gltf_nodes *all = file->nodes;
    uint32_t node;
    (void)number;
    if (!zr_json_index(json, path, all->count, "nodes", &node)) return;
    if (all->parents[node] != ZR_GLTF_NONE) zr_gltf_note(&file->child_roots, path);
    push(all, node);
}

/* Reads the scene `file->scene`, and skips the others. */
static void read_scene(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_scene given = {NULL};
    if (number != file->scene) {
        zr_json_skip(json);
        return;
    }
    zr_gltf_fields(file, json, path, &scene_object, &given);
    if (given.nodes) zr_gltf_read_items(file, given.nodes, ZR_JSON_KEY(path, scene_fields[0].key), read_root);
}

/* Finds the roots of the default scene, else of the first scene, else all nodes without a parent. */
static bool find_roots(struct zr_gltf *file)
{
    struct zr_gltf_nodes *all = file->nodes;
    struct zr_json *json = &file->json;
    file->scene = 0;
    if (file->places[ZR_GLTF_SCENE]) {
        struct zr_json there = zr_json_at(json, file->places[ZR_GLTF_SCENE]);
        zr_json_index(&there, ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_SCENE)), file->counts[ZR_GLTF_SCENES], "scenes",
                      &file->scene);
    }
    if (file->counts[ZR_GLTF_SCENES] > 0) {
        zr_gltf_read_list(file, ZR_GLTF_SCENES, read_scene);
    } else {
        for (uint32_t i = 0; i < all->count; i++)
            if (all->parents[i] == ZR_GLTF_NONE) push(all, i);
    }
    return json->error->count == 0;
}

/* Marks the descendants of the roots as drawn. */
static void find_drawn(struct zr_gltf_nodes *all)
{
    while (all->stacked > 0) {
        const struct zr_node *node = &all->nodes[all->stack[--all->stacked]];
        for (uint32_t k = 0; k < node->child_count; k++)
            push(all, all->children[node->first_child + k]);
    }
}

/* Takes nodes that the scene lists away from parents outside the scene, which do not move them. */
static void detach_roots(struct zr_gltf_nodes *all)
{
    for (uint32_t i = 0; i < all->count; i++) {
        const uint32_t parent = all->parents[i];
        if (!all->is_drawn[i] || parent == ZR_GLTF_NONE || all->is_drawn[parent]) continue;
        struct zr_node *node = &all->nodes[parent];
        uint32_t *children = &all->children[node->first_child], kept = 0;
        for (uint32_t k = 0; k < node->child_count; k++)
            if (children[k] != i) children[kept++] = children[k];
        node->child_count = kept;
        all->parents[i] = ZR_GLTF_NONE;
    }
}

/* Sets the matrices of the nodes that the animation moves. */
static bool animate(struct zr_gltf *file)
{
    if (!zr_gltf_animate(file)) return false;
    for (uint32_t i = 0; i < file->nodes->count; i++) {
        const struct zr_gltf_pose *pose = &file->poses[i];
        const bool has_rotation = has_length(pose->rotation);
        if (!pose->is_moved) continue;
        if (!has_rotation) zr_gltf_note(&file->no_rotation, ZR_GLTF_ITEM(ZR_GLTF_NODES, i));
        file->nodes->nodes[i].local =
            zr_mat4_of_pose(pose->translation, has_rotation ? pose->rotation : (zr_vec4){0, 0, 0, 1}, pose->scale);
    }
    return true;
}

/* Computes the matrices of all nodes to world space. */
static void find_worlds(struct zr_gltf_nodes *all)
{
    for (uint32_t i = 0; i < all->count; i++) {
        all->worlds[i] = all->nodes[i].local;
        if (all->parents[i] == ZR_GLTF_NONE) all->stack[all->stacked++] = i;
    }
    while (all->stacked > 0) {
        const uint32_t number = all->stack[--all->stacked];
        const struct zr_node *node = &all->nodes[number];
        for (uint32_t k = 0; k < node->child_count; k++) {
            const uint32_t child = all->children[node->first_child + k];
            all->worlds[child] = zr_mat4_mul(&all->worlds[number], &all->nodes[child].local);
            all->stack[all->stacked++] = child;
        }
    }
}

static bool is_shared(const struct zr_gltf_use *use)
{
    return use->skin == ZR_GLTF_NONE && !use->weights && !use->instancing && !use->pose;
}

/* Returns the entry of file->uses for a node's mesh.
 * Nodes with a skin, weights or instancing get a new entry. Others share one. */
static uint32_t use_of(struct zr_gltf *file, uint32_t node)
{
    const struct zr_gltf_nodes *all = file->nodes;
    uint32_t *next = &file->first_uses[all->nodes[node].mesh];
    const struct zr_gltf_pose *pose = file->poses && file->poses[node].weights ? &file->poses[node] : NULL;
    const bool is_own = all->skins[node] != ZR_GLTF_NONE || all->weights[node] || all->instancing[node] || pose;
    if (!is_own && *next != ZR_GLTF_NONE && is_shared(&file->uses[*next])) return *next;
    file->uses[file->use_count] = (struct zr_gltf_use){.skin = all->skins[node],
                                                       .weights = all->weights[node],
                                                       .instancing = all->instancing[node],
                                                       .pose = pose,
                                                       .node = node,
                                                       .next = *next};
    if (is_own && *next != ZR_GLTF_NONE && is_shared(&file->uses[*next])) { /* inserts it after the shared one */
        file->uses[file->use_count].next = file->uses[*next].next;
        next = &file->uses[*next].next;
    }
    return *next = file->use_count++;
}

/* Replaces the mesh of each node by an entry of file->uses. Removes the meshes of nodes outside the scene. */
static void find_uses(struct zr_gltf *file)
{
    struct zr_gltf_nodes *all = file->nodes;
    for (uint32_t i = 0; i < all->count; i++)
        if (!all->is_drawn[i])
            all->nodes[i].mesh = ZR_NODE_NO_MESH;
        else if (all->nodes[i].mesh != ZR_NODE_NO_MESH)
            all->nodes[i].mesh = use_of(file, i);
}

bool zr_gltf_read_nodes(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    const uint32_t count = file->counts[ZR_GLTF_NODES];
    struct zr_gltf_nodes *all = file->nodes = zr_arena_zero(arena, 1, sizeof *all);
    file->first_uses = zr_arena_alloc(arena, file->counts[ZR_GLTF_MESHES], sizeof *file->first_uses);
    file->uses = zr_arena_alloc(arena, count, sizeof *file->uses);
    if (!all || !file->first_uses) return false;
    memset(file->first_uses, 0xFF, file->counts[ZR_GLTF_MESHES] * sizeof *file->first_uses);
    all->skins = zr_arena_alloc(arena, count, sizeof *all->skins);
    all->cameras = zr_arena_alloc(arena, count, sizeof *all->cameras);
    all->lights = zr_arena_alloc(arena, count, sizeof *all->lights);
    all->names = zr_arena_alloc(arena, count, sizeof *all->names);
    all->weights = zr_arena_alloc(arena, count, sizeof *all->weights);
    all->instancing = zr_arena_alloc(arena, count, sizeof *all->instancing);
    all->worlds = zr_arena_alloc(arena, count, sizeof *all->worlds);
    all->exact = zr_arena_alloc(arena, count, sizeof *all->exact);
    all->count = count;
    all->nodes = zr_arena_zero(arena, count, sizeof *all->nodes);
    all->places = zr_arena_zero(arena, count, sizeof *all->places);
    all->parents = zr_arena_alloc(arena, count, sizeof *all->parents);
    all->is_drawn = zr_arena_zero(arena, count, sizeof *all->is_drawn);
    all->stack = zr_arena_alloc(arena, count, sizeof *all->stack);
    if (!zr_arena_ok(arena)) return false;
    memset(all->parents, 0xFF, count * sizeof *all->parents);
    if (!zr_gltf_read_list(file, ZR_GLTF_NODES, read_node) || !read_children(file) || !find_roots(file)) return false;
    if (file->poses && !animate(file)) return false;
    find_drawn(all);
    detach_roots(all);
    find_worlds(all);
    find_uses(file);
    for (uint32_t i = 0; i < count; i++) {
        if (all->is_drawn[i] && all->cameras[i] != ZR_GLTF_NONE)
            zr_gltf_place_camera(file, all->cameras[i], all->names[i], &all->worlds[i]);
        if (all->is_drawn[i] && all->lights[i] != ZR_GLTF_NONE)
            zr_gltf_place_light(file, i, all->lights[i], &all->worlds[i]);
    }
    return true;
}
