/* Merges a scene with its look: a key of the scene overrides the look's. Runs once the root is read, since `look` may
 * be the last key. */
#include <string.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "scene/camera/upright.h"
#include "scene/defaults.h"
#include "scene/environment_map.h"
#include "scene/parsed_picture.h"

/* ---- the picture ---- */

static void use_picture(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    struct zr_environment *environment = &root->picture->merged.environment;
    zr_parsed_note_keys(root->picture, "", &zr_json_object_scene, root->keys);
    root->picture->merged = zr_picture_merge(root->picture, scene->look);
    scene->picture = &root->picture->merged;
    if (zr_scene_gives(root, ZR_SCENE_BACKGROUND)) scene->background = root->background;
    if (zr_scene_gives(root, ZR_SCENE_ENVIRONMENT)) {
        if (environment->name == ZR_ENVIRONMENT_NONE && !zr_picture_gives(root->picture, ZR_PICTURE_ENVIRONMENT))
            zr_json_fault(&root->json, ZR_SCENE_PATH(ZR_SCENE_ENVIRONMENT), "name is missing: the look %s has none",
                          scene->look->name);
    } else if (zr_scene_gives(root, ZR_SCENE_LIGHTS) || zr_scene_gives(root, ZR_SCENE_AMBIENT)) {
        environment->name = ZR_ENVIRONMENT_NONE;
    }
    if (environment->name != ZR_ENVIRONMENT_IMAGE) environment->map = NULL;
}

/* Reduces the samples to fit a large window. Samples of the look give a warning; samples of the scene are a fault. */
static void fit_samples(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const struct zr_view *view = &scene->views[0];
    const uint32_t most = root->json.limits->window_side_max;
    const uint32_t side = scene->picture->side, fits = zr_picture_side_in(side, view->width, view->height);
    if (fits == side || view->width > most || view->height > most) return; /* zr_scene_validate reports such windows */
    if (zr_scene_gives(root, ZR_SCENE_SAMPLES))
        zr_json_fault(&root->json, ZR_SCENE_PATH(ZR_SCENE_SAMPLES),
                      "%u samples per pixel are %u x %u; up to %u are allowed in this window", side * side, side, side,
                      fits * fits);
    else
        zr_warn_of_fewer_samples(root->builder, side, fits);
    root->picture->merged.side = fits;
}

/* ---- lamps ---- */

/* Lamps without a direction shine from above. */
static void use_own_lights(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    for (uint32_t i = 0; i < root->light_count; i++) {
        struct zr_light *light = &root->lights[i];
        if (zr_vec3_dot(light->direction, light->direction) > 0.0f) continue;
        light->direction = scene->picture->z_is_up && !light->camera_frame ? (zr_vec3){0, 0, 1} : (zr_vec3){0, 1, 0};
    }
    scene->lights = root->lights;
    scene->light_count = root->light_count;
}

static bool lights_pbr(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].lit != ZR_LIT_CLASSIC) return true;
    return false;
}

/* Lamps of a look stand in for its environment in classic shadings only. Without the environment they light all
 * shadings. */
static void light_pbr_too(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    if (scene->light_count == 0 || lights_pbr(scene)) return;
    struct zr_light *lights = zr_arena_alloc(root->json.arena, scene->light_count, sizeof *lights);
    if (!lights) return;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        lights[i] = scene->lights[i];
        lights[i].lit = ZR_LIT_ALL;
    }
    scene->lights = lights;
}

/* Lamps belong to an environment: those of another environment come from the first look that has it. */
static void use_lights_of_environment(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const enum zr_environment_name name = scene->picture->environment.name;
    if (name == scene->look->picture->environment.name) return;
    if (name == ZR_ENVIRONMENT_IMAGE) return;
    if (name == ZR_ENVIRONMENT_NONE) {
        light_pbr_too(root);
        return;
    }
    int i = 0;
    while (zr_looks[i].picture->environment.name != name)
        i++;
    scene->ambient = zr_looks[i].ambient;
    scene->lights = zr_looks[i].lights;
    scene->light_count = zr_looks[i].light_count;
}

/* Adds the sun of an environment image, which replaces the look's lights of pbr. */
static void use_lights_of_image(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const struct zr_environment *environment = &scene->picture->environment;
    const struct zr_environment_map *map = environment->map;
    const bool is_own = zr_scene_gives(root, ZR_SCENE_LIGHTS);
    struct zr_light *lights = zr_arena_alloc(root->json.arena, scene->light_count + 1, sizeof *lights);
    uint32_t count = 0;
    if (!lights) return;
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (is_own || scene->lights[i].lit == ZR_LIT_CLASSIC) lights[count++] = scene->lights[i];
    if (map->has_sun && count < ZR_LIGHTS_MAX)
        lights[count++] = (struct zr_light){.type = ZR_LIGHT_DIRECTIONAL,
                                            .direction = map->sun_direction,
                                            .color = zr_vec3_scale(map->sun_color, environment->intensity),
                                            .environment_frame = true,
                                            .has_shadows = true,
                                            .lit = ZR_LIT_PBR};
    if (is_own) root->lights = lights; /* their colours are decoded later */
    scene->lights = lights;
    scene->light_count = count;
}

/* The look textbook has ambient light and lamps apart, so a scene may give either. */
static void use_lights(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const bool has_environment = scene->picture->environment.name != ZR_ENVIRONMENT_NONE;
    if (zr_scene_gives(root, ZR_SCENE_LIGHTS)) {
        use_own_lights(root);
        scene->ambient = has_environment ? (zr_vec3){0, 0, 0} : zr_default_ambient_of_own_lights();
    } else if (zr_scene_gives(root, ZR_SCENE_AMBIENT) && scene->look != zr_look_textbook()) {
        scene->light_count = 0;
    } else {
        use_lights_of_environment(root);
    }
    if (scene->picture->environment.map) use_lights_of_image(root);
    if (zr_scene_gives(root, ZR_SCENE_AMBIENT))
        scene->ambient = (zr_vec3){root->ambient.x, root->ambient.y, root->ambient.z};
}

void zr_parsed_use_look(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const struct zr_look *look = root->look ? root->look : zr_look_textbook();
    zr_look_apply(look, scene);
    use_picture(root);
    fit_samples(root);
    use_lights(root);
    if (!zr_scene_gives(root, ZR_SCENE_VIEW)) zr_look_set_view(look, &scene->views[0]);
    if (scene->picture->z_is_up) zr_view_put_z_up(&scene->views[0], root->view_has_up);
    scene->algorithm = (enum zr_algorithm)root->algorithm;
    if (!root->fog_has_color)
        scene->fog.color = (zr_vec3){scene->background.x, scene->background.y, scene->background.z};
}

/* ---- linear light ---- */

/* Returns a key that needs linear light, or NULL. */
static const char *linear_key_of(const struct zr_parsed_scene *root)
{
    const struct zr_scene *scene = root->scene;
    const char *key = zr_picture_linear_key(root->picture, scene->picture);
    if (!key) key = root->linear_key;
    if (!key && scene->look->picture->is_linear) key = zr_scene_fields[ZR_SCENE_LOOK].key;
    return key;
}

/* A base has one sample per pixel, and its values are not linear light. */
static void check_base(struct zr_parsed_scene *root, const char *linear_key)
{
    const struct zr_scene *scene = root->scene;
    const struct zr_json_path *path = ZR_SCENE_PATH(ZR_SCENE_BASE);
    if (!root->base) return;
    if (scene->look != zr_look_textbook())
        zr_json_fault(&root->json, path, "cannot be combined with the look %s: textbook is the only one for it",
                      scene->look->name);
    else if (linear_key)
        zr_json_fault(&root->json, path, "cannot be combined with linear light, which is needed for: %s", linear_key);
    else if (scene->picture->side > 1)
        zr_json_fault(&root->json, path, "cannot be combined with samples other than 1");
}

static void check_edges(struct zr_parsed_scene *root)
{
    const struct zr_edges *edges = &root->scene->picture->edges;
    if (edges->is_on && edges->has_hidden && !edges->is_from_mesh &&
        zr_picture_gives(root->picture, ZR_PICTURE_EDGES_HIDDEN))
        zr_json_fault(&root->json, ZR_SCENE_PATH(ZR_SCENE_EDGES),
                      "hiddenLines needs lines of the mesh: give \"from\": \"mesh\" as well");
}

void zr_parsed_check_light(struct zr_parsed_scene *root)
{
    check_edges(root);
    const bool is_given = zr_scene_gives(root, ZR_SCENE_COLOR_MANAGEMENT);
    const bool is_srgb = is_given && root->color_management == 1;
    const char *key = linear_key_of(root);
    if (is_given && !is_srgb && key)
        zr_json_fault(&root->json, ZR_SCENE_PATH(ZR_SCENE_COLOR_MANAGEMENT),
                      "none cannot be combined with %s, which needs linear light: srgb", key);
    if (is_srgb && !key) key = zr_scene_fields[ZR_SCENE_COLOR_MANAGEMENT].key;
    root->picture->merged.is_linear = key != NULL;
    zr_parsed_decode_light(root);
    if (key && zr_scene_gives(root, ZR_SCENE_FOG))
        zr_json_fault(&root->json, ZR_SCENE_PATH(ZR_SCENE_FOG),
                      "not supported in this version together with linear light, which is needed for: %s", key);
    check_base(root, key);
}
