/* Reads polygons, the simple form of a scene, into one mesh. Each polygon is a face with its own vertices and
 * material. */
#include <string.h>

#include "input/json_array.h"
#include "input/json_list.h"
#include "input/json_objects.h"
#include "input/json_rows.h"
#include "input/json_scene.h"
#include "input/kept.h"

/* Kinds of polygons, by their optional colours and normals. */
enum { HAS_COLOR = 1, HAS_COLORS = 2, HAS_NORMALS = 4, KINDS = 8 };

#define NO_STYLE UINT32_MAX

/* The style of polygons; it becomes a material once the root is read. */
struct style {
    uint32_t polygon; /* the first with this style */
    int has;
    struct zr_json_text material; /* name as written, escapes unresolved; at is NULL if there is none */
    struct zr_face_style face_style;
};

/* The polygons read so far. An optional array is empty until a polygon has such a list; then the earlier polygons get
 * defaults. */
struct zr_soup {
    struct zr_growing positions, colors, normals; /* one per vertex; colors and normals are optional */
    struct zr_growing offsets, face_styles;       /* one per polygon */
    struct zr_growing face_colors;                /* one per polygon; optional */
    struct zr_growing rings, ring_offsets;        /* of all polygons; empty without holes */
    struct zr_growing styles;
    uint32_t last_styles[KINDS]; /* the last style of each kind, for comparison: consecutive polygons often share it */
};

_Static_assert(sizeof(struct zr_soup) <= ZR_JSON_STATE_MAX, "a state of json_list.h");

/* A polygon while it is read. */
struct polygon {
    struct zr_soup *soup;
    size_t first_vertex;
    zr_vec4 color;
    const char *holes; /* place in the text, or NULL */
    struct style style;
};

/* ---- lists of a polygon ---- */

/* Arrays that may stand for a list. The scene's lists are shared by all polygons, and change. */
static const struct zr_array_wanted position_array = {.least = 3, .most = 4, .is_changed = true},
                                    color_array = {.least = 3, .most = 4, .is_changed = true, .is_color = true},
                                    normal_array = {.least = 3, .most = 3, .is_changed = true};

/* Appends the items of the next value, a list or an array. The path numbers them from item `first` on. */
static bool read_items_of(struct zr_json *json, const struct zr_json_path *path, struct zr_array_wanted wanted,
                          zr_rows_read_fn *read, size_t first, struct zr_growing *list)
{
    if (zr_json_type(json) == ZR_JSON_OBJECT) {
        wanted.high = wanted.is_color ? 1.0 : (double)json->limits->coordinate_max;
        wanted.low = wanted.is_color ? 0.0 : -wanted.high;
        return zr_json_array_read(json, path, &wanted, list);
    }
    if (!zr_json_list(json, path) || !zr_json_enter(json, '[')) return false;
    const unsigned inside = json->depth;
    read(json, path, list, first, json->end);
    zr_json_check_closed(json, inside);
    return true;
}

/* struct polygon: a ring of positions: the outer one or, called with its path, a hole. */
static bool read_ring(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                      void *out)
{
    const struct polygon *polygon = out;
    struct zr_growing *positions = &polygon->soup->positions;
    const size_t first = positions->count;
    (void)field;
    if (!read_items_of(json, path, position_array, zr_rows_read_positions, first, positions)) return false;
    const size_t count = positions->count - first, most = json->limits->polygon_vertices_max;
    const size_t all = positions->count - polygon->first_vertex;
    if (first > polygon->first_vertex && count < 3)
        return zr_json_fault(json, path, "a ring of %zu vertices; 3 or more are needed", count);
    if (count < 3 || all > most)
        return zr_json_fault(json, path, "a polygon of %zu vertices; 3 to %zu are allowed", all, most);
    return true;
}

/* Extends the array to `count` items by copies of `item`. */
static bool fill(struct zr_growing *array, struct zr_json *json, size_t count, const void *item)
{
    if (array->count >= count) return true;
    if (!zr_growing_reserve(array, json, count - array->count)) return false;
    for (; array->count < count; array->count++)
        memcpy((char *)array->items + array->count * array->size, item, array->size);
    return true;
}

static const zr_vec4 white = {1, 1, 1, 1};
static const zr_vec3 computed = {0, 0, 0}; /* normal that is computed later */

/* Reads a list with one item per vertex. Earlier polygons get `item` if this is the first such list. */
static bool read_each(struct zr_json *json, const struct zr_json_path *path, const struct polygon *polygon,
                      struct zr_growing *list, const void *item, struct zr_array_wanted wanted, zr_rows_read_fn *read)
{
    return fill(list, json, polygon->first_vertex, item) &&
           read_items_of(json, path, wanted, read, polygon->first_vertex, list);
}

/* struct polygon, also for read_normals */
static bool read_colors(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                        void *out)
{
    const struct polygon *polygon = out;
    (void)field;
    return read_each(json, path, polygon, &polygon->soup->colors, &white, color_array, zr_rows_read_colors);
}

static bool read_normals(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                         void *out)
{
    const struct polygon *polygon = out;
    (void)field;
    return read_each(json, path, polygon, &polygon->soup->normals, &computed, normal_array, zr_rows_read_vec3s);
}

/* zr_vec4 */
static bool read_color(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                       void *out)
{
    zr_json_type(json);
    const char *behind = zr_row_color(json->at, json->end, out);
    if (!behind) return zr_json_color(json, path, field, out);
    json->at = behind;
    return true;
}

/* struct zr_json_text: a name, compared as written and decoded once per style. */
static bool read_material(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                          void *out)
{
    (void)field;
    return zr_json_type(json) == ZR_JSON_STRING ? zr_json_take_string(json, out)
                                                : zr_json_expect(json, path, "a string");
}

/* ---- a polygon ---- */

enum { VERTICES, HOLES, COLOR, COLORS, NORMALS, MATERIAL };
#define AT(member) offsetof(struct polygon, member)
static const struct zr_json_field fields[] = {
    [VERTICES] = {"vertices", read_ring, 0, .required = true, .unit = "scene units",
                  .text = "list of [x,y,z] or [x,y,z,w], counter-clockwise"},
    [HOLES] = {"holes", zr_json_place, AT(holes), .otherwise = "[]", .text = "rings of vertices to cut out"},
    [COLOR] = {"color", read_color, AT(color), .otherwise = "white", .text = "colour of the polygon"},
    [COLORS] = {"colors", read_colors, 0, .text = "colours, one per vertex"},
    [NORMALS] = {"normals", read_normals, 0, .otherwise = "computed", .text = "normals, one per vertex"},
    [MATERIAL] = {"material", read_material, AT(style.material), .otherwise = "none", .text = "name of a material"},
    ZR_FACE_STYLE_FIELDS(struct polygon, style.face_style),
    ZR_SIDES_FIELD(struct polygon, style.face_style)};
const struct zr_json_object zr_json_object_polygon = ZR_JSON_OBJECT_OF("polygon", fields);

static bool add(struct zr_growing *array, struct zr_json *json, size_t value)
{
    uint32_t *place = zr_growing_next(array, json);
    if (!place) return false;
    *place = (uint32_t)value;
    array->count++;
    return true;
}

/* Appends the rings of the last polygon, the outer one first. Before the first hole, it also appends the outer rings of
 * all earlier polygons. */
static bool read_holes(struct zr_json *json, const struct zr_json_path *path, struct polygon *polygon)
{
    struct zr_soup *soup = polygon->soup;
    const uint32_t *offsets = soup->offsets.items;
    for (size_t i = soup->rings.count; i < soup->offsets.count; i++)
        if (!add(&soup->rings, json, soup->ring_offsets.count) || !add(&soup->ring_offsets, json, offsets[i]))
            return false;
    if (!polygon->holes) return true;
    struct zr_json there = zr_json_at(json, polygon->holes);
    const struct zr_json_path *holes = ZR_JSON_KEY(path, fields[HOLES].key);
    size_t number = 0;
    if (!zr_json_list(&there, holes)) return false;
    for (zr_json_enter(&there, '['); zr_json_item(&there); number++)
        if (!add(&soup->ring_offsets, json, soup->positions.count) ||
            !read_ring(&there, ZR_JSON_ITEM(holes, number), NULL, polygon))
            return false;
    return true;
}

/* Checks that a given list has one item per vertex. Extends a list that is not given, if an earlier polygon has it. */
static bool check_list(struct zr_json *json, const struct zr_json_path *path, const struct polygon *polygon,
                       bool is_given, int key, struct zr_growing *list, const void *item)
{
    const size_t behind = polygon->soup->positions.count;
    if (!is_given) return list->items == NULL || fill(list, json, behind, item);
    return list->count == behind ||
           zr_json_fault(json, ZR_JSON_KEY(path, fields[key].key), "%zu items for %zu vertices; one each is needed",
                         list->count - polygon->first_vertex, behind - polygon->first_vertex);
}

static bool same_text(const struct zr_json_text *a, const struct zr_json_text *b)
{
    if (!a->at || !b->at) return a->at == b->at;
    return a->end - a->at == b->end - b->at && memcmp(a->at, b->at, (size_t)(a->end - a->at)) == 0;
}

static bool same_face_style(const struct zr_face_style *a, const struct zr_face_style *b)
{
    return a->shading == b->shading && a->double_sided == b->double_sided && a->fill == b->fill &&
           a->outline == b->outline && zr_vec4_equal(a->outline_color, b->outline_color) &&
           a->alpha_mode == b->alpha_mode && a->alpha_cutoff == b->alpha_cutoff;
}

/* Returns the number of an equal style, or adds it. */
static bool find_style(struct zr_json *json, struct zr_soup *soup, const struct style *style, uint32_t *number)
{
    uint32_t *last = &soup->last_styles[style->has];
    const struct style *styles = soup->styles.items;
    if (*last == NO_STYLE || !same_text(&styles[*last].material, &style->material) ||
        !same_face_style(&styles[*last].face_style, &style->face_style)) {
        struct style *place = zr_growing_next(&soup->styles, json);
        if (!place) return false;
        *place = *style;
        *last = (uint32_t)soup->styles.count++;
    }
    *number = *last;
    return true;
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
                              .color = white,
                              .style = {.polygon = (uint32_t)soup->offsets.count, .face_style = zr_face_style_unset}};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!add(&soup->offsets, json, polygon.first_vertex)) return;
    zr_json_fields(json, path, &zr_json_object_polygon, &polygon, &keys);
    const bool has_color = zr_json_gives(keys, COLOR), has_colors = zr_json_gives(keys, COLORS),
               has_normals = zr_json_gives(keys, NORMALS);
    if (polygon.holes && json->is_ahead)
        zr_json_give_up(json); /* rings need the count of all rings before, so one thread reads them */
    if (json->error->count > faults || json->ended) {
        drop_vertices(&polygon);
        return;
    }
    if (polygon.holes || soup->rings.count > 0) read_holes(json, path, &polygon);
    if (has_color || soup->face_colors.items) {
        if (!fill(&soup->face_colors, json, soup->offsets.count - 1, &white) ||
            !fill(&soup->face_colors, json, soup->offsets.count, &polygon.color))
            return;
    }
    check_list(json, path, &polygon, has_colors, COLORS, &soup->colors, &white);
    check_list(json, path, &polygon, has_normals, NORMALS, &soup->normals, &computed);
    polygon.style.has = (has_color ? HAS_COLOR : 0) | (has_colors ? HAS_COLORS : 0) | (has_normals ? HAS_NORMALS : 0);
    uint32_t style;
    if (find_style(json, soup, &polygon.style, &style)) add(&soup->face_styles, json, style);
}

/* ---- all polygons ---- */

static struct zr_soup empty_soup(void)
{
    const struct zr_growing words = {.size = sizeof(uint32_t)}, fours = {.size = sizeof(zr_vec4)};
    struct zr_soup soup = {.positions = fours,
                           .colors = fours,
                           .normals.size = sizeof(zr_vec3),
                           .offsets = words,
                           .face_styles = words,
                           .face_colors = fours,
                           .rings = words,
                           .ring_offsets = words,
                           .styles.size = sizeof(struct style)};
    for (int i = 0; i < KINDS; i++)
        soup.last_styles[i] = NO_STYLE;
    return soup;
}

static void read_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_soup *soup = state;
    while (json->at < until && zr_json_item(json))
        read_polygon(json, ZR_JSON_ITEM(path, soup->offsets.count), soup);
}

/* begin_part for an optional array. */
static bool begin_if_any(struct zr_json *json, const struct zr_growing *array, struct zr_growing *part, double share)
{
    return array->count == 0 || zr_growing_begin_part(json, array, part, share, 1);
}

static bool begin_soup(struct zr_json *json, const void *state, void *part, double share)
{
    const struct zr_soup *all = state;
    struct zr_soup *soup = part;
    *soup = empty_soup();
    return all->rings.count == 0 && zr_growing_begin_part(json, &all->positions, &soup->positions, share, 1) &&
           zr_growing_begin_part(json, &all->offsets, &soup->offsets, share, 1) &&
           zr_growing_begin_part(json, &all->face_styles, &soup->face_styles, share, 1) &&
           begin_if_any(json, &all->colors, &soup->colors, share) &&
           begin_if_any(json, &all->normals, &soup->normals, share) &&
           begin_if_any(json, &all->face_colors, &soup->face_colors, share);
}

/* Appends an optional array; fills the missing part with `item` if only one of the two has it. */
static bool join_some(struct zr_json *json, struct zr_growing *all, size_t count, const struct zr_growing *part,
                      size_t part_count, const void *item)
{
    if (!all->items && !part->items) return true;
    return fill(all, json, count, item) && zr_growing_join(json, all, part) &&
           fill(all, json, count + part_count, item);
}

static bool join_styles(struct zr_json *json, struct zr_soup *all, const struct zr_soup *part)
{
    const uint32_t *numbers = part->face_styles.items;
    const struct style *styles = part->styles.items;
    uint32_t last = NO_STYLE, number = 0;
    for (size_t i = 0; i < part->face_styles.count; i++) {
        if (numbers[i] != last) {
            struct style style = styles[last = numbers[i]];
            style.polygon += (uint32_t)all->offsets.count;
            if (!find_style(json, all, &style, &number)) return false;
        }
        if (!add(&all->face_styles, json, number)) return false;
    }
    return true;
}

static bool join_soup(struct zr_json *json, void *state, const void *part)
{
    struct zr_soup *all = state;
    const struct zr_soup *soup = part;
    const size_t vertices = all->positions.count, polygons = all->offsets.count;
    const uint32_t *offsets = soup->offsets.items;
    if (!join_styles(json, all, soup) || !zr_growing_join(json, &all->positions, &soup->positions) ||
        !join_some(json, &all->colors, vertices, &soup->colors, soup->positions.count, &white) ||
        !join_some(json, &all->normals, vertices, &soup->normals, soup->positions.count, &computed) ||
        !join_some(json, &all->face_colors, polygons, &soup->face_colors, soup->offsets.count, &white))
        return false;
    for (size_t i = 0; i < soup->offsets.count; i++)
        if (!add(&all->offsets, json, vertices + offsets[i])) return false;
    return true;
}

bool zr_read_polygons(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                      void *out)
{
    static const struct zr_json_list list = {'{', read_items, begin_soup, join_soup};
    struct zr_soup *soup = zr_arena_alloc(json->arena, 1, sizeof *soup);
    (void)field;
    if (!soup) return false;
    *soup = empty_soup();
    struct zr_parsed_scene *root = out;
    root->soup = soup;
    json->assets->use |= ZR_USED_BY_GEOMETRY;
    const bool good = zr_json_list_read(json, path, &list, soup);
    json->assets->use = ZR_USED;
    root->polygons_end = json->at;
    return good;
}

/* ---- copies ---- */

/* Copies an array to which one more item may be added. */
static bool copy_array(struct zr_arena *arena, struct zr_growing *array)
{
    void *items = zr_arena_alloc(arena, array->count + 1, array->size);
    if (items && array->count > 0) memcpy(items, array->items, array->count * array->size);
    if (array->items) array->items = items;
    array->room = array->items ? array->count + 1 : 0;
    return items;
}

static bool copy_texts(struct zr_arena *arena, struct zr_soup *soup)
{
    struct style *styles = soup->styles.items;
    if (!copy_array(arena, &soup->styles)) return false;
    styles = soup->styles.items;
    for (size_t i = 0; i < soup->styles.count; i++) {
        struct zr_json_text *name = &styles[i].material;
        const size_t size = name->at ? (size_t)(name->end - name->at) : 0;
        char *copied = name->at ? zr_arena_alloc(arena, size, 1) : NULL;
        if (!copied) continue;
        memcpy(copied, name->at, size);
        name->at = copied;
        name->end = copied + size;
    }
    return zr_arena_ok(arena);
}

struct zr_soup *zr_soup_copy(struct zr_arena *arena, const struct zr_soup *soup, bool texts)
{
    struct zr_soup *copy = zr_arena_alloc(arena, 1, sizeof *copy);
    if (!copy) return NULL;
    *copy = *soup;
    if (texts && !copy_texts(arena, copy)) return NULL;
    return copy_array(arena, &copy->face_styles) && copy_array(arena, &copy->offsets) &&
                   copy_array(arena, &copy->rings) && copy_array(arena, &copy->ring_offsets)
               ? copy
               : NULL;
}

/* ---- a mesh ---- */

/* Returns the alpha range of the polygons of each style. */
static struct zr_alpha_range *find_alphas(struct zr_json *json, const struct zr_soup *soup)
{
    struct zr_alpha_range *alphas = zr_arena_alloc(json->arena, soup->styles.count, sizeof *alphas);
    const uint32_t *styles = soup->face_styles.items, *offsets = soup->offsets.items;
    const zr_vec4 *face_colors = soup->face_colors.items, *colors = soup->colors.items;
    for (size_t i = 0; alphas && i < soup->styles.count; i++)
        alphas[i] = (struct zr_alpha_range){1.0f, 0.0f};
    for (size_t f = 0; alphas && f < soup->face_styles.count; f++) {
        struct zr_alpha_range *all = &alphas[styles[f]];
        const size_t end = f + 1 < soup->offsets.count ? offsets[f + 1] : soup->positions.count;
        const struct zr_alpha_range range =
            zr_alpha_range_times(face_colors ? zr_alpha_range_of(&face_colors[f], 1) : zr_alpha_opaque,
                                 colors ? zr_alpha_range_of(colors + offsets[f], end - offsets[f]) : zr_alpha_opaque);
        if (range.least < all->least) all->least = range.least;
        if (range.most > all->most) all->most = range.most;
    }
    return alphas;
}

/* Makes the material of each style and replaces each face's style number by its material. */
static void find_materials(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_soup *soup)
{
    const struct style *styles = soup->styles.items;
    uint32_t *materials = zr_arena_alloc(root->json.arena, soup->styles.count, sizeof *materials);
    uint32_t *faces = soup->face_styles.items;
    const struct zr_alpha_range *alphas = find_alphas(&root->json, soup);
    for (size_t i = 0; materials && alphas && i < soup->styles.count; i++) {
        if (zr_json_stops(&root->json)) return;
        struct zr_style style = {.material = root->material_count,
                                 .face_style = styles[i].face_style,
                                 .has_faces = true,
                                 .number = styles[i].polygon,
                                 .is_polygon = true,
                                 .alpha = alphas[i]};
        const char *name = styles[i].material.at ? zr_json_decode(&root->json, &styles[i].material) : NULL;
        if (name)
            style.material = zr_parsed_find_material(
                root, ZR_JSON_KEY(ZR_JSON_ITEM(path, styles[i].polygon), fields[MATERIAL].key), name);
        if (zr_parsed_has_textures(root, style.material))
            zr_json_fault(&root->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, styles[i].polygon), fields[MATERIAL].key),
                          "it has textures, which need texcoords: meshes have them, and polygons have not");
        style.is_uniform = !(styles[i].has & HAS_COLORS);
        materials[i] = zr_parsed_make_material(root, &style, styles[i].has & (HAS_COLOR | HAS_COLORS),
                                               styles[i].has & (HAS_COLORS | HAS_NORMALS));
    }
    for (size_t f = 0; materials && alphas && f < soup->face_styles.count; f++)
        faces[f] = materials[faces[f]];
}

/* Passes the normals of polygons that have some to the builder; the others are filled with zeros. Runs before
 * find_materials replaces the style numbers. */
static void note_normals(struct zr_scene_builder *builder, uint32_t mesh, const struct zr_soup *soup)
{
    const struct style *styles = soup->styles.items;
    const uint32_t *numbers = soup->face_styles.items, *offsets = soup->offsets.items;
    const zr_vec3 *normals = soup->normals.items;
    for (size_t f = 0; normals && f < soup->face_styles.count; f++) {
        const size_t end = f + 1 < soup->offsets.count ? offsets[f + 1] : soup->positions.count;
        if (styles[numbers[f]].has & HAS_NORMALS)
            zr_scene_builder_note_normals(builder, mesh, normals + offsets[f], end - offsets[f]);
    }
}

bool zr_parsed_make_polygons(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *mesh)
{
    struct zr_json *json = &root->json;
    struct zr_soup *soup = root->soup;
    if (!soup || soup->offsets.count == 0) return false;
    const size_t faces = soup->offsets.count, vertices = soup->positions.count;
    *mesh = (struct zr_mesh){.name = "polygons"};
    if (json->error->count > 0 || !zr_arena_ok(json->arena)) return true;
    if (soup->rings.count > 0 &&
        (!add(&soup->rings, json, soup->ring_offsets.count) || !add(&soup->ring_offsets, json, vertices)))
        return true;
    note_normals(root->builder, (uint32_t)root->meshes.count, soup);
    find_materials(root, path, soup);
    if (!add(&soup->offsets, json, vertices)) return true;
    *mesh = (struct zr_mesh){.name = "polygons",
                             .position_count = (uint32_t)vertices,
                             .positions = soup->positions.items,
                             .face_count = (uint32_t)faces,
                             .face_offsets = soup->offsets.items,
                             .face_rings = soup->rings.items,
                             .ring_offsets = soup->ring_offsets.items,
                             .normal_count = soup->normals.items ? (uint32_t)vertices : 0,
                             .normals = soup->normals.items,
                             .colors = soup->colors.items,
                             .face_colors = soup->face_colors.items,
                             .face_materials = soup->face_styles.items,
                             .material = *(const uint32_t *)soup->face_styles.items};
    return true;
}
