#include "drawing/technical_drawing.h"

#include <stdio.h>

#include "base/cancel.h"
#include "drawing/overall.h"
#include "drawing/title_block.h"
#include "drawing/view_lines.h"
#include "overlay/annotate/length_text.h"
#include "scene/csg.h"
#include "scene/picture.h"
#include "scene/scene_edit.h"

/* Runs the stage unless an earlier one failed. */
#define STAGE(call)                                                                                                    \
    if (status == ZR_OK) status = (call)

struct making {
    const struct zr_run *run;
    const struct zr_scene *scene; /* that draws both sides of its faces */
    const struct zr_technical_options *options;
    struct zr_plot *plot;
    struct zr_bounds bounds;
    bool z_is_up;
    double unit;     /* millimetres per unit of the scene */
    double sizes[3]; /* width, height, depth, millimetres of the model */
    struct zr_page page;
    struct zr_page_layout layout;
    struct zr_view_lines views[ZR_PAGE_VIEWS];
};

/* ---- checks ---- */

static uint64_t faces_of(const struct zr_scene *scene)
{
    uint64_t faces = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++)
        faces += scene->meshes[scene->instances[i].mesh].face_count;
    return faces;
}

static enum zr_status check(const struct zr_scene *scene, struct zr_error *error)
{
    if (scene->view_set || scene->sheet.is_on)
        return zr_error_add(error, ZR_BAD_SCENE, NULL,
                            "the scene has several views; a drawing has its own four: leave out views and sheet");
    if (faces_of(scene) == 0)
        return zr_error_add(error, ZR_BAD_SCENE, NULL,
                            "a drawing shows the edges of faces, and the scene has none: points and lines alone have "
                            "no drawing");
    if (scene->csg)
        return zr_error_add(error, ZR_BAD_SCENE, scene->parts.csg.pointer,
                            "combined solids have no mesh, so they have no drawing: leave out csg");
    if (scene->sections.count > 0)
        return zr_error_add(error, ZR_BAD_SCENE, "/sections",
                            "a drawing shows the whole model: leave out sections; its own section gives the section "
                            "A-A");
    return ZR_OK;
}

static void draw_both_sides(struct zr_material *material)
{
    material->double_sided = true;
}

/* Sets bounds and sizes. */
static enum zr_status measure(struct making *m)
{
    const struct zr_run *run = m->run;
    m->bounds = zr_bounds_of(m->scene, run->team, run->cancel);
    const zr_vec3 low = m->bounds.min, high = m->bounds.max;
    const double x = (double)high.x - (double)low.x, y = (double)high.y - (double)low.y,
                 z = (double)high.z - (double)low.z;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!m->bounds.valid || !(x + y + z > 0.0))
        return zr_error_add(run->error, ZR_BAD_SCENE, NULL, "the scene has no extent");
    m->sizes[0] = m->unit * x;
    m->sizes[1] = m->unit * (m->z_is_up ? z : y);
    m->sizes[2] = m->unit * (m->z_is_up ? y : z);
    return ZR_OK;
}

/* ---- views ---- */

static enum zr_status make_views(struct making *m)
{
    const struct zr_run inner = zr_run_in(m->run, m->run->scratch);
    enum zr_status status = ZR_OK;
    for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
        const struct zr_view_axes axes = zr_view_axes_of((enum zr_page_view)view, m->z_is_up);
        const bool has_hidden = m->options->has_hidden && view != ZR_PAGE_ISOMETRIC;
        STAGE(zr_view_lines_make(&inner, m->scene, &m->bounds, axes, has_hidden, &m->views[view]));
    }
    return status;
}

/* Chooses scale and places. */
static enum zr_status lay_out(struct making *m)
{
    struct zr_page_request request = {.asked = m->options->scale};
    struct zr_page_scale largest;
    char asked[ZR_PAGE_SCALE_SIZE], fitting[ZR_PAGE_SCALE_SIZE];
    for (int view = 0; view < ZR_PAGE_VIEWS; view++)
        for (int k = 0; k < 2; k++)
            request.sizes[view][k] = m->unit * (m->views[view].high[k] - m->views[view].low[k]);
    if (zr_page_lay_out(&m->page, &request, &m->layout, &largest)) return ZR_OK;
    zr_page_scale_write(request.asked, asked);
    zr_page_scale_write(largest, fitting);
    if (!(largest.paper > 0.0))
        return zr_error_add(m->run->error, ZR_BAD_SCENE, NULL, "the views fit on the paper at no scale");
    return zr_error_add(m->run->error, ZR_BAD_SCENE, NULL,
                        "the views do not fit on %s at %s; the largest standard scale that fits is %s",
                        zr_page_names[m->page.size], asked, fitting);
}

static struct zr_point on_paper(const struct making *m, enum zr_page_view view, const double place[2])
{
    const struct zr_view_lines *of = &m->views[view];
    const struct zr_page_box box = m->layout.views[view];
    const double factor = m->unit * zr_page_factor(m->layout.scale);
    return (struct zr_point){box.x0 + factor * (place[0] - of->low[0]), box.y1 - factor * (place[1] - of->low[1])};
}

static enum zr_plot_pen pen_of(const struct zr_polyline *line)
{
    return line->class == ZR_STROKE_HIDDEN ? ZR_PLOT_HIDDEN : ZR_PLOT_VISIBLE;
}

/* Adds the lines of a view that have a pen. */
static enum zr_status add_lines(struct making *m, enum zr_page_view view, enum zr_plot_pen pen)
{
    enum { LINES_PER_CANCEL_CHECK = 1 << 10 };
    const struct zr_polylines *lines = &m->views[view].lines;
    struct zr_point *points = zr_arena_alloc(m->run->scratch, lines->point_count, sizeof *points);
    if (!points) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct zr_polyline *line = &lines->at[i];
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->run->cancel)) return ZR_CANCELLED;
        if (pen_of(line) != pen || line->count < 2) continue;
        for (uint32_t k = 0; k < line->count; k++)
            points[k] = on_paper(m, view, lines->points[line->first + k]);
        const double *first = lines->points[line->first], *last = lines->points[line->first + line->count - 1];
        const bool is_ring = line->count > 3 && first[0] == last[0] && first[1] == last[1];
        if (is_ring)
            zr_plot_add_ring(m->plot, pen, points, line->count - 1);
        else
            zr_plot_add_line(m->plot, pen, points, line->count);
    }
    return ZR_OK;
}

static enum zr_status add_views(struct making *m)
{
    enum zr_status status = ZR_OK;
    for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
        zr_plot_begin(m->plot, zr_page_view_names[view]);
        STAGE(add_lines(m, (enum zr_page_view)view, ZR_PLOT_HIDDEN));
        STAGE(add_lines(m, (enum zr_page_view)view, ZR_PLOT_VISIBLE));
    }
    return status;
}

/* ---- the title block ---- */

static void add_title(struct making *m)
{
    const struct zr_technical_options *options = m->options;
    const double largest = m->sizes[0] > m->sizes[1] ? m->sizes[0] : m->sizes[1];
    char lengths[3][ZR_LENGTH_SIZE], size[3 * ZR_LENGTH_SIZE + 16];
    for (int k = 0; k < 3; k++)
        zr_length_write(m->sizes[k], largest > m->sizes[2] ? largest : m->sizes[2], "", lengths[k]);
    snprintf(size, sizeof size, "%s \xc3\x97 %s \xc3\x97 %s", lengths[0], lengths[2], lengths[1]);
    zr_page_scale_write(m->layout.scale, m->plot->scale);
    const struct zr_title_texts texts = {.title = options->title,
                                         .scale = m->plot->scale,
                                         .unit = m->scene->file.unit ? "mm" : "none in file (1 = 1 mm)",
                                         .size = size,
                                         .date = options->date};
    zr_title_block_add(m->plot, &m->page, &texts);
}

enum zr_status zr_technical_drawing_make(const struct zr_run *run, const struct zr_scene *scene,
                                         const struct zr_technical_options *options, struct zr_plot *out,
                                         struct zr_warning_list *warnings)
{
    const double millimetres = zr_unit_millimetres(scene->file.unit);
    struct zr_scene edited;
    struct making m = {.run = run,
                       .scene = &edited,
                       .options = options,
                       .plot = out,
                       .z_is_up = scene->picture->z_is_up,
                       .unit = millimetres > 0.0 ? millimetres : 1.0,
                       .page = zr_page_make(options->page, options->is_first_angle)};
    (void)warnings;
    *out = (struct zr_plot){.arena = run->arena, .width = m.page.width, .height = m.page.height};
    enum zr_status status = check(scene, run->error);
    if (status == ZR_OK && !zr_scene_edit_materials(run->scratch, scene, draw_both_sides, &edited))
        status = ZR_NO_MEMORY;
    STAGE(measure(&m));
    STAGE(make_views(&m));
    STAGE(lay_out(&m));
    if (status != ZR_OK) return status;
    add_title(&m);
    status = add_views(&m);
    zr_overall_add(out, &m.page, &m.layout, m.sizes);
    if (status == ZR_OK && (out->has_failed || !zr_arena_ok(run->scratch))) status = ZR_NO_MEMORY;
    return status;
}
