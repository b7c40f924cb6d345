#include "input/mesh/parsed_mesh.h"
#include "input/text/recenter.h"

#include <string.h>

#include "input/scene/kept.h"

#define NO_STYLE UINT32_MAX

const zr_vec4 zr_soup_white = {1, 1, 1, 1};
const zr_vec3 zr_soup_computed = {0, 0, 0};

/* ---- styles ---- */

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

bool zr_soup_find_style(struct zr_json *json, struct zr_soup *soup, const struct zr_polygon_style *style,
                        uint32_t *number)
{
    uint32_t *last = &soup->last_styles[style->has];
    const struct zr_polygon_style *styles = soup->styles.items;
    if (*last == NO_STYLE || !same_text(&styles[*last].material, &style->material) ||
        !same_face_style(&styles[*last].face_style, &style->face_style)) {
        struct zr_polygon_style *place = zr_growing_next(&soup->styles, json);
        if (!place) return false;
        *place = *style;
        *last = (uint32_t)soup->styles.count++;
    }
    *number = *last;
    return true;
}

/* ---- parts of the list ---- */

struct zr_soup zr_soup_empty(void)
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
                           .styles.size = sizeof(struct zr_polygon_style)};
    for (int i = 0; i < ZR_POLYGON_KINDS; i++)
        soup.last_styles[i] = NO_STYLE;
    return soup;
}

/* begin_part for an optional array. */
static bool begin_if_any(struct zr_json *json, const struct zr_growing *array, struct zr_growing *part, double share)
{
    return array->count == 0 || zr_growing_begin_part(json, array, part, share, 1);
}

bool zr_soup_begin_part(struct zr_json *json, const void *state, void *part, double share)
{
    const struct zr_soup *all = state;
    struct zr_soup *soup = part;
    *soup = zr_soup_empty();
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
    return zr_growing_fill(all, json, count, item) && zr_growing_join(json, all, part) &&
           zr_growing_fill(all, json, count + part_count, item);
}

static bool join_styles(struct zr_json *json, struct zr_soup *all, const struct zr_soup *part)
{
    const uint32_t *numbers = part->face_styles.items;
    const struct zr_polygon_style *styles = part->styles.items;
    uint32_t last = NO_STYLE, number = 0;
    for (size_t i = 0; i < part->face_styles.count; i++) {
        if (numbers[i] != last) {
            struct zr_polygon_style style = styles[last = numbers[i]];
            style.polygon += (uint32_t)all->offsets.count;
            if (!zr_soup_find_style(json, all, &style, &number)) return false;
        }
        if (!zr_growing_add(&all->face_styles, json, number)) return false;
    }
    return true;
}

bool zr_soup_join(struct zr_json *json, void *state, const void *part)
{
    struct zr_soup *all = state;
    const struct zr_soup *soup = part;
    const size_t vertices = all->positions.count, polygons = all->offsets.count;
    const uint32_t *offsets = soup->offsets.items;
    if (!join_styles(json, all, soup) || !zr_growing_join(json, &all->positions, &soup->positions) ||
        !join_some(json, &all->colors, vertices, &soup->colors, soup->positions.count, &zr_soup_white) ||
        !join_some(json, &all->normals, vertices, &soup->normals, soup->positions.count, &zr_soup_computed) ||
        !join_some(json, &all->face_colors, polygons, &soup->face_colors, soup->offsets.count, &zr_soup_white))
        return false;
    for (size_t i = 0; i < soup->offsets.count; i++)
        if (!zr_growing_add(&all->offsets, json, vertices + offsets[i])) return false;
    return true;
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
    if (!copy_array(arena, &soup->styles)) return false;
    struct zr_polygon_style *styles = soup->styles.items;
    for (size_t i = 0; i < soup->styles.count; i++) {
        struct zr_json_text *name = &styles[i].material;
        if (!name->at) continue;
        const size_t size = (size_t)(name->end - name->at);
        name->at = zr_arena_copy(arena, name->at, size);
        if (!name->at) return false;
        name->end = name->at + size;
    }
    return true;
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
    const struct zr_polygon_style *styles = soup->styles.items;
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
                root, ZR_JSON_KEY(ZR_JSON_ITEM(path, styles[i].polygon), ZR_POLYGON_MATERIAL), name);
        if (zr_parsed_has_textures(root, style.material))
            zr_json_fault(&root->json, ZR_JSON_KEY(ZR_JSON_ITEM(path, styles[i].polygon), ZR_POLYGON_MATERIAL),
                          "it has textures, which need texcoords; only meshes have them");
        style.is_uniform = !(styles[i].has & ZR_POLYGON_COLORS);
        materials[i] = zr_parsed_make_material(root, &style, styles[i].has & (ZR_POLYGON_COLOR | ZR_POLYGON_COLORS),
                                               styles[i].has & (ZR_POLYGON_COLORS | ZR_POLYGON_NORMALS));
    }
    for (size_t f = 0; materials && alphas && f < soup->face_styles.count; f++)
        faces[f] = materials[faces[f]];
}

/* Passes the normals of polygons that have some to the builder; the others are filled with zeros. Runs before
 * find_materials replaces the style numbers. */
static void note_normals(struct zr_scene_builder *builder, uint32_t mesh, const struct zr_soup *soup)
{
    const struct zr_polygon_style *styles = soup->styles.items;
    const uint32_t *numbers = soup->face_styles.items, *offsets = soup->offsets.items;
    const zr_vec3 *normals = soup->normals.items;
    for (size_t f = 0; normals && f < soup->face_styles.count; f++) {
        const size_t end = f + 1 < soup->offsets.count ? offsets[f + 1] : soup->positions.count;
        if (styles[numbers[f]].has & ZR_POLYGON_NORMALS)
            zr_scene_builder_note_normals(builder, mesh, normals + offsets[f], end - offsets[f]);
    }
}

bool zr_parsed_has_polygons(const struct zr_parsed_scene *root)
{
    return root->soup && root->soup->offsets.count > 0;
}

void zr_parsed_make_polygons(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *mesh)
{
    struct zr_json *json = &root->json;
    struct zr_soup *soup = root->soup;
    const size_t faces = soup->offsets.count, vertices = soup->positions.count;
    *mesh = (struct zr_mesh){.name = "polygons"};
    if (json->error->count > 0 || !zr_arena_ok(json->arena)) return;
    if (soup->rings.count > 0 && (!zr_growing_add(&soup->rings, json, soup->ring_offsets.count) ||
                                  !zr_growing_add(&soup->ring_offsets, json, vertices)))
        return;
    note_normals(root->builder, (uint32_t)root->meshes.count, soup);
    find_materials(root, path, soup);
    if (!zr_growing_add(&soup->offsets, json, vertices)) return;
    *mesh = (struct zr_mesh){.name = "polygons",
                             .position_count = (uint32_t)vertices,
                             .positions = soup->positions.items,
                             .move = json->far ? zr_far_move(json->far, json->far->mesh_count) : NULL,
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
}
