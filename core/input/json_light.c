#include "input/json_objects.h"
#include "input/json_scene.h"

#define INTENSITY_MAX 1e6

/* In the order of enum zr_light_type, and what is not supported. */
static const char *const types[] = {"directional", "hemisphere", "point", "spot"};
static const struct zr_names type_names = ZR_NAMES(2, types);

enum { FRAME_WORLD, FRAME_CAMERA, FRAMES };
static const char *const frames[] = {"world", "camera"};
static const struct zr_names frame_names = ZR_NAMES(FRAMES, frames);

struct given_light {
    int type, frame;
    zr_vec3 direction, up;
    zr_vec4 color, sky, ground;
    double intensity;
    bool has_shadows;
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

enum { TYPE, DIRECTION, COLOR, SHADOWS, SKY, GROUND, UP, INTENSITY, FRAME };
#define AT(member) offsetof(struct given_light, member)
static const struct zr_json_field fields[] = {
    [TYPE] = {"type", zr_json_choice, AT(type), .words = &type_names, .required = true, .text = "the kind of lamp"},
    [DIRECTION] = {"direction", read_direction, AT(direction), .text = "of directional: the way the light travels"},
    [COLOR] = {"color", zr_json_color, AT(color), .otherwise = "white", .text = "of directional: of the light"},
    [SHADOWS] = {"shadows", zr_json_bool, AT(has_shadows), .otherwise = "false",
                 .text = "of directional: what the light does not reach is dark"},
    [SKY] = {"sky", zr_json_color, AT(sky), .otherwise = "white", .text = "of hemisphere: of the light from above"},
    [GROUND] = {"ground", zr_json_color, AT(ground), .otherwise = "black",
                .text = "of hemisphere: of the light from below"},
    [UP] = {"up", read_direction, AT(up), .otherwise = "the scene's; y in the camera's frame",
            .text = "of hemisphere: where the sky is"},
    [INTENSITY] = {"intensity", zr_json_number, AT(intensity), 0, INTENSITY_MAX, .otherwise = "1",
                   .text = "a factor of its colours"},
    [FRAME] = {"frame", zr_json_choice, AT(frame), .words = &frame_names, .otherwise = "world",
               .text = "where directions are measured; camera: the lamp goes with the camera"},
    {.key = "position"},
    {.key = "range"},
    {.key = "spot"},
    {.key = "name"}};
const struct zr_json_object zr_json_object_light = ZR_JSON_OBJECT_OF("light", fields);

/* Keys from `first` to `last` are those of the other type. */
static void refuse_strange_keys(struct zr_json *json, const struct zr_json_path *path, uint64_t keys, int first,
                                int last, const char *type)
{
    for (int key = first; key <= last; key++)
        if (zr_json_gives(keys, key))
            zr_json_fault(json, ZR_JSON_KEY(path, fields[key].key), "belongs to lights of the type %s only", type);
}

static zr_vec3 light_of(zr_vec4 color, double intensity)
{
    return zr_vec3_scale((zr_vec3){color.x, color.y, color.z}, (float)intensity);
}

static void make_light(const struct given_light *given, struct zr_light *light)
{
    light->type = (enum zr_light_type)given->type;
    light->camera_frame = given->frame == FRAME_CAMERA;
    if (light->type == ZR_LIGHT_HEMISPHERE) {
        light->direction = given->up;
        light->color = light_of(given->sky, given->intensity);
        light->ground = light_of(given->ground, given->intensity);
    } else {
        light->direction = given->direction;
        light->color = light_of(given->color, given->intensity);
        light->has_shadows = given->has_shadows;
    }
}

static void read_light(struct zr_given_scene *root, struct zr_json *json, const struct zr_json_path *path,
                       struct zr_light *light)
{
    struct given_light given = {
        .type = -1, .color = {1, 1, 1, 1}, .sky = {1, 1, 1, 1}, .ground = {0, 0, 0, 1}, .intensity = 1};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_light, &given, &keys) || given.type < 0) return;
    if (given.type == ZR_LIGHT_HEMISPHERE)
        refuse_strange_keys(json, path, keys, DIRECTION, SHADOWS, types[ZR_LIGHT_DIRECTIONAL]);
    else
        refuse_strange_keys(json, path, keys, SKY, UP, types[ZR_LIGHT_HEMISPHERE]);
    if (given.type == ZR_LIGHT_DIRECTIONAL && !zr_json_gives(keys, DIRECTION))
        zr_json_fault(json, path, "direction is missing: %s", fields[DIRECTION].text);
    make_light(&given, light);
    if (light->type == ZR_LIGHT_HEMISPHERE) root->linear_key = "the type hemisphere of lights";
    if (light->has_shadows) root->linear_key = "the key shadows of lights";
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
        read_light(root, json, ZR_JSON_ITEM(path, number), &lights[number]);
    root->lights = lights;
    root->light_count = (uint32_t)number;
    return true;
}
