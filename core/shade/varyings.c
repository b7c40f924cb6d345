#include "shade/varyings.h"

#include <string.h>

#include "base/rgba.h"
#include "raster/line.h"
#include "shade/cloud_values.h"

/* Colours at the ends of a line: values[ends[k]]. */
struct line_colors {
    bool back;
    uint32_t ends[2];
    const zr_vec4 *values;
};

static struct line_colors line_colors_of(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                         uint32_t number)
{
    const struct zr_draw *draw = of_draw->draw;
    const bool back = of_draw->two_sided_colors && zr_triangle_of(geometry, draw, number).back;
    const bool smooth = zr_draw_is_smooth(of_draw);
    const enum zr_rate rate = of_draw->attributes[ZR_ATTRIBUTE_COLOR].rate;
    const uint32_t t = number - draw->first;
    const uint32_t n0 = smooth ? zr_smooth_number(draw, rate, t, 0) : zr_flat_number(draw, rate, t);
    const uint32_t n1 = smooth ? zr_smooth_number(draw, rate, t, 1) : n0;
    return (struct line_colors){
        back, {n0, n1}, of_draw->attributes[back ? ZR_ATTRIBUTE_BACK_COLOR : ZR_ATTRIBUTE_COLOR].values};
}

bool zr_line_color(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number,
                   uint32_t *color)
{
    if (zr_draw_is_cloud(of_draw->draw)) {
        *color = zr_rgba_opaque(zr_cloud_color(of_draw, number));
        return true;
    }
    const struct line_colors colors = line_colors_of(geometry, of_draw, number);
    const uint32_t n = colors.ends[0];
    if (n != colors.ends[1]) return false;
    *color = of_draw->packed ? of_draw->packed[colors.back ? of_draw->color_count + n : n]
                             : zr_rgba_opaque(colors.values[n]);
    return true;
}

/* Values at the two ends of a line. */
struct ends {
    struct zr_line_basis basis;
    float oow[2];
    const zr_vec4 *values[2];
};

static struct zr_plane plane_of(const struct ends *ends, float p0, float p1)
{
    return zr_line_plane_make(&ends->basis, p0 * ends->oow[0], p1 * ends->oow[1]);
}

static void put_xyz(const struct ends *ends, bool constant, struct zr_plane out[3])
{
    const zr_vec4 *p0 = ends->values[0], *p1 = ends->values[1];
    const float from[3] = {p0->x, p0->y, p0->z}, to[3] = {p1->x, p1->y, p1->z};
    for (int k = 0; k < 3; k++)
        out[k] = constant ? (struct zr_plane){from[k], 0, 0} : plane_of(ends, from[k], to[k]);
}

static void put_w(const struct ends *ends, bool constant, struct zr_plane *out)
{
    const float from = ends->values[0]->w;
    *out = constant ? (struct zr_plane){from, 0, 0} : plane_of(ends, from, ends->values[1]->w);
}

/* Values of both ends. A point's ends are one. */
struct end_values {
    zr_vec4 color[2], point[2];
    bool has_point, differ; /* differ: in colour */
};

static void find_cloud_values(const struct zr_draw_attributes *of_draw, uint32_t number, bool has_colors, unsigned mask,
                              struct end_values *out)
{
    if (has_colors) out->color[0] = out->color[1] = zr_cloud_color(of_draw, number);
    out->has_point = zr_draw_has_points(of_draw) && mask & (ZR_VARY_POINT | ZR_VARY_DEPTH);
    if (out->has_point)
        out->point[0] = out->point[1] = zr_draw_point(of_draw, zr_cloud_position(of_draw->draw, number));
}

static void find_values(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number,
                        bool has_colors, struct end_values *out)
{
    const struct line_colors colors = line_colors_of(geometry, of_draw, number);
    out->differ = colors.ends[0] != colors.ends[1];
    out->has_point = zr_draw_has_points(of_draw);
    for (uint32_t k = 0; k < 2; k++) {
        if (has_colors) out->color[k] = colors.values[colors.ends[k]];
        if (out->has_point)
            out->point[k] = zr_draw_point(of_draw, zr_draw_corner(of_draw->draw, number - of_draw->draw->first, k));
    }
}

bool zr_line_planes(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number,
                    unsigned mask, struct zr_plane planes[ZR_PLANES_MOST])
{
    const bool has_colors = mask & (ZR_VARY_COLOR | ZR_VARY_OPACITY);
    struct end_values values = {.differ = false};
    struct zr_wire_end at[2];
    if (zr_draw_is_cloud(of_draw->draw))
        find_cloud_values(of_draw, number, has_colors, mask, &values);
    else
        find_values(geometry, of_draw, number, has_colors, &values);
    const struct zr_window_vertex *v0 = &at[0].vertex, *v1 = &at[1].vertex;
    const bool constant = !(mask & ZR_VARY_OVER_W) && !(has_colors && values.differ);
    zr_wire_ends(geometry, of_draw->draw, number, at);
    struct ends ends = {zr_line_basis_make(v0, v1), {v0->oow, v1->oow}, {&values.color[0], &values.color[1]}};
    memset(planes, 0, (size_t)zr_plane_count(mask) * sizeof *planes);
    planes[0] = constant && zr_may_lack_w(mask) ? (struct zr_plane){1, 0, 0} : plane_of(&ends, 1.0f, 1.0f);
    if (mask & ZR_VARY_COLOR) put_xyz(&ends, constant, &planes[zr_first_plane(mask, ZR_VARY_COLOR)]);
    if (mask & ZR_VARY_OPACITY) put_w(&ends, constant, &planes[zr_first_plane(mask, ZR_VARY_OPACITY)]);
    if (!values.has_point) return constant;
    for (int k = 0; k < 2; k++)
        ends.values[k] = &values.point[k];
    if (mask & ZR_VARY_POINT) put_xyz(&ends, false, &planes[zr_first_plane(mask, ZR_VARY_POINT)]);
    if (mask & ZR_VARY_DEPTH) put_w(&ends, false, &planes[zr_first_plane(mask, ZR_VARY_DEPTH)]);
    return constant;
}
