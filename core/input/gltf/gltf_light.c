/* Reads the lights of KHR_lights_punctual, and places them by nodes. */
#include "input/gltf/gltf_extensions.h"

#include <float.h>
#include <math.h>

static const char NAME[] = "KHR_lights_punctual";

/* Intensities of the format are in lux and candela, of which a matt white surface reflects 1 / pi. In a scene, a light
 * of intensity 1 lights such a surface to white. */
#define SHARE      0.31830988618379067
#define TO_DEGREES 57.295779513082321

/* Largest intensities of lights of a scene. */
#define INTENSITY_MAX        1e6
#define INTENSITY_PLACED_MAX 1e15

/* ---- one light ---- */

struct given_spot {
    double inner, outer; /* radians */
};
#define AT(member) offsetof(struct given_spot, member)
static const struct zr_json_field spot_fields[] = {
    {.key = "innerConeAngle", .read = zr_json_number, .offset = AT(inner), .low = -DBL_MAX, .high = DBL_MAX},
    {.key = "outerConeAngle", .read = zr_json_number, .offset = AT(outer), .low = -DBL_MAX, .high = DBL_MAX},
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object spot_object = ZR_JSON_OBJECT_OF("spot", spot_fields);

struct given_light {
    const char *type, *spot; /* spot: JSON text */
    double color[3], intensity, range;
};

enum { TYPE, SPOT };
#define AT(member) offsetof(struct given_light, member)
static const struct zr_json_field fields[] = {
    [TYPE] = {"type", zr_json_string, AT(type), .required = true, .text = "directional, point or spot"},
    [SPOT] = {.key = "spot", .read = zr_json_value_start, .offset = AT(spot)},
    {.key = "color", .read = zr_gltf_three, .offset = AT(color)},
    {.key = "intensity", .read = zr_json_number, .offset = AT(intensity), .low = -DBL_MAX, .high = DBL_MAX},
    {.key = "range", .read = zr_json_number, .offset = AT(range), .low = -DBL_MAX, .high = DBL_MAX},
    ZR_GLTF_NAME,
    ZR_GLTF_COMMON};
#undef AT
static const struct zr_json_object object = ZR_JSON_OBJECT_OF("light", fields);

/* Brings the angles of a spot light to 0 <= inner < outer <= 90. A cone that is wider inside than outside gets a sharp
 * edge, as by the format's formula. Returns true if an angle was beyond its range. */
static bool clamp_angles(struct zr_light *light)
{
    const double most = 90.0, rounding = 1e-5; /* of pi / 2 as float, which is above it */
    const double inner = light->inner_degrees, outer = light->outer_degrees;
    if (outer > most) light->outer_degrees = most;
    if (inner < 0.0) light->inner_degrees = 0.0;
    if (inner >= light->outer_degrees) light->inner_degrees = nextafter(light->outer_degrees, 0.0);
    return inner < 0.0 || inner >= outer || outer > most + rounding;
}

/* Converts the light, but does not clamp its angles. False if a value is beyond the limits of a scene. */
static bool convert(const struct given_light *given, const struct given_spot *spot, struct zr_light *out)
{
    const bool is_placed = zr_light_has_place(out);
    const double intensity = given->intensity * SHARE;
    float color[3];
    if (!(intensity >= 0.0 && intensity <= (is_placed ? INTENSITY_PLACED_MAX : INTENSITY_MAX))) return false;
    for (int k = 0; k < 3; k++) {
        if (!(given->color[k] >= 0.0 && given->color[k] <= 1.0)) return false;
        color[k] = (float)(given->color[k] * intensity);
    }
    out->color = (zr_vec3){color[0], color[1], color[2]};
    out->inner_degrees = spot->inner * TO_DEGREES;
    out->outer_degrees = spot->outer * TO_DEGREES;
    out->range = (float)given->range;
    if (is_placed && !(given->range >= 0.0 && given->range <= (double)FLT_MAX)) return false;
    return out->type != ZR_LIGHT_SPOT || out->outer_degrees > 0.0;
}

static void read_light(struct zr_gltf *file, struct zr_json *json, const struct zr_json_path *path, uint32_t number)
{
    struct given_light given = {.type = "", .color = {1, 1, 1}, .intensity = 1};
    struct given_spot spot = {0, 45 / TO_DEGREES};
    zr_gltf_fields(file, json, path, &object, &given);
    if (given.spot) {
        zr_gltf_fields_at(file, given.spot, ZR_JSON_KEY(path, fields[SPOT].key), &spot_object, &spot);
    }
    const int type = zr_names_find(&zr_light_names, given.type);
    struct zr_light *light = &file->lights[number];
    *light = (struct zr_light){.type = type < 0 ? ZR_LIGHT_HEMISPHERE : (enum zr_light_type)type};
    if (light->type == ZR_LIGHT_HEMISPHERE || !convert(&given, &spot, light)) {
        zr_gltf_note(&file->bad_lights, path);
        light->type = ZR_LIGHT_HEMISPHERE; /* no type of the format: marks lights that are not placed */
    }
    if (light->type == ZR_LIGHT_SPOT && clamp_angles(light)) zr_gltf_note(&file->clamped_spots, path);
}

/* ---- the list of the file ---- */

static const struct zr_json_field list_fields[] = {{.key = "lights", .read = zr_json_value_start, .offset = 0},
                                                   ZR_GLTF_COMMON};
static const struct zr_json_object list_object = ZR_JSON_OBJECT_OF(NAME, list_fields);

bool zr_gltf_read_lights(struct zr_gltf *file)
{
    struct zr_json *json = &file->json;
    const struct zr_json_path *extensions = ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_EXTENSIONS)),
                              *path = ZR_JSON_KEY(extensions, NAME), *list = ZR_JSON_KEY(path, "lights");
    const char *found = NULL, *lights = NULL;
    size_t count;
    if (!file->places[ZR_GLTF_EXTENSIONS]) return true;
    if (!zr_gltf_find_extension(file, extensions, file->places[ZR_GLTF_EXTENSIONS], NAME, &found)) return false;
    if (!found) return true;
    if (!zr_gltf_fields_at(file, found, path, &list_object, &lights)) return false;
    if (!lights) return true;
    struct zr_json there = zr_json_at(json, lights);
    if (!zr_json_count(&there, list, &count)) return false;
    file->light_count = (uint32_t)count;
    file->lights = zr_arena_zero(json->arena, count, sizeof *file->lights);
    file->made->lights = zr_arena_zero(json->arena, ZR_LIGHTS_MAX, sizeof *file->made->lights);
    return zr_arena_ok(json->arena) && zr_gltf_read_items(file, lights, list, read_light);
}

/* ---- lights of nodes ---- */

static const struct zr_json_field node_fields[] = {
    {"light", zr_gltf_index, 0, .required = true, .text = "number of the light"}, ZR_GLTF_COMMON};
static const struct zr_json_object node_object = ZR_JSON_OBJECT_OF(NAME, node_fields);

uint32_t zr_gltf_find_light(struct zr_gltf *file, const struct zr_json_path *path, const char *extensions)
{
    const char *found = NULL;
    uint32_t light = ZR_GLTF_NONE;
    const struct zr_json_path *at = ZR_JSON_KEY(path, NAME);
    if (!zr_gltf_find_extension(file, path, extensions, NAME, &found) || !found) return light;
    zr_gltf_fields_at(file, found, at, &node_object, &light);
    if (light != ZR_GLTF_NONE && light >= file->light_count)
        zr_json_bad_index(&file->json, ZR_JSON_KEY(at, node_fields[0].key), (double)light, file->light_count, "lights");
    return light < file->light_count ? light : ZR_GLTF_NONE;
}

static bool is_near(const struct zr_gltf *file, const float *position)
{
    const float limit = file->json.limits->coordinate_max;
    return fabsf(position[0]) <= limit && fabsf(position[1]) <= limit && fabsf(position[2]) <= limit;
}

void zr_gltf_place_light(struct zr_gltf *file, uint32_t node, uint32_t light, const zr_mat4 *world)
{
    struct zr_model_scene *made = file->made;
    const float *m = world->m;
    struct zr_light placed = file->lights[light];
    const zr_vec3 axis = {-m[8], -m[9], -m[10]};
    const float squared = zr_vec3_dot(axis, axis);
    if (placed.type == ZR_LIGHT_HEMISPHERE) return; /* counted when it was read */
    if (!is_near(file, &m[12]) || made->light_count == ZR_LIGHTS_MAX ||
        (placed.type != ZR_LIGHT_POINT && !(squared > 0.0f && squared <= FLT_MAX))) {
        zr_gltf_note(&file->bad_lights, ZR_GLTF_ITEM(ZR_GLTF_NODES, node));
        return;
    }
    if (placed.type != ZR_LIGHT_POINT) placed.direction = zr_vec3_normalize(axis);
    placed.position = (zr_vec3){m[12], m[13], m[14]};
    made->lights[made->light_count++] = placed;
}
