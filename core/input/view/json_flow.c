/* The keys of the target of the channel flow. Their values are read after the root (json_flow_target.c). */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

enum { VIEW, POSES };
#define AT(member) offsetof(struct zr_parsed_flow, member)
static const struct zr_json_field fields[] = {
    [VIEW] = {"view", zr_json_value_start, AT(view), .object = &zr_json_object_view, .otherwise = "that of the picture",
              .text = "pose and projection of the camera"},
    [POSES] = {"poses", zr_json_value_start, AT(poses), .otherwise = "those of the picture",
               .text = "matrices of nodes, by their names",
               .schema = ZR_SCHEMA({"type" : "object", "additionalProperties" : {"$ref" : "#/$defs/affine"}})}};
#undef AT
static const struct zr_json_rule rules[] = {
    {ZR_RULE_SOME, .text = "neither view nor poses: nothing moves", .sets = {ZR_KEY(VIEW) | ZR_KEY(POSES)}}};
const struct zr_json_object zr_json_object_flow = {
    ZR_JSON_FIELDS("flow", fields), ZR_JSON_RULES(rules),
    .schema = ZR_SCHEMA({"properties" : {"view" : {"properties" : {"camera" : false}}}})};

bool zr_read_flow(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint64_t keys;
    return zr_json_fields(json, path, &zr_json_object_flow, out, &keys);
}
