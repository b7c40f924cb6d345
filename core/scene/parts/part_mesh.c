#include "scene/parts/part_mesh.h"
#include "base/cancel.h"
#include "scene/picture.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 12 };

/* Checks for cancellation at every ITEMS_PER_CANCEL_CHECK-th item. */
static bool is_stopped(const struct zr_arena *arena, uint64_t item)
{
    return item % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(arena->cancel);
}

/* Factors of a ghost's opacity. The second one is for the shading xray, which is translucent by itself. */
#define GHOST_OPACITY      0.16f
#define GHOST_XRAY_OPACITY 0.45f

/* ---- materials ---- */

static void hide(struct zr_material *material)
{
    *material = (struct zr_material){.base_color = material->base_color,
                                     .uniform_color = material->uniform_color,
                                     .shading = ZR_SHADING_UNLIT,
                                     .unfilled = true,
                                     .is_hidden = true};
}

static void color(struct zr_material *material, zr_vec4 color)
{
    material->base_color = (zr_vec4){color.x, color.y, color.z, material->base_color.w};
    material->emissive = (zr_vec3){0, 0, 0};
    material->textures[ZR_TEXTURE_EMISSIVE] = 0;
    if (material->alpha_mode != ZR_ALPHA_MASK) material->textures[ZR_TEXTURE_BASE_COLOR] = 0;
}

/* Makes a ghost of a material. In drawings, surfaces have the colour of the background, and lines show them. Ghosts
 * have no lines, so they become x-rays there. An x-ray without a colour of its part has the colour of the lines. */
static void make_ghost(const struct zr_picture *picture, bool has_color, struct zr_material *material)
{
    const bool is_drawing = material->shading == ZR_SHADING_GOOCH || material->shading == ZR_SHADING_UNLIT;
    if (picture->edges.is_on && is_drawing) {
        const zr_vec3 ink = picture->edges.color;
        material->shading = ZR_SHADING_XRAY;
        if (!has_color) {
            material->base_color = (zr_vec4){ink.x, ink.y, ink.z, material->base_color.w};
            material->textures[ZR_TEXTURE_BASE_COLOR] = 0;
        }
    }
    if (material->alpha_mode != ZR_ALPHA_BLEND) material->base_color.w = 1.0f;
    material->alpha_mode = ZR_ALPHA_BLEND;
    material->base_color.w *= material->shading == ZR_SHADING_XRAY ? GHOST_XRAY_OPACITY : GHOST_OPACITY;
}

/* Applies a style to the material `number`. Returns the number of the result. */
static uint32_t style_material(struct zr_scene_builder *builder, const zr_vec4 *colors, uint32_t number, uint32_t style)
{
    struct zr_material material = builder->materials[number];
    if (style == 0) return number;
    if (style >> ZR_PART_COLOR_SHIFT) color(&material, colors[(style >> ZR_PART_COLOR_SHIFT) - 1]);
    if (style & ZR_PART_GHOST) make_ghost(builder->scene->picture, style >> ZR_PART_COLOR_SHIFT != 0, &material);
    if (style & ZR_PART_HIDDEN) hide(&material);
    if (style & ZR_PART_OPERAND) material.is_operand = material.double_sided = true;
    return zr_scene_builder_material(builder, &material);
}

static uint32_t part_of(const struct zr_mesh *mesh, uint32_t face)
{
    return mesh->face_parts ? mesh->face_parts[face] : 0;
}

/* Returns the style of lines and points. They have the style of a mesh's only part. Otherwise they belong to no part,
 * and are hidden or have no style. */
static uint32_t style_of_rest(const struct zr_mesh *mesh, const struct zr_part_mesh_edit *edit)
{
    return mesh->face_parts ? edit->hides_rest ? ZR_PART_HIDDEN : 0 : edit->styles[0];
}

static bool style_materials(struct zr_scene_builder *builder, const struct zr_part_mesh_edit *edit,
                            struct zr_mesh *mesh)
{
    const uint32_t own = mesh->material;
    mesh->material = style_material(builder, edit->colors, own, style_of_rest(mesh, edit));
    if (!mesh->face_materials && !mesh->face_parts) return zr_arena_ok(builder->arena);
    uint32_t *materials = zr_arena_alloc(builder->arena, mesh->face_count, sizeof *materials);
    uint32_t last = UINT32_MAX, last_style = 0, made = 0;
    for (uint32_t f = 0; materials && f < mesh->face_count; f++) {
        const uint32_t number = mesh->face_materials ? mesh->face_materials[f] : own;
        const uint32_t style = edit->styles[part_of(mesh, f)];
        if (is_stopped(builder->arena, f)) return false;
        if (number != last || style != last_style) made = style_material(builder, edit->colors, number, style);
        last = number;
        last_style = style;
        materials[f] = made;
    }
    mesh->face_materials = materials;
    return zr_arena_ok(builder->arena);
}

/* ---- own positions for each part ---- */

/* Positions of a mesh, copied for each part that uses them. Position i is a copy of from[i] for the part part[i]. Lines
 * and points belong to no part; part[i] of their positions is the number of parts. */
struct split {
    uint32_t count, *from, *part;
    uint32_t *next;            /* per face: the next face of its part; UINT32_MAX: none */
    uint32_t *first;           /* per part */
    uint32_t *seen_by, *place; /* per position of the mesh: 1 + the last part that uses it, and its copy */
};

static uint32_t place_of(struct split *s, uint32_t position, uint32_t part)
{
    if (s->seen_by[position] == part + 1) return s->place[position];
    s->seen_by[position] = part + 1;
    s->place[position] = s->count;
    s->from[s->count] = position;
    s->part[s->count] = part;
    return s->count++;
}

static bool open_split(struct zr_arena *arena, const struct zr_mesh *mesh, struct split *s)
{
    const uint64_t most = zr_mesh_corners(mesh);
    s->from = zr_arena_alloc(arena, most, sizeof *s->from);
    s->part = zr_arena_alloc(arena, most, sizeof *s->part);
    s->next = zr_arena_alloc(arena, mesh->face_count, sizeof *s->next);
    s->first = zr_arena_alloc(arena, mesh->part_count, sizeof *s->first);
    s->seen_by = zr_arena_zero(arena, mesh->position_count, sizeof *s->seen_by);
    s->place = zr_arena_alloc(arena, mesh->position_count, sizeof *s->place);
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t p = 0; p < mesh->part_count; p++)
        s->first[p] = UINT32_MAX;
    for (uint32_t f = mesh->face_count; f-- > 0;) {
        if (is_stopped(arena, f)) return false;
        s->next[f] = s->first[mesh->face_parts[f]];
        s->first[mesh->face_parts[f]] = f;
    }
    return true;
}

/* Returns the copied positions of lines or points; positions NULL: i. NULL without memory, or if cancelled. */
static const uint32_t *place_rest(struct zr_arena *arena, struct split *s, const struct zr_mesh *mesh,
                                  const uint32_t *positions, uint64_t count)
{
    uint32_t *out = zr_arena_alloc(arena, count, sizeof *out);
    for (uint64_t i = 0; out && i < count; i++) {
        if (is_stopped(arena, i)) return NULL;
        out[i] = place_of(s, positions ? positions[i] : (uint32_t)i, mesh->part_count);
    }
    return out;
}

/* Replaces the positions of corners, lines and points by copies. */
static bool place_all(struct zr_arena *arena, struct split *s, struct zr_mesh *mesh)
{
    uint32_t *indices = zr_arena_alloc(arena, mesh->face_offsets[mesh->face_count], sizeof *indices), faces = 0;
    if (!indices) return false;
    for (uint32_t p = 0; p < mesh->part_count; p++)
        for (uint32_t f = s->first[p]; f != UINT32_MAX; f = s->next[f]) {
            if (is_stopped(arena, faces++)) return false;
            for (uint32_t c = mesh->face_offsets[f]; c < mesh->face_offsets[f + 1]; c++)
                indices[c] = place_of(s, mesh->indices[c], p);
        }
    mesh->lines = place_rest(arena, s, mesh, mesh->lines, 2 * (uint64_t)mesh->line_count);
    mesh->points = place_rest(arena, s, mesh, mesh->points, mesh->point_count);
    if (mesh->normal_count > 0 && !mesh->normal_indices) mesh->normal_indices = mesh->indices;
    mesh->indices = indices;
    return mesh->lines && mesh->points;
}

/* Returns the values of an array for all copied positions; NULL for NULL. Stops early if cancelled. */
static zr_vec4 *gather(struct zr_arena *arena, const struct split *s, const zr_vec4 *values)
{
    zr_vec4 *out = values ? zr_arena_alloc(arena, s->count, sizeof *out) : NULL;
    for (uint32_t i = 0; out && i < s->count && !is_stopped(arena, i); i++)
        out[i] = values[s->from[i]];
    return out;
}

static void move(const struct zr_arena *arena, const struct split *s, const struct zr_part_offset *offsets,
                 uint32_t part_count, zr_vec4 *positions)
{
    for (uint32_t i = 0; i < s->count && !is_stopped(arena, i); i++) {
        if (s->part[i] == part_count) continue;
        zr_vec4 *p = &positions[i];
        const double *by = offsets[s->part[i]].by, w = (double)p->w;
        *p = (zr_vec4){(float)((double)p->x + by[0] * w), (float)((double)p->y + by[1] * w),
                       (float)((double)p->z + by[2] * w), p->w};
    }
}

/* Makes the vertex colours of recoloured parts white. */
static void whiten(const struct zr_arena *arena, const struct split *s, const uint32_t *styles, uint32_t part_count,
                   zr_vec4 *colors)
{
    for (uint32_t i = 0; i < s->count && !is_stopped(arena, i); i++)
        if (s->part[i] < part_count && styles[s->part[i]] >> ZR_PART_COLOR_SHIFT) colors[i] = (zr_vec4){1, 1, 1, 1};
}

/* Gives each part its own positions, moves them, and makes the vertex colours of recoloured parts white. */
static bool split(struct zr_arena *arena, const struct zr_part_mesh_edit *edit, struct zr_mesh *mesh)
{
    struct split s = {.count = 0};
    if (!open_split(arena, mesh, &s) || !place_all(arena, &s, mesh)) return false;
    zr_vec4 *positions = gather(arena, &s, mesh->positions);
    zr_vec4 *colors = gather(arena, &s, mesh->colors);
    mesh->texcoords = gather(arena, &s, mesh->texcoords);
    mesh->tangents = gather(arena, &s, mesh->tangents);
    if (!zr_arena_ok(arena)) return false;
    if (edit->offsets) move(arena, &s, edit->offsets, mesh->part_count, positions);
    if (colors) whiten(arena, &s, edit->styles, mesh->part_count, colors);
    mesh->positions = positions;
    mesh->position_count = s.count;
    mesh->colors = colors;
    return !zr_is_cancelled(arena->cancel);
}

/* ---- colours ---- */

static bool any_part_has_color(const struct zr_mesh *mesh, const struct zr_part_mesh_edit *edit)
{
    for (uint32_t p = 0; p < zr_mesh_part_count(mesh); p++)
        if (edit->styles[p] >> ZR_PART_COLOR_SHIFT) return true;
    return false;
}

/* Makes the face colours of recoloured parts white. */
static bool whiten_faces(struct zr_arena *arena, const struct zr_part_mesh_edit *edit, struct zr_mesh *mesh)
{
    if (!mesh->face_colors) return true;
    zr_vec4 *colors = zr_arena_alloc(arena, mesh->face_count, sizeof *colors);
    for (uint32_t f = 0; colors && f < mesh->face_count; f++) {
        if (is_stopped(arena, f)) return false;
        const bool is_white = edit->styles[part_of(mesh, f)] >> ZR_PART_COLOR_SHIFT;
        colors[f] = is_white ? (zr_vec4){1, 1, 1, 1} : mesh->face_colors[f];
    }
    mesh->face_colors = colors;
    return colors != NULL;
}

/* ---- shown positions ---- */

/* True for elements that are not drawn, and for tools of combined solids. */
static bool is_passed_over(const struct zr_scene_builder *builder, uint32_t material, uint32_t style)
{
    return builder->materials[material].is_hidden || style & ZR_PART_TOOL;
}

/* Lists the positions of elements that views fit. */
static bool list_shown(struct zr_arena *arena, const struct zr_scene_builder *builder,
                       const struct zr_part_mesh_edit *edit, struct zr_mesh *mesh)
{
    const bool has_rest = !is_passed_over(builder, mesh->material, mesh->face_parts ? 0 : edit->styles[0]);
    uint8_t *is_shown = zr_arena_zero(arena, mesh->position_count, 1);
    zr_vec4 *shown = zr_arena_alloc(arena, mesh->position_count, sizeof *shown);
    if (!is_shown || !shown) return false;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t material = mesh->face_materials ? mesh->face_materials[f] : mesh->material;
        if (is_stopped(arena, f)) return false;
        if (is_passed_over(builder, material, edit->styles[part_of(mesh, f)])) continue;
        for (uint32_t c = mesh->face_offsets[f]; c < mesh->face_offsets[f + 1]; c++)
            is_shown[mesh->indices[c]] = 1;
    }
    for (uint64_t i = 0; has_rest && i < 2 * (uint64_t)mesh->line_count && !is_stopped(arena, i); i++)
        is_shown[mesh->lines[i]] = 1;
    for (uint32_t i = 0; has_rest && i < mesh->point_count && !is_stopped(arena, i); i++)
        is_shown[zr_mesh_point(mesh, i)] = 1;
    mesh->shown = shown;
    mesh->shown_count = 0;
    for (uint32_t i = 0; i < mesh->position_count && !is_stopped(arena, i); i++)
        if (is_shown[i]) shown[mesh->shown_count++] = mesh->positions[i];
    return !zr_is_cancelled(arena->cancel);
}

static bool hides_any(const struct zr_mesh *mesh, const struct zr_part_mesh_edit *edit)
{
    for (uint32_t p = 0; p < zr_mesh_part_count(mesh); p++)
        if (edit->styles[p] & (ZR_PART_HIDDEN | ZR_PART_TOOL)) return true;
    return edit->hides_rest && zr_mesh_has_rest(mesh);
}

bool zr_part_mesh_make(struct zr_scene_builder *builder, const struct zr_mesh *mesh,
                       const struct zr_part_mesh_edit *edit, struct zr_mesh *out)
{
    struct zr_arena *arena = builder->arena;
    const bool has_color = any_part_has_color(mesh, edit);
    *out = *mesh;
    if (has_color && !mesh->face_parts) out->colors = NULL;
    if (!style_materials(builder, edit, out)) return false;
    if (has_color && !whiten_faces(arena, edit, out)) return false;
    if (mesh->face_parts && (edit->offsets || (has_color && mesh->colors)) && !split(arena, edit, out)) return false;
    return !hides_any(mesh, edit) || list_shown(arena, builder, edit, out);
}
