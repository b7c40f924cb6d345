/* json_scene.h - input: shared by the readers of a JSON scene's parts, private to them.
 *
 * Order:  the text is read once, and lists of numbers go into arrays directly. A key that refers to another part of the
 *         scene (a material's name, nodes, the base) is resolved once the root is read. So keys may come in any order.
 */
#ifndef ZR_JSON_SCENE_H
#define ZR_JSON_SCENE_H

#include "input/images/image_list.h"
#include "input/json/json_bytes.h"
#include "input/json/json_list.h"
#include "input/json/json_value.h"
#include "input/model/parsed_material.h"
#include "scene/scene_builder.h"

/* Oddities of meshes: keys or opacities without the effect that they suggest. Each kind is one warning, which names the
 * first mesh and counts the others. */
enum zr_oddity {
    ZR_ODD_ALPHA,         /* an alpha below 1 without an alphaMode */
    ZR_ODD_TEXTURE_ALPHA, /* the same for a baseColorTexture */
    ZR_ODD_UNSEEN,        /* BLEND with an alpha of 0 everywhere */
    ZR_ODD_MASKED,        /* MASK with an alpha below the cutoff everywhere */
    ZR_ODD_CUTOFF,        /* an alphaCutoff without MASK */
    ZR_ODD_POINT_SIZE,    /* a pointSize without points */
    ZR_ODDITIES
};

/* The count of one oddity, and the number of the first mesh or polygon that has it. */
struct zr_oddity_note {
    uint32_t count, number;
    bool is_polygon;
};

/* Colours of a lamp, as read: see zr_read_light_color. */
struct zr_parsed_light_colors {
    zr_vec3 color, ground;
    float intensity;
};

/* A mesh as read, its references unresolved. */
struct zr_parsed_mesh;

/* The polygons of a scene, likewise. */
struct zr_soup;

struct zr_kept; /* kept.h */

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
    ZR_SCENE_COLOR_BAR,
    ZR_SCENE_ANNOTATE,
    ZR_SCENE_TITLE,
    ZR_SCENE_DIMENSIONS,
    ZR_SCENE_MARKS,
    ZR_SCENE_RENDER,
    ZR_SCENE_VISIBILITY,
    ZR_SCENE_FEATURES,
    ZR_SCENE_PICKS,
    ZR_SCENE_DISTANCES,
    ZR_SCENE_HIDE,
    ZR_SCENE_ISOLATE,
    ZR_SCENE_GHOST,
    ZR_SCENE_HIGHLIGHT,
    ZR_SCENE_EXPLODE,
    ZR_SCENE_COLORS,
    ZR_SCENE_SECTIONS,
    ZR_SCENE_CSG,
    ZR_SCENE_VIEWS,
    ZR_SCENE_TURNTABLE,
    ZR_SCENE_ORBIT,
    ZR_SCENE_SHEET,
    ZR_SCENE_ANIMATE
};

enum { ZR_SCENE_KEYS_MAX = 64 };

/* The target of the channel flow: places in the text, or NULL. */
struct zr_parsed_flow {
    const char *view, *poses;
    uint32_t output; /* number of the output */
};

/* Matrices by names of nodes that override those of the scene. */
struct zr_parsed_poses {
    const char *place; /* in the text */
    const struct zr_json_path *path;
};

/* A JSON scene while it is read. */
struct zr_parsed_scene {
    struct zr_json json;
    struct zr_scene_builder *builder;
    struct zr_scene *scene; /* the builder's */

    uint64_t keys; /* bit i: key i of the root is given */
    bool is_bare;  /* a bare mesh: without baseColorFactor, the default colour of the look applies */
    int algorithm, color_management;
    zr_vec4 background, ambient;
    struct zr_face_style face_style; /* of the root */
    const struct zr_look *look;      /* of the key `look`, or NULL */
    struct zr_parsed_picture *picture;
    uint32_t light_count;
    struct zr_light *lights;                     /* direction 0: the scene's up, set later */
    struct zr_parsed_light_colors *light_colors; /* one per light */
    bool view_has_up;
    bool fog_has_color;
    const char *fit_mesh; /* name of the mesh that the view is fitted to, or NULL */
    const char *camera;   /* name or number of the model file's camera that is the view, or NULL */
    bool gives_projection, gives_znear, gives_zfar; /* keys of the view that override the camera's */
    const char *color_bar_mesh;                     /* name of the mesh whose scale the colour bar shows, or NULL */
    const char *nodes, *base;                       /* places in the text, or NULL */
    struct zr_parsed_flow flow;                     /* of the output flow */

    size_t material_count;
    int keeps_materials;                   /* 1: materials of model files stay, in looks that are a material, too */
    struct zr_parsed_material *materials;  /* sorted by name */
    struct zr_growing meshes;              /* struct zr_parsed_mesh */
    struct zr_soup *soup;                  /* or NULL */
    const char *meshes_end, *polygons_end; /* places in the text after both lists; NULL: not there */

    struct zr_oddity_note oddities[ZR_ODDITIES];
    uint32_t shadings;      /* bit i: a filled face has the shading i */
    const char *linear_key; /* the name of a key, anywhere in the scene, that needs linear light; or NULL */

    struct zr_parsed_assets assets;
    struct zr_image_list images;
    struct zr_bytes_name environment_file; /* image of the key environment */

    uint32_t unplaced_meshes; /* meshes that no node places */
    struct zr_matrix *exact;  /* of a far scene: matrices of the instances that nodes place, with room for one more */
    const uint32_t *model_firsts; /* per mesh of the list: number of its file's second mesh; or NULL (json_model.c) */
};

extern const struct zr_json_field zr_scene_fields[]; /* json_scene_fields.c: enum zr_scene_key, then other keys */

static inline bool zr_scene_gives(const struct zr_parsed_scene *root, enum zr_scene_key key)
{
    return zr_json_gives(root->keys, (int)key);
}

/* The path of a key of the root. */
#define ZR_SCENE_PATH(which) ZR_JSON_KEY(NULL, zr_scene_fields[which].key)

/* Draw style of a mesh or a polygon, as read. */
struct zr_style {
    size_t material; /* index into root->materials, or material_count: none */
    struct zr_face_style face_style;
    bool is_uniform; /* without colours of its own, though others of its mesh may have some */
    bool is_open;    /* an open surface: two-sided by default */
    bool has_faces;  /* false: it has only lines and points */
    uint32_t number; /* number of the mesh, or of the first polygon, with this style */
    bool is_polygon;
    bool blends;                 /* blended, unless an alphaMode applies */
    struct zr_alpha_range alpha; /* alpha range of its own colours */
};

/* json_material.c. Keys of a face style, with the same names in all objects: rows for the table of an object that fills
 * a `type`, whose member `faces` is a struct zr_face_style. doubleSided has its own row, since a scene lacks it. */
#define ZR_FACE_STYLE_FIELDS(type, faces)                                                                              \
    {.key = "shading",                                                                                                 \
     .read = zr_json_choice,                                                                                           \
     .offset = offsetof(type, faces.shading),                                                                          \
     .words = &zr_shading_names,                                                                                       \
     .otherwise = "gouraud if there are normals or vertex colours, else flat",                                         \
     .text = "model of reflection"},                                                                                   \
        {.key = "fill",                                                                                                \
         .read = zr_json_flag,                                                                                         \
         .offset = offsetof(type, faces.fill),                                                                         \
         .otherwise = "true",                                                                                          \
         .text = "filled faces; false: outlines only"},                                                                \
        {.key = "alphaMode",                                                                                           \
         .read = zr_json_choice,                                                                                       \
         .offset = offsetof(type, faces.alpha_mode),                                                                   \
         .words = &zr_alpha_mode_names,                                                                                \
         .otherwise = "OPAQUE",                                                                                        \
         .text = "use of opacity: OPAQUE ignores it, MASK compares it with alphaCutoff, BLEND blends"},                \
        {.key = "alphaCutoff",                                                                                         \
         .read = zr_json_float,                                                                                        \
         .offset = offsetof(type, faces.alpha_cutoff),                                                                 \
         .low = 0,                                                                                                     \
         .high = 1,                                                                                                    \
         .otherwise = "0.5",                                                                                           \
         .text = "MASK: smallest opacity that is drawn"},                                                              \
    {                                                                                                                  \
        .key = "outline", .read = zr_read_outline, .offset = offsetof(type, faces), .otherwise = "false",              \
        .text = "outlines of faces: true, false or a colour"                                                           \
    }
#define ZR_SIDES_FIELD(type, faces)                                                                                    \
    {                                                                                                                  \
        .key = "doubleSided", .read = zr_json_flag, .offset = offsetof(type, faces.double_sided),                      \
        .otherwise = "false", .text = "both sides of faces"                                                            \
    }
zr_json_read_fn zr_read_outline; /* struct zr_face_style */

/* json_material.c: reads a list of materials; sorts them by name, once the root is read; finds one by name. An unknown
 * name is a fault at `path` and gives material_count. */
zr_json_read_fn zr_read_materials; /* struct zr_parsed_scene, as for all that follow */
void zr_parsed_sort_materials(struct zr_parsed_scene *root, const struct zr_json_path *path);
size_t zr_parsed_find_material(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name);

/* Resolves a material and returns its number. coloured: the mesh has its own colours; smooth: it has normals or vertex
 * colours. */
uint32_t zr_parsed_make_material(struct zr_parsed_scene *root, const struct zr_style *style, bool coloured,
                                 bool smooth);

/* The same for a mesh, which sets has_faces and alpha of the style. blends: colours of the mesh with an alpha below 1
 * are blended, unless an alphaMode applies. */
uint32_t zr_parsed_make_mesh_material(struct zr_parsed_scene *root, const struct zr_style *style,
                                      const struct zr_mesh *mesh, bool smooth, bool blends);

/* json_oddities.c: notes an oddity of mesh or polygon `number`; warns of all that were noted, once there are meshes. */
void zr_parsed_note_oddity(struct zr_parsed_scene *root, enum zr_oddity oddity, uint32_t number, bool is_polygon);
void zr_parsed_warn_of_oddities(struct zr_parsed_scene *root);

/* json_material.c: warns of unused materials, and of keys without effect in the shadings of their meshes. */
void zr_parsed_warn_of_materials(struct zr_parsed_scene *root);

/* json_mesh.c, json_polygons.c and json_soup.c: read a list; make its meshes once the root is read. The list `meshes`
 * makes root->meshes.count meshes, and more if model files have several. Polygons make one mesh, if there are any. */
zr_json_read_fn zr_read_meshes, zr_read_polygons;
void zr_parsed_make_meshes(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *meshes);
bool zr_parsed_has_polygons(const struct zr_parsed_scene *root);
void zr_parsed_make_polygons(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *mesh);

/* json_model.c: meshes that are model files. Numbers their meshes beyond the first of each file, from `first` on; sets
 * scene->mesh_owners, or leaves it NULL if there are no files; returns their count. */
uint32_t zr_parsed_number_models(struct zr_parsed_scene *root, uint32_t first);

/* Sets the view to root->camera, in the first instance of a file that has this camera.
 * A fault at `path` if there is none. */
void zr_parsed_use_model_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                const struct zr_instance *instances, uint32_t count);

/* Replaces each instance of a file by the instances of its meshes. Returns the new array and its length in *count; the
 * given one if there are no files; NULL after a fault at `path`. */
struct zr_instance *zr_parsed_place_models(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                           struct zr_instance *instances, uint32_t *count);

/* json_kept.c: keeps the parsed root before references are resolved, or gives the kept meshes to the root (kept.h).
 * False without memory. */
bool zr_kept_save(struct zr_kept *kept, struct zr_parsed_scene *root);
bool zr_kept_load(const struct zr_kept *kept, struct zr_parsed_scene *root);

/* json_nodes.c: returns the instances that nodes place, *count of them, with room for one more. Each mesh is one of
 * meshes[0..mesh_count-1]. `poses`: NULL, or read last. NULL after a fault, here or before. */
struct zr_instance *zr_parsed_read_nodes(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                         const struct zr_parsed_poses *poses, const struct zr_mesh *meshes,
                                         uint32_t mesh_count, uint32_t *count);

/* json_instances.c: returns the instances that nodes or meshes make, *count of them. `poses`: NULL, or those of a flow;
 * the order is the same. NULL after a fault. */
struct zr_instance *zr_parsed_make_instances(struct zr_parsed_scene *root, const struct zr_parsed_poses *poses,
                                             uint32_t *count);

/* json_flow.c: reads the key `to` of an output, a struct zr_parsed_flow. */
zr_json_read_fn zr_read_flow;

/* json_flow.c: finds the target of the flow, after the instances. */
void zr_parsed_find_flow(struct zr_parsed_scene *root);

/* json_mesh.c: finds the number of the mesh with this name, once there are meshes. False, and a fault at `path`, if
 * none or several have it. */
bool zr_parsed_find_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name,
                         uint32_t *out);

/* json_view.c: reads a view over the defaults in scene->views[0]. json_view_fields.c: finds the mesh that the view is
 * fitted to, once there are meshes. */
zr_json_read_fn zr_read_view;
void zr_parsed_find_fit_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* json_picks.c: reads pixels into the view, and pairs of parts. */
zr_json_read_fn zr_read_picks, zr_read_distances;

/* json_annotate.c: reads words, the title and dimensions into the view. */
zr_json_read_fn zr_read_annotate, zr_read_title, zr_read_dimensions, zr_read_marks;

/* json_color_bar.c: reads the colour bar into the scene, and finds its mesh once there are meshes. */
zr_json_read_fn zr_read_color_bar;
void zr_parsed_find_color_bar_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* json_parts.c: reads the keys of parts into the scene. */
zr_json_read_fn zr_read_hide, zr_read_isolate, zr_read_ghost, zr_read_highlight, zr_read_explode, zr_read_colors;
extern const struct zr_names zr_part_color_names;
zr_json_read_fn zr_read_csg; /* json_csg.c */

/* Reads one pattern or a list of patterns. */
bool zr_read_part_set(struct zr_json *json, const struct zr_json_path *path, struct zr_part_set *out);

/* Read into the scene; lights into root->lights. */
zr_json_read_fn zr_read_window; /* json_window.c */
zr_json_read_fn zr_read_fog, zr_read_lights, zr_read_outputs, zr_read_sections;
zr_json_read_fn zr_read_views, zr_read_turntable, zr_read_orbit, zr_read_sheet; /* json_views.c */
zr_json_read_fn zr_read_animate;                                                /* json_animate.c */

/* json_views.c: adds a set of views to the scene, which has at most one. NULL if it has one, which is reported, or
 * without memory. */
struct zr_view_set *zr_view_set_add(struct zr_json *json, const struct zr_json_path *path, struct zr_scene *scene);
bool zr_view_count_check(struct zr_json *json, const struct zr_json_path *path, size_t count);

/* json_light.c: zr_vec4, a colour of light. Numbers are linear light. A text is sRGB-encoded and is stored
 * negated until zr_light_color (model/parsed_material.h) decodes it: to linear light, or to the values as written if
 * light is not linear. */
zr_json_read_fn zr_read_light_color;

/* Decodes the colours of lamps, of `ambient` and of materials' specular, once scene->picture->is_linear is known. */
void zr_parsed_decode_light(struct zr_parsed_scene *root);

/* json_picture.c: marks the given keys of the object `name` in `given`. */
void zr_parsed_note_keys(struct zr_parsed_picture *given, const char *name, const struct zr_json_object *object,
                         uint64_t keys);

/* Read into root->look and root->picture. */
zr_json_read_fn zr_read_look, zr_read_up, zr_read_samples, zr_read_background, zr_read_environment, zr_read_occlusion,
    zr_read_edges;
extern const struct zr_names zr_management_names, zr_tone_names, zr_sample_names, zr_file_material_names;

/* json_looks.c: fills keys that the scene does not give from its look: the picture, lamps, view and window. Then, once
 * there are materials, decides on linear light and reports keys that exclude it. */
void zr_parsed_use_look(struct zr_parsed_scene *root);

/* json_picture.c: reads the image of the key environment, if it has one that is not read. False after a fault. A quick
 * reading stops. */
bool zr_parsed_read_environment(struct zr_parsed_scene *root);
void zr_parsed_check_light(struct zr_parsed_scene *root);

/* json_image.c: finds the index in scene->images of the image with these bytes; each is decoded once. `path`: of the
 * object with the keys of ZR_BYTES_NAME_FIELDS. False, and reported, on failure. The bytes are read only here, so the
 * keys may be read at any time, and images once the root is read. */
bool zr_parsed_find_image(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_bytes_name *name, uint32_t *number);

/* Decodes the images of all materials by several threads. Faults are reported when the textures are read. */
void zr_parsed_read_ahead(struct zr_parsed_scene *root);

/* json_texture.c: struct zr_parsed_texture. A normal map has the key normalScale, and occlusion has the key
 * strength. */
zr_json_read_fn zr_read_texture, zr_read_normal_texture, zr_read_occlusion_texture;

/* Adds the textures of all materials to the scene. `path`: of the list of materials. */
void zr_parsed_find_textures(struct zr_parsed_scene *root, const struct zr_json_path *path);

/* True if a material, by its index in root->materials, has a texture; false for material_count. */
bool zr_parsed_has_textures(const struct zr_parsed_scene *root, size_t material);

/* Reports, at `path`, texture coordinates that a mesh lacks for the material; returns false then. */
bool zr_parsed_check_texcoords(struct zr_parsed_scene *root, const struct zr_json_path *path, size_t material,
                               bool has_texcoords, bool has_texcoords1);

/* json_base.c: reads the base. Needs the window, the background, the view and the meshes. */
void zr_parsed_read_base(struct zr_parsed_scene *root, const struct zr_json_path *path);

#endif
