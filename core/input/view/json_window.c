/* The window: the size of the picture. */
#include <float.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

/* uint32_t. zr_scene_validate checks the range. */
static bool read_side(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double value;
    if (!zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, &value)) return false;
    if (value >= 0 && value <= UINT32_MAX && (double)(uint32_t)value == value) {
        *(uint32_t *)out = (uint32_t)value;
        return true;
    }
    return zr_json_fault(json, path, "%.9g pixels; 1 to %u are allowed, in whole pixels", value,
                         json->limits->window_side_max);
}

static const struct zr_json_field window_fields[] = {
    {"width", read_side, offsetof(struct zr_view, width), .unit = "pixels", .otherwise = "640",
     .text = "width of the picture", .schema = ZR_SCHEMA_OF("side")},
    {"height", read_side, offsetof(struct zr_view, height), .unit = "pixels", .otherwise = "480",
     .text = "height of the picture", .schema = ZR_SCHEMA_OF("side")}};
const struct zr_json_object zr_json_object_window = ZR_JSON_OBJECT_OF("window", window_fields);

bool zr_read_window(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    uint64_t keys;
    return zr_json_fields(json, path, &zr_json_object_window, &root->scene->views[0], &keys);
}
