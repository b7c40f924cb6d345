/* The plain form of a scene, a soup of polygons -> one mesh, in which each
 * polygon is a face with vertices and a material of its own. */
#include <string.h>

#include "input/json_rows.h"
#include "input/json_scene.h"
#include "input/json_text.h"
#include "input/json_walk.h"

enum { VERTICES, HOLES, COLOR, COLORS, NORMALS, MATERIAL, LOOK, KEYS = LOOK + ZR_LOOK_KEYS };
static const char *const words[] = {"vertices", "holes", "color", "colors", "normals", "material", ZR_LOOK_WORDS};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

/* What polygons have of their own, beside vertices. */
enum { HAS_COLOR = 1, HAS_COLORS = 2, HAS_NORMALS = 4, KINDS = 8 };

/* The members of a polygon that say how it looks, as text, and the material that came of it. */
struct known_look {
    const char *text; /* NULL: not seen yet */
    size_t size;
    uint32_t material;
};

/* The mesh under construction, as far as it is filled. */
struct soup {
    size_t polygons, rings, vertices;
    zr_vec4 *positions, *colors, *face_colors;
    zr_vec3 *normals;
    uint32_t *face_offsets, *face_materials, *face_rings, *ring_offsets;
    uint32_t face, ring, vertex;        /* filled so far */
    bool ahead;                         /* this is a part of it, filled beside others */
    struct known_look looks[2 * KINDS]; /* without members that say so, and with: the last, for neighbours look alike */
};

static bool allocate(struct soup *soup, const struct zr_json_soup *size, struct zr_arena *arena)
{
    soup->positions = zr_arena_alloc(arena, soup->vertices, sizeof *soup->positions);
    soup->face_offsets = zr_arena_alloc(arena, soup->polygons + 1, sizeof *soup->face_offsets);
    soup->face_materials = zr_arena_alloc(arena, soup->polygons, sizeof *soup->face_materials);
    if (size->has_holes) {
        soup->face_rings = zr_arena_alloc(arena, soup->polygons + 1, sizeof *soup->face_rings);
        soup->ring_offsets = zr_arena_alloc(arena, soup->rings + 1, sizeof *soup->ring_offsets);
    }
    if (size->has_normals) soup->normals = zr_arena_alloc(arena, soup->vertices, sizeof *soup->normals);
    if (size->has_colors) soup->colors = zr_arena_alloc(arena, soup->vertices, sizeof *soup->colors);
    if (size->has_color) soup->face_colors = zr_arena_alloc(arena, soup->polygons, sizeof *soup->face_colors);
    return zr_arena_ok(arena);
}

/* Ends a polygon of so many vertices: white and no normals where nothing is said. */
static void add_face(struct soup *soup, int has, size_t vertices)
{
    const zr_vec4 white = {1, 1, 1, 1};
    if (soup->face_colors && !(has & HAS_COLOR)) soup->face_colors[soup->face] = white;
    for (size_t i = 0; soup->colors && !(has & HAS_COLORS) && i < vertices; i++)
        soup->colors[soup->vertex + i] = white;
    for (size_t i = 0; soup->normals && !(has & HAS_NORMALS) && i < vertices; i++)
        soup->normals[soup->vertex + i] = (zr_vec3){0, 0, 0};
    soup->vertex += (uint32_t)vertices;
    soup->face++;
}

/* ---- polygons as most are, straight from the text ---- */

/* A polygon in plain form: what it has, how many of each, and the text of its look. */
struct plain {
    int has;
    size_t vertices, colors, normals;
    const char *look, *look_end;
    bool look_is_last; /* of the members so far */
};

/* Behind a row: to the next one, or behind the list, and *last becomes true. */
static inline const char *next_row(const char *at, const char *end, bool *last)
{
    at = zr_row_skip_space(at, end);
    if (at == end) return NULL;
    *last = *at == ']';
    return *at == ',' ? zr_row_skip_space(at + 1, end) : *last ? at + 1 : NULL;
}

/* Positions, or colours, which may be strings too. */
static const char *read_vec4s(const char *at, const char *end, double low, double high, bool colors, size_t room,
                              zr_vec4 *out, size_t *count)
{
    if (*at != '[') return NULL;
    at = zr_row_skip_space(at + 1, end);
    for (bool last = false; !last; ++*count) {
        if (*count == room) return NULL;
        bool string = colors && at < end && *at == '"';
        at = string ? zr_row_color(at, end, &out[*count]) : zr_row_vec4(at, end, low, high, &out[*count]);
        at = at ? next_row(at, end, &last) : NULL;
        if (!at) return NULL;
    }
    return at;
}

static const char *read_vec3s(const char *at, const char *end, double limit, size_t room, zr_vec3 *out, size_t *count)
{
    if (*at != '[') return NULL;
    at = zr_row_skip_space(at + 1, end);
    for (bool last = false; !last; ++*count) {
        if (*count == room) return NULL;
        at = zr_row_vec3(at, end, limit, &out[*count]);
        at = at ? next_row(at, end, &last) : NULL;
        if (!at) return NULL;
    }
    return at;
}

/* The value of the member at `at`, where it has this key; inlined, so that a key is two comparisons of words. */
static inline const char *value_of(const char *at, const char *end, const char *key, size_t size)
{
    if ((size_t)(end - at) <= size || memcmp(at, key, size) != 0) return NULL;
    at = zr_row_skip_space(at + size, end);
    if (at == end || *at != ':') return NULL;
    at = zr_row_skip_space(at + 1, end);
    return at < end ? at : NULL;
}

#define VALUE_OF(at, end, key) value_of((at), (end), "\"" key "\"", sizeof(key) + 1)

/* A member that only says how the polygon looks. Outlines are not among them: where they have colours, each is a
 * material of its own. */
static const char *read_look(struct plain *plain, const char *at, const char *end)
{
    size_t items, commas;
    const char *value = VALUE_OF(at, end, "material");
    if (!value) value = VALUE_OF(at, end, "doubleSided");
    if (!value) value = VALUE_OF(at, end, "shading");
    if (!value) value = VALUE_OF(at, end, "fill");
    if (!value || (plain->look && !plain->look_is_last)) return NULL;
    if (!plain->look) plain->look = at;
    plain->look_is_last = true;
    return plain->look_end = zr_json_skip(value, end, NULL, &items, &commas);
}

static const char *read_member(struct soup *soup, double limit, const char *at, const char *end, struct plain *plain)
{
    size_t room = soup->vertices - soup->vertex;
    const char *value;
    int has = 0;
    if (!plain->vertices && (value = VALUE_OF(at, end, "vertices")))
        at = read_vec4s(value, end, -limit, limit, false, room, soup->positions + soup->vertex, &plain->vertices);
    else if (soup->face_colors && (value = VALUE_OF(at, end, "color")) && (has = HAS_COLOR))
        at = zr_row_color(value, end, &soup->face_colors[soup->face]);
    else if (soup->colors && (value = VALUE_OF(at, end, "colors")) && (has = HAS_COLORS))
        at = read_vec4s(value, end, 0.0, 1.0, true, room, soup->colors + soup->vertex, &plain->colors);
    else if (soup->normals && (value = VALUE_OF(at, end, "normals")) && (has = HAS_NORMALS))
        at = read_vec3s(value, end, limit, room, soup->normals + soup->vertex, &plain->normals);
    else
        return read_look(plain, at, end);
    if (plain->has & has) return NULL; /* given twice */
    plain->has |= has;
    plain->look_is_last = false;
    return at;
}

static const char *read_members(struct soup *soup, double limit, const char *at, const char *end, struct plain *plain)
{
    if (*at != '{') return NULL;
    for (;;) {
        at = zr_row_skip_space(at + 1, end);
        if (at < end) at = read_member(soup, limit, at, end, plain);
        if (at) at = zr_row_skip_space(at, end);
        if (!at || at == end) return NULL;
        if (*at == '}') return at + 1;
        if (*at != ',') return NULL;
    }
}

static struct known_look *look_of(struct soup *soup, const struct plain *plain)
{
    return &soup->looks[plain->look ? plain->has + KINDS : plain->has];
}

/* The material of a look that has been seen before, or of none; UINT32_MAX where it is another one, or has to be made
 * while others read. */
static uint32_t find_material(struct zr_draft *draft, struct soup *soup, const struct plain *plain)
{
    struct known_look *look = look_of(soup, plain);
    if (plain->look) {
        size_t size = (size_t)(plain->look_end - plain->look);
        return look->text && look->size == size && memcmp(look->text, plain->look, size) == 0 ? look->material
                                                                                              : UINT32_MAX;
    }
    if (!look->text && soup->ahead) return UINT32_MAX;
    if (!look->text) {
        static const cJSON *const nothing[ZR_LOOK_KEYS];
        struct zr_style style;
        zr_draft_read_style(draft, NULL, NULL, nothing, &style);
        style.is_plain = !(plain->has & HAS_COLORS);
        *look = (struct known_look){"", 0,
                                    zr_draft_variant(draft, &style, plain->has & (HAS_COLOR | HAS_COLORS),
                                                     plain->has & (HAS_COLORS | HAS_NORMALS))};
    }
    return look->material;
}

/* Behind the polygon at `at`; NULL, and nothing has happened to the mesh, where it is not plain, or not right. */
static const char *read_plain(struct zr_draft *draft, const char *at, struct soup *soup, struct plain *plain)
{
    const struct zr_limits *limits = draft->json.limits;
    at = read_members(soup, (double)limits->coordinate_max, at, draft->json.text->end, plain);
    if (!at || plain->vertices < 3 || plain->vertices > limits->polygon_vertices_max ||
        ((plain->has & HAS_COLORS) && plain->colors != plain->vertices) ||
        ((plain->has & HAS_NORMALS) && plain->normals != plain->vertices)) {
        plain->look = NULL;
        return NULL;
    }
    uint32_t material = find_material(draft, soup, plain);
    if (material == UINT32_MAX) return NULL;
    soup->face_materials[soup->face] = material;
    if (soup->ring_offsets) soup->ring_offsets[soup->ring++] = soup->vertex;
    add_face(soup, plain->has, plain->vertices);
    return at;
}

/* ---- all others, by way of cJSON ---- */

/* One ring, behind the vertices that the polygon has so far: *count of them. */
static bool read_ring(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct soup *soup,
                      size_t *count)
{
    size_t more;
    if (!zr_json_array(json, path, node, &more)) return false;
    if (*count > 0 && more < 3) return zr_json_fault(json, path, "a ring of %zu vertices; 3 or more are needed", more);
    if (more < 3 || *count + more > json->limits->polygon_vertices_max)
        return zr_json_fault(json, path, "a polygon of %zu vertices; 3 to %u are allowed", *count + more,
                             json->limits->polygon_vertices_max);
    if (*count + more > soup->vertices - soup->vertex) {
        zr_error_add(json->error, ZR_INTERNAL, NULL, "the vertices of a polygon were miscounted");
        return false;
    }
    if (soup->ring_offsets) soup->ring_offsets[soup->ring++] = soup->vertex + (uint32_t)*count;
    if (!zr_json_vec4_list(json, path, node, zr_json_position, soup->positions + soup->vertex + *count)) return false;
    *count += more;
    return true;
}

static bool read_rings(struct zr_json *json, const struct zr_json_path *path, const cJSON *vertices, const cJSON *holes,
                       struct soup *soup, size_t *count)
{
    size_t hole_count, number = 0;
    *count = 0;
    if (!read_ring(json, ZR_JSON_KEY(path, words[VERTICES]), vertices, soup, count)) return false;
    if (!holes) return true;
    const struct zr_json_path *holes_path = ZR_JSON_KEY(path, words[HOLES]);
    if (!zr_json_array(json, holes_path, holes, &hole_count)) return false;
    for (const cJSON *hole = holes->child; hole; hole = hole->next, number++)
        if (!read_ring(json, ZR_JSON_ITEM(holes_path, number), hole, soup, count)) return false;
    return true;
}

/* A list with as many items as the polygon has vertices. */
static bool is_per_vertex(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, size_t vertices)
{
    size_t count;
    if (!zr_json_array(json, path, node, &count)) return false;
    return count == vertices ||
           zr_json_fault(json, path, "%zu items for %zu vertices; one each is needed", count, vertices);
}

/* True where all is well; else the face has no vertices. */
static bool read_members_of(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                            struct soup *soup, int *has, size_t *count)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    if (!zr_json_object(json, path, node, &keys, found)) return false;
    struct zr_style style;
    zr_draft_read_style(draft, path, found[MATERIAL], &found[LOOK], &style);
    if (found[COLOR])
        zr_json_color(json, ZR_JSON_KEY(path, words[COLOR]), found[COLOR], &soup->face_colors[soup->face]);
    style.is_plain = !found[COLORS];
    soup->face_materials[soup->face] =
        zr_draft_variant(draft, &style, found[COLOR] || found[COLORS], found[COLORS] || found[NORMALS]);
    if (!found[VERTICES]) return zr_json_fault(json, path, "vertices is missing");
    if (!read_rings(json, path, found[VERTICES], found[HOLES], soup, count)) return false;
    const struct zr_json_path *colors = ZR_JSON_KEY(path, words[COLORS]), *normals = ZR_JSON_KEY(path, words[NORMALS]);
    if (found[COLORS] && is_per_vertex(json, colors, found[COLORS], *count))
        zr_json_vec4_list(json, colors, found[COLORS], zr_json_color, soup->colors + soup->vertex);
    if (found[NORMALS] && is_per_vertex(json, normals, found[NORMALS], *count))
        zr_json_vec3_list(json, normals, found[NORMALS], soup->normals + soup->vertex);
    *has = (found[COLOR] ? HAS_COLOR : 0) | (found[COLORS] ? HAS_COLORS : 0) | (found[NORMALS] ? HAS_NORMALS : 0);
    return true;
}

static void read_polygon(struct zr_draft *draft, struct zr_json_walk *walk, struct soup *soup)
{
    struct plain plain = {0};
    soup->face_offsets[soup->face] = soup->vertex;
    if (soup->face_rings) soup->face_rings[soup->face] = soup->ring;
    walk->behind = read_plain(draft, walk->at, soup, &plain);
    if (walk->behind) return;
    cJSON *item = zr_json_walk_parse(walk);
    if (!item) return;
    size_t faults = draft->json.error->count, count = 0;
    int has = 0;
    if (!read_members_of(draft, ZR_JSON_ITEM(walk->path, walk->index), item, soup, &has, &count)) count = 0;
    if (plain.look && draft->json.error->count == faults)
        *look_of(soup, &plain) =
            (struct known_look){plain.look, (size_t)(plain.look_end - plain.look), soup->face_materials[soup->face]};
    add_face(soup, has, count);
    zr_json_walk_drop(walk, item);
}

struct soup_reader {
    struct zr_draft *draft;
    struct soup *soup;
};

/* Rings have no place of their own in a walk: where there are holes, one thread reads all. */
static void read_polygons(struct zr_json_walk *walk, void *context)
{
    const struct soup_reader *reader = context;
    struct soup soup = *reader->soup;
    soup.ahead = walk->ahead;
    if (walk->begun) soup.face = (uint32_t)walk->index + 1;
    soup.vertex = (uint32_t)walk->number;
    soup.vertices = walk->to.numbers;
    while (zr_json_walk_on(walk))
        read_polygon(reader->draft, walk, &soup);
    walk->number = soup.vertex;
    if (!walk->ahead)
        *reader->soup = soup;
    else if (walk->number != walk->to.numbers)
        walk->done = false; /* not all vertices are of plain polygons */
}

void zr_draft_read_polygons(struct zr_draft *draft, const struct zr_json_path *path, struct zr_json_list *list,
                            struct zr_mesh *mesh)
{
    struct zr_json *json = &draft->json;
    struct soup soup = {.polygons = list->items, .rings = list->soup.rings, .vertices = list->soup.vertices};
    *mesh = (struct zr_mesh){.name = "polygons"};
    if (!allocate(&soup, &list->soup, json->arena)) return;
    struct soup_reader reader = {draft, &soup};
    struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
    /* The first one alone: nothing is known of looks yet. */
    if (zr_json_walk_on(&walk)) read_polygon(draft, &walk, &soup);
    walk.number = soup.vertex;
    if (soup.face_rings)
        read_polygons(&walk, &reader);
    else
        zr_json_walk_all(&walk, read_polygons, &reader);
    soup.face = (uint32_t)walk.index;
    soup.vertex = (uint32_t)walk.number;
    if (json->error->count == 0 && walk.index == list->items) { /* else not all colours are there */
        zr_draft_note_alpha(draft, soup.face_colors, soup.face_colors ? soup.face : 0);
        zr_draft_note_alpha(draft, soup.colors, soup.colors ? soup.vertex : 0);
    }
    soup.face_offsets[soup.face] = soup.vertex;
    if (soup.face_rings) soup.face_rings[soup.face] = soup.ring;
    if (soup.ring_offsets) soup.ring_offsets[soup.ring] = soup.vertex;
    uint32_t *indices = zr_arena_alloc(json->arena, soup.vertex, sizeof *indices);
    if (!indices || soup.face == 0) return;
    for (uint32_t i = 0; i < soup.vertex; i++)
        indices[i] = i;
    *mesh = (struct zr_mesh){.name = "polygons",
                             .position_count = soup.vertex,
                             .positions = soup.positions,
                             .face_count = soup.face,
                             .face_offsets = soup.face_offsets,
                             .indices = indices,
                             .face_rings = soup.face_rings,
                             .ring_offsets = soup.ring_offsets,
                             .normal_count = soup.normals ? soup.vertex : 0,
                             .normals = soup.normals,
                             .colors = soup.colors,
                             .face_colors = soup.face_colors,
                             .face_materials = soup.face_materials,
                             .material = soup.face_materials[0]};
}
