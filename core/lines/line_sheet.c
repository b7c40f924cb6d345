#include "lines/line_sheet.h"

#include "base/cancel.h"
#include "base/run.h"
#include "scene/parts/part_list.h"

/* Pixels count as square if their sides differ by less than this share. */
#define SQUARE 1e-5

struct sheet {
    const struct zr_scene *scene;
    const struct zr_drawing *drawing;
    uint64_t *first_parts; /* by instance */
    uint32_t part_count;
};

static uint64_t part_of(const struct sheet *s, uint32_t triangle)
{
    const struct zr_window_mesh *mesh = &s->drawing->mesh;
    const uint32_t i = zr_drawn_instance_of(mesh, offsetof(struct zr_drawn_instance, first_triangle), triangle);
    const struct zr_drawn_instance *of = &mesh->instances[i];
    const uint32_t *face_parts = of->mesh->face_parts;
    return s->first_parts[i] + (face_parts ? face_parts[of->table->faces[triangle - of->first_triangle]] : 0);
}

/* Returns the part of a polyline, or the last one, which has no name. */
static uint32_t part_of_line(const struct sheet *s, const struct zr_polyline *line)
{
    const uint32_t triangle = line->line == ZR_NO_LINE ? ZR_NO_TRIANGLE : s->drawing->lines.at[line->line].triangles[0];
    const uint64_t part = triangle == ZR_NO_TRIANGLE ? s->part_count : part_of(s, triangle);
    return part < s->part_count ? (uint32_t)part : s->part_count;
}

static bool copy_names(struct zr_arena *arena, const struct zr_part_list *list, struct zr_line_sheet *out)
{
    const char **names = zr_arena_alloc(arena, list->count + 1, sizeof *names);
    if (!names) return false;
    for (uint32_t i = 0; i < list->count; i++)
        names[i] = zr_arena_copy(arena, list->at[i].name, strlen(list->at[i].name) + 1);
    names[list->count] = "";
    out->part_names = names;
    out->part_count = list->count + 1;
    return zr_arena_ok(arena);
}

static bool list_first_parts(struct zr_arena *scratch, struct sheet *s)
{
    const struct zr_scene *scene = s->scene;
    uint64_t part = 0;
    s->first_parts = zr_arena_alloc(scratch, scene->instance_count, sizeof *s->first_parts);
    for (uint32_t i = 0; s->first_parts && i < scene->instance_count; i++) {
        s->first_parts[i] = part;
        part += zr_mesh_part_count(&scene->meshes[scene->instances[i].mesh]);
    }
    return s->first_parts != NULL;
}

/* Returns the length of a pixel in world units; 0 in perspective and for pixels that are not square. */
static double pixel_length(const struct zr_drawing_desc *desc)
{
    const float *p = desc->camera->projection.m;
    const bool is_parallel = p[3] == 0.0f && p[7] == 0.0f && p[11] == 0.0f && p[15] != 0.0f;
    const bool is_straight = p[1] == 0.0f && p[4] == 0.0f;
    const double scale = (double)zr_eye_scale_of(desc->camera), w = fabs((double)p[15]);
    const double x = 0.5 * (double)desc->width * fabs((double)p[0]) * scale,
                 y = 0.5 * (double)desc->height * fabs((double)p[5]) * scale;
    if (!is_parallel || !is_straight || !(x > 0.0) || !(y > 0.0) || fabs(x - y) > SQUARE * y) return 0.0;
    return w / y;
}

enum zr_status zr_line_sheet_make(const struct zr_run *run, const struct zr_drawing_desc *desc,
                                  const struct zr_drawing *drawing, struct zr_line_sheet *out)
{
    const struct zr_polylines *lines = &drawing->polylines;
    const struct zr_part_list list = zr_part_list_make(run->scratch, desc->scene, ZR_SHEET_PARTS_MOST);
    struct sheet s = {.scene = desc->scene, .drawing = drawing, .part_count = list.count};
    uint32_t *parts = zr_arena_alloc(run->arena, lines->count, sizeof *parts);
    *out = (struct zr_line_sheet){.lines = *lines, .parts = parts, .pixel = pixel_length(desc)};
    out->lines.at = zr_arena_copy(run->arena, lines->at, lines->count * sizeof *lines->at);
    out->lines.points = zr_arena_copy(run->arena, lines->points, lines->point_count * sizeof *lines->points);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!list_first_parts(run->scratch, &s) || !copy_names(run->arena, &list, out) || !parts) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < lines->count; i++)
        parts[i] = part_of_line(&s, &lines->at[i]);
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
