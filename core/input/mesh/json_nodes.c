/* Reads the hierarchy of nodes and makes the instances that it places. */
#include "input/json/json_matrix.h"
#include "input/json/json_placement.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/scene/kept.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "input/formats/quick.h"
#include "input/text/text.h"
#include "scene/camera/view_set.h"
#include "scene/parts/animation.h"

/* ---- references ---- */

struct named {
    const char *name;
    uint32_t number;
};

/* Things that a number or a unique name refers to. */
struct directory {
    const char *one, *many; /* nouns for messages */
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

/* Returns the index of the first entry with the name, or the place to insert it. */
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

static bool read_reference(struct zr_json *json, const struct zr_json_path *path, const struct directory *directory,
                           uint32_t *out)
{
    const enum zr_json_type type = zr_json_type(json);
    const char *name;
    if (type == ZR_JSON_STRING) return zr_json_string(json, path, &name) && find_name(json, path, directory, name, out);
    if (type != ZR_JSON_NUMBER) return zr_json_expect(json, path, "an index or a name");
    return zr_json_index(json, path, directory->count, directory->many, out);
}

/* ---- nodes ---- */

struct given_node {
    const char *name, *mesh, *children; /* mesh, children: places in the text, or NULL */
    struct given_matrix {
        zr_mat4 rounded;
        struct zr_matrix exact;
    } matrix;
    double translation[3], scale[3], rotation[4];
};

/* struct given_matrix */
static bool read_matrix(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct given_matrix *matrix = out;
    return zr_json_affine_exact(json, path, &matrix->rounded, &matrix->exact);
}

/* double[4] */
static bool read_rotation(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    double v[4] = {0};
    if (!zr_json_numbers(json, path, (struct zr_json_row){4, 4, -limit, limit}, v, NULL)) return false;
    memcpy(out, v, sizeof v);
    return true;
}

enum { NAME, MESH, MATRIX, TRANSLATION, ROTATION, SCALE, CHILDREN };
#define AT(member) offsetof(struct given_node, member)
static const struct zr_json_field fields[] = {
    [NAME] = {"name", zr_json_string, AT(name), .text = "name for parents and the output info"},
    [MESH] = {"mesh", zr_json_value_start, AT(mesh), .otherwise = "a group", .text = "number or name of a mesh",
              .schema = ZR_SCHEMA({"anyOf" : [ {"$ref" : "#/$defs/index"}, {"type" : "string"} ]})},
    [MATRIX] = {"matrix", read_matrix, AT(matrix), .otherwise = "the identity",
                .text = "transformation to the parent's space", .schema = ZR_SCHEMA_OF("affine")},
    [TRANSLATION] = {"translation", zr_json_place3, AT(translation), .unit = "scene units", .otherwise = "[0, 0, 0]",
                     .text = "translation, after scale and rotation"},
    [ROTATION] = {"rotation", read_rotation, AT(rotation), .otherwise = "[0, 0, 0, 1]",
                  .text = "rotation as a quaternion x, y, z, w, after scale", .schema = ZR_SCHEMA_OF("quaternion")},
    [SCALE] = {"scale", zr_json_doubles3, AT(scale), .otherwise = "[1, 1, 1]", .text = "factor per axis"},
    [CHILDREN] = {
        "children", zr_json_value_start, AT(children), .otherwise = "[]", .text = "numbers or names of child nodes",
        .schema =
            ZR_SCHEMA({"type" : "array", "items" : {"anyOf" : [ {"$ref" : "#/$defs/index"}, {"type" : "string"} ]}})}};
static const struct zr_json_rule rules[] = {
    {ZR_RULE_AGAINST, .text = "two transformations: %s and %s",
     .sets = {ZR_KEY(MATRIX), ZR_KEY(TRANSLATION) | ZR_KEY(ROTATION) | ZR_KEY(SCALE)}}};
const struct zr_json_object zr_json_object_node = {ZR_JSON_FIELDS("node", fields), ZR_JSON_RULES(rules)};

/* Pose of a node as read. */
struct own_pose {
    struct zr_node_pose pose;
    bool is_matrix;
};

/* Nodes while they are read. Children are resolved once every name is known. */
struct reader {
    struct zr_json *json;
    const struct zr_json_path *path; /* the list's */
    struct directory meshes, nodes;
    const char **children; /* the place of each node's list in the text, or NULL */
    struct zr_node *made;
    struct own_pose *own;    /* of each node, for an animation; or NULL */
    struct zr_matrix *exact; /* of each node of a far scene: its matrix; or NULL */
};

static zr_vec3 rounded(const double v[3])
{
    return (zr_vec3){(float)v[0], (float)v[1], (float)v[2]};
}

static zr_vec4 rounded_rotation(const struct given_node *given)
{
    const double *q = given->rotation;
    return (zr_vec4){(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
}

static zr_mat4 find_local(struct zr_json *json, const struct zr_json_path *path, const struct given_node *given,
                          uint64_t keys)
{
    const zr_vec4 q = rounded_rotation(given);
    if (zr_json_gives(keys, MATRIX)) return given->matrix.rounded;
    if (!(zr_json_gives(keys, TRANSLATION) || zr_json_gives(keys, ROTATION) || zr_json_gives(keys, SCALE)))
        return zr_mat4_identity();
    if (q.x == 0.0f && q.y == 0.0f && q.z == 0.0f && q.w == 0.0f)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[ROTATION].key),
                      "the quaternion has the length 0; 0 0 0 1 is no rotation");
    return zr_mat4_of_pose(rounded(given->translation), q, rounded(given->scale));
}

static struct own_pose own_pose_of(const struct given_node *given, bool is_exact, uint64_t keys)
{
    struct own_pose own = {.pose.is_exact = is_exact, .is_matrix = zr_json_gives(keys, MATRIX)};
    memcpy(own.pose.translation, given->translation, sizeof given->translation);
    memcpy(own.pose.scale, given->scale, sizeof given->scale);
    memcpy(own.pose.rotation, given->rotation, sizeof given->rotation);
    return own;
}

static void read_node(struct reader *reader, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct zr_node *node = &reader->made[number];
    struct given_node given = {.name = "", .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    uint64_t keys;
    *node = (struct zr_node){.mesh = ZR_NODE_NO_MESH};
    zr_json_fields(json, path, &zr_json_object_node, &given, &keys);
    add_name(&reader->nodes, given.name, number);
    if (*given.name && given.mesh) node->name = given.name;
    if (given.mesh) {
        struct zr_json there = zr_json_at(json, given.mesh);
        read_reference(&there, ZR_JSON_KEY(path, fields[MESH].key), &reader->meshes, &node->mesh);
    }
    node->local = find_local(json, path, &given, keys);
    if (reader->own) reader->own[number] = own_pose_of(&given, reader->exact != NULL, keys);
    if (reader->exact)
        reader->exact[number] = zr_json_gives(keys, MATRIX)
                                    ? given.matrix.exact
                                    : zr_matrix_of_pose(given.translation, given.rotation, given.scale);
    reader->children[number] = NULL;
    if (given.children) {
        struct zr_json there = zr_json_at(json, given.children);
        size_t count;
        if (!zr_json_count(&there, ZR_JSON_KEY(path, fields[CHILDREN].key), &count)) return;
        node->child_count = (uint32_t)count;
        reader->children[number] = given.children;
    }
}

static const uint32_t *read_children(struct reader *reader, uint32_t *total)
{
    struct zr_json *json = reader->json;
    *total = 0;
    for (uint32_t i = 0; i < reader->nodes.count; i++) {
        reader->made[i].first_child = *total;
        *total += reader->made[i].child_count; /* no overflow: each is a value of the text */
    }
    uint32_t *children = zr_arena_alloc(json->arena, *total, sizeof *children), *next = children;
    if (!children) return NULL;
    for (uint32_t i = 0; i < reader->nodes.count; i++) {
        const struct zr_json_path *node = ZR_JSON_ITEM(reader->path, i),
                                  *path = ZR_JSON_KEY(node, fields[CHILDREN].key);
        if (!reader->children[i]) continue;
        struct zr_json there = zr_json_at(json, reader->children[i]);
        zr_json_enter(&there, '[');
        for (size_t k = 0; zr_json_item(&there); k++)
            read_reference(&there, ZR_JSON_ITEM(path, k), &reader->nodes, next++);
    }
    return children;
}

/* Reads {"node": matrix}, which replace the nodes' own matrices. */
static void read_poses(struct reader *reader, struct zr_json *json, const struct zr_json_path *path)
{
    struct zr_json_text key;
    if (zr_json_type(json) != ZR_JSON_OBJECT) {
        zr_json_expect(json, path, "an object");
        return;
    }
    for (zr_json_enter(json, '{'); zr_json_member(json, &key);) {
        const char *name = zr_json_decode(json, &key);
        const struct zr_json_path *at = ZR_JSON_KEY(path, name ? name : "");
        uint32_t number;
        struct given_matrix matrix;
        if (!name) return;
        if (!read_matrix(json, at, &matrix) || !find_name(json, at, &reader->nodes, name, &number)) continue;
        reader->made[number].local = matrix.rounded;
        if (reader->exact) reader->exact[number] = matrix.exact;
    }
}

/* Reads the poses of a change. */
static void read_changed_poses(struct reader *reader, const struct zr_keeping *keeping)
{
    if (!keeping || !keeping->poses) return;
    struct zr_json there = *reader->json;
    zr_json_open(&there, keeping->poses, keeping->poses_size);
    read_poses(reader, &there, ZR_JSON_KEY(NULL, ZR_POSES));
}

/* Returns the animation that moves the nodes, or that has the scene as its set of views. */
static const struct zr_animation *animation_of(const struct zr_parsed_scene *root)
{
    const struct zr_keeping *keeping = root->builder->keeping;
    const struct zr_view_set *set = root->scene->view_set;
    return keeping && keeping->animation ? keeping->animation : set ? set->animation : NULL;
}

static void move_node(struct reader *reader, uint32_t number, const struct zr_track *track,
                      const struct zr_moment *moment)
{
    zr_mat4 *local = &reader->made[number].local;
    const struct zr_matrix before = reader->exact ? reader->exact[number] : zr_matrix_of(local),
                           after = zr_track_matrix(track, moment, &reader->own[number].pose, &before);
    for (int i = 0; i < 16; i++)
        local->m[i] = (float)after.m[i];
    if (reader->exact) reader->exact[number] = after;
}

/* Checks the nodes that an animation names. Moves them if the scene is that of a frame. */
static void animate(struct reader *reader, const struct zr_keeping *keeping, const struct zr_animation *animation)
{
    const struct zr_json_path *path = ZR_JSON_KEY(ZR_JSON_KEY(NULL, "animate"), "nodes");
    for (uint32_t i = 0; animation && i < animation->count; i++) {
        const struct zr_track *track = &animation->tracks[i];
        const struct zr_json_path *at = ZR_JSON_KEY(path, track->node);
        uint32_t number;
        if (!find_name(reader->json, at, &reader->nodes, track->node, &number)) continue;
        if (track->key_count > 0 && reader->own[number].is_matrix)
            zr_json_fault(reader->json, at, "node %" PRIu32 " has a matrix; translation, rotation and scale can move",
                          number);
        else if (keeping && keeping->animation)
            move_node(reader, number, track, &keeping->moment);
    }
}

/* Returns the number of meshes that no node places. In a hierarchy without cycles every node is below a root. */
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

struct zr_instance *zr_parsed_read_nodes(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                         const struct zr_parsed_poses *poses, const struct zr_mesh *meshes,
                                         uint32_t mesh_count, uint32_t *count)
{
    struct zr_json there = zr_json_at(&root->json, root->nodes), *json = &there;
    struct zr_arena *arena = json->arena;
    size_t nodes;
    *count = 0;
    if (!zr_json_count(json, path, &nodes)) return NULL;
    struct reader reader = {.json = json,
                            .path = path,
                            .meshes = open_directory(arena, "mesh", "meshes", mesh_count),
                            .nodes = open_directory(arena, "node", "nodes", (uint32_t)nodes),
                            .children = zr_arena_alloc(arena, nodes, sizeof *reader.children),
                            .made = zr_arena_alloc(arena, nodes, sizeof *reader.made)};
    const struct zr_animation *animation = animation_of(root);
    if (animation) reader.own = zr_arena_alloc(arena, nodes, sizeof *reader.own);
    if (json->far) reader.exact = zr_arena_alloc(arena, nodes, sizeof *reader.exact);
    if (!zr_arena_ok(arena)) return NULL;
    for (uint32_t i = 0; i < mesh_count; i++)
        add_name(&reader.meshes, meshes[i].name, i);
    sort_names(&reader.meshes);
    uint32_t number = 0;
    for (zr_json_enter(json, '['); zr_json_item(json); number++)
        read_node(&reader, json, ZR_JSON_ITEM(path, number), number);
    reader.nodes.count = number;
    sort_names(&reader.nodes);
    struct zr_nodes hierarchy = {.count = reader.nodes.count, .nodes = reader.made, .exact = reader.exact};
    read_changed_poses(&reader, root->builder->keeping);
    animate(&reader, root->builder->keeping, animation);
    if (poses) {
        struct zr_json given = zr_json_at(&root->json, poses->place);
        read_poses(&reader, &given, poses->path);
    }
    hierarchy.children = read_children(&reader, &hierarchy.child_count);
    if (!zr_arena_ok(arena) || json->error->count > 0) return NULL;
    struct zr_quick *quick = root->assets.quick;
    const uint64_t most = zr_json_visits_max(json, reader.nodes.count);
    const uint64_t quick_most = quick && quick->node_visits_max < most ? quick->node_visits_max : most;
    struct zr_placement placement = zr_nodes_place(arena, &hierarchy, json->limits->instances_max, quick_most);
    if (placement.fault == ZR_NODES_TOO_MANY_VISITS && placement.visits <= most) {
        zr_quick_exceed(quick, json->error);
        return NULL;
    }
    if (!zr_arena_ok(arena) || zr_is_cancelled(arena->cancel) ||
        !zr_json_check_placement(json, path, reader.nodes.count, fields[CHILDREN].key, &placement))
        return NULL;
    root->unplaced_meshes = count_unplaced(arena, &reader);
    root->exact = placement.exact;
    *count = placement.count;
    return placement.instances;
}
