/* The keys of the target of the channel flow. Their values are read after the root (json_flow_target.c). */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

enum { VIEW, POSES };
#define AT(member) offsetof(struct zr_parsed_flow, member)
static const struct zr_json_field fields[] = {
    [VIEW] = {"view", zr_json_place, AT(view), .object = &zr_json_object_view, .otherwise = "that of the picture",
              .text = "pose and projection of the camera"},
    [POSES] = {"poses", zr_json_place, AT(poses), .otherwise = "those of the picture",
               .text = "matrices of nodes, by their names",
               .schema = ZR_SCHEMA({"type" : "object", "additionalProperties" : {"$ref" : "#/$defs/affine"}})}};
#undef AT
/* clang-format off */
const struct zr_json_object zr_json_object_flow = ZR_JSON_RULED_OBJECT("flow", fields, {
    "minProperties": 1, "dependentSchemas": {"view": {"properties": {"view": {"properties": {"camera": false}}}}}
});
/* clang-format on */

bool zr_read_flow(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_flow, out, &keys)) return false;
    return keys != 0 || zr_json_fault(json, path, "neither view nor poses: nothing moves");
}
