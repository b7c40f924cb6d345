/* model_scene.h - input: nodes, materials, cameras, lights and animations of bare meshes in formats such as glTF.
 *
 * Over:   a parameter of the query replaces the file's value, which replaces the look's.
 */
#ifndef ZR_MODEL_SCENE_H
#define ZR_MODEL_SCENE_H

#include "input/model/parsed_material.h"
#include "input/text/names.h"
#include "scene/scene.h"
#include "scene/scene_builder.h"

#define ZR_MODEL_MATERIAL_NONE UINT32_MAX

/* A camera that a node of the scene places. */
struct zr_model_camera {
    const char *name; /* the camera's name, else its node's name, else "" */
    uint32_t number;  /* in the file */
    zr_mat4 camera_to_world;
    bool is_perspective;
    float yfov_radians, xmag, ymag;
    bool has_zfar;
    float znear, zfar;
    const char *fault; /* why it cannot be a view; NULL: it can */
};

struct zr_model_scene {
    uint32_t instance_count;
    struct zr_instance *instances;
    uint32_t material_count;
    struct zr_parsed_material *materials;
    bool blends_colors; /* colours with an alpha below 1 are blended, unless an alphaMode applies */
    uint32_t camera_count;
    struct zr_model_camera *cameras;
    uint32_t light_count;
    struct zr_light *lights;               /* directions and positions are in the file's space */
    struct zr_warning_list light_warnings; /* added if the lights are used */
    uint32_t animation_count;              /* 0 unless the request has the parameter animation, time or frames */
    double animation_end;                  /* time of the last key of the request's animation, seconds */
    const char *const *animation_names;    /* "" for an animation without a name */
    const uint32_t *mesh_materials;        /* one per mesh; NONE: the look's material */
    const uint32_t *const *face_materials; /* NULL, or one per mesh: NULL, or the material of each face */
};

/* Returns the camera of this name, else the one of this number, else NULL. */
const struct zr_model_camera *zr_model_scene_find_camera(const struct zr_model_scene *file, const char *wanted);

/* Finds an animation by its name, else by its number; NULL: the first one. False if there is none. */
bool zr_model_scene_find_animation(const struct zr_model_scene *file, const char *wanted, uint32_t *number);

/* Lists the names of cameras or animations for a message; a number stands for an empty name. */
struct zr_names_text zr_model_scene_cameras(const struct zr_model_scene *file);
struct zr_names_text zr_model_scene_animations(const struct zr_model_scene *file);

#endif
