/* json_scene.h - input: what the readers of a JSON scene's parts share.
 *
 * Order:  the text is read once. Lists of numbers go into arrays where they are met, and whatever needs another part of
 *         the scene (a material by its name, nodes, the base) waits until the root is read: so keys may come in any
 *         order.
 * Materials: a scene's materials are what it says of itself; a drawn mesh needs
 *         them resolved (base colour, shading, sidedness), where the mesh's own word goes
 *         before the material's, and that before the scene's.
 */
#ifndef ZR_JSON_SCENE_H
#define ZR_JSON_SCENE_H

#include "input/growing.h"
#include "input/json_value.h"
#include "scene/alpha_range.h"
#include "scene/face_style.h"
#include "scene/parsed_picture.h"
#include "scene/scene_builder.h"

/* Bytes have a name by one of two keys. */
struct zr_bytes_name {
    const char *uri, *asset; /* NULL: not given */
};

/* How texels become pixels: enum zr_filter and enum zr_wrap. */
struct zr_parsed_sampler {
    int magnify, minify, wrap_s, wrap_t;
};

/* A texture as a material has it. */
struct zr_parsed_texture {
    bool is_given;
    struct zr_bytes_name name;
    uint32_t texcoord;
    struct zr_parsed_sampler sampler;
    float offset[2], scale[2];
    double rotation; /* radians */
    float strength;  /* of normals and of occlusion */
    uint32_t number; /* 1 + that in the scene, once the root is read; 0: it was refused */
};

/* A material as the scene has it, under its name. */
struct zr_parsed_material {
    const char *name;
    size_t number; /* in the scene's list */
    uint64_t keys; /* those that it gives; the rest is the look's */
    zr_vec4 base_color, specular, cool;
    float shininess, metallic, roughness;
    zr_vec3 emissive;
    struct zr_parsed_texture textures[ZR_TEXTURE_SLOTS];
    struct zr_face_style face_style;
    bool is_used, is_masked; /* by a mesh, and by one whose alphaMode is MASK */
    uint32_t shadings;       /* those that its meshes have, a bit each */
};

/* What meshes say that shows nothing, or not what is meant: opacities that nothing is made of, or that hide all of a
 * mesh, and keys that nothing uses. Each kind is one warning, of the first mesh and how many more there are. */
enum zr_oddity {
    ZR_ODD_ALPHA,         /* an alpha below 1, and no word of what it is for */
    ZR_ODD_TEXTURE_ALPHA, /* the same of a baseColorTexture */
    ZR_ODD_UNSEEN,        /* BLEND, with an alpha of 0 everywhere */
    ZR_ODD_MASKED,        /* MASK, with an alpha below the cutoff everywhere */
    ZR_ODD_CUTOFF,        /* an alphaCutoff of its own, without MASK */
    ZR_ODD_EXPOSURE,      /* gooch, and an exposure or a tone mapping of the scene's */
    ZR_ODD_POINT_SIZE,    /* a pointSize without points */
    ZR_ODDITIES
};

/* What has it first: a mesh, or a polygon, by its number. */
struct zr_oddity_note {
    uint32_t count, number;
    bool is_polygon;
};

/* Colours of a lamp as they are given: see zr_read_light_color. */
struct zr_parsed_light_colors {
    zr_vec3 color, ground;
    float intensity;
};

/* A mesh as the scene has it, before what it refers to is known. */
struct zr_parsed_mesh;

/* The polygons of a scene, likewise. */
struct zr_soup;

/* Keys of a scene. */
enum zr_scene_key {
    ZR_SCENE_VERSION,
    ZR_SCENE_WINDOW,
    ZR_SCENE_LOOK,
    ZR_SCENE_BACKGROUND,
    ZR_SCENE_VIEW,
    ZR_SCENE_UP,
    ZR_SCENE_AMBIENT,
    ZR_SCENE_LIGHTS,
    ZR_SCENE_ENVIRONMENT,
    ZR_SCENE_MATERIALS,
    ZR_SCENE_MESHES,
    ZR_SCENE_POLYGONS,
    ZR_SCENE_OUTPUTS,
    ZR_SCENE_COLOR_MANAGEMENT,
    ZR_SCENE_TONE_MAPPING,
    ZR_SCENE_EXPOSURE,
    ZR_SCENE_SAMPLES,
    ZR_SCENE_LINE_WIDTH,
    ZR_SCENE_OCCLUSION,
    ZR_SCENE_GROUND_SHADOW,
    ZR_SCENE_EDGES,
    ZR_SCENE_CREASE_DEGREES,
    ZR_SCENE_ALGORITHM,
    ZR_SCENE_BASE,
    ZR_SCENE_NODES,
    ZR_SCENE_FOG,
    ZR_SCENE_COLOR_BAR
};

/* A scene while its JSON is being read. */
struct zr_parsed_scene {
    struct zr_json json;
    struct zr_scene_builder *builder;
    struct zr_scene *scene; /* the builder's */

    uint64_t keys; /* those of the root that are there */
    bool is_bare;  /* a mesh with keys of a query: its material keeps the colour of the look textbook */
    int algorithm, color_management;
    zr_vec4 background, ambient;
    struct zr_face_style face_style;  /* the scene's own */
    const struct zr_look *look;       /* the one that it names, or NULL */
    struct zr_parsed_picture picture; /* complete once the root is read */
    uint32_t light_count;
    struct zr_light *lights;                     /* without a direction: the scene's up */
    struct zr_parsed_light_colors *light_colors; /* of each */
    bool view_says_up;
    bool fog_has_color;
    const char *fit_mesh;       /* the name of the mesh that the view is fitted to, or NULL */
    const char *color_bar_mesh; /* that of the mesh whose scale the colour bar shows, or NULL */
    const char *nodes, *base;   /* where they are in the text, or NULL */

    size_t material_count;
    struct zr_parsed_material *materials; /* sorted by name */
    struct zr_growing meshes;             /* struct zr_parsed_mesh */
    struct zr_soup *soup;                 /* or NULL */

    struct zr_oddity_note oddities[ZR_ODDITIES];
    const char *linear_key; /* one that needs linear light, in whatever part of the scene; or NULL */

    size_t asset_count;
    const struct zr_asset *assets;
    bool *assets_used;
    struct zr_stored stored;
    struct zr_quick *quick;   /* the request's; may be NULL */
    struct zr_growing images; /* json_image.c's */
    uint64_t image_pixels;    /* of all of them */

    uint32_t unplaced_meshes; /* by any node */
};

extern const struct zr_json_field zr_scene_fields[]; /* json_scene_fields.c: enum zr_scene_key, and others */

static inline bool zr_scene_gives(const struct zr_parsed_scene *root, enum zr_scene_key key)
{
    return zr_json_gives(root->keys, (int)key);
}

/* The path of a key, as ZR_JSON_KEY has it. */
#define ZR_SCENE_PATH(which) ZR_JSON_KEY(NULL, zr_scene_fields[which].key)

/* What a mesh or a polygon says of its faces. */
struct zr_style {
    size_t material; /* index into root->materials, or material_count: none */
    struct zr_face_style face_style;
    bool is_uniform; /* has no colours of its own, whatever others of its mesh have */
    bool is_open;    /* an open surface: two-sided where nobody says otherwise */
    bool has_faces;  /* else what has it are lines and points */
    uint32_t number; /* of the mesh, or of the first polygon, that has it */
    bool is_polygon;
    struct zr_alpha_range alpha; /* of colours of its own */
};

/* json_material.c. The keys of a face style have the same names wherever they may stand: rows for the table of an
 * object that fills a `type`, whose member `faces` is a struct zr_face_style. That of a scene is one without sides:
 * those are a body's. */
#define ZR_FACE_STYLE_FIELDS(type, faces)                                                                              \
    {.key = "shading",                                                                                                 \
     .read = zr_json_choice,                                                                                           \
     .offset = offsetof(type, faces.shading),                                                                          \
     .words = &zr_shading_names,                                                                                       \
     .otherwise = "gouraud where there are normals or vertex colours, else flat",                                      \
     .text = "how faces are coloured"},                                                                                \
        {.key = "fill",                                                                                                \
         .read = zr_json_flag,                                                                                         \
         .offset = offsetof(type, faces.fill),                                                                         \
         .otherwise = "true",                                                                                          \
         .text = "false: faces are left out, and only their outlines are drawn"},                                      \
        {.key = "alphaMode",                                                                                           \
         .read = zr_json_choice,                                                                                       \
         .offset = offsetof(type, faces.alpha_mode),                                                                   \
         .words = &zr_alpha_mode_names,                                                                                \
         .otherwise = "OPAQUE",                                                                                        \
         .text = "what opacity does: nothing, or it is compared with alphaCutoff, or what is behind shows through"},   \
        {.key = "alphaCutoff",                                                                                         \
         .read = zr_json_float,                                                                                        \
         .offset = offsetof(type, faces.alpha_cutoff),                                                                 \
         .low = 0,                                                                                                     \
         .high = 1,                                                                                                    \
         .otherwise = "0.5",                                                                                           \
         .text = "of MASK: where the opacity is less, nothing is there"},                                              \
    {                                                                                                                  \
        .key = "outline", .read = zr_read_outline, .offset = offsetof(type, faces), .otherwise = "false",              \
        .text = "the edges of faces: true, false or a colour"                                                          \
    }
#define ZR_SIDES_FIELD(type, faces)                                                                                    \
    {                                                                                                                  \
        .key = "doubleSided", .read = zr_json_flag, .offset = offsetof(type, faces.double_sided),                      \
        .otherwise = "false", .text = "faces are seen from behind too"                                                 \
    }
zr_json_read_fn zr_read_outline; /* struct zr_face_style */

/* json_material.c: a list of materials; by their names, once the root is read; the index of one by its name, or
 * material_count, and a fault at `path`. */
zr_json_read_fn zr_read_materials; /* struct zr_parsed_scene, as all that follow */
void zr_parsed_sort_materials(struct zr_parsed_scene *root, const struct zr_json_path *path);
size_t zr_parsed_find_material(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name);

/* The number of the resolved material. coloured: the mesh has colours of its own;
 * smooth: it has normals or vertex colours. */
uint32_t zr_parsed_make_material(struct zr_parsed_scene *root, const struct zr_style *style, bool coloured,
                                 bool smooth);

/* json_oddities.c: notes what a mesh or a polygon, by its number, has; and warns of all that was noted, once there are
 * meshes. */
void zr_parsed_note_oddity(struct zr_parsed_scene *root, enum zr_oddity oddity, uint32_t number, bool is_polygon);
void zr_parsed_warn_of_oddities(struct zr_parsed_scene *root);

/* json_material.c: of materials that nothing uses, and of what they have for other shadings than those of their meshes.
 */
void zr_parsed_warn_of_materials(struct zr_parsed_scene *root);

/* json_mesh.c and json_polygons.c: read a list, and make meshes of it once the root is read: as many as root->meshes
 * has, and one, or none where there is no polygon. */
zr_json_read_fn zr_read_meshes, zr_read_polygons;
void zr_parsed_make_meshes(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *meshes);
bool zr_parsed_make_polygons(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *mesh);

/* json_nodes.c: the instances that nodes place, *count of them and room for one more; each
 * mesh is one of meshes[0..mesh_count-1]. NULL where there was a fault, here or before. */
struct zr_instance *zr_parsed_read_nodes(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                         const struct zr_mesh *meshes, uint32_t mesh_count, uint32_t *count);

/* json_mesh.c: once there are meshes, the number of the only one that has this name. False, and a fault at `path`,
 * where none has it, or two. */
bool zr_parsed_find_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name,
                         uint32_t *out);

/* json_view.c: over the defaults that scene->views[0] already has; json_view_fields.c: once there are meshes, the one
 * that the view is fitted to. */
zr_json_read_fn zr_read_view;
void zr_parsed_find_fit_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* json_color_bar.c: into the scene; and, once there are meshes, the one that it is of. */
zr_json_read_fn zr_read_color_bar;
void zr_parsed_find_color_bar_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* Into the scene, and lights into root->lights. */
zr_json_read_fn zr_read_fog, zr_read_lights, zr_read_outputs;

/* json_light_color.c: a zr_vec4, a colour of light: numbers are linear light, and a text is sRGB-encoded, whose parts
 * are negative until zr_light_color makes a colour of them, in linear light or, else, as it is given. */
zr_json_read_fn zr_read_light_color;
zr_vec3 zr_light_color(zr_vec3 given, bool is_linear);

/* Makes colours of those of lamps, of `ambient` and of the specular of materials, once it is known whether light is
 * linear. */
void zr_parsed_decode_light(struct zr_parsed_scene *root);

/* json_picture.c: notes, in `given`, which keys of an object of this name are given. */
void zr_parsed_note_keys(struct zr_parsed_picture *given, const char *name, const struct zr_json_object *object,
                         uint64_t keys);

/* Into root->look and root->picture. */
zr_json_read_fn zr_read_look, zr_read_up, zr_read_samples, zr_read_background, zr_read_environment, zr_read_occlusion,
    zr_read_edges;
extern const struct zr_names zr_management_names, zr_tone_names, zr_sample_names;

/* json_looks.c: what the scene does not say is as its look has it. First the picture, lamps, view and window; and, once
 * there are materials, whether light is linear, and what does not go with that. */
void zr_parsed_use_look(struct zr_parsed_scene *root);
void zr_parsed_check_light(struct zr_parsed_scene *root);

/* json_bytes.c: rows for the table of an object that fills a `type`, whose member `name` is a struct zr_bytes_name. */
#define ZR_BYTES_URI   "uri"
#define ZR_BYTES_ASSET "asset"
#define ZR_BYTES_NAME_FIELDS(type, name)                                                                               \
    {.key = ZR_BYTES_URI,                                                                                              \
     .read = zr_json_string,                                                                                           \
     .offset = offsetof(type, name.uri),                                                                               \
     .text = "a data: URI with the bytes"},                                                                            \
    {                                                                                                                  \
        .key = ZR_BYTES_ASSET, .read = zr_json_string, .offset = offsetof(type, name.asset),                           \
        .text = "the name of a part of the request, or sha256: and the hash of what was uploaded before"               \
    }

/* What a data: URI, {"uri": one}, {"asset": name} or {"asset": "sha256:..."} stands for. In the arena or the
 * request. */
struct zr_parsed_bytes {
    const void *bytes;
    size_t size;
};
bool zr_parsed_read_named(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_bytes_name *name, struct zr_parsed_bytes *out);
bool zr_parsed_read_bytes(struct zr_parsed_scene *root, struct zr_json *json, const struct zr_json_path *path,
                          struct zr_parsed_bytes *out);

/* json_image.c: the number of the image in scene->images that the bytes of this name are, decoded where they were not
 * asked for before; `path` is that of the object which has the keys of ZR_BYTES_NAME_FIELDS. False, and reported, where
 * it cannot be had. The bytes are not looked at before, and so keys may be read at any time, and images once the root
 * is read. */
bool zr_parsed_find_image(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_bytes_name *name, uint32_t *number);

/* Whether no texel of the image has an alpha below 1. Looks at its texels once. */
bool zr_parsed_image_is_opaque(const struct zr_parsed_scene *root, uint32_t number);

/* json_texture.c: reads an object into a struct zr_parsed_texture: that of a normal map and that of occlusion have a
 * key more. */
zr_json_read_fn zr_read_texture, zr_read_normal_texture, zr_read_occlusion_texture;

/* What materials need of their textures, in the scene: `path` is that of the list of materials. */
void zr_parsed_find_textures(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* The keys of materials that have textures, by enum zr_texture_slot. */
extern const char *const zr_texture_keys[ZR_TEXTURE_SLOTS];

/* Whether the material, by its number in the scene's list, has any; false of the number behind the last one. */
bool zr_parsed_has_textures(const struct zr_parsed_scene *root, size_t material);

/* Reports, at `path`, what a mesh lacks that is drawn with the material. */
bool zr_parsed_check_texcoords(struct zr_parsed_scene *root, const struct zr_json_path *path, size_t material,
                               bool has_texcoords, bool has_texcoords1);

/* json_base.c. Needs the window, the background, the view and the meshes. */
void zr_parsed_read_base(struct zr_parsed_scene *root, const struct zr_json_path *path);

#endif
