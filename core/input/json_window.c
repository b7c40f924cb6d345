/* The window: the size of the picture. */
#include "input/json_objects.h"
#include "input/json_scene.h"

static const struct zr_json_field window_fields[] = {
    {"width", zr_json_whole, offsetof(struct zr_view, width), .unit = "pixels", .otherwise = "640",
     .text = "width of the picture", .schema = ZR_SCHEMA_OF("side")},
    {"height", zr_json_whole, offsetof(struct zr_view, height), .unit = "pixels", .otherwise = "480",
     .text = "height of the picture", .schema = ZR_SCHEMA_OF("side")}};
const struct zr_json_object zr_json_object_window = ZR_JSON_OBJECT_OF("window", window_fields);

bool zr_read_window(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field, void *out)
{
    struct zr_parsed_scene *root = out;
    uint64_t keys;
    (void)field;
    return zr_json_fields(json, path, &zr_json_object_window, &root->scene->views[0], &keys);
}
