#include "views/sheet_picture.h"

#include <stdio.h>
#include <string.h>

#include "base/rgba.h"
#include "base/run.h"
#include "output/json/camera_json.h"
#include "scene/output.h"
#include "scene/picture.h"
#include "views/view_scene.h"

enum zr_status zr_sheet_picture_make(struct zr_arena *arena, const struct zr_views *views,
                                     struct zr_sheet_picture *sheet)
{
    const struct zr_view *window = &views->scene->views[0];
    *sheet = (struct zr_sheet_picture){
        .views = views,
        .canvas = {zr_arena_alloc(arena, (size_t)window->width * window->height, sizeof *sheet->canvas.pixels),
                   (int32_t)window->width, (int32_t)window->height},
        .cameras = zr_arena_zero(arena, views->set->count, sizeof *sheet->cameras),
        .ymags = zr_arena_zero(arena, views->set->count, sizeof *sheet->ymags),
        .shares = zr_arena_zero(arena, views->set->count, sizeof *sheet->shares)};
    if (!sheet->canvas.pixels || !sheet->cameras || !sheet->ymags || !sheet->shares) return ZR_NO_MEMORY;
    zr_canvas_fill(&sheet->canvas, (struct zr_box){0, 0, sheet->canvas.width, sheet->canvas.height},
                   zr_rgba_make(views->scene->background));
    return ZR_OK;
}

/* ---- captions ---- */

static const char *unit_of(const struct zr_scene *scene)
{
    static const char *const units[][2] = {{"millimetre", "mm"},    {"centimetre", "cm"}, {"metre", "m"},
                                           {"micron", "\xc2\xb5m"}, {"inch", "in"},       {"foot", "ft"}};
    for (size_t i = 0; scene->file.unit && i < sizeof units / sizeof *units; i++)
        if (strcmp(scene->file.unit, units[i][0]) == 0) return units[i][1];
    return "units";
}

/* Writes the angles of a view; nothing if its name is a direction. */
static void find_direction(const struct zr_sheet_picture *sheet, uint32_t number, char text[64])
{
    const struct zr_views *views = sheet->views;
    const struct zr_view_set *set = views->set;
    const struct zr_orbit orbit = zr_orbit_of(&sheet->cameras[number], views->scene->picture->z_is_up);
    const bool is_named =
        set->kind == ZR_VIEW_SET_LIST && (set->items[number].preset >= 0 || set->items[number].has_angles);
    text[0] = '\0';
    if (!is_named && orbit.has_angles)
        snprintf(text, 64, "  %.4g\xc2\xb0, %.4g\xc2\xb0", orbit.azimuth_degrees, orbit.elevation_degrees);
}

static void write_caption(const struct zr_sheet_picture *sheet, uint32_t number)
{
    const struct zr_views *views = sheet->views;
    char name[ZR_VIEW_NAME_SIZE], direction[64], scale[64] = "", all[256], most[160];
    zr_view_name(views->set, number, name);
    find_direction(sheet, number, direction);
    if (sheet->ymags[number] > 0.0f)
        snprintf(scale, sizeof scale, "  %.3g %s a pixel",
                 2.0 * (double)sheet->ymags[number] / (double)views->layout.height, unit_of(views->scene));
    snprintf(all, sizeof all, "%s%s%s", name, direction, scale);
    snprintf(most, sizeof most, "%s%s", name, *scale && !*direction ? scale : direction);
    const char *const texts[] = {all, most, name};
    zr_sheet_write(&views->layout, number, texts, 3, &sheet->canvas);
}

static float covered_share(const struct zr_frame *frame)
{
    const double pixels = (double)frame->width * (double)frame->height;
    if (!frame->color && !frame->face_id) return -1.0f;
    if (frame->samples_a_pixel == 0) return (float)((double)frame->covered_pixels / pixels);
    return (float)((double)frame->covered_samples / (pixels * (double)frame->samples_a_pixel));
}

void zr_sheet_picture_add(struct zr_sheet_picture *sheet, uint32_t number, const struct zr_frame *frame)
{
    const struct zr_views *views = sheet->views;
    sheet->cameras[number] = frame->camera;
    sheet->shares[number] = covered_share(frame);
    if (frame->view->projection == ZR_PROJECTION_ORTHOGRAPHIC)
        sheet->ymags[number] = 1.0f / frame->camera.projection.m[5];
    if (!frame->color) return;
    zr_sheet_put(&views->layout, number, frame->color, &sheet->canvas);
    if (views->layout.caption > 0) write_caption(sheet, number);
}

/* ---- files ---- */

enum zr_status zr_sheet_picture_encode(const struct zr_run *run, const struct zr_sheet_picture *sheet, uint32_t number,
                                       struct zr_files *files)
{
    const struct zr_drawing_warnings none = {.first = {.count = 0}};
    struct zr_scene scene = *sheet->views->scene;
    struct zr_view *view = &scene.views[0];
    view->outputs = &view->outputs[number];
    view->output_count = 1;
    const struct zr_frame frame = {
        .view = view, .width = view->width, .height = view->height, .color = (uint8_t *)sheet->canvas.pixels};
    return zr_encode_files(run, &scene, &frame, &none, files);
}

static void print_view(struct zr_print *print, const struct zr_sheet_picture *sheet, uint32_t number)
{
    const struct zr_views *views = sheet->views;
    const struct zr_camera *camera = &sheet->cameras[number];
    const struct zr_orbit orbit = zr_orbit_of(camera, views->scene->picture->z_is_up);
    const struct zr_box box = zr_sheet_box(&views->layout, number);
    const int32_t corners[] = {box.x, box.y, box.x + box.width, box.y + box.height};
    char name[ZR_VIEW_NAME_SIZE];
    zr_view_name(views->set, number, name);
    zr_print_begin(print, NULL, '{');
    zr_print_string(print, "name", name);
    zr_print_begin(print, "box", '[');
    for (int i = 0; i < 4; i++)
        zr_print_count(print, NULL, (uint64_t)corners[i]);
    zr_print_end(print, ']');
    if (orbit.has_angles) {
        zr_print_float(print, "azimuthDegrees", (float)orbit.azimuth_degrees);
        zr_print_float(print, "elevationDegrees", (float)orbit.elevation_degrees);
    }
    if (sheet->ymags[number] > 0.0f)
        zr_print_float(print, "unitsPerPixel", 2.0f * sheet->ymags[number] / (float)views->layout.height);
    if (sheet->shares[number] >= 0.0f) zr_print_float(print, "coveredShare", sheet->shares[number]);
    zr_camera_print_pose(print, camera, views->scene->adds_origin ? views->scene->origin : NULL);
    zr_print_floats(print, "projectionMatrix", camera->projection.m, 16);
    zr_print_end(print, '}');
}

enum zr_status zr_sheet_info_add(const struct zr_sheet_picture *sheet, struct zr_buffer *info)
{
    struct zr_print print = {.out = info, .needs_comma = true};
    info->size -= strlen("}\n");
    zr_print_begin(&print, "sheet", '[');
    for (uint32_t i = 0; i < sheet->views->set->count; i++)
        print_view(&print, sheet, i);
    zr_print_end(&print, ']');
    return zr_buffer_add(info, "}\n", 2) ? ZR_OK : ZR_NO_MEMORY;
}
