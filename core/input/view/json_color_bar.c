/* Reads a colour bar: true, false, or an object. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

static const char *const places[] = {"right", "left"};
static const struct zr_names place_names = ZR_NAMES(2, places);

struct given_color_bar {
    const char *mesh, *title;
    int place;
    bool has_room;
};

enum { MESH };
#define AT(member) offsetof(struct given_color_bar, member)
static const struct zr_json_field fields[] = {
    [MESH] = {"mesh", zr_json_string, AT(mesh), .otherwise = "the first drawn mesh with scalars",
              .text = "name of the mesh whose colormap and range are shown"},
    {"title", zr_json_string, AT(title), .otherwise = "none", .text = "line above the bar: a quantity and its unit"},
    {"place", zr_json_choice, AT(place), .words = &place_names, .otherwise = "right", .text = "edge of the picture"},
    {"room", zr_json_bool, AT(has_room), .otherwise = "false", .text = "fitted views leave room for the bar"}};
#undef AT
const struct zr_json_object zr_json_object_colorBar = ZR_JSON_OBJECT_OF("colorBar", fields);

bool zr_read_color_bar(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_color_bar *bar = &root->scene->color_bar;
    const enum zr_json_type type = zr_json_type(json);
    struct given_color_bar given = {.place = 0};
    uint64_t keys;
    if (type == ZR_JSON_BOOL) return zr_json_take_bool(json, &bar->is_on);
    if (type != ZR_JSON_OBJECT) return zr_json_expect(json, path, "true, false or an object");
    if (!zr_json_fields(json, path, &zr_json_object_colorBar, &given, &keys)) return false;
    *bar = (struct zr_color_bar){.is_on = true, .is_left = given.place == 1, .title = given.title};
    root->color_bar_mesh = given.mesh;
    if (given.has_room) root->scene->views[0].annotate.bar_room = bar->is_left ? ZR_BAR_ROOM_LEFT : ZR_BAR_ROOM_RIGHT;
    return true;
}

void zr_parsed_find_color_bar_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    struct zr_color_bar *bar = &root->scene->color_bar;
    bar->has_mesh = zr_parsed_find_mesh(root, ZR_JSON_KEY(path, fields[MESH].key), root->color_bar_mesh, &bar->mesh);
}
