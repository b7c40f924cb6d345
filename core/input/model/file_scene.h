/* file_scene.h - input: nodes, materials, cameras, lights and animations of bare meshes in formats such as glTF.
 *
 * Over:   a parameter of the query replaces the file's value, which replaces the look's.
 */
#ifndef ZR_FILE_SCENE_H
#define ZR_FILE_SCENE_H

#include "scene/scene.h"
#include "scene/scene_builder.h"

struct zr_parsed_material; /* json_scene.h */
struct zr_style;
struct zr_parsed_scene;
struct zr_json_path;

#define ZR_FILE_MATERIAL_NONE UINT32_MAX

/* A camera that a node of the scene places. */
struct zr_file_camera {
    const char *name; /* the camera's name, else its node's name, else "" */
    uint32_t number;  /* in the file */
    zr_mat4 camera_to_world;
    bool is_perspective;
    float yfov_radians, xmag, ymag;
    bool has_zfar;
    float znear, zfar;
};

struct zr_file_scene {
    uint32_t instance_count;
    struct zr_instance *instances;
    uint32_t material_count;
    struct zr_parsed_material *materials;
    bool blends_colors; /* colours with an alpha below 1 are blended, unless an alphaMode applies */
    uint32_t camera_count;
    struct zr_file_camera *cameras;
    uint32_t light_count;
    struct zr_light *lights;               /* directions and positions are in the file's space */
    struct zr_warning_list light_warnings; /* added if the lights are used */
    uint32_t animation_count;              /* 0 unless the request has the parameter animation, time or frames */
    double animation_end;                  /* time of the last key of the request's animation, seconds */
    const char *const *animation_names;    /* "" for an animation without a name */
    const uint32_t *mesh_materials;        /* one per mesh; NONE: the look's material */
    const uint32_t *const *face_materials; /* NULL, or one per mesh: NULL, or the material of each face */
};

/* Makes the materials of the builder's meshes from those of the file. The keys of the query override them. */
void zr_file_scene_make_materials(struct zr_parsed_scene *root, const struct zr_file_scene *file);

/* Makes the materials of mesh `which` of the file. root->materials begins with the file's materials; the next one is
 * for faces without a material. The keys of the style override the materials. */
void zr_file_scene_make_mesh(struct zr_parsed_scene *root, const struct zr_file_scene *file, uint32_t which,
                             const struct zr_style *style, struct zr_mesh *mesh);

/* Removes the shading of a file's material if the scene's look does not light surfaces. */
void zr_file_scene_fit_look(const struct zr_parsed_scene *root, struct zr_parsed_material *material);

/* True if the file has a camera of this name or number. */
bool zr_file_scene_has_camera(const struct zr_file_scene *file, const char *camera);

/* Sets the view's pose, projection and planes to those of the file's camera of this name or number, except the keys in
 * root->camera_keys. `up` turns the file's space to world space. False, and a fault at `path`, if there is no such
 * camera, or its planes and those of the view are in the wrong order. `file` may be NULL. */
bool zr_file_scene_use_camera(struct zr_parsed_scene *root, const struct zr_json_path *path,
                              const struct zr_file_scene *file, const char *camera, const zr_mat4 *up);

/* Replaces the scene's lights by the file's lights, as the key `lights` does.
 * Warns if the file has none. `up`: as above. */
void zr_file_scene_use_lights(struct zr_parsed_scene *root, const struct zr_file_scene *file, const zr_mat4 *up);

/* Finds an animation by its name, else by its number; NULL: the first one. False if there is none. */
bool zr_file_scene_find_animation(const struct zr_file_scene *file, const char *wanted, uint32_t *number);

/* Reports at `path` that the file has no such animation. `file` may be NULL. */
void zr_file_scene_refuse_animation(struct zr_parsed_scene *root, const struct zr_json_path *path,
                                    const struct zr_file_scene *file, const char *wanted);

#endif
