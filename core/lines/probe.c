#include "lines/probe.h"

static double side_of(const struct zr_window_point *a, const struct zr_window_point *b, double x, double y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

double zr_plane_depth(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y)
{
    const uint32_t *corners = mesh->corners[hider];
    const struct zr_window_point *a = &mesh->points[corners[0]], *b = &mesh->points[corners[1]],
                                 *c = &mesh->points[corners[2]];
    const double of_b = side_of(c, a, x, y), of_c = side_of(a, b, x, y), area = side_of(a, b, c->x, c->y);
    return a->z + (of_b * (b->z - a->z) + of_c * (c->z - a->z)) / area;
}

bool zr_hider_covers(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y)
{
    const uint32_t *corners = mesh->corners[hider];
    const struct zr_window_point *a = &mesh->points[corners[0]], *b = &mesh->points[corners[1]],
                                 *c = &mesh->points[corners[2]];
    return side_of(a, b, x, y) >= 0.0 && side_of(b, c, x, y) >= 0.0 && side_of(c, a, x, y) >= 0.0;
}

struct zr_cell_hiders zr_cell_hiders_at(const struct zr_cells *cells, double x, double y)
{
    const uint32_t cell = zr_cell_at(y, cells->rows) * cells->columns + zr_cell_at(x, cells->columns);
    return (struct zr_cell_hiders){cells->firsts[cell + 1] - cells->firsts[cell], cells->entries + cells->firsts[cell]};
}

struct zr_probe zr_probe_at(const struct zr_window_mesh *mesh, const struct zr_cells *cells, double x, double y)
{
    const uint32_t column = zr_cell_at(x, cells->columns), row = zr_cell_at(y, cells->rows);
    const uint32_t cell = row * cells->columns + column;
    const uint8_t step_x = zr_box_step(x, column), step_y = zr_box_step(y, row);
    const struct zr_cell_box box = {step_x, step_y, step_x, step_y};
    struct zr_probe nearest = {ZR_NO_HIDER, HUGE_VAL};
    const uint32_t first = cells->firsts[cell], count = cells->firsts[cell + 1] - first;
    for (uint32_t i = first; i < first + count && !zr_cell_ends(&cells->entries[i], nearest.depth, count); i++) {
        const struct zr_cell_entry *entry = &cells->entries[i];
        const uint32_t hider = entry->hider;
        if (zr_boxes_are_apart(&entry->box, &box) || !((double)entry->near < nearest.depth)) continue;
        if (!zr_hider_covers(mesh, hider, x, y)) continue;
        const double depth = zr_plane_depth(mesh, hider, x, y);
        if (depth < nearest.depth) nearest = (struct zr_probe){hider, depth};
    }
    return nearest;
}

float zr_hider_cosine(const struct zr_window_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t first = zr_hider_source(mesh, a), second = zr_hider_source(mesh, b);
    const float *u = mesh->normals[first], *v = mesh->normals[second];
    const float cosine = (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2];
    return (mesh->traits[first] ^ mesh->traits[second]) & ZR_TRIANGLE_FRONT ? -cosine : cosine;
}
