#include "raster/setup.h"

static int32_t min3(int32_t a, int32_t b, int32_t c)
{
    int32_t m = a < b ? a : b;
    return m < c ? m : c;
}

static int32_t max3(int32_t a, int32_t b, int32_t c)
{
    int32_t m = a > b ? a : b;
    return m > c ? m : c;
}

void zr_setup_box(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle, int32_t box[4])
{
    const struct zr_window_vertex *v0 = &vertices[triangle->v[0]], *v1 = &vertices[triangle->v[1]],
                                  *v2 = &vertices[triangle->v[2]];
    box[0] = zr_viewport_first_centre(min3(zr_snapped_x(v0), zr_snapped_x(v1), zr_snapped_x(v2)));
    box[1] = zr_viewport_first_centre(min3(zr_snapped_y(v0), zr_snapped_y(v1), zr_snapped_y(v2)));
    box[2] = zr_viewport_last_centre(max3(zr_snapped_x(v0), zr_snapped_x(v1), zr_snapped_x(v2)));
    box[3] = zr_viewport_last_centre(max3(zr_snapped_y(v0), zr_snapped_y(v1), zr_snapped_y(v2)));
}

/* Makes the edge from i to j. It includes pixel centres exactly on it if it is a left or a bottom edge. */
static struct zr_edge edge_make(const struct zr_window_vertex *i, const struct zr_window_vertex *j)
{
    int64_t a = zr_snapped_y(i) - zr_snapped_y(j), b = zr_snapped_x(i) - zr_snapped_x(j);
    int64_t bias = a < 0 || (a == 0 && ZR_MUTANT(top_edges_kept, b > 0, b < 0)) ? 1 : ZR_MUTANT(all_edges_kept, 0, 1);
    return (struct zr_edge){
        .a = -a * ZR_SUBPIXELS, .b = b * ZR_SUBPIXELS, .c = a * zr_snapped_x(i) - b * zr_snapped_y(i) + bias};
}

struct zr_setup zr_setup_make(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle)
{
    const struct zr_window_vertex *v0 = &vertices[triangle->v[0]], *v1 = &vertices[triangle->v[1]],
                                  *v2 = &vertices[triangle->v[2]];
    struct zr_setup setup = {.edges = {edge_make(v0, v1), edge_make(v1, v2), edge_make(v2, v0)}};
    setup.depth = zr_depth_make(vertices, triangle);
    int32_t box[4];
    zr_setup_box(vertices, triangle, box);
    setup.min_x = box[0];
    setup.min_y = box[1];
    setup.max_x = box[2];
    setup.max_y = box[3];
    return setup;
}
