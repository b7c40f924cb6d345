#include "render/layers/solid_boxes.h"

enum { FACES_PER_CANCEL_CHECK = 1 << 15 };

/* Samples lie at the middles of pixels, and corners are rounded to 1/256 pixel. */
#define MARGIN 1.0f

static void add(struct zr_solid_boxes *boxes, uint32_t part, float x, float y)
{
    if (x < boxes->min_x[part]) boxes->min_x[part] = x;
    if (y < boxes->min_y[part]) boxes->min_y[part] = y;
    if (x > boxes->max_x[part]) boxes->max_x[part] = x;
    if (y > boxes->max_y[part]) boxes->max_y[part] = y;
}

static float pixels_of(int32_t snapped)
{
    return (float)snapped / (float)ZR_SUBPIXELS + 0.5f;
}

static void add_primitive(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t t, uint32_t part,
                          struct zr_solid_boxes *boxes)
{
    if (draw->kind == ZR_DRAW_SHAPES) {
        const struct zr_shape *shape = &geometry->shapes[draw->traits[t] / 2];
        add(boxes, part, pixels_of(shape->min_x), pixels_of(shape->min_y));
        add(boxes, part, pixels_of(shape->max_x), pixels_of(shape->max_y));
        return;
    }
    for (uint32_t k = 0; k < 3; k++) {
        const struct zr_window_vertex *v = &geometry->vertices[draw->first_vertex + zr_draw_corner(draw, t, k)];
        add(boxes, part, v->x, v->y);
    }
}

/* False if cancelled. */
static bool add_draw(const struct zr_run *run, const struct zr_csg *csg, const struct zr_geometry *geometry,
                     const struct zr_draw *draw, struct zr_solid_boxes *boxes)
{
    for (uint32_t t = 0; t < draw->count; t++) {
        if (t % FACES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) return false;
        const uint32_t part = zr_csg_part_of(csg, draw->instance, draw->mesh, zr_draw_face(draw, t)) - 1;
        add_primitive(geometry, draw, t, part, boxes);
    }
    return true;
}

enum zr_status zr_solid_boxes_make(const struct zr_run *run, const struct zr_csg *csg,
                                   const struct zr_geometry *geometry, const struct zr_solid_boxes **out)
{
    struct zr_solid_boxes *boxes = zr_arena_alloc(run->arena, 1, sizeof *boxes);
    if (!boxes) return ZR_NO_MEMORY;
    boxes->count = csg->part_count;
    for (uint32_t i = 0; i < boxes->count; i++) {
        boxes->min_x[i] = boxes->min_y[i] = INFINITY;
        boxes->max_x[i] = boxes->max_y[i] = -INFINITY;
    }
    for (uint32_t i = 0; i < geometry->draw_count; i++)
        if (zr_draw_mode(&geometry->draws[i]) == ZR_ALPHA_OPERAND &&
            !add_draw(run, csg, geometry, &geometry->draws[i], boxes))
            return ZR_CANCELLED;
    *out = boxes;
    return ZR_OK;
}

uint64_t zr_solid_boxes_at(const struct zr_solid_boxes *boxes, const struct zr_tile *tile)
{
    const float x0 = (float)tile->x - MARGIN, x1 = (float)(tile->x + tile->width) + MARGIN;
    const float y0 = (float)tile->y - MARGIN, y1 = (float)(tile->y + tile->height) + MARGIN;
    uint64_t parts = 0;
    for (uint32_t i = 0; i < boxes->count; i++)
        if (boxes->min_x[i] < x1 && boxes->max_x[i] > x0 && boxes->min_y[i] < y1 && boxes->max_y[i] > y0)
            parts |= UINT64_C(1) << i;
    return parts;
}
