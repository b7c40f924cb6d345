#include "reference/drawing.h"

#include <stdlib.h>
#include <string.h>

#include "reference/generate/batches.h"

void drawing_start(struct drawing *drawing, uint32_t width, uint32_t height)
{
    drawing->width = width;
    drawing->height = height;
    drawing->smooth = drawing->first_corner = false;
    drawing->side = 1;
    drawing->line_width = drawing->point_size = 1.0f;
    drawing->modelview = drawing->projection = zr_mat4_identity();
    drawing->position_count = drawing->face_count = drawing->corner_count = 0;
    drawing->ring_count = drawing->line_count = drawing->point_count = 0;
    drawing->outline = ZR_OUTLINE_NONE;
    drawing->unfilled = drawing->lit = drawing->given_normals = drawing->see_through = false;
    drawing->light_count = 0;
}

void drawing_free(struct drawing *drawing)
{
    free(drawing->positions);
    free(drawing->colors);
    free(drawing->normals);
    free(drawing->face_offsets);
    free(drawing->face_rings);
    free(drawing->ring_offsets);
    free(drawing->lines);
    free(drawing->points);
    free(drawing->face_colors);
    free(drawing->face_materials);
    free(drawing->indices);
    memset(drawing, 0, sizeof *drawing);
}

/* False, with *array as it was, where memory is short. */
static bool widen(void *array, size_t count, size_t size)
{
    void *old, *wider;
    memcpy(&old, array, sizeof old);
    wider = realloc(old, count * size);
    if (!wider) return false;
    memcpy(array, &wider, sizeof wider);
    return true;
}

uint32_t drawing_position(struct drawing *drawing, zr_vec4 position, zr_vec4 color)
{
    if (drawing->position_count == drawing->position_room) {
        uint32_t room = drawing->position_room * 2 + 64;
        if (!widen(&drawing->positions, room, sizeof *drawing->positions) ||
            !widen(&drawing->colors, room, sizeof *drawing->colors) ||
            !widen(&drawing->normals, room, sizeof *drawing->normals)) {
            drawing->failed = true;
            return 0;
        }
        drawing->position_room = room;
    }
    drawing->positions[drawing->position_count] = position;
    drawing->colors[drawing->position_count] = color;
    drawing->normals[drawing->position_count] = (zr_vec3){0, 0, 0};
    return drawing->position_count++;
}

static bool have_face_room(struct drawing *drawing)
{
    uint32_t room = drawing->face_room * 2 + 64;
    if (drawing->face_count < drawing->face_room) return true;
    if (!widen(&drawing->face_offsets, room + 1, sizeof *drawing->face_offsets) ||
        !widen(&drawing->face_rings, room + 1, sizeof *drawing->face_rings) ||
        !widen(&drawing->face_colors, room, sizeof *drawing->face_colors) ||
        !widen(&drawing->face_materials, room, sizeof *drawing->face_materials))
        return false;
    drawing->face_room = room;
    return true;
}

static bool have_ring_room(struct drawing *drawing, uint32_t corners)
{
    if (drawing->ring_count == drawing->ring_room) {
        uint32_t room = drawing->ring_room * 2 + 64;
        if (!widen(&drawing->ring_offsets, room + 1, sizeof *drawing->ring_offsets)) return false;
        drawing->ring_room = room;
    }
    if (drawing->corner_room - drawing->corner_count < corners) {
        uint32_t room = drawing->corner_room * 2 + corners + 64;
        if (!widen(&drawing->indices, room, sizeof *drawing->indices)) return false;
        drawing->corner_room = room;
    }
    return true;
}

void drawing_face(struct drawing *drawing, const uint32_t *indices, uint32_t count)
{
    if (drawing->failed || drawing->face_count == BATCHES_OWNERS_MAX || !have_face_room(drawing)) {
        drawing->failed = true;
        return;
    }
    drawing->face_offsets[drawing->face_count] = drawing->corner_count;
    drawing->face_rings[drawing->face_count] = drawing->ring_count;
    drawing->face_colors[drawing->face_count] = batches_owner_color(drawing->face_count + 1);
    drawing->face_materials[drawing->face_count] = ZR_ALPHA_OPAQUE;
    drawing->face_count++;
    drawing_hole(drawing, indices, count);
}

void drawing_hole(struct drawing *drawing, const uint32_t *indices, uint32_t count)
{
    if (drawing->failed || !have_ring_room(drawing, count)) {
        drawing->failed = true;
        return;
    }
    memcpy(drawing->indices + drawing->corner_count, indices, count * sizeof *indices);
    drawing->ring_offsets[drawing->ring_count] = drawing->corner_count;
    drawing->corner_count += count;
    drawing->ring_offsets[++drawing->ring_count] = drawing->corner_count;
    drawing->face_offsets[drawing->face_count] = drawing->corner_count;
    drawing->face_rings[drawing->face_count] = drawing->ring_count;
}

void drawing_line(struct drawing *drawing, uint32_t a, uint32_t b)
{
    uint32_t room = drawing->line_room * 2 + 64;
    if (drawing->line_count == drawing->line_room) {
        if (drawing->failed || !widen(&drawing->lines, 2 * (size_t)room, sizeof *drawing->lines)) {
            drawing->failed = true;
            return;
        }
        drawing->line_room = room;
    }
    drawing->lines[2 * drawing->line_count] = a;
    drawing->lines[2 * drawing->line_count++ + 1] = b;
}

void drawing_point(struct drawing *drawing, uint32_t position)
{
    uint32_t room = drawing->point_room * 2 + 64;
    if (drawing->point_count == drawing->point_room) {
        if (drawing->failed || !widen(&drawing->points, room, sizeof *drawing->points)) {
            drawing->failed = true;
            return;
        }
        drawing->point_room = room;
    }
    drawing->points[drawing->point_count++] = position;
}

void drawing_triangle(struct drawing *drawing, uint32_t a, uint32_t b, uint32_t c)
{
    drawing_face(drawing, (uint32_t[]){a, b, c}, 3);
}

uint32_t drawing_triangles(const struct drawing *drawing)
{
    return drawing->corner_count - 2 * drawing->ring_count + drawing->line_count + drawing->point_count;
}
