#include "input/json_scene.h"

#include <string.h>

enum {
    NAME,
    MATERIAL,
    POSITIONS,
    NORMALS,
    COLORS,
    FACE_COLORS,
    FACES,
    LINES,
    HEIGHTS,
    LOOK,
    KEYS = LOOK + ZR_LOOK_KEYS
};
static const char *const words[] = {"name",  "material", "positions", "normals",     "colors",    "faceColors",
                                    "faces", "lines",    "heights",   ZR_LOOK_WORDS, "texcoords", "data"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static const char *copy_text(struct zr_arena *arena, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = zr_arena_alloc(arena, size, 1);
    return copy ? memcpy(copy, text, size) : "";
}

/* A list that must have one item for each of `wanted` things. */
static bool read_count(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, size_t wanted,
                       const char *of)
{
    size_t count;
    if (!zr_json_array(json, path, node, &count)) return false;
    return count == wanted || zr_json_fault(json, path, "%zu items for %zu %s; one each is needed", count, wanted, of);
}

/* A list of colours, one for each; NULL where it is not given or not right. */
static const zr_vec4 *read_colors(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                                  size_t wanted, const char *of)
{
    struct zr_json *json = &draft->json;
    if (!node || !read_count(json, path, node, wanted, of)) return NULL;
    zr_vec4 *colors = zr_arena_alloc(json->arena, wanted, sizeof *colors);
    if (!colors || !zr_json_vec4_list(json, path, node, zr_json_color, colors)) return NULL;
    zr_draft_note_alpha(draft, colors, wanted);
    return colors;
}

static void read_positions(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                           struct zr_mesh *mesh)
{
    size_t count;
    if (!zr_json_array(json, path, node, &count)) return;
    zr_vec4 *positions = zr_arena_alloc(json->arena, count, sizeof *positions);
    if (!positions) return;
    zr_json_vec4_list(json, path, node, zr_json_position, positions);
    mesh->position_count = (uint32_t)count;
    mesh->positions = positions;
}

static void read_normals(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    if (!read_count(json, path, node, mesh->position_count, "positions")) return;
    zr_vec3 *normals = zr_arena_alloc(json->arena, mesh->position_count, sizeof *normals);
    if (!normals || !zr_json_vec3_list(json, path, node, normals)) return;
    mesh->normal_count = mesh->position_count;
    mesh->normals = normals;
}

/* Writes a face's corners to `indices`, which has room for all items of `node`. */
static void read_face(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t positions,
                      uint32_t *indices)
{
    size_t count, corner = 0;
    if (!zr_json_array(json, path, node, &count)) return;
    if (count < 3 || count > json->limits->polygon_vertices_max) {
        zr_json_fault(json, path, "a face of %zu corners; 3 to %u are allowed", count,
                      json->limits->polygon_vertices_max);
        return;
    }
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, corner++)
        zr_json_index(json, ZR_JSON_ITEM(path, corner), item, positions, "positions", &indices[corner]);
}

static size_t count_corners(const cJSON *faces)
{
    size_t corners = 0;
    for (const cJSON *face = faces->child; face; face = face->next)
        for (const cJSON *corner = cJSON_IsArray(face) ? face->child : NULL; corner; corner = corner->next)
            corners++;
    return corners;
}

static void read_faces(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    size_t faces, face = 0;
    if (!zr_json_array(json, path, node, &faces)) return;
    uint32_t *offsets = zr_arena_alloc(json->arena, faces + 1, sizeof *offsets);
    uint32_t *indices = zr_arena_alloc(json->arena, count_corners(node), sizeof *indices);
    if (!zr_arena_ok(json->arena)) return;
    uint32_t used = 0;
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, face++) {
        size_t faults = json->error->count;
        offsets[face] = used;
        read_face(json, ZR_JSON_ITEM(path, face), item, mesh->position_count, indices + used);
        if (json->error->count == faults) used += (uint32_t)cJSON_GetArraySize(item);
    }
    offsets[face] = used;
    mesh->face_count = (uint32_t)face;
    mesh->face_offsets = offsets;
    mesh->indices = indices;
}

static void read_lines(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    size_t count, number = 0;
    if (!zr_json_array(json, path, node, &count)) return;
    uint32_t *lines = zr_arena_alloc(json->arena, count, 2 * sizeof *lines);
    if (!lines) return;
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, number++) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, number);
        size_t ends;
        if (!zr_json_array(json, at, item, &ends)) continue;
        if (ends != 2) {
            zr_json_fault(json, at, "a line of %zu ends; it has two", ends);
            continue;
        }
        const cJSON *end = item->child;
        for (size_t k = 0; k < 2; k++, end = end->next)
            zr_json_index(json, ZR_JSON_ITEM(at, k), end, mesh->position_count, "positions", &lines[2 * number + k]);
    }
    mesh->line_count = (uint32_t)count;
    mesh->lines = lines;
}

/* Either positions with faces, lines or both, or heights. */
static void check_shape(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found)
{
    static const int others[] = {POSITIONS, FACES, LINES};
    if (found[HEIGHTS]) {
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (found[others[i]]) zr_json_fault(json, path, "two shapes: heights and %s", words[others[i]]);
        return;
    }
    if (!found[POSITIONS]) zr_json_fault(json, path, "positions is missing");
    if (!found[FACES] && !found[LINES]) zr_json_fault(json, path, "faces is missing, and so is lines");
}

void zr_draft_read_mesh(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                        struct zr_mesh *mesh)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    static const uint32_t no_faces[1] = {0};
    *mesh = (struct zr_mesh){.name = "", .face_offsets = no_faces};
    if (!zr_json_object(json, path, node, &keys, found)) return;
    const char *name;
    if (found[NAME] && zr_json_string(json, ZR_JSON_KEY(path, words[NAME]), found[NAME], &name))
        mesh->name = copy_text(json->arena, name);
    check_shape(json, path, found);
    struct zr_style style;
    zr_draft_read_style(draft, path, found[MATERIAL], &found[LOOK], &style);
    style.is_open = found[HEIGHTS] != NULL;
    if (!found[HEIGHTS] && (!found[POSITIONS] || (!found[FACES] && !found[LINES]))) return;

    const bool *holes = NULL;
    if (found[HEIGHTS])
        holes = zr_json_read_heights(json, ZR_JSON_KEY(path, words[HEIGHTS]), found[HEIGHTS], mesh);
    else
        read_positions(json, ZR_JSON_KEY(path, words[POSITIONS]), found[POSITIONS], mesh);
    if (!mesh->positions) return; /* no count to hold the rest against */
    if (found[NORMALS]) read_normals(json, ZR_JSON_KEY(path, words[NORMALS]), found[NORMALS], mesh);
    mesh->colors =
        read_colors(draft, ZR_JSON_KEY(path, words[COLORS]), found[COLORS], mesh->position_count, "positions");
    if (found[FACES] && !found[HEIGHTS]) read_faces(json, ZR_JSON_KEY(path, words[FACES]), found[FACES], mesh);
    if (found[LINES] && !found[HEIGHTS]) read_lines(json, ZR_JSON_KEY(path, words[LINES]), found[LINES], mesh);
    mesh->face_colors =
        read_colors(draft, ZR_JSON_KEY(path, words[FACE_COLORS]), found[FACE_COLORS], mesh->face_count, "faces");
    mesh->material = zr_draft_variant(draft, &style, mesh->colors || mesh->face_colors,
                                      mesh->normals || mesh->colors || found[HEIGHTS]);
    if (holes) zr_heights_drop_holes(json->arena, holes, mesh);
}
