/* json_scene.h - input: what the readers of a JSON scene's parts share.
 *
 * Materials: a scene's materials are what it says of itself; a drawn mesh needs
 * them resolved (base colour, shading, sidedness), where the mesh's own word goes
 * before the material's, and that before the scene's. zr_draft_variant makes
 * each combination once, as it is first asked for.
 */
#ifndef ZR_JSON_SCENE_H
#define ZR_JSON_SCENE_H

#include "base/warning_list.h"
#include "input/json_list.h"
#include "input/json_value.h"
#include "input/look.h"
#include "scene/scene.h"

/* A material as the scene has it, under its name. */
struct zr_given_material {
    const char *name; /* in the cJSON tree */
    size_t number;    /* in the scene's list */
    zr_vec4 base_color, specular;
    float shininess;
    struct zr_look look;
};

/* A scene while its JSON is being read. */
struct zr_draft {
    struct zr_json json;
    struct zr_scene *scene;
    struct zr_look look; /* the scene's own */

    size_t given_count;
    struct zr_given_material *given; /* sorted by name */

    uint32_t *variants; /* one for each combination without a colour of its own for outlines: its index in
                         * `materials`, or UINT32_MAX */
    size_t material_count, material_room;
    struct zr_material *materials;

    bool transparent; /* some colour wants to be */

    size_t asset_count;
    const struct zr_asset *assets;
    bool *assets_used;
    struct zr_stored stored;

    struct zr_warning_list warnings;

    uint32_t unplaced_meshes; /* by any node */
};

/* What a mesh or a polygon says of its looks. */
struct zr_style {
    size_t given; /* index into draft->given, or given_count: none */
    struct zr_look look;
    bool is_plain; /* has no colours of its own, whatever others of its mesh have */
    bool is_open;  /* an open surface: two-sided where nobody says otherwise */
};

/* json_material.c. `list` may be NULL: no materials. */
void zr_draft_read_materials(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list);

/* json_look.c. The keys of a look have the same names wherever they may stand, and come one
 * after the other in a reader's list of keys, in the order of this enum: nodes[] points to the first
 * of them. Any may be NULL: not said. */
enum { ZR_LOOK_SHADING, ZR_LOOK_FILL, ZR_LOOK_OUTLINE, ZR_LOOK_DOUBLE_SIDED, ZR_LOOK_KEYS };
#define ZR_LOOK_WORDS "shading", "fill", "outline", "doubleSided"
void zr_draft_read_look(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *const *nodes, int count,
                        struct zr_look *look);

/* json_material.c. `material` and the nodes of the look may be NULL: not said. `path` is that of the mesh or
 * polygon. */
void zr_draft_read_style(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *material,
                         const cJSON *const *look_nodes, struct zr_style *style);

/* The index of the resolved material. coloured: the mesh has colours of its own;
 * smooth: it has normals or vertex colours. 0 once the arena has failed. */
uint32_t zr_draft_variant(struct zr_draft *draft, const struct zr_style *style, bool coloured, bool smooth);

/* Notes colours that are not opaque. */
void zr_draft_note_alpha(struct zr_draft *draft, const zr_vec4 *colors, size_t count);

/* json_mesh.c and json_polygons.c: fill one mesh each. Errors are in
 * draft->json.error, failures to allocate in its arena. */
void zr_draft_read_mesh(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                        struct zr_mesh *mesh);
void zr_draft_read_polygons(struct zr_draft *draft, const struct zr_json_path *path, struct zr_json_list *list,
                            struct zr_mesh *mesh);

/* json_heights.c: fills positions and faces of a mesh from a grid, values that are null
 * included; mesh->positions stays NULL where there was a fault. Returns a flag a position,
 * true for a null, or NULL where there is none. Once everything else of the mesh is read,
 * zr_heights_drop_holes takes away the cells that touch one, and positions left without a cell. */
const bool *zr_json_read_heights(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                                 struct zr_mesh *mesh);
void zr_heights_drop_holes(struct zr_arena *arena, const bool *holes, struct zr_mesh *mesh);

/* json_nodes.c: the instances that nodes place, *count of them and room for one more; each
 * mesh is one of meshes[0..mesh_count-1]. NULL where there was a fault, here or before. */
struct zr_instance *zr_draft_read_nodes(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list,
                                        const struct zr_mesh *meshes, uint32_t mesh_count, uint32_t *count);

/* json_view.c: over the defaults that scene->views[0] already has. */
void zr_draft_read_view(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node);

/* The mesh that a view is to be fitted to, by its name: once there are meshes. */
void zr_draft_find_fit_mesh(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node);

/* json_light.c and json_outputs.c: the lists of these. */
/* Behind the background, whose colour fog has where none is given. */
void zr_draft_read_fog(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node);
void zr_draft_read_lights(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list);
void zr_draft_read_outputs(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list);

/* json_bytes.c: what a data: URI, {"uri": one}, {"asset": name} or {"asset": "sha256:..."} stands for.
 * In the arena or the request. */
struct zr_given_bytes {
    const void *bytes;
    size_t size;
};
bool zr_draft_read_bytes(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                         struct zr_given_bytes *out);

/* json_base.c. Needs the window, the background, the view and the meshes to be read. */
void zr_draft_read_base(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node);

#endif
