#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/srgb.h"
#include "base/team.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"
#include "scene/picture.h"

/* The larger limit is for lamps with a position: it lights objects as far away as coordinates allow. */
#define INTENSITY_MAX        1e6
#define INTENSITY_PLACED_MAX 1e15

#define PI 3.14159265358979323846

/* A wider cone leaves too few texels of the shadow map for its middle. */
#define SHADOW_DEGREES_MAX 80.0

enum { FRAME_WORLD, FRAME_CAMERA, FRAMES };
static const char *const frames[] = {"world", "camera"};
static const struct zr_names frame_names = ZR_NAMES(FRAMES, frames);

struct given_light {
    int type, frame;
    zr_vec3 direction, up;
    zr_vec4 color, sky, ground;
    double position[3], intensity, inner_degrees, outer_degrees;
    float range;
    bool has_shadows;
};

static bool read_direction(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_vec3 v;
    if (!zr_json_vec3(json, path, &v)) return false;
    if (v.x == 0.0f && v.y == 0.0f && v.z == 0.0f) return zr_json_fault(json, path, "the direction has the length 0");
    *(zr_vec3 *)out = zr_vec3_normalize(v);
    return true;
}

/* double: check_light checks the range, which depends on the type. */
static bool read_intensity(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, out);
}

/* double, degrees: field->high is a quarter turn, in radians or degrees. The message suggests degrees for a large
 * number of radians. */
static bool read_half_angle(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const bool degrees = path->field->high > 4.0;
    double value;
    if (!zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, &value)) return false;
    if (!degrees && value > path->field->high && value <= 90.0)
        return zr_json_fault(json, path, "%.9g is more than a quarter turn: %s takes radians, %sDegrees takes degrees",
                             value, path->field->key, path->field->key);
    if (!(value >= 0.0 && value <= path->field->high))
        return zr_json_fault(json, path, "%.10g is outside of %.10g to %.10g", value, 0.0, path->field->high);
    value = degrees ? value : value * 180.0 / PI;
    *(double *)out = value < 90.0 ? value : 90.0;
    return true;
}

/* Types that have a key. */
#define OF(ID, ...) OF_##ID = 1 << ZR_LIGHT_##ID,
enum { ZR_LIGHT_ROWS(OF) };
#undef OF

enum {
    TYPE,
    DIRECTION,
    COLOR,
    SHADOWS,
    SKY,
    GROUND,
    UP,
    INTENSITY,
    FRAME,
    POSITION,
    RANGE,
    INNER,
    INNER_DEGREES,
    OUTER,
    OUTER_DEGREES
};
#define AT(member) offsetof(struct given_light, member)
static const struct zr_json_field fields[] = {
    [TYPE] = {"type", zr_json_choice, AT(type), .words = &zr_light_names, .required = true, .text = "kind of light"},
    [DIRECTION] = {"direction", read_direction, AT(direction),
                   .text = "directional, spot: direction in which the light travels",
                   .schema = ZR_SCHEMA_OF("direction"), .of = OF_DIRECTIONAL | OF_SPOT,
                   .required_of = OF_DIRECTIONAL | OF_SPOT},
    [COLOR] = {"color", zr_read_light_color, AT(color), .otherwise = "white",
               .text = "directional, point, spot: colour of the light", .of = OF_DIRECTIONAL | OF_POINT | OF_SPOT},
    [SHADOWS] = {"shadows", zr_json_bool, AT(has_shadows), .otherwise = "false",
                 .text = "directional, spot: true if geometry casts shadows", .of = OF_DIRECTIONAL | OF_SPOT},
    [SKY] = {"sky", zr_read_light_color, AT(sky), .otherwise = "white", .text = "hemisphere: light from above",
             .of = OF_HEMISPHERE},
    [GROUND] = {"ground", zr_read_light_color, AT(ground), .otherwise = "black", .text = "hemisphere: light from below",
                .of = OF_HEMISPHERE},
    [UP] = {"up", read_direction, AT(up), .otherwise = "the scene's; y in the camera's frame",
            .text = "hemisphere: direction of the sky", .schema = ZR_SCHEMA_OF("direction"), .of = OF_HEMISPHERE},
    [INTENSITY] = {"intensity", read_intensity, AT(intensity), 0, INTENSITY_PLACED_MAX, .otherwise = "1",
                   .text = "factor of the colours; point, spot: at a distance of 1",
                   .schema = ZR_SCHEMA({"type" : "number"})},
    [FRAME] = {"frame", zr_json_choice, AT(frame), .words = &frame_names, .otherwise = "world",
               .text = "space of directions and positions; camera: the light moves with the camera"},
    [POSITION] = {"position", zr_json_place3, AT(position), .unit = "scene units", .text = "point, spot: position",
                  .of = OF_POINT | OF_SPOT, .required_of = OF_POINT | OF_SPOT},
    [RANGE] = {"range", zr_json_positive, AT(range), .unit = "scene units", .otherwise = "none",
               .text = "point, spot: distance at which the light has faded to 0", .of = OF_POINT | OF_SPOT},
    [INNER] = {"innerConeAngle", read_half_angle, AT(inner_degrees), 0, PI / 2, .unit = "radians", .otherwise = "0",
               .text = "spot: angle from the axis at which the light begins to fade", .of = OF_SPOT,
               .schema = ZR_SCHEMA({"type" : "number"})},
    [INNER_DEGREES] = {"innerConeAngleDegrees", read_half_angle, AT(inner_degrees), 0, 90, .unit = "degrees",
                       .otherwise = "0", .text = "spot: angle from the axis at which the light begins to fade",
                       .of = OF_SPOT, .schema = ZR_SCHEMA({"type" : "number"})},
    [OUTER] = {"outerConeAngle", read_half_angle, AT(outer_degrees), 0, PI / 2, .unit = "radians", .otherwise = "pi/4",
               .text = "spot: angle from the axis at which the light has faded to 0", .of = OF_SPOT,
               .schema = ZR_SCHEMA({"type" : "number"})},
    [OUTER_DEGREES] = {"outerConeAngleDegrees", read_half_angle, AT(outer_degrees), 0, 90, .unit = "degrees",
                       .otherwise = "45", .text = "spot: angle from the axis at which the light has faded to 0",
                       .of = OF_SPOT, .schema = ZR_SCHEMA({"type" : "number"})},
    {.key = "spot"},
    {.key = "name"}};
static const struct zr_json_rule rules[] = {
    {ZR_RULE_APART, .text = "two angles: %s and %s", .sets = {ZR_KEY(INNER), ZR_KEY(INNER_DEGREES)}},
    {ZR_RULE_APART, .text = "two angles: %s and %s", .sets = {ZR_KEY(OUTER), ZR_KEY(OUTER_DEGREES)}}};
/* clang-format off */
const struct zr_json_object zr_json_object_light = {
    ZR_JSON_FIELDS("light", fields), .has_types = true, ZR_JSON_RULES(rules), .schema = ZR_SCHEMA({
        "dependentSchemas": {
            "intensity": {
                "if": {"properties": {"type": {"enum": ["directional", "hemisphere"]}}},
                "then": {"properties": {"intensity": {"maximum": 1e6}}}
            },
            "shadows": {
                "if": {"properties": {"shadows": {"const": true}}},
                "then": {
                    "properties": {"outerConeAngle": {"maximum": 1.396263}, "outerConeAngleDegrees": {"maximum": 80}}
                }
            }
        }
    })};
/* clang-format on */

static void check_cone(struct zr_json *json, const struct zr_json_path *path, const struct given_light *given)
{
    if (!(given->inner_degrees < given->outer_degrees))
        zr_json_fault(json, path, "innerConeAngle must be smaller than outerConeAngle: %.9g and %.9g degrees",
                      given->inner_degrees, given->outer_degrees);
    if (given->has_shadows && given->outer_degrees > SHADOW_DEGREES_MAX)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[SHADOWS].key),
                      "shadows need a spot whose outerConeAngle is at most %g degrees; this one has %.9g",
                      SHADOW_DEGREES_MAX, given->outer_degrees);
}

static void check_light(struct zr_json *json, const struct zr_json_path *path, const struct given_light *given)
{
    const double most = ZR_LIGHT_SET_PLACED >> given->type & 1 ? INTENSITY_PLACED_MAX : INTENSITY_MAX;
    if (given->type == ZR_LIGHT_SPOT) check_cone(json, path, given);
    if (!(given->intensity >= 0.0 && given->intensity <= most))
        zr_json_fault(json, ZR_JSON_KEY(path, fields[INTENSITY].key), "%.10g is outside of %.10g to %.10g",
                      given->intensity, 0.0, most);
}

static zr_vec3 rgb(zr_vec4 color)
{
    return (zr_vec3){color.x, color.y, color.z};
}

/* Returns the light as if it were not linear; zr_parsed_decode_light replaces it if it is. */
static zr_vec3 light_of(zr_vec3 color, float intensity)
{
    return zr_vec3_scale(zr_light_color(color, false), intensity);
}

static void make_light(const struct given_light *given, const struct zr_far *far, struct zr_light *light,
                       struct zr_parsed_light_colors *colors)
{
    const bool is_hemisphere = given->type == ZR_LIGHT_HEMISPHERE;
    *colors = (struct zr_parsed_light_colors){rgb(is_hemisphere ? given->sky : given->color),
                                              is_hemisphere ? rgb(given->ground) : (zr_vec3){0, 0, 0},
                                              (float)given->intensity};
    light->color = light_of(colors->color, colors->intensity);
    light->ground = light_of(colors->ground, colors->intensity);
    light->type = (enum zr_light_type)given->type;
    light->camera_frame = given->frame == FRAME_CAMERA;
    if (light->type == ZR_LIGHT_HEMISPHERE) {
        light->direction = given->up;
    } else {
        light->direction = given->direction;
        light->has_shadows = given->has_shadows;
        light->position = zr_far_place(light->camera_frame ? NULL : far, given->position);
        light->range = given->range;
        light->inner_degrees = given->inner_degrees;
        light->outer_degrees = given->outer_degrees;
    }
}

static void read_light(struct zr_parsed_scene *root, struct zr_json *json, const struct zr_json_path *path,
                       struct zr_light *light, struct zr_parsed_light_colors *colors)
{
    struct given_light given = {.type = -1,
                                .color = {1, 1, 1, 1},
                                .sky = {1, 1, 1, 1},
                                .ground = {0, 0, 0, 1},
                                .intensity = 1,
                                .outer_degrees = 45};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_light, &given, &keys) || given.type < 0) return;
    check_light(json, path, &given);
    make_light(&given, json->far, light, colors);
    if (light->type == ZR_LIGHT_HEMISPHERE) root->linear_key = "the type hemisphere of lights";
    if (light->has_shadows) root->linear_key = "the key shadows of lights";
}

bool zr_read_lights(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    size_t count, number = 0;
    struct zr_light *lights = zr_json_enter_list(json, path, "lights", ZR_LIGHTS_MAX, sizeof *lights, &count);
    if (!lights) return false;
    root->light_colors = zr_arena_zero(json->arena, count, sizeof *root->light_colors);
    if (!root->light_colors) return false;
    for (; zr_json_item(json); number++)
        read_light(root, json, ZR_JSON_ITEM(path, number), &lights[number], &root->light_colors[number]);
    root->lights = lights;
    root->light_count = (uint32_t)number;
    return true;
}

/* ---- colours of light ----
 *
 * Numbers are linear light. A text, such as "#808080", is sRGB-encoded and is decoded if light is
 * linear. That depends on all materials, so a text's components are stored negated until then. */

bool zr_read_light_color(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const bool is_text = zr_json_type(json) == ZR_JSON_STRING;
    zr_vec4 *color = out;
    if (!zr_json_color(json, path, out)) return false;
    if (is_text) *color = (zr_vec4){-color->x, -color->y, -color->z, color->w};
    return true;
}

void zr_parsed_decode_light(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const bool is_linear = scene->picture->is_linear;
    for (uint32_t i = 0; is_linear && zr_scene_gives(root, ZR_SCENE_LIGHTS) && i < root->light_count; i++) {
        const struct zr_parsed_light_colors *given = &root->light_colors[i];
        root->lights[i].color = zr_vec3_scale(zr_light_color(given->color, true), given->intensity);
        root->lights[i].ground = zr_vec3_scale(zr_light_color(given->ground, true), given->intensity);
    }
    scene->ambient = zr_light_color(scene->ambient, is_linear);
    for (uint32_t i = 0; i < scene->material_count; i++)
        root->builder->materials[i].specular = zr_light_color(root->builder->materials[i].specular, is_linear);
}
