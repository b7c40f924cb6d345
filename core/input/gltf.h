/* gltf.h - input: shared by the readers of a glTF file's parts, private to them.
 *
 * Source: glTF 2.0 (Khronos, ISO/IEC 12113:2022).
 * Order:  the text is read once, and the places of its lists are kept. Then each list is read by the one that needs it:
 *         accessors, materials, nodes, meshes. So keys may come in any order.
 * Keys:   unknown keys are skipped, as the format asks, and counted for one warning.
 * Lazy:   buffers, accessors and images are checked when something that is drawn uses them.
 */
#ifndef ZR_GLTF_H
#define ZR_GLTF_H

#include "input/file_scene.h"
#include "input/json_scene.h"

#define ZR_GLTF_NONE UINT32_MAX

/* Keys of the root. */
enum zr_gltf_key {
    ZR_GLTF_ASSET,
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

struct zr_gltf_buffer {
    uint32_t length;
    const char *uri;
    enum zr_gltf_state state;
    struct zr_parsed_bytes bytes; /* READ: `length` of them */
};

struct zr_gltf_view {
    uint32_t buffer, offset, length;
    uint32_t stride; /* 0: packed */
};

/* Elements of an accessor that differ from its view. */
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
};

/* `type` of an accessor, in the order of its words. */
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

/* Elements of an accessor whose bytes are checked. */
struct zr_gltf_values {
    const struct zr_gltf_accessor *accessor;
    uint32_t number, count; /* of the accessor; of its elements */
    uint32_t width;         /* components per element */
    bool is_normalized;
    const unsigned char *bytes; /* NULL: zeros */
    size_t stride;
    const unsigned char *sparse_indices, *sparse_values;
};

/* A texture of the file: an image and a sampler. */
struct zr_gltf_texture {
    uint32_t source, sampler;
};

/* A use of a mesh of the file: one mesh of the scene for each primitive that is drawn. Nodes without a skin and weights
 * of their own share one. */
struct zr_gltf_use {
    uint32_t skin;          /* or NONE */
    uint32_t next;          /* use of the same mesh, or NONE */
    const char *weights;    /* place of the node's, or NULL */
    const char *instancing; /* place of the node's, or NULL */
    uint32_t node;          /* the first one */
    uint32_t pose_count;    /* of instancing */
    const zr_mat4 *poses;
    uint32_t first, count; /* in the scene */
};

struct zr_gltf_image {
    const char *uri;
    uint32_t view; /* or NONE */
    enum zr_gltf_state state;
    uint32_t number; /* READ: in the scene */
};

/* First of a kind of oddities, and their number. */
struct zr_gltf_note {
    uint32_t count;
    char first[ZR_POINTER_SIZE];
};

struct zr_gltf {
    struct zr_parsed_scene root; /* its reader, builder, images and assets */
    const char *places[ZR_GLTF_KEYS];
    uint32_t counts[ZR_GLTF_KEYS]; /* of the items of lists */
    struct zr_parsed_bytes chunk;  /* binary chunk of a GLB; bytes NULL: none */
    uint64_t bytes;                /* of the request, parts included */
    struct zr_gltf_buffer *buffers;
    struct zr_gltf_view *views;
    struct zr_gltf_accessor *accessors;
    struct zr_gltf_texture *textures;
    struct zr_parsed_sampler *samplers;
    struct zr_gltf_image *images;
    const char **material_places; /* NULL: read */
    uint32_t *first_uses;         /* one per mesh, or NONE: no node of the scene places it */
    uint32_t use_count;
    struct zr_gltf_use *uses;
    struct zr_gltf_nodes *nodes; /* private to gltf_node.c */
    uint32_t scene;              /* number of the scene that is drawn */
    uint64_t primitives;         /* of all uses of meshes */
    uint32_t use, next_mesh;     /* that is read now; in the scene, the next one to make */
    const char *weights;         /* place of those of the mesh that is read now, or NULL */
    struct zr_gltf_skin *skins;
    struct zr_file_camera *cameras; /* one per camera of the file */
    bool *placed_cameras;           /* a node of the scene places it */
    uint32_t *mesh_materials;
    struct zr_file_scene *made;
    size_t made_bytes; /* of arrays of meshes */
    struct zr_gltf_note unknown, no_positions, no_texcoords, no_source, clamped, left_over, empty;
    uint32_t unread_extensions; /* used ones; their names: */
    struct zr_names_text extensions;
};

/* ---- gltf_container.c ---- */

/* Finds the JSON and the binary chunk of a GLB; other bytes are JSON. `warnings`: bytes behind the end. */
enum zr_status zr_gltf_unpack(struct zr_scene_builder *builder, const char *bytes, size_t size,
                              struct zr_parsed_bytes *text, struct zr_parsed_bytes *chunk, struct zr_error *error);

/* ---- gltf_json.c ---- */

/* Reads an object as zr_json_fields, but skips unknown keys. Counts those outside of `extensions` and `extras`. */
bool zr_gltf_fields(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                    const struct zr_json_object *object, void *out, uint64_t *given);

/* Readers of fields: skips a value; reads the index of something, whose count is not checked. */
zr_json_read_fn zr_gltf_ignore, zr_gltf_index;

/* Rows that every object has. Those of names that nobody reads. */
#define ZR_GLTF_COMMON                                                                                                 \
    {.key = "extras", .read = zr_gltf_ignore},                                                                         \
    {                                                                                                                  \
        .key = "extensions", .read = zr_gltf_ignore                                                                    \
    }
#define ZR_GLTF_NAME                                                                                                   \
    {                                                                                                                  \
        .key = "name", .read = zr_gltf_ignore                                                                          \
    }

/* Notes an oddity at `path`. */
void zr_gltf_note(struct zr_gltf_note *note, const struct zr_json_path *path);

/* Reads the items of a list of the root, or of the list at `place`. False after a fault. */
typedef void zr_gltf_item_fn(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                             uint32_t number);
bool zr_gltf_read_list(struct zr_gltf *file, enum zr_gltf_key key, zr_gltf_item_fn *read);
bool zr_gltf_read_items(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                        zr_gltf_item_fn *read);

/* Checks an index into a list of the root; false and reported at `path`. */
bool zr_gltf_check_index(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, enum zr_gltf_key of);

/* Keys of the root, and their names. */
extern const struct zr_json_object zr_gltf_root;
const char *zr_gltf_word(enum zr_gltf_key key);

/* Path of an item of a list of the root. */
#define ZR_GLTF_ITEM(key, number) ZR_JSON_ITEM(ZR_JSON_KEY(NULL, zr_gltf_word(key)), (number))

/* True if nothing more should be read. */
bool zr_gltf_stops(struct zr_gltf *file);

/* ---- gltf_buffer.c: buffers and views ---- */

/* Reads the lists of buffers and views. */
bool zr_gltf_read_buffers(struct zr_gltf *file);

/* Finds the bytes of a view. `path`: of the key that names it. */
bool zr_gltf_find_view(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number,
                       struct zr_parsed_bytes *out);

/* Finds the bytes of a URI: a data: URI or a part of the request. `path`: of the key with the URI. */
bool zr_gltf_find_uri(struct zr_gltf *file, const struct zr_json_path *path, const char *uri,
                      struct zr_parsed_bytes *out);

/* ---- gltf_accessor.c: accessors; gltf_values.c: their elements ---- */

bool zr_gltf_read_accessors(struct zr_gltf *file);

/* Checks that all elements of an accessor are within their bytes. `path`: of the key that names it. */
bool zr_gltf_open(struct zr_gltf *file, const struct zr_json_path *path, uint32_t number, struct zr_gltf_values *out);

/* Bytes of a component; 0 for no type of glTF. */
size_t zr_gltf_type_bytes(uint32_t type);

/* Reads elements first .. first + count - 1, converted to floats: `width` numbers each, at out[i * step]. Missing ones
 * keep their value. False, and reported, if a number is not finite or its magnitude is beyond `limit`. */
bool zr_gltf_read_floats(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t first, uint32_t count,
                         double limit, float *out, size_t step);

/* Reads all elements as indices, each below `end`. *low and *high: the smallest and the largest one. */
bool zr_gltf_read_indices(struct zr_gltf *file, const struct zr_gltf_values *values, uint32_t end, uint32_t *out,
                          uint32_t *low, uint32_t *high);

/* ---- gltf_node.c ---- */

/* Reads nodes and the scene; marks the meshes that they place. Then, once there are meshes, places them. */
bool zr_gltf_read_nodes(struct zr_gltf *file);
void zr_gltf_place(struct zr_gltf *file);

/* Returns the matrix of a node to world space, in the pose of the file. */
const zr_mat4 *zr_gltf_world_of(const struct zr_gltf *file, uint32_t node);

/* ---- gltf_instancing.c: EXT_mesh_gpu_instancing ---- */

/* Returns the place of the extension in a node's extensions, or NULL. */
const char *zr_gltf_find_instancing(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions);

/* Reads the poses of a use with instancing. False after a fault. */
bool zr_gltf_read_poses(struct zr_gltf *file, struct zr_gltf_use *use);

/* ---- gltf_mesh.c: the list; gltf_primitive.c: one primitive; gltf_topology.c: its faces, lines and points ---- */

/* Makes the scene's meshes of the placed ones. */
bool zr_gltf_read_meshes(struct zr_gltf *file);

/* `mode` of a primitive. */
enum {
    ZR_GLTF_POINTS,
    ZR_GLTF_LINES,
    ZR_GLTF_LINE_LOOP,
    ZR_GLTF_LINE_STRIP,
    ZR_GLTF_TRIANGLES,
    ZR_GLTF_TRIANGLE_STRIP,
    ZR_GLTF_TRIANGLE_FAN
};

/* Attributes of a primitive: numbers of accessors, or NONE. */
struct zr_gltf_attributes {
    uint32_t position, normal, tangent, texcoords[2], color, joints[2], weights[2];
};

struct zr_gltf_primitive {
    struct zr_gltf_attributes attributes;
    uint32_t indices, material, mode;
    const char *targets; /* place, or NULL */
};

/* The vertices that a primitive uses. */
struct zr_gltf_range {
    uint32_t first, count;
    uint32_t all; /* of its attribute POSITION */
};

/* Opens an attribute of the primitive's vertices: `shape` or `other`. `path`: of the object with the attributes. */
bool zr_gltf_open_attribute(struct zr_gltf *file, const struct zr_json_path *path, const char *name, uint32_t number,
                            int shape, int other, uint32_t vertices, struct zr_gltf_values *out);

/* Counts the bytes of an array that is to be made; false if a quick reading ends here. */
bool zr_gltf_note_bytes(struct zr_gltf *file, size_t bytes);

/* ---- gltf_morph.c, gltf_skin.c: both change the positions, normals and tangents of a mesh ---- */

/* Adds the primitive's targets by the weights of the node or of the mesh. `path`: of the primitive. */
bool zr_gltf_morph(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_primitive *given,
                   const struct zr_gltf_range *range, struct zr_mesh *mesh);

/* Checks the vertices that `by` ("a skin") has moved; `path`: of the primitive. */
bool zr_gltf_check_moved(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_mesh *mesh,
                         const char *by);

/* Reads the list of skins. */
bool zr_gltf_read_skins(struct zr_gltf *file);

/* Moves vertices to world space by the joints of the use that is read now. */
bool zr_gltf_bend(struct zr_gltf *file, const struct zr_json_path *path, const struct zr_gltf_primitive *given,
                  const struct zr_gltf_range *range, struct zr_mesh *mesh);

/* Fills a mesh; its name is set. False if there is nothing to draw, or after a fault. */
bool zr_gltf_make_primitive(struct zr_gltf *file, const struct zr_json_path *path,
                            const struct zr_gltf_primitive *given, struct zr_mesh *mesh, uint32_t number);

/* Makes faces, lines or points of `count` corners, in `corners` or consecutive (NULL). False if there are too few
 * corners, which is noted, or without memory. */
bool zr_gltf_make_topology(struct zr_gltf *file, const struct zr_json_path *path, uint32_t mode, uint32_t *corners,
                           uint32_t count, struct zr_mesh *mesh);

/* ---- gltf_material.c, gltf_texture.c ---- */

bool zr_gltf_read_materials(struct zr_gltf *file);

/* Returns a material, which is read now unless it was before; NULL after a fault. `path`: of the key that names it. */
const struct zr_parsed_material *zr_gltf_find_material(struct zr_gltf *file, const struct zr_json_path *path,
                                                       uint32_t number);

/* The sets of texture coordinates that a material uses, one bit each. */
uint32_t zr_gltf_texcoords_of(const struct zr_parsed_material *material);

/* Reads the lists of textures, samplers and images. */
bool zr_gltf_read_textures(struct zr_gltf *file);

/* Reads a texture of a material: {"index", "texCoord", ...}. False after a fault. */
bool zr_gltf_read_texture(struct zr_gltf *file, const char *place, const struct zr_json_path *path,
                          enum zr_texture_slot slot, struct zr_parsed_texture *out);

/* ---- gltf_camera.c ---- */

/* Reads the list of cameras; keeps those that nodes place. */
bool zr_gltf_read_cameras(struct zr_gltf *file);
void zr_gltf_keep_cameras(struct zr_gltf *file);

/* Notes the first node of the scene that places a camera. `name`: of the node, or NULL. */
void zr_gltf_place_camera(struct zr_gltf *file, uint32_t camera, const char *name, const zr_mat4 *camera_to_world);

/* ---- gltf_extension.c ---- */

/* Refuses required extensions that are not read, and notes used ones. */
void zr_gltf_check_extensions(struct zr_gltf *file);

/* Reads an object of extensions. Others than those of the table are skipped without a note. */
bool zr_gltf_extensions(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path,
                        const struct zr_json_object *object, void *out, uint64_t *given);

/* ---- gltf_warning.c ---- */

void zr_gltf_warn(struct zr_gltf *file);

/* Returns the number of meshes that no node of the scene places. */
uint32_t zr_gltf_count_unplaced(const struct zr_gltf *file);

#endif
