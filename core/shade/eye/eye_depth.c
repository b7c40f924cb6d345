#include "shade/eye/eye_depth.h"

/* ---- depths of corners ---- */

static double least(const double v[3])
{
    double low = v[0] < v[1] ? v[0] : v[1];
    return low < v[2] ? low : v[2];
}

static double most(const double v[3])
{
    double high = v[0] > v[1] ? v[0] : v[1];
    return high > v[2] ? high : v[2];
}

static double depth_of(const struct zr_eye *eye)
{
    return -(double)eye->z / (double)eye->w;
}

/* ---- lines ---- */

/* Makes the plane of a value that varies along the line's major axis alone (raster/line.h). */
static struct zr_eye_plane line_plane(const struct zr_window_vertex *const v[2], double p0, double p1)
{
    double x0 = (double)v[0]->x, y0 = (double)v[0]->y, dx = x0 - (double)v[1]->x, dy = y0 - (double)v[1]->y;
    bool along_x = fabs(dx) >= fabs(dy);
    if (dx == 0.0 && dy == 0.0) return (struct zr_eye_plane){p0, 0.0, 0.0}; /* a point */
    double dadx = along_x ? (p0 - p1) / dx : 0.0, dady = along_x ? 0.0 : (p0 - p1) / dy;
    return (struct zr_eye_plane){p0 - (dadx * (x0 - 0.5) + dady * (y0 - 0.5)), dadx, dady};
}

struct zr_eye_depth zr_eye_depth_of_line(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                         uint32_t number)
{
    struct zr_wire_end ends[2];
    zr_wire_ends(geometry, draw, number, ends);
    const struct zr_window_vertex *const v[2] = {&ends[0].vertex, &ends[1].vertex};
    double z[2], w[2], depths[3];
    for (int k = 0; k < 2; k++) {
        const struct zr_eye *eye = &ends[k].eye;
        depths[k] = depth_of(eye);
        z[k] = -(double)eye->z * (double)v[k]->oow;
        w[k] = (double)eye->w * (double)v[k]->oow;
    }
    depths[2] = depths[1];
    return (struct zr_eye_depth){line_plane(v, z[0], z[1]), line_plane(v, w[0], w[1]), least(depths), most(depths)};
}

/* ---- triangles ---- */

void zr_eye_depth_widen(struct zr_eye_depth *depth)
{
    depth->min *= depth->min > 0.0 ? 0.5 : 1.5;
    depth->max *= depth->max > 0.0 ? 1.5 : 0.5;
}

void zr_eye_depth_take_piece(const struct zr_geometry *geometry, const struct zr_triangle *piece,
                             struct zr_eye_depth *depth)
{
    double depths[3];
    for (int k = 0; k < 3; k++)
        depths[k] = depth_of(&geometry->eyes[piece->v[k]]); /* clipping has made entries */
    depth->min = least(depths);
    depth->max = most(depths);
    zr_eye_depth_widen(depth);
}
