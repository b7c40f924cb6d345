/* Reads polygons, the simple form of a scene, into the arrays of parsed_mesh.h. */
#include "input/json/json_array.h"
#include "input/json/json_list.h"
#include "input/json/json_number_rows.h"
#include "input/mesh/parsed_mesh.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"

/* A polygon while it is read. */
struct polygon {
    struct zr_soup *soup;
    size_t first_vertex;
    zr_vec4 color;
    const char *holes; /* place in the text, or NULL */
    struct zr_polygon_style style;
};

/* ---- lists of a polygon ---- */

/* A list with one item per vertex, and the array that may stand for it. All polygons append to the same lists of the
 * scene, so arrays are copied. */
struct vertex_list {
    size_t offset; /* in struct zr_soup */
    struct zr_array_wanted array;
    zr_rows_read_fn *read;
    const void *otherwise; /* item of polygons without the list; NULL: all have it */
};
#define AT(member) offsetof(struct zr_soup, member)
static const struct vertex_list positions_list = {AT(positions),
                                                  {.least = 3, .most = 4, .is_changed = true, .is_place = true},
                                                  zr_rows_read_positions,
                                                  NULL},
                                colors_list = {AT(colors),
                                               {.least = 3, .most = 4, .is_changed = true, .is_color = true},
                                               zr_rows_read_colors,
                                               &zr_soup_white},
                                normals_list = {AT(normals),
                                                {.least = 3, .most = 3, .is_changed = true},
                                                zr_rows_read_vec3s,
                                                &zr_soup_computed};
#undef AT

static struct zr_growing *items_of(const struct polygon *polygon, const struct vertex_list *of)
{
    return (struct zr_growing *)(void *)((char *)polygon->soup + of->offset);
}

/* Appends the items of the next value, a list or an array. The path numbers them from item `first` on. */
static bool read_items_of(struct zr_json *json, const struct zr_json_path *path, const struct vertex_list *of,
                          size_t first, struct zr_growing *items)
{
    if (zr_json_type(json) == ZR_JSON_OBJECT) {
        struct zr_array_wanted wanted = of->array;
        wanted.high = wanted.is_color ? 1.0 : (double)json->limits->coordinate_max;
        wanted.low = wanted.is_color ? 0.0 : -wanted.high;
        return zr_json_array_read(json, path, &wanted, items);
    }
    if (!zr_json_list(json, path) || !zr_json_enter(json, '[')) return false;
    const unsigned inside = json->depth;
    items->first = first;
    of->read(json, path, items, json->end);
    zr_json_check_closed(json, inside);
    return true;
}

/* struct polygon: a ring of positions: the outer one or, called with its path, a hole. */
static bool read_ring(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const struct polygon *polygon = out;
    struct zr_growing *positions = &polygon->soup->positions;
    const size_t first = positions->count;
    if (!read_items_of(json, path, &positions_list, first, positions)) return false;
    const size_t count = positions->count - first, most = json->limits->polygon_vertices_max;
    const size_t all = positions->count - polygon->first_vertex;
    if (first > polygon->first_vertex && count < 3)
        return zr_json_fault(json, path, "a ring of %zu vertices; 3 or more are needed", count);
    if (count < 3 || all > most)
        return zr_json_fault(json, path, "a polygon of %zu vertices; 3 to %zu are allowed", all, most);
    return true;
}

/* Reads a list with one item per vertex. Earlier polygons get the default if this is the first such list. */
static bool read_each(struct zr_json *json, const struct zr_json_path *path, const struct polygon *polygon,
                      const struct vertex_list *of)
{
    struct zr_growing *items = items_of(polygon, of);
    return zr_growing_fill(items, json, polygon->first_vertex, of->otherwise) &&
           read_items_of(json, path, of, polygon->first_vertex, items);
}

/* struct polygon, also for read_normals */
static bool read_colors(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_each(json, path, out, &colors_list);
}

static bool read_normals(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return read_each(json, path, out, &normals_list);
}

/* zr_vec4 */
static bool read_color(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_json_type(json);
    const char *behind = zr_numbers_color(json->at, json->end, out);
    if (!behind) return zr_json_color(json, path, out);
    json->at = behind;
    return true;
}

/* struct zr_json_text: a name, compared as written and decoded once per style. */
static bool read_material(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_json_type(json) == ZR_JSON_STRING ? zr_json_take_string(json, out)
                                                : zr_json_expect(json, path, "a string");
}

/* ---- a polygon ---- */

enum { VERTICES, HOLES, COLOR, COLORS, NORMALS, MATERIAL };
#define AT(member) offsetof(struct polygon, member)
static const struct zr_json_field fields[] = {
    [VERTICES] = {"vertices", read_ring, 0, .required = true, .unit = "scene units",
                  .text = "list of [x,y,z] or [x,y,z,w], counter-clockwise", .schema = ZR_SCHEMA_OF("ring")},
    [HOLES] = {"holes", zr_json_value_start, AT(holes), .otherwise = "[]", .text = "rings of vertices to cut out",
               .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/ring"}})},
    [COLOR] = {"color", read_color, AT(color), .otherwise = "white", .text = "colour of the polygon",
               .schema = ZR_SCHEMA_OF("color")},
    [COLORS] = {"colors", read_colors, 0, .text = "colours, one per vertex", .schema = ZR_SCHEMA_OF("colors")},
    [NORMALS] = {"normals", read_normals, 0, .otherwise = "computed", .text = "normals, one per vertex",
                 .schema = ZR_SCHEMA_OF("vectors")},
    [MATERIAL] = {ZR_POLYGON_MATERIAL, read_material, AT(style.material), .otherwise = "none",
                  .text = "name of a material", .schema = ZR_SCHEMA({"type" : "string"})},
    ZR_FACE_STYLE_FIELDS(struct polygon, style.face_style),
    ZR_SIDES_FIELD(struct polygon, style.face_style)};
const struct zr_json_object zr_json_object_polygon = ZR_JSON_OBJECT_OF("polygon", fields);

/* Appends the rings of the last polygon, the outer one first. Before the first hole, it also appends the outer rings of
 * all earlier polygons. */
static bool read_holes(struct zr_json *json, const struct zr_json_path *path, struct polygon *polygon)
{
    struct zr_soup *soup = polygon->soup;
    const uint32_t *offsets = soup->offsets.items;
    for (size_t i = soup->rings.count; i < soup->offsets.count; i++)
        if (!zr_growing_add(&soup->rings, json, soup->ring_offsets.count) ||
            !zr_growing_add(&soup->ring_offsets, json, offsets[i]))
            return false;
    if (!polygon->holes) return true;
    struct zr_json there = zr_json_at(json, polygon->holes);
    const struct zr_json_path *holes = ZR_JSON_KEY(path, fields[HOLES].key);
    size_t number = 0;
    if (!zr_json_list(&there, holes)) return false;
    for (zr_json_enter(&there, '['); zr_json_item(&there); number++)
        if (!zr_growing_add(&soup->ring_offsets, json, soup->positions.count) ||
            !read_ring(&there, ZR_JSON_ITEM(holes, number), polygon))
            return false;
    return true;
}

/* Checks that a given list has one item per vertex. Extends a list that is not given, if an earlier polygon has it. */
static bool check_list(struct zr_json *json, const struct zr_json_path *path, const struct polygon *polygon,
                       bool is_given, const struct vertex_list *of)
{
    const size_t behind = polygon->soup->positions.count;
    struct zr_growing *items = items_of(polygon, of);
    if (!is_given) return items->items == NULL || zr_growing_fill(items, json, behind, of->otherwise);
    return items->count == behind ||
           zr_json_fault(json, path, "%zu items for %zu vertices; the counts must be equal",
                         items->count - polygon->first_vertex, behind - polygon->first_vertex);
}

/* Removes the vertices of a polygon with faults, so that the next polygon is checked on its own. */
static void drop_vertices(const struct polygon *polygon)
{
    struct zr_growing *const lists[] = {&polygon->soup->positions, &polygon->soup->colors, &polygon->soup->normals};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (lists[i]->count > polygon->first_vertex) lists[i]->count = polygon->first_vertex;
}

static void read_polygon(struct zr_json *json, const struct zr_json_path *path, struct zr_soup *soup)
{
    struct polygon polygon = {.soup = soup,
                              .first_vertex = soup->positions.count,
                              .color = zr_soup_white,
                              .style = {.polygon = (uint32_t)soup->offsets.count, .face_style = zr_face_style_unset}};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_growing_add(&soup->offsets, json, polygon.first_vertex)) return;
    zr_json_fields(json, path, &zr_json_object_polygon, &polygon, &keys);
    const bool has_color = zr_json_gives(keys, COLOR), has_colors = zr_json_gives(keys, COLORS),
               has_normals = zr_json_gives(keys, NORMALS);
    if (polygon.holes && json->is_ahead)
        zr_json_give_up(json); /* rings need the count of all rings before, so one thread reads them */
    if (zr_json_failed_since(json, faults)) {
        drop_vertices(&polygon);
        return;
    }
    if (polygon.holes || soup->rings.count > 0) read_holes(json, path, &polygon);
    if (has_color || soup->face_colors.items) {
        if (!zr_growing_fill(&soup->face_colors, json, soup->offsets.count - 1, &zr_soup_white) ||
            !zr_growing_fill(&soup->face_colors, json, soup->offsets.count, &polygon.color))
            return;
    }
    check_list(json, ZR_JSON_KEY(path, fields[COLORS].key), &polygon, has_colors, &colors_list);
    check_list(json, ZR_JSON_KEY(path, fields[NORMALS].key), &polygon, has_normals, &normals_list);
    polygon.style.has = (has_color ? ZR_POLYGON_COLOR : 0) | (has_colors ? ZR_POLYGON_COLORS : 0) |
                        (has_normals ? ZR_POLYGON_NORMALS : 0);
    uint32_t style;
    if (zr_soup_find_style(json, soup, &polygon.style, &style)) zr_growing_add(&soup->face_styles, json, style);
}

/* ---- all polygons ---- */

static void read_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_soup *soup = state;
    while (json->at < until && zr_json_item(json))
        read_polygon(json, ZR_JSON_ITEM(path, soup->offsets.count), soup);
}

bool zr_read_polygons(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_json_list list = {'{', read_items, zr_soup_begin_part, zr_soup_join};
    struct zr_soup *soup = zr_arena_alloc(json->arena, 1, sizeof *soup);
    if (!soup) return false;
    *soup = zr_soup_empty();
    struct zr_parsed_scene *root = out;
    root->soup = soup;
    json->assets->use |= ZR_USED_BY_GEOMETRY;
    if (json->far) json->move = zr_far_move(json->far, json->far->mesh_count);
    const bool good = zr_json_list_read(json, path, &list, soup);
    json->assets->use = ZR_USED;
    root->polygons_end = json->at;
    return good;
}
