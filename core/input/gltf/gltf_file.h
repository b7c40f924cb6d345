/* gltf_file.h - input: types and functions that the readers of glTF share; private to them.
 *
 * Source: glTF 2.0 (Khronos, ISO/IEC 12113:2022).
 * Order:  the first pass stores the positions of the lists. Later passes read accessors, materials, nodes and meshes.
 *         Keys may therefore come in any order.
 * Keys:   unknown keys are skipped, as the format demands, and counted for one warning.
 * Lazy:   a buffer, accessor or image is checked at its first use by a drawn mesh or material.
 */
#ifndef ZR_GLTF_FILE_H
#define ZR_GLTF_FILE_H

#include "input/images/image_list.h"
#include "input/json/json_array.h"
#include "input/json/json_bytes.h"
#include "input/json/json_uris.h"
#include "input/model/model_scene.h"
#include "input/model/recenter_scene.h"
#include "scene/parts/nodes.h"

#define ZR_GLTF_NONE UINT32_MAX

/* Keys of the root. */
enum zr_gltf_key {
    ZR_GLTF_ASSET,
    ZR_GLTF_EXTENSIONS,
    ZR_GLTF_ACCESSORS,
    ZR_GLTF_BUFFER_VIEWS,
    ZR_GLTF_BUFFERS,
    ZR_GLTF_IMAGES,
    ZR_GLTF_MATERIALS,
    ZR_GLTF_MESHES,
    ZR_GLTF_NODES,
    ZR_GLTF_SAMPLERS,
    ZR_GLTF_SCENE,
    ZR_GLTF_SCENES,
    ZR_GLTF_TEXTURES,
    ZR_GLTF_ANIMATIONS,
    ZR_GLTF_CAMERAS,
    ZR_GLTF_SKINS,
    ZR_GLTF_USED,
    ZR_GLTF_REQUIRED,
    ZR_GLTF_KEYS
};

enum zr_gltf_state { ZR_GLTF_UNREAD, ZR_GLTF_READ, ZR_GLTF_REFUSED };

/* A URI. A noted one (json_uris.h) lies in the text of the file; others are copies with a final zero. */
struct zr_gltf_uri {
    const char *text; /* NULL: none */
    size_t size;
};

struct zr_gltf_buffer {
    uint32_t length;
    struct zr_gltf_uri uri;
    enum zr_gltf_state state;
    struct zr_parsed_bytes bytes; /* if READ: `length` bytes */
};

struct zr_draco_mesh; /* draco.h */

/* A range of bytes of a buffer. */
struct zr_gltf_span {
    uint32_t buffer, offset, length;
};

struct zr_gltf_view {
    struct zr_gltf_span span;
    uint32_t stride;          /* 0: packed */
    const char *compressed;   /* JSON text of the extension `compression`, or NULL */
    const char *compression;  /* EXT_meshopt_compression or KHR_meshopt_compression */
    enum zr_gltf_state state; /* state of `bytes`, the decompressed bytes */
    struct zr_parsed_bytes bytes;
    enum zr_gltf_state mesh_state;
    struct zr_draco_mesh *mesh; /* decoded from the bytes of the view, if mesh_state is READ */
};

/* Elements of an accessor that replace those of its view. */
struct zr_gltf_sparse {
    uint32_t count;
    uint32_t indices_view, indices_offset, indices_type;
    uint32_t values_view, values_offset;
};

struct zr_gltf_accessor {
    uint32_t view; /* or NONE: zeros */
    uint32_t offset, type, count;
    int shape; /* index of enum zr_gltf_shape */
    bool is_normalized;
    struct zr_gltf_sparse sparse; /* count 0: none */
    const unsigned char
        *decoded; /* packed elements of the primitive that is read now, instead of the view's; or NULL */
    uint32_t decoded_count;
};

/* `type` of an accessor, in the order of the table of its words. */
enum zr_gltf_shape {
    ZR_GLTF_SCALAR,
    ZR_GLTF_VEC2,
    ZR_GLTF_VEC3,
    ZR_GLTF_VEC4,
    ZR_GLTF_MAT2,
    ZR_GLTF_MAT3,
    ZR_GLTF_MAT4,
    ZR_GLTF_SHAPES
};

/* `componentType` of an accessor. */
enum {
    ZR_GLTF_INT8 = 5120,
    ZR_GLTF_UINT8 = 5121,
    ZR_GLTF_INT16 = 5122,
    ZR_GLTF_UINT16 = 5123,
    ZR_GLTF_UINT32 = 5125,
    ZR_GLTF_FLOAT32 = 5126
};

/* Elements of an accessor, after the check of their bytes. */
struct zr_gltf_values {
    const struct zr_gltf_accessor *accessor;
    uint32_t number, count; /* number of the accessor; count of its elements */
    uint32_t width;         /* components per element */
    bool is_normalized;
    const unsigned char *bytes; /* NULL: zeros */
    size_t stride;
    const unsigned char *sparse_indices, *sparse_values;
    double limit; /* of magnitudes, if they are read as floats; FLT_MAX until the caller sets it */
    bool mends;   /* elements that are not finite are read as 0, with a note */
    bool holes;   /* they are read as NaN, with another note */
};

/* Elements of an accessor. */
struct zr_gltf_range {
    uint32_t first, count;
};

/* A texture of the file: numbers of its image and its sampler. */
struct zr_gltf_texture {
    uint32_t source, sampler;
};

/* A mesh of the file with the skin, weights or instancing of one node. Nodes without these share one entry per mesh.
 * Each drawn primitive of an entry becomes a mesh of the scene. */
struct zr_gltf_use {
    uint32_t skin;                   /* or NONE */
    uint32_t next;                   /* next entry of the same mesh, or NONE */
    const char *weights;             /* JSON text of the node's weights, or NULL */
    const char *instancing;          /* JSON text of the node's instancing, or NULL */
    const struct zr_gltf_pose *pose; /* pose with the animation's weights, or NULL */
    uint32_t node;                   /* first node of the entry */
    uint32_t pose_count;             /* number of instances by instancing */
    const zr_mat4 *poses;
    uint32_t first, count; /* range of the scene's meshes */
};

/* The pose of a node, which the animation changes. */
struct zr_gltf_pose {
    zr_vec3 translation, scale;
    zr_vec4 rotation;
    bool has_matrix; /* the node has a matrix instead */
    bool is_moved;   /* the animation has set a part of the pose */
    uint32_t weight_count;
    const float *weights; /* weights of morph targets; NULL: those of the node or the mesh */
};

struct zr_gltf_image {
    struct zr_gltf_uri uri;
    uint32_t view; /* or NONE */
    enum zr_gltf_state state;
    uint32_t number;              /* if READ: number of the scene's image */
    struct zr_parsed_bytes bytes; /* of its file, once they are found */
};

/* Number of problems of one kind, and the path of the first one. */
struct zr_gltf_note {
    uint32_t count;
    char first[ZR_POINTER_SIZE];
};

/* State of a rehearsal. Textures list their images for decoding ahead, and are not made. */
struct zr_gltf_listing {
    struct zr_image_list *images;
    bool *has_material; /* one per material: true if it is listed */
};

/* Sets of texture coordinates that textures may name. */
enum { ZR_GLTF_SETS = 8 };

struct zr_gltf {
    struct zr_json json;
    struct zr_scene_builder *builder;
    struct zr_parsed_assets assets;
    struct zr_image_list decoded; /* images of the file */
    const char *places[ZR_GLTF_KEYS];
    uint32_t counts[ZR_GLTF_KEYS]; /* items per list */
    struct zr_json_uris uris;
    struct zr_parsed_bytes chunk; /* binary chunk of a GLB; bytes NULL if none */
    size_t size;                  /* of the file */
    uint64_t bytes;               /* size of the request, parts included */
    uint64_t given;               /* keys of the object that was read last, one bit each */
    struct zr_gltf_buffer *buffers;
    struct zr_gltf_view *views;
    struct zr_gltf_accessor *accessors;
    struct zr_gltf_texture *textures;
    struct zr_parsed_sampler *samplers;
    struct zr_gltf_image *images;
    struct zr_gltf_listing *listing; /* NULL: images are decoded */
    const char **material_places;    /* NULL after the material is read */
    struct zr_gltf_sets {
        uint32_t of[2];
    } sets, *material_sets; /* of the material that is read; of each material */
    uint32_t *first_uses;   /* one per mesh; NONE if no node of the scene places it */
    uint32_t use_count;
    struct zr_gltf_use *uses;
    struct zr_gltf_animation *animation; /* private to gltf_animation.c */
    struct zr_gltf_pose *poses;          /* one per node; NULL: no animation is drawn */
    struct zr_gltf_nodes *nodes;         /* made by gltf_node.c */
    uint32_t scene;                      /* number of the drawn scene */
    uint64_t primitives;                 /* number of primitives in all entries of `uses` */
    uint32_t use, next_mesh;             /* entry that is read now; next mesh of the scene to make */
    const char *weights;                 /* JSON text of the weights of the mesh that is read now, or NULL */
    struct zr_gltf_skin *skins;
    struct zr_model_camera *cameras; /* one per camera of the file */
    uint32_t light_count;
    struct zr_light *lights; /* the file's lights before they are placed; ZR_LIGHT_HEMISPHERE: not usable */
    bool *placed_cameras;    /* one per camera: a node of the scene places it */
    uint32_t *mesh_materials;
    const struct zr_recenter_move **moves; /* one per mesh of the scene, or NULL */
    struct zr_model_scene *made;
    struct zr_gltf_note child_roots, second_parents, no_rotation; /* nodes */
    struct zr_gltf_note holes;                                    /* positions that are not finite */
    struct zr_gltf_note short_buffers,
        other_counts; /* fewer bytes than byteLength; other counts than compressed data */
    struct zr_gltf_note missing_images, not_finite, third_sets, wide_texcoords, zero_strides, bad_cameras;
    struct zr_gltf_note unknown, no_positions, no_texcoords, no_source, clamped, left_over, empty, unread_channels,
        bad_lights, clamped_spots, specular_textures, gloss_textures, undrawn_textures;
    struct zr_gltf_note not_compressed, not_drawn; /* attributes of primitives with compressed data */
    uint32_t baked_count;
    struct zr_gltf_baked *baked; /* of specular and glossiness */
    bool requires_draco;
    bool has_fallbacks;              /* an extension replaces textures or accessors, whose files may be unused */
    uint32_t unread_extensions;      /* number of used extensions that are not read */
    struct zr_names_text extensions; /* names of these */
};

/* The nodes of a file. */
struct zr_gltf_nodes {
    uint32_t count, child_count;
    struct zr_node *nodes; /* `mesh`: number of a mesh of the file, later of an entry of file->uses */
    uint32_t *children;
    const char **places;                /* JSON text of the lists of children, or NULL */
    uint32_t *parents;                  /* or NONE */
    bool *is_drawn;                     /* the node is a root of the scene or its descendant */
    uint32_t *skins, *cameras, *lights; /* or NONE */
    const char **names;
    const char **weights, **instancing;
    zr_mat4 *worlds;
    double (*exact)[3]; /* translations of the local matrices */
    uint32_t *stack;    /* numbers of nodes to visit */
    size_t stacked;
};

/* ---- gltf_container.c ---- */

/* Finds the JSON and the binary chunk of a GLB. Other bytes are taken as JSON. Warns of bytes after the end. */
enum zr_status zr_gltf_unpack(struct zr_scene_builder *builder, const struct zr_parsed_bytes *file,
                              struct zr_parsed_bytes *text, struct zr_parsed_bytes *chunk, struct zr_error *error);

/* ---- gltf_json.c ---- */

/* Reads an object as zr_json_fields, but skips unknown keys, and counts them unless the object is open. Sets
 * file->given. zr_gltf_fields_at reads the object at `place`, which was skipped before. */
bool zr_gltf_fields(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                    const struct zr_json_object *object, void *out);
bool zr_gltf_fields_at(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                       const struct zr_json_object *object, void *out);

/* Readers of fields. zr_gltf_ignore skips a value. zr_gltf_index reads an index without a check of its upper bound. */
zr_json_read_fn zr_gltf_ignore, zr_gltf_index;

/* Read double[3] and double[4], of any magnitude. */
zr_json_read_fn zr_gltf_three, zr_gltf_four;

/* Rows of every object: skip `extras` and `extensions`. ZR_GLTF_NAME skips a name. */
#define ZR_GLTF_COMMON                                                                                                 \
    {.key = "extras", .read = zr_gltf_ignore},                                                                         \
    {                                                                                                                  \
        .key = "extensions", .read = zr_gltf_ignore                                                                    \
    }
#define ZR_GLTF_NAME                                                                                                   \
    {                                                                                                                  \
        .key = "name", .read = zr_gltf_ignore                                                                          \
    }

/* Counts the bytes of an array, and makes it. NULL beyond the limit of a quick reading, or without memory. */
void *zr_gltf_allocate(struct zr_gltf *file, size_t count, size_t size);

/* Counts a problem; stores the path of the first. */
void zr_gltf_note(struct zr_gltf_note *note, const struct zr_json_path *path);

/* Adds " 'NAME'" to the note of the first problem, with '?' for bytes that show nothing. */
void zr_gltf_note_name(struct zr_gltf_note *note, const char *name);

/* Returns a factor within its range; notes one beyond it. */
double zr_gltf_clamp(struct zr_gltf *file, const struct zr_json_path *path, double value, double low, double high);

/* Reads the items of a list of the root, or of the list at `place`. False after a fault. */
typedef void zr_gltf_item_fn(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                             uint32_t number);
bool zr_gltf_read_list(struct zr_gltf *file, enum zr_gltf_key key, zr_gltf_item_fn *read);
bool zr_gltf_read_items(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                        zr_gltf_item_fn *read);

/* Checks an index into a list of the root. False, and a fault at `path`, if it is too large. */
bool zr_gltf_check_index(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, enum zr_gltf_key of);

/* Keys of the root, and their names. */
extern const struct zr_json_object zr_gltf_root;
const char *zr_gltf_word(enum zr_gltf_key key);

/* The path of an item of a list of the root. */
#define ZR_GLTF_ITEM(key, number) ZR_JSON_ITEM(ZR_JSON_KEY(NULL, zr_gltf_word(key)), (number))

/* ---- gltf_buffer.c: buffers and views ---- */

/* Reads the lists of buffers and views. */
bool zr_gltf_read_buffers(struct zr_gltf *file);

/* Finds the bytes of a view. `path` leads to the key with its number. */
bool zr_gltf_find_view(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number,
                       struct zr_parsed_bytes *out);

/* True if the request has the bytes of a view's buffer. */
bool zr_gltf_has_view(struct zr_gltf *file, uint32_t number);

/* Reads a struct zr_gltf_uri. */
zr_json_read_fn zr_gltf_uri;

/* Returns true if a URI names a part of the request that is not there. */
bool zr_gltf_is_missing(struct zr_gltf *file, const struct zr_gltf_uri *uri);

/* Finds the bytes of a URI: a data: URI or a part of the request. `path` leads to the key with the URI. */
bool zr_gltf_find_uri(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_uri *uri,
                      struct zr_parsed_bytes *out);

/* ---- gltf_accessor.c: accessors; gltf_values.c: their elements ---- */

bool zr_gltf_read_accessors(struct zr_gltf *file);

/* Checks that all elements of an accessor are within its view. `path` leads to the key with its number. */
bool zr_gltf_open(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, struct zr_gltf_values *out);

/* Returns the bytes per component, or 0 if glTF has no such type. */
size_t zr_gltf_type_bytes(uint32_t type);

/* Converts a range of elements to floats: `width` numbers each, at out[i * step]. Other floats of `out` keep their
 * values. False, and a fault, if a number is not finite or its magnitude is beyond the limit. */
bool zr_gltf_read_floats(struct zr_gltf *file, const struct zr_gltf_values *values, const struct zr_gltf_range *range,
                         float *out, size_t step);

/* Reads all elements as indices, each below `end`. Sets *range from the smallest to the largest index. */
bool zr_gltf_read_indices(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t end, uint32_t *out,
                          struct zr_gltf_range *range);

/* ---- gltf_node.c; gltf_place.c ---- */

/* Reads the nodes and the scene, and makes the entries of file->uses. */
bool zr_gltf_read_nodes(struct zr_gltf *file);

/* Makes the instances of the meshes, after zr_gltf_read_meshes. */
void zr_gltf_place(struct zr_gltf *file);

/* ---- gltf_animation.c ---- */

/* Finds the animation that the request names. Makes file->poses if there is one; reports nothing if there is none. */
bool zr_gltf_choose_animation(struct zr_gltf *file, const struct zr_request *request);

/* Moves file->poses to the time of the request. False after a fault. */
bool zr_gltf_animate(struct zr_gltf *file);

/* ---- gltf_mesh.c, gltf_skin.c; gltf_parts.h has the parts of a mesh ---- */

/* Makes the meshes of the scene from the file's meshes that nodes place. */
bool zr_gltf_read_meshes(struct zr_gltf *file);

/* Reads the list of skins. */
bool zr_gltf_read_skins(struct zr_gltf *file);

/* ---- gltf_material.c, gltf_texture.c ---- */

bool zr_gltf_read_materials(struct zr_gltf *file);

/* Returns a material, and reads it at its first use. NULL after a fault. `path` leads to the key with its number. */
const struct zr_parsed_material *zr_gltf_find_material(struct zr_gltf *file, const struct zr_json_path *path,
                                                       uint32_t number);

/* Lists the images of a material in a rehearsal. */
void zr_gltf_list_images_of(struct zr_gltf *file, uint32_t material);

/* Returns the sets of texture coordinates that a material uses, one bit each. */
uint32_t zr_gltf_texcoords_of(const struct zr_parsed_material *material);

/* Returns the set of texture coordinates that a material has as its set `place`, 0 or 1. NONE: no material. */
uint32_t zr_gltf_set_of(const struct zr_gltf *file, uint32_t material, uint32_t place);

/* Reads the lists of textures, samplers and images. */
bool zr_gltf_read_textures(struct zr_gltf *file);

/* Reads a texture of a material: {"index", "texCoord", ...}. */
void zr_gltf_read_texture(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          enum zr_texture_slot slot, struct zr_parsed_texture *out);

/* ---- gltf_camera.c ---- */

/* Reads the list of cameras. */
bool zr_gltf_read_cameras(struct zr_gltf *file);

/* Removes the cameras that no node of the scene places. */
void zr_gltf_keep_cameras(struct zr_gltf *file);

/* Sets a camera's pose from the first node that places it, and its name if it has none.
 * `name`: the node's name, or NULL. */
void zr_gltf_place_camera(struct zr_gltf *file, uint32_t camera, const char *name, const zr_mat4 *camera_to_world);

/* ---- gltf_extension.c, gltf_light.c: extensions of the root; gltf_extensions.h has the others ---- */

/* Refuses required extensions that are not read. Lists used extensions that are not read for a warning. */
void zr_gltf_check_extensions(struct zr_gltf *file);

/* Reads the list of lights of KHR_lights_punctual. */
bool zr_gltf_read_lights(struct zr_gltf *file);

/* ---- gltf_warning.c ---- */

/* Adds the warnings of a file. */
void zr_gltf_warn(struct zr_gltf *file);

/* Returns the number of meshes that no node of the scene places. */
uint32_t zr_gltf_count_unplaced(const struct zr_gltf *file);

#endif
