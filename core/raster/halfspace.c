#include "raster/halfspace.h"

#include <stdbool.h>

/* From the first to the last pixel centre in a box whose vertices are at most 64 pixels
 * apart: up to one pixel at each end holds no centre. */
enum { SMALL_MAX = 62 };

/* Pixels of one call, inside both the triangle's box and the tile. */
struct area {
    int32_t x0, y0, x1, y1; /* window pixels, x1 and y1 exclusive */
};

/* A triangle whose vertices are less than 64 pixels apart, 2^14 on the grid, has edge
 * functions below 2 * 2^28 inside its box: 32 bits hold them, and every pixel is tried. */
static void draw_small(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner, struct area area)
{
    int32_t step[3], row_step[3], row[3];
    for (int k = 0; k < 3; k++) {
        step[k] = (int32_t)setup->edges[k].a;
        row_step[k] = (int32_t)setup->edges[k].b;
        row[k] = (int32_t)zr_edge_at(&setup->edges[k], area.x0, area.y0) - 1; /* > 0 becomes >= 0: the sign bit */
    }
    const struct zr_plane plane = setup->depth.plane;
    const float offset = setup->depth.offset;
    const int32_t s0 = step[0], s1 = step[1], s2 = step[2], width = area.x1 - area.x0;
    for (int32_t y = area.y0; y < area.y1; y++) {
        float *depth = &tile->depth[(y - tile->y) * ZR_TILE_SIZE + area.x0 - tile->x];
        uint32_t *owners = &tile->owner[(y - tile->y) * ZR_TILE_SIZE + area.x0 - tile->x];
        const int32_t e0 = row[0], e1 = row[1], e2 = row[2];
        const float z_row = plane.dady * (float)y;
        for (int32_t i = 0; i < width; i++) {
            int32_t inside = (e0 + s0 * i) | (e1 + s1 * i) | (e2 + s2 * i);
            float z = zr_depth_clamp(((plane.a0 + plane.dadx * (float)(area.x0 + i)) + z_row) + offset);
            bool nearer = inside >= 0 && z < depth[i];
            depth[i] = nearer ? z : depth[i];
            owners[i] = nearer ? owner : owners[i];
        }
        for (int k = 0; k < 3; k++)
            row[k] += row_step[k];
    }
}

/* Cuts [*x0, *x1) to where value + a (x - *x0) > 0, value being that at *x0. */
static void cut_span(int64_t value, int64_t a, int32_t *x0, int32_t *x1)
{
    int64_t begin = *x0, end = *x1;
    if (a > 0 && value <= 0) begin += -value / a + 1;
    if (a < 0) end = value > 0 ? begin + (value - 1) / -a + 1 : begin;
    if (a == 0 && value <= 0) end = begin;
    *x0 = begin < *x1 ? (int32_t)begin : *x1;
    *x1 = end < *x1 ? (int32_t)end : *x1;
}

static void draw_span(struct zr_tile *tile, const struct zr_depth *at, uint32_t owner, int32_t y, int32_t x0,
                      int32_t x1)
{
    float *depth = &tile->depth[(y - tile->y) * ZR_TILE_SIZE + x0 - tile->x];
    uint32_t *owners = &tile->owner[(y - tile->y) * ZR_TILE_SIZE + x0 - tile->x];
    const float a0 = at->plane.a0, dadx = at->plane.dadx, z_row = at->plane.dady * (float)y, offset = at->offset;
    for (int32_t i = 0; i < x1 - x0; i++) {
        float z = zr_depth_clamp(((a0 + dadx * (float)(x0 + i)) + z_row) + offset);
        bool nearer = z < depth[i];
        depth[i] = nearer ? z : depth[i];
        owners[i] = nearer ? owner : owners[i];
    }
}

/* Row by row; edges that the whole area lies inside of are not looked at again. */
static void draw_large(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner, struct area area)
{
    const struct zr_edge *cutting[3];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const struct zr_edge *e = &setup->edges[k];
        int32_t low_x = e->a > 0 ? area.x0 : area.x1 - 1, high_x = e->a > 0 ? area.x1 - 1 : area.x0;
        int32_t low_y = e->b > 0 ? area.y0 : area.y1 - 1, high_y = e->b > 0 ? area.y1 - 1 : area.y0;
        if (zr_edge_at(e, high_x, high_y) <= 0) return;
        if (zr_edge_at(e, low_x, low_y) <= 0) cutting[count++] = e;
    }
    for (int32_t y = area.y0; y < area.y1; y++) {
        int32_t x0 = area.x0, x1 = area.x1;
        for (int k = 0; k < count && x0 < x1; k++)
            cut_span(zr_edge_at(cutting[k], x0, y), cutting[k]->a, &x0, &x1);
        if (x0 < x1) draw_span(tile, &setup->depth, owner, y, x0, x1);
    }
}

void zr_halfspace_draw(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner)
{
    struct area area = {tile->x, tile->y, tile->x + tile->width, tile->y + tile->height};
    if (setup->min_x > area.x0) area.x0 = setup->min_x;
    if (setup->min_y > area.y0) area.y0 = setup->min_y;
    if (setup->max_x < area.x1) area.x1 = setup->max_x + 1;
    if (setup->max_y < area.y1) area.y1 = setup->max_y + 1;
    if (area.x0 >= area.x1 || area.y0 >= area.y1) return;
    bool small = setup->max_x - setup->min_x <= SMALL_MAX && setup->max_y - setup->min_y <= SMALL_MAX;
    if (small)
        draw_small(tile, setup, owner, area);
    else
        draw_large(tile, setup, owner, area);
}
