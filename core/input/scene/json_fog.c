#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

struct given_fog {
    zr_vec4 color;
    float near, far;
};

enum { NEAR, FAR, COLOR };
#define AT(member) offsetof(struct given_fog, member)
static const struct zr_json_field fields[] = {
    [NEAR] = {"near", zr_json_float, AT(near), 0, (double)ZR_MATRIX_MAX, .required = true, .unit = "scene units",
              .text = "depth in front of the camera where fog begins"},
    [FAR] = {"far", zr_json_float, AT(far), 0, (double)ZR_MATRIX_MAX, .required = true, .unit = "scene units",
             .text = "depth in front of the camera from which fog is opaque"},
    [COLOR] = {"color", zr_json_color, AT(color), .otherwise = "the background", .text = "colour of the fog"},
    {.key = "mode"},
    {.key = "density"}};
const struct zr_json_object zr_json_object_fog = ZR_JSON_OBJECT_OF("fog", fields);

bool zr_read_fog(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct given_fog given = {.near = -1, .far = -1};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_fog, &given, &keys) || given.near < 0 || given.far < 0)
        return false;
    if (!(given.near < given.far))
        return zr_json_fault(json, path, "near is %g and far %g: fog begins at near, and far must be farther",
                             (double)given.near, (double)given.far);
    root->fog_has_color = zr_json_gives(keys, COLOR);
    root->scene->fog = (struct zr_fog){true, {given.color.x, given.color.y, given.color.z}, given.near, given.far};
    return true;
}
