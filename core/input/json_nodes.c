/* The hierarchy of nodes as JSON has it -> the instances that it places. */
#include "input/json_scene.h"

#include <stdlib.h>
#include <string.h>

#include "input/text.h"
#include "scene/nodes.h"

enum { NAME, MESH, MATRIX, TRANSLATION, ROTATION, SCALE, CHILDREN, KEYS };
static const char *const words[] = {"name", "mesh", "matrix", "translation", "rotation", "scale", "children"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

/* ---- what names refer to ---- */

struct named {
    const char *name;
    uint32_t number;
};

/* Things that may be referred to by number, or by a name that only one of them has. */
struct directory {
    const char *one, *many; /* what they are called */
    uint32_t count;
    size_t named_count;
    struct named *named; /* sorted by name, then by number */
};

static struct directory open_directory(struct zr_arena *arena, const char *one, const char *many, uint32_t count)
{
    return (struct directory){one, many, count, 0, zr_arena_alloc(arena, count, sizeof(struct named))};
}

static void add_name(struct directory *directory, const char *name, uint32_t number)
{
    if (*name) directory->named[directory->named_count++] = (struct named){name, number};
}

static int compare_named(const void *left, const void *right)
{
    const struct named *a = left, *b = right;
    int order = strcmp(a->name, b->name);
    return order != 0 ? order : a->number < b->number ? -1 : a->number > b->number;
}

static void sort_names(struct directory *directory)
{
    qsort(directory->named, directory->named_count, sizeof *directory->named, compare_named);
}

/* The first of those that have the name, or where it would be. */
static size_t first_with_name(const struct directory *directory, const char *name)
{
    size_t low = 0, high = directory->named_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(directory->named[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool find_name(struct zr_json *json, const struct zr_json_path *path, const struct directory *directory,
                      const char *name, uint32_t *out)
{
    size_t first = first_with_name(directory, name);
    const struct named *found = &directory->named[first];
    struct zr_quote quote = zr_quote(name, strlen(name));
    if (first == directory->named_count || strcmp(found->name, name) != 0)
        return zr_json_fault(json, path, "no %s has the name %s", directory->one, quote.text);
    if (first + 1 < directory->named_count && strcmp(found[1].name, name) == 0)
        return zr_json_fault(json, path, "%s is ambiguous: %s %u and %u have this name", quote.text, directory->many,
                             found[0].number, found[1].number);
    *out = found->number;
    return true;
}

static bool read_reference(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                           const struct directory *directory, uint32_t *out)
{
    if (cJSON_IsString(node)) return find_name(json, path, directory, node->valuestring, out);
    if (!cJSON_IsNumber(node)) return zr_json_expect(json, path, node, "an index or a name");
    return zr_json_index(json, path, node, directory->count, directory->many, out);
}

/* ---- matrices ---- */

/* T · R · S. The quaternion is normalised by dividing products by its squared length, which
 * leaves turns by a right angle exact.
 * Source: glTF 2.0, section 3.5.3 "Transformations"; Shoemake, "Quaternions", 1991. */
static zr_mat4 matrix_of(zr_vec3 t, zr_vec4 q, zr_vec3 s)
{
    const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
    const double n = x * x + y * y + z * z + w * w;
    const double rotation[9] = {
        (w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n, 2 * (x * y - w * z) / n,
        (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n, 2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n,
        (w * w - x * x - y * y + z * z) / n};
    const double scale[3] = {(double)s.x, (double)s.y, (double)s.z};
    zr_mat4 out = zr_mat4_identity();
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            out.m[column * 4 + row] = (float)(rotation[column * 3 + row] * scale[column]);
    out.m[12] = t.x;
    out.m[13] = t.y;
    out.m[14] = t.z;
    return out;
}

static void read_parts(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found, zr_mat4 *out)
{
    zr_vec3 translation = {0, 0, 0}, scale = {1, 1, 1};
    zr_vec4 rotation = {0, 0, 0, 1};
    const struct zr_json_path *turn = ZR_JSON_KEY(path, words[ROTATION]);
    if (found[TRANSLATION]) zr_json_vec3(json, ZR_JSON_KEY(path, words[TRANSLATION]), found[TRANSLATION], &translation);
    if (found[SCALE]) zr_json_vec3(json, ZR_JSON_KEY(path, words[SCALE]), found[SCALE], &scale);
    if (found[ROTATION] && zr_json_vec4(json, turn, found[ROTATION], &rotation) && rotation.x == 0.0f &&
        rotation.y == 0.0f && rotation.z == 0.0f && rotation.w == 0.0f) {
        zr_json_fault(json, turn, "a quaternion of no length; 0 0 0 1 turns nothing");
        return;
    }
    *out = matrix_of(translation, rotation, scale);
}

static void read_local(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found, zr_mat4 *out)
{
    *out = zr_mat4_identity();
    if (!found[MATRIX]) {
        if (found[TRANSLATION] || found[ROTATION] || found[SCALE]) read_parts(json, path, found, out);
        return;
    }
    for (int key = TRANSLATION; key <= SCALE; key++)
        if (found[key]) zr_json_fault(json, path, "two transformations: %s and %s", words[MATRIX], words[key]);
    zr_json_affine(json, ZR_JSON_KEY(path, words[MATRIX]), found[MATRIX], out);
}

/* ---- nodes ---- */

/* Nodes while they are read. Children wait until every name is known. */
struct reader {
    struct zr_json *json;
    const struct zr_json_path *path; /* of the list */
    struct directory meshes, nodes;
    const cJSON **children; /* one list a node, or NULL */
    struct zr_node *made;
};

static void read_node(struct reader *reader, const struct zr_json_path *path, const cJSON *item, uint32_t number)
{
    struct zr_json *json = reader->json;
    struct zr_node *node = &reader->made[number];
    const cJSON *found[KEYS];
    const char *name;
    *node = (struct zr_node){.mesh = ZR_NODE_NO_MESH};
    reader->children[number] = NULL;
    if (!zr_json_object(json, path, item, &keys, found)) return;
    if (found[NAME] && zr_json_string(json, ZR_JSON_KEY(path, words[NAME]), found[NAME], &name)) {
        add_name(&reader->nodes, name, number);
        if (*name && found[MESH]) node->name = zr_json_keep(json, name);
    }
    if (found[MESH]) read_reference(json, ZR_JSON_KEY(path, words[MESH]), found[MESH], &reader->meshes, &node->mesh);
    read_local(json, path, found, &node->local);
    size_t count;
    if (found[CHILDREN] && zr_json_array(json, ZR_JSON_KEY(path, words[CHILDREN]), found[CHILDREN], &count)) {
        node->child_count = (uint32_t)count;
        reader->children[number] = found[CHILDREN];
    }
}

static const uint32_t *read_children(struct reader *reader, uint32_t *total)
{
    struct zr_json *json = reader->json;
    *total = 0;
    for (uint32_t i = 0; i < reader->nodes.count; i++) {
        reader->made[i].first_child = *total;
        *total += reader->made[i].child_count; /* values of one text: they fit */
    }
    uint32_t *children = zr_arena_alloc(json->arena, *total, sizeof *children), *next = children;
    if (!children) return NULL;
    for (uint32_t i = 0; i < reader->nodes.count; i++) {
        const struct zr_json_path *node = ZR_JSON_ITEM(reader->path, i), *path = ZR_JSON_KEY(node, words[CHILDREN]);
        const cJSON *item = reader->children[i] ? reader->children[i]->child : NULL;
        for (size_t k = 0; item && !zr_json_full(json); item = item->next, k++)
            read_reference(json, ZR_JSON_ITEM(path, k), item, &reader->nodes, next++);
    }
    return children;
}

static bool report(const struct reader *reader, const struct zr_placement *placement)
{
    struct zr_json *json = reader->json;
    const struct zr_json_path *node = ZR_JSON_ITEM(reader->path, placement->node);
    switch (placement->fault) {
    case ZR_NODES_GOOD:
        return true;
    case ZR_NODES_CYCLE:
        return zr_json_fault(json, ZR_JSON_ITEM(ZR_JSON_KEY(node, words[CHILDREN]), placement->child),
                             "a cycle: this child is the node itself, or has it for a descendant");
    case ZR_NODES_TOO_DEEP:
        return zr_json_fault(json, node, "nested too deep: below this node are more than the limit of %d levels",
                             (int)ZR_NODES_DEPTH_MAX - 1);
    case ZR_NODES_TOO_MANY:
        return zr_json_fault(json, reader->path, "the nodes place more than the limit of %u instances of meshes",
                             json->limits->instances_max);
    case ZR_NODES_OUT_OF_RANGE:
        return zr_json_fault(json, node, "the matrix to world space has an entry beyond %g", (double)ZR_MATRIX_MAX);
    }
    return false;
}

/* How many meshes no node places. In a hierarchy without cycles every node is below a root. */
static uint32_t count_unplaced(struct zr_arena *arena, const struct reader *reader)
{
    bool *placed = zr_arena_zero(arena, reader->meshes.count, sizeof *placed);
    uint32_t unplaced = placed ? reader->meshes.count : 0;
    for (uint32_t i = 0; placed && i < reader->nodes.count; i++) {
        uint32_t mesh = reader->made[i].mesh;
        if (mesh == ZR_NODE_NO_MESH || placed[mesh]) continue;
        placed[mesh] = true;
        unplaced--;
    }
    return unplaced;
}

static void read_all(struct reader *reader, const cJSON *list)
{
    uint32_t number = 0;
    sort_names(&reader->meshes);
    for (const cJSON *item = list->child; item && !zr_json_full(reader->json) && !zr_json_stopped(reader->json);
         item = item->next, number++)
        read_node(reader, ZR_JSON_ITEM(reader->path, number), item, number);
    reader->nodes.count = number;
    sort_names(&reader->nodes);
}

struct zr_instance *zr_draft_read_nodes(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list,
                                        const struct zr_mesh *meshes, uint32_t mesh_count, uint32_t *count)
{
    struct zr_json *json = &draft->json;
    struct zr_arena *arena = json->arena;
    size_t nodes;
    *count = 0;
    if (!zr_json_array(json, path, list, &nodes)) return NULL;
    struct reader reader = {.json = json,
                            .path = path,
                            .meshes = open_directory(arena, "mesh", "meshes", mesh_count),
                            .nodes = open_directory(arena, "node", "nodes", (uint32_t)nodes),
                            .children = zr_arena_alloc(arena, nodes, sizeof *reader.children),
                            .made = zr_arena_alloc(arena, nodes, sizeof *reader.made)};
    if (!zr_arena_ok(arena)) return NULL;
    for (uint32_t i = 0; i < mesh_count; i++)
        add_name(&reader.meshes, meshes[i].name, i);
    read_all(&reader, list);
    struct zr_nodes hierarchy = {.count = reader.nodes.count, .nodes = reader.made};
    hierarchy.children = read_children(&reader, &hierarchy.child_count);
    if (!zr_arena_ok(arena) || json->error->count > 0) return NULL;
    struct zr_placement placement = zr_nodes_place(arena, &hierarchy, json->limits->instances_max);
    if (!zr_arena_ok(arena) || !report(&reader, &placement)) return NULL;
    draft->unplaced_meshes = count_unplaced(arena, &reader);
    *count = placement.count;
    return placement.instances;
}
