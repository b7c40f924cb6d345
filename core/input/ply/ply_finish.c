/* Makes the mesh of a PLY file: fills holes, limits colours, makes points and adds the warnings. */
#include <math.h>
#include <string.h>

#include "input/ply/ply_file.h"
#include "input/text/text.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 16 };

/* A float colour above this means a range of 0 to 255, not a rounding error at 1. */
static const float BRIGHT = 2.0f;

/* Adds a warning of a count, followed by `one` or `many`. */
static void warn(struct zr_scene_builder *builder, size_t count, const char *one, const char *many)
{
    if (count > 0)
        zr_warning_list_add(builder->arena, &builder->warnings, "PLY: %zu %s", count, count == 1 ? one : many);
}

/* Adds a warning that also names the first place. */
static void warn_of_first(struct zr_scene_builder *builder, size_t count, const char *one, const char *many,
                          const char *place, size_t first)
{
    if (count > 0)
        zr_warning_list_add(builder->arena, &builder->warnings, "PLY: %zu %s; %s %s %zu", count,
                            count == 1 ? one : many, count == 1 ? "it is" : "the first is", place, first);
}

static bool looks_cancelled(const struct zr_ply_file *file, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel);
}

/* ---- holes ---- */

static bool is_hole(const struct zr_ply_file *file, size_t vertex)
{
    return isnan(file->positions[vertex].x);
}

static bool has_hole(const struct zr_ply_file *file, const uint32_t *indices, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (is_hole(file, indices[i])) return true;
    return false;
}

/* Leaves out faces with a hole as a corner. Returns their number. */
static size_t drop_faces(struct zr_ply_file *file)
{
    struct zr_ply_faces *faces = &file->faces;
    size_t kept = 0, corners = 0;
    for (size_t i = 0; i < faces->count && !looks_cancelled(file, i); i++) {
        const size_t first = faces->offsets ? faces->offsets[i] : 3 * i;
        const size_t count = faces->offsets ? faces->offsets[i + 1] - first : 3;
        if (has_hole(file, faces->indices + first, count)) continue;
        memmove(faces->indices + corners, faces->indices + first, count * sizeof *faces->indices);
        if (faces->colors) faces->colors[kept] = faces->colors[i];
        if (faces->offsets) faces->offsets[kept] = (uint32_t)corners;
        corners += count;
        kept++;
    }
    const size_t dropped = faces->count - kept;
    if (faces->offsets) faces->offsets[kept] = (uint32_t)corners;
    faces->count = kept;
    faces->corner_count = corners;
    return dropped;
}

/* Leaves out lines that begin or end at a hole. Returns their number. */
static size_t drop_lines(struct zr_ply_file *file)
{
    size_t kept = 0;
    for (size_t i = 0; i < file->line_count && !looks_cancelled(file, i); i++) {
        const uint32_t *line = file->lines + 2 * i;
        if (has_hole(file, line, 2)) continue;
        file->lines[2 * kept] = line[0];
        file->lines[2 * kept + 1] = line[1];
        kept++;
    }
    const size_t dropped = file->line_count - kept;
    file->line_count = kept;
    return dropped;
}

/* Warns of the holes and sets them to the origin; nothing uses them. */
static void fill_holes(struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    size_t count = 0, first = 0;
    for (size_t i = 0; i < file->vertex_count && !looks_cancelled(file, i); i++) {
        if (!is_hole(file, i)) continue;
        if (count++ == 0) first = i;
        file->positions[i] = (zr_vec4){0, 0, 0, 1};
    }
    warn_of_first(builder, count, "vertex is not finite and is left out", "vertices are not finite and are left out",
                  "vertex", first);
}

/* Leaves out what is drawn at holes. */
static void drop_holes(struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    warn(builder, drop_faces(file), "face at a vertex that is not finite is left out",
         "faces at vertices that are not finite are left out");
    warn(builder, drop_lines(file), "line at a vertex that is not finite is left out",
         "lines at vertices that are not finite are left out");
}

/* ---- points ---- */

static uint32_t count_holes(const struct zr_ply_file *file)
{
    uint32_t holes = 0;
    for (size_t i = 0; i < file->vertex_count && !looks_cancelled(file, i); i++)
        holes += is_hole(file, i);
    return holes;
}

/* Lists the points, unless that is all of them. */
static bool make_points(struct zr_ply_file *file, struct zr_mesh *mesh)
{
    mesh->point_count = (uint32_t)file->vertex_count;
    if (count_holes(file) == 0) return true;
    mesh->point_count = 0;
    uint32_t *points = zr_arena_alloc(file->arena, file->vertex_count, sizeof *points);
    if (!points) return false;
    for (size_t i = 0; i < file->vertex_count && !looks_cancelled(file, i); i++)
        if (!is_hole(file, i)) points[mesh->point_count++] = (uint32_t)i;
    mesh->points = points;
    return true;
}

/* ---- colours ---- */

struct odd_colors {
    size_t clamped;
    bool is_bright;
};

static float clamped(float value)
{
    return !(value >= 0.0f) ? 0.0f : value > 1.0f ? 1.0f : value;
}

/* Takes colours of type float as 0 to 255 if one of them is far beyond 1, then limits them to 0 to 1. */
static void mend_colors(const struct zr_ply_file *file, zr_vec4 *colors, size_t count, bool is_float,
                        struct odd_colors *odd)
{
    float most = 0.0f;
    for (size_t i = 0; is_float && i < count && !looks_cancelled(file, i); i++)
        most = fmaxf(most, fmaxf(fmaxf(colors[i].x, colors[i].y), fmaxf(colors[i].z, colors[i].w)));
    const bool is_bright = most > BRIGHT;
    for (size_t i = 0; i < count && !looks_cancelled(file, i); i++) {
        zr_vec4 c = colors[i];
        if (is_bright) c = (zr_vec4){c.x / 255.0f, c.y / 255.0f, c.z / 255.0f, c.w > 1.0f ? c.w / 255.0f : c.w};
        colors[i] = (zr_vec4){clamped(c.x), clamped(c.y), clamped(c.z), clamped(c.w)};
        odd->clamped += !zr_vec4_equal(colors[i], c);
    }
    odd->is_bright |= is_bright;
}

/* Takes colours of type ushort as 0 to 255 if none is above: programs widen the type and keep the values. */
static bool brighten(const struct zr_ply_file *file, zr_vec4 *colors, size_t count)
{
    const float most = 255.0f / 65535.0f;
    bool has_color = false;
    for (size_t i = 0; i < count && !looks_cancelled(file, i); i++) {
        if (colors[i].x > most || colors[i].y > most || colors[i].z > most) return false;
        has_color |= colors[i].x > 1.0f / 65535.0f || colors[i].y > 1.0f / 65535.0f || colors[i].z > 1.0f / 65535.0f;
    }
    for (size_t i = 0; has_color && i < count && !looks_cancelled(file, i); i++)
        for (int k = 0; k < 4; k++) {
            float *value = (float *)&colors[i] + k;
            if (k < 3 || *value <= most) *value = roundf(*value * 65535.0f) / 255.0f;
        }
    return has_color;
}

/* Sets alpha to 1 if it is 0 everywhere, as some programs write opaque colours. */
static void mend_alpha(struct zr_scene_builder *builder, zr_vec4 *colors, size_t count)
{
    size_t i = 0;
    while (i < count && colors[i].w <= 0.0f)
        i++;
    if (i < count || count == 0) return;
    for (i = 0; i < count; i++)
        colors[i].w = 1.0f;
    zr_warning_list_add(builder->arena, &builder->color_warnings, "PLY: alpha is 0 everywhere: drawn opaque");
}

/* Returns the value that is a colour of 1; 0: elements of this kind have no colours of numbers. */
static double color_scale(const struct zr_ply_file *file, enum zr_ply_kind kind)
{
    for (size_t i = 0; i < file->header.element_count; i++) {
        const struct zr_ply_plan plan = zr_ply_plan_of(&file->header.elements[i]);
        if (plan.kind == kind && plan.slots[ZR_PLY_RED] && !plan.is_packed && !plan.is_splat)
            return zr_ply_color_scale(plan.slots[ZR_PLY_RED]->type);
    }
    return 0.0;
}

static void finish_colors(struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    struct odd_colors odd = {.clamped = 0};
    struct zr_ply_faces *faces = &file->faces;
    const double of_vertices = color_scale(file, ZR_PLY_VERTEX), of_faces = color_scale(file, ZR_PLY_FACE);
    if (file->colors && faces->colors && faces->count > 0) {
        zr_warning_list_add(builder->arena, &builder->color_warnings,
                            "PLY: colours of faces are not drawn, since the vertices have colours");
        faces->colors = NULL;
    }
    if (file->has_odd_colors) {
        if (file->colors) mend_colors(file, file->colors, file->vertex_count, of_vertices == 1.0, &odd);
        if (faces->colors) mend_colors(file, faces->colors, faces->count, of_faces == 1.0, &odd);
    }
    if ((file->colors && of_vertices == 65535.0 && brighten(file, file->colors, file->vertex_count)) ||
        (faces->colors && of_faces == 65535.0 && brighten(file, faces->colors, faces->count)))
        zr_warning_list_add(builder->arena, &builder->color_warnings,
                            "PLY: colours of type ushort have no value above 255: taken as 0 to 255");
    if (odd.is_bright)
        zr_warning_list_add(builder->arena, &builder->color_warnings,
                            "PLY: colours of type float go beyond 1: taken as 0 to 255");
    if (odd.clamped > 0)
        zr_warning_list_add(builder->arena, &builder->color_warnings, "PLY: %zu %s limited to %s range", odd.clamped,
                            odd.clamped == 1 ? "colour is" : "colours are", odd.clamped == 1 ? "its" : "their");
    if (file->colors) mend_alpha(builder, file->colors, file->vertex_count);
    if (faces->colors) mend_alpha(builder, faces->colors, faces->count);
}

/* ---- warnings ---- */

static void warn_of_elements(const struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    const struct zr_ply_element *first = NULL;
    size_t count = 0;
    for (size_t i = 0; i < file->header.element_count; i++) {
        const struct zr_ply_element *element = &file->header.elements[i];
        const struct zr_ply_plan plan = zr_ply_plan_of(element);
        if (plan.is_splat)
            zr_warning_list_add(
                builder->arena, &builder->color_warnings,
                "PLY: splats (f_dc_0) are drawn as opaque points of their mean colours; sizes, shapes and "
                "opacities are not read in this version");
        if (plan.kind != ZR_PLY_OTHER || element->count == 0) continue;
        if (count++ == 0) first = element;
    }
    if (count > 0)
        zr_warning_list_add(builder->arena, &builder->warnings,
                            "PLY: %zu kind%s of elements %s not drawn; %s %s (%zu of them)", count,
                            count == 1 ? "" : "s", count == 1 ? "is" : "are", count == 1 ? "it is" : "the first is",
                            zr_quote(first->name.at, first->name.size).text, first->count);
}

static void warn_of_oddities(const struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    const struct zr_ply_header *header = &file->header;
    const struct zr_ply_oddities *odd = &file->odd;
    if (header->texture_count > 0)
        zr_warning_list_add(builder->arena, &builder->color_warnings,
                            "PLY: %zu texture%s not read in this version; %s %s", header->texture_count,
                            header->texture_count == 1 ? " is" : "s are",
                            header->texture_count == 1 ? "it is" : "the first is",
                            zr_quote(header->texture.at, header->texture.size).text);
    warn_of_first(builder, header->unknown_count, "line of the header is not known",
                  "lines of the header are not known", "line", header->unknown_line);
    warn_of_first(builder, odd->small_faces, "face has fewer than 3 corners and is left out",
                  "faces have fewer than 3 corners and are left out", "face", odd->first_small_face);
    warn_of_first(builder, odd->broken_lines, "line has another number of values than the header says",
                  "lines have another number of values than the header says", "line", odd->first_broken_line);
    warn_of_first(builder, odd->comments, "comment between the values is skipped",
                  "comments between the values are skipped", "line", odd->first_comment);
    warn(builder, odd->trailing_bytes, "byte behind the last element is not read",
         "bytes behind the last element are not read");
    warn_of_elements(file, builder);
}

/* ---- interface ---- */

/* Moves the arrays of all faces to the mesh. Without offsets, the faces are triangles. */
static void take_faces(struct zr_ply_file *file, struct zr_mesh *mesh)
{
    const struct zr_ply_faces *faces = &file->faces;
    if (faces->count == 0) return;
    mesh->face_count = (uint32_t)faces->count;
    mesh->face_offsets = faces->offsets;
    mesh->indices = faces->indices;
    mesh->face_colors = faces->colors;
}

enum zr_status zr_ply_finish(struct zr_ply_file *file, struct zr_scene_builder *builder)
{
    struct zr_mesh *mesh = zr_scene_builder_meshes(builder, 1);
    if (!mesh) return ZR_NO_MEMORY;
    const bool has_surface = file->faces.count > 0 || file->line_count > 0;
    if (file->has_holes) drop_holes(file, builder);
    finish_colors(file, builder);
    mesh->position_count = (uint32_t)file->vertex_count;
    mesh->positions = file->positions;
    mesh->colors = file->colors;
    mesh->texcoords = file->texcoords;
    mesh->line_count = (uint32_t)file->line_count;
    mesh->lines = file->lines;
    take_faces(file, mesh);
    if (mesh->face_count > 0 && file->normals) {
        mesh->normals = file->normals;
        mesh->normal_count = mesh->position_count;
        zr_scene_builder_note_normals(builder, 0, file->normals, file->vertex_count);
    }
    if (!has_surface && !make_points(file, mesh)) return ZR_NO_MEMORY;
    if (mesh->face_count == 0 && mesh->line_count == 0 && mesh->point_count == 0)
        return zr_error_add(file->error, ZR_BAD_SCENE, NULL, "no geometry: the PLY file has no vertex to draw");
    if (file->has_holes) fill_holes(file, builder);
    warn_of_oddities(file, builder);
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(file->arena) ? ZR_OK : ZR_NO_MEMORY;
}
