#include "input/json_objects.h"
#include "input/json_scene.h"

#define INTENSITY_MAX 1e6

static const char *const types[] = {"directional", "point", "spot"};
static const struct zr_names type_names = ZR_NAMES(1, types);

enum { FRAME_WORLD, FRAME_CAMERA, FRAMES };
static const char *const frames[] = {"world", "camera"};
static const struct zr_names frame_names = ZR_NAMES(FRAMES, frames);

struct given_light {
    int type, frame;
    zr_vec3 direction;
    zr_vec4 color;
    double intensity;
};

static bool read_direction(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                           void *out)
{
    zr_vec3 v;
    if (!zr_json_vec3(json, path, field, &v)) return false;
    if (v.x == 0.0f && v.y == 0.0f && v.z == 0.0f) return zr_json_fault(json, path, "a direction of no length");
    *(zr_vec3 *)out = zr_vec3_normalize(v);
    return true;
}

#define AT(member) offsetof(struct given_light, member)
static const struct zr_json_field fields[] = {
    {"type", zr_json_choice, AT(type), .words = &type_names, .required = true, .text = "the kind of lamp"},
    {"direction", read_direction, AT(direction), .required = true, .text = "the way the light travels"},
    {"color", zr_json_color, AT(color), .otherwise = "white", .text = "of the light"},
    {"intensity", zr_json_number, AT(intensity), 0, INTENSITY_MAX, .otherwise = "1", .text = "a factor of its colour"},
    {"frame", zr_json_choice, AT(frame), .words = &frame_names, .otherwise = "world",
     .text = "where direction is measured; camera: the lamp goes with the camera"},
    {.key = "position"},
    {.key = "range"},
    {.key = "spot"},
    {.key = "shadows"},
    {.key = "name"}};
const struct zr_json_object zr_json_object_light = ZR_JSON_OBJECT_OF("light", fields);

static void read_light(struct zr_json *json, const struct zr_json_path *path, struct zr_light *light)
{
    struct given_light given = {.color = {1, 1, 1, 1}, .intensity = 1};
    uint64_t keys;
    zr_json_fields(json, path, &zr_json_object_light, &given, &keys);
    light->direction = given.direction;
    light->color = zr_vec3_scale((zr_vec3){given.color.x, given.color.y, given.color.z}, (float)given.intensity);
    light->camera_frame = given.frame == FRAME_CAMERA;
}

bool zr_read_lights(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field, void *out)
{
    struct zr_given_scene *root = out;
    size_t count, number = 0;
    (void)field;
    if (!zr_json_count(json, path, &count)) return false;
    if (count > ZR_LIGHTS_MAX)
        return zr_json_skip(json) &&
               zr_json_fault(json, path, "%zu lights; up to %d are allowed", count, ZR_LIGHTS_MAX);
    struct zr_light *lights = zr_arena_zero(json->arena, count, sizeof *lights);
    if (!lights) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); number++)
        read_light(json, ZR_JSON_ITEM(path, number), &lights[number]);
    root->scene->lights = lights;
    root->scene->light_count = (uint32_t)number;
    return true;
}
