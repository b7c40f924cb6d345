#include "drawing/view_lines.h"

#include "lines/drawing.h"

/* Of the look technical: crease angle, degrees. */
#define CREASE_DEGREES 30.0f

/* Points closer to a straight line go: pixels of the fine window (lines/window_view.h). */
#define STRAIGHT 1e-6

enum { WINDOW = 1024 }; /* pixels; any: lines are found in the fine window */

static zr_dvec3 turned(zr_dvec3 v, bool z_is_up)
{
    return z_is_up ? (zr_dvec3){v.x, 0.0 - v.z, v.y} : v;
}

struct zr_view_axes zr_view_axes_of(enum zr_page_view view, bool z_is_up)
{
    const double half = sqrt(0.5), third = sqrt(1.0 / 3.0), sixth = sqrt(1.0 / 6.0);
    const struct zr_view_axes all[ZR_PAGE_VIEWS] = {
        [ZR_PAGE_FRONT] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        [ZR_PAGE_TOP] = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
        [ZR_PAGE_RIGHT] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
        [ZR_PAGE_ISOMETRIC] = {{half, 0, -half}, {-sixth, 2.0 * sixth, -sixth}, {third, third, third}}};
    const struct zr_view_axes axes = all[view];
    return (struct zr_view_axes){turned(axes.right, z_is_up), turned(axes.up, z_is_up), turned(axes.back, z_is_up)};
}

static zr_vec3 floats_of(zr_dvec3 v)
{
    return (zr_vec3){(float)v.x, (float)v.y, (float)v.z};
}

/* Extends low and high by the corners of the bounds. */
static void find_extent(const struct zr_bounds *bounds, struct zr_view_lines *out)
{
    for (unsigned corner = 0; corner < 8; corner++) {
        const zr_dvec3 at = {(double)(corner & 1 ? bounds->max.x : bounds->min.x),
                             (double)(corner & 2 ? bounds->max.y : bounds->min.y),
                             (double)(corner & 4 ? bounds->max.z : bounds->min.z)};
        const double place[2] = {zr_dvec3_dot(out->axes.right, at), zr_dvec3_dot(out->axes.up, at)};
        for (int k = 0; k < 2; k++) {
            if (corner == 0 || place[k] < out->low[k]) out->low[k] = place[k];
            if (corner == 0 || place[k] > out->high[k]) out->high[k] = place[k];
        }
    }
}

/* Narrows the extent to that of the lines, which is less than that of the corners of the bounds in an oblique view. */
static void narrow_extent(struct zr_view_lines *out)
{
    const struct zr_polylines *lines = &out->lines;
    for (uint32_t i = 0; i < lines->point_count; i++)
        for (int k = 0; k < 2; k++) {
            if (i == 0 || lines->points[i][k] < out->low[k]) out->low[k] = lines->points[i][k];
            if (i == 0 || lines->points[i][k] > out->high[k]) out->high[k] = lines->points[i][k];
        }
}

/* Brings points of the window back to the scene. */
static void bring_back(const struct zr_camera *camera, struct zr_polylines *lines)
{
    const float *eye = camera->world_to_eye.m, *project = camera->projection.m;
    const double moved[2] = {(double)eye[12], (double)eye[13]};
    const double scale[2] = {(double)project[0], (double)project[5]};
    for (uint32_t i = 0; i < lines->point_count; i++)
        for (int k = 0; k < 2; k++) {
            const double clip = lines->points[i][k] / (0.5 * WINDOW) - 1.0;
            lines->points[i][k] = clip / scale[k] - moved[k];
        }
}

enum zr_status zr_view_lines_make(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_bounds *bounds, struct zr_view_axes axes, bool has_hidden,
                                  struct zr_view_lines *out)
{
    const zr_vec3 low = bounds->min, high = bounds->max, back = floats_of(axes.back);
    const zr_vec3 center = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    const float size = zr_diagonal_of(bounds);
    const zr_vec3 at = {center.x + size * back.x, center.y + size * back.y, center.z + size * back.z};
    const struct zr_camera camera = zr_camera_orthographic(floats_of(axes.right), floats_of(axes.up), back, at,
                                                           0.625f * size, 0.25f * size, 1.75f * size);
    const struct zr_drawing_desc desc = {.scene = scene,
                                         .camera = &camera,
                                         .bounds = bounds,
                                         .width = WINDOW,
                                         .height = WINDOW,
                                         .rule = {.crease_degrees = CREASE_DEGREES},
                                         .has_hidden = has_hidden,
                                         .straight = STRAIGHT};
    struct zr_drawing drawing;
    *out = (struct zr_view_lines){.axes = axes};
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    enum zr_status status = zr_drawing_make(&inner, &desc, &drawing);
    const struct zr_polylines *lines = &drawing.polylines;
    if (status == ZR_OK) {
        out->lines = *lines;
        out->lines.at = zr_arena_alloc_beside(run->arena, &scratch, lines->count, sizeof *lines->at);
        out->lines.points = zr_arena_alloc_beside(run->arena, &scratch, lines->point_count, sizeof *lines->points);
        if (out->lines.at && out->lines.points) {
            memcpy(out->lines.at, lines->at, lines->count * sizeof *lines->at);
            memcpy(out->lines.points, lines->points, lines->point_count * sizeof *lines->points);
        } else {
            status = ZR_NO_MEMORY;
        }
    }
    zr_arena_close_scratch(&scratch, run->arena);
    if (status != ZR_OK) return status;
    bring_back(&camera, &out->lines);
    const bool is_oblique = axes.back.x != 0.0 && axes.back.y != 0.0;
    if (is_oblique && lines->point_count > 0)
        narrow_extent(out);
    else
        find_extent(bounds, out);
    return ZR_OK;
}
