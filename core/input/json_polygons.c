/* The plain form of a scene, a soup of polygons -> one mesh, in which each
 * polygon is a face with vertices and a material of its own. */
#include "input/json_scene.h"

enum { VERTICES, HOLES, COLOR, COLORS, NORMALS, MATERIAL, LOOK, KEYS = LOOK + ZR_LOOK_KEYS };
static const char *const words[] = {"vertices", "holes", "color", "colors", "normals", "material", ZR_LOOK_WORDS};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

/* The mesh under construction, as far as it is filled. */
struct soup {
    size_t polygons, rings, vertices;
    bool has_colors, has_color, has_normals, has_holes; /* any polygon */
    zr_vec4 *positions, *colors, *face_colors;
    zr_vec3 *normals;
    uint32_t *face_offsets, *face_materials, *face_rings, *ring_offsets;
    uint32_t face, ring, vertex; /* filled so far */
};

static size_t count_items(const cJSON *list)
{
    size_t count = 0;
    for (const cJSON *item = cJSON_IsArray(list) ? list->child : NULL; item; item = item->next)
        count++;
    return count;
}

/* Sizes first; what is wrong is found, and reported, when it is read. */
static void measure(struct soup *soup, const cJSON *list)
{
    for (const cJSON *polygon = list->child; polygon; polygon = polygon->next, soup->polygons++) {
        soup->rings++;
        if (!cJSON_IsObject(polygon)) continue;
        const cJSON *holes = cJSON_GetObjectItemCaseSensitive(polygon, words[HOLES]);
        soup->vertices += count_items(cJSON_GetObjectItemCaseSensitive(polygon, words[VERTICES]));
        for (const cJSON *hole = cJSON_IsArray(holes) ? holes->child : NULL; hole; hole = hole->next, soup->rings++)
            soup->vertices += count_items(hole);
        soup->has_holes = soup->has_holes || holes;
        soup->has_color = soup->has_color || cJSON_GetObjectItemCaseSensitive(polygon, words[COLOR]);
        soup->has_colors = soup->has_colors || cJSON_GetObjectItemCaseSensitive(polygon, words[COLORS]);
        soup->has_normals = soup->has_normals || cJSON_GetObjectItemCaseSensitive(polygon, words[NORMALS]);
    }
}

static bool allocate(struct soup *soup, struct zr_arena *arena)
{
    const zr_vec4 white = {1, 1, 1, 1};
    soup->positions = zr_arena_alloc(arena, soup->vertices, sizeof *soup->positions);
    soup->face_offsets = zr_arena_alloc(arena, soup->polygons + 1, sizeof *soup->face_offsets);
    soup->face_materials = zr_arena_alloc(arena, soup->polygons, sizeof *soup->face_materials);
    if (soup->has_holes) {
        soup->face_rings = zr_arena_alloc(arena, soup->polygons + 1, sizeof *soup->face_rings);
        soup->ring_offsets = zr_arena_alloc(arena, soup->rings + 1, sizeof *soup->ring_offsets);
    }
    if (soup->has_normals) soup->normals = zr_arena_zero(arena, soup->vertices, sizeof *soup->normals);
    if (soup->has_colors) soup->colors = zr_arena_alloc(arena, soup->vertices, sizeof *soup->colors);
    if (soup->has_color) soup->face_colors = zr_arena_alloc(arena, soup->polygons, sizeof *soup->face_colors);
    if (!zr_arena_ok(arena)) return false;
    for (size_t i = 0; soup->colors && i < soup->vertices; i++)
        soup->colors[i] = white;
    for (size_t i = 0; soup->face_colors && i < soup->polygons; i++)
        soup->face_colors[i] = white;
    return true;
}

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

static void read_polygon(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node, struct soup *soup)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    if (!zr_json_object(json, path, node, &keys, found)) return;
    struct zr_style style;
    zr_draft_read_style(draft, path, found[MATERIAL], &found[LOOK], &style);
    if (found[COLOR] &&
        zr_json_color(json, ZR_JSON_KEY(path, words[COLOR]), found[COLOR], &soup->face_colors[soup->face]))
        zr_draft_note_alpha(draft, &soup->face_colors[soup->face], 1);
    style.is_plain = !found[COLORS];
    soup->face_materials[soup->face] =
        zr_draft_variant(draft, &style, found[COLOR] || found[COLORS], found[COLORS] || found[NORMALS]);
    if (!found[VERTICES]) {
        zr_json_fault(json, path, "vertices is missing");
        return;
    }
    size_t count;
    if (!read_rings(json, path, found[VERTICES], found[HOLES], soup, &count)) return;
    const struct zr_json_path *colors = ZR_JSON_KEY(path, words[COLORS]), *normals = ZR_JSON_KEY(path, words[NORMALS]);
    if (found[COLORS] && is_per_vertex(json, colors, found[COLORS], count) &&
        zr_json_vec4_list(json, colors, found[COLORS], zr_json_color, soup->colors + soup->vertex))
        zr_draft_note_alpha(draft, soup->colors + soup->vertex, count);
    if (found[NORMALS] && is_per_vertex(json, normals, found[NORMALS], count))
        zr_json_vec3_list(json, normals, found[NORMALS], soup->normals + soup->vertex);
    soup->vertex += (uint32_t)count;
}

void zr_draft_read_polygons(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *list,
                            struct zr_mesh *mesh)
{
    struct zr_json *json = &draft->json;
    struct soup soup = {0};
    measure(&soup, list);
    *mesh = (struct zr_mesh){.name = "polygons"};
    if (!allocate(&soup, json->arena)) return;
    size_t number = 0;
    for (const cJSON *node = list->child; node && !zr_json_full(json); node = node->next, number++) {
        soup.face_offsets[soup.face] = soup.vertex;
        if (soup.face_rings) soup.face_rings[soup.face] = soup.ring;
        read_polygon(draft, ZR_JSON_ITEM(path, number), node, &soup);
        soup.face++;
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
