#include "input/json_scene.h"

#define INTENSITY_MAX 1e6

enum { TYPE, DIRECTION, COLOR, INTENSITY, FRAME, KEYS };
static const char *const words[] = {"type",     "direction", "color", "intensity", "frame",
                                    "position", "range",     "spot",  "shadows",   "name"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static const char *const types[] = {"directional", "point", "spot"};
static const struct zr_names type_names = ZR_NAMES(1, types);

enum { FRAME_WORLD, FRAME_CAMERA, FRAMES };
static const char *const frames[] = {"world", "camera"};
static const struct zr_names frame_names = ZR_NAMES(FRAMES, frames);

static void read_direction(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, zr_vec3 *out)
{
    zr_vec3 v;
    if (!zr_json_vec3(json, path, node, &v)) return;
    if (v.x == 0.0f && v.y == 0.0f && v.z == 0.0f)
        zr_json_fault(json, path, "a direction of no length");
    else
        *out = zr_vec3_normalize(v);
}

static void read_light(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_light *light)
{
    const cJSON *found[KEYS];
    if (!zr_json_object(json, path, node, &keys, found)) return;
    int type, frame = FRAME_WORLD;
    zr_vec4 color = {1, 1, 1, 1};
    double intensity = 1;
    if (!found[TYPE])
        zr_json_fault(json, path, "type is missing");
    else
        zr_json_choice(json, ZR_JSON_KEY(path, words[TYPE]), found[TYPE], &type_names, &type);
    if (!found[DIRECTION])
        zr_json_fault(json, path, "direction is missing");
    else
        read_direction(json, ZR_JSON_KEY(path, words[DIRECTION]), found[DIRECTION], &light->direction);
    if (found[COLOR]) zr_json_color(json, ZR_JSON_KEY(path, words[COLOR]), found[COLOR], &color);
    if (found[INTENSITY])
        zr_json_number(json, ZR_JSON_KEY(path, words[INTENSITY]), found[INTENSITY], 0, INTENSITY_MAX, &intensity);
    if (found[FRAME]) zr_json_choice(json, ZR_JSON_KEY(path, words[FRAME]), found[FRAME], &frame_names, &frame);
    light->color = zr_vec3_scale((zr_vec3){color.x, color.y, color.z}, (float)intensity);
    light->camera_frame = frame == FRAME_CAMERA;
}

void zr_draft_read_lights(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list)
{
    struct zr_json *json = &draft->json;
    size_t count, number = 0;
    if (!zr_json_array(json, path, list, &count)) return;
    if (count > ZR_LIGHTS_MAX) {
        zr_json_fault(json, path, "%zu lights; up to %d are allowed", count, ZR_LIGHTS_MAX);
        return;
    }
    struct zr_light *lights = zr_arena_zero(json->arena, count, sizeof *lights);
    if (!lights) return;
    for (const cJSON *node = list->child; node && !zr_json_full(json); node = node->next, number++)
        read_light(json, ZR_JSON_ITEM(path, number), node, &lights[number]);
    draft->scene->lights = lights;
    draft->scene->light_count = (uint32_t)number;
}
