#include "drawing/technical_drawing.h"

#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "drawing/center_lines.h"
#include "drawing/cut_view.h"
#include "drawing/hole_notes.h"
#include "drawing/overall.h"
#include "drawing/placed_views.h"
#include "drawing/title_block.h"
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
    struct zr_warning_list *warnings;
    struct zr_bounds bounds;
    const struct zr_sections_cut *cut; /* NULL: no section */
    struct zr_placed_views placed;
    struct zr_part_holes holes;
    struct zr_hole_notes *notes;
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

/* Sets bounds, sizes and axes. */
static enum zr_status measure(struct making *m)
{
    const struct zr_run *run = m->run;
    const bool z_is_up = m->scene->picture->z_is_up;
    struct zr_placed_views *placed = &m->placed;
    m->bounds = zr_bounds_of(m->scene, run->team, run->cancel);
    const zr_vec3 low = m->bounds.min, high = m->bounds.max;
    const double x = (double)high.x - (double)low.x, y = (double)high.y - (double)low.y,
                 z = (double)high.z - (double)low.z;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!m->bounds.valid || !(x + y + z > 0.0))
        return zr_error_add(run->error, ZR_BAD_SCENE, NULL, "the scene has no extent");
    placed->sizes[0] = placed->unit * x;
    placed->sizes[1] = placed->unit * (z_is_up ? z : y);
    placed->sizes[2] = placed->unit * (z_is_up ? y : z);
    for (int view = 0; view < ZR_PAGE_VIEWS; view++)
        placed->views[view].axes = zr_view_axes_of((enum zr_page_view)view, z_is_up);
    return ZR_OK;
}

/* Cuts the scene for the section, if it is asked for. */
static enum zr_status cut(struct making *m)
{
    const struct zr_technical_options *options = m->options;
    const struct zr_run inner = zr_run_in(m->run, m->run->scratch);
    if (options->cut == ZR_CUT_NONE) return ZR_OK;
    zr_cut_view_choose(&m->placed, &m->bounds, (int)options->cut - (int)ZR_CUT_X, options->cut_at);
    const enum zr_status status = zr_cut_view_scene(&inner, m->scene, &m->bounds, &m->placed, &m->cut);
    if (status == ZR_OK && m->cut->warning) zr_warning_list_add(m->run->arena, m->warnings, "%s", m->cut->warning);
    return status;
}

/* ---- views ---- */

static enum zr_status make_views(struct making *m)
{
    const struct zr_run inner = zr_run_in(m->run, m->run->scratch);
    enum zr_status status = ZR_OK;
    for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
        struct zr_view_lines *lines = &m->placed.views[view];
        const bool is_cut = m->placed.is_cut && (int)m->placed.cut == view;
        const bool has_hidden = m->options->has_hidden && view != ZR_PAGE_ISOMETRIC && !is_cut;
        STAGE(
            zr_view_lines_make(&inner, is_cut ? m->cut->scene : m->scene, &m->bounds, lines->axes, has_hidden, lines));
    }
    return status;
}

static enum zr_status find_holes(struct making *m)
{
    const struct zr_run inner = zr_run_in(m->run, m->run->scratch);
    m->notes = zr_arena_alloc(m->run->scratch, 1, sizeof *m->notes);
    const enum zr_status status =
        m->notes ? zr_part_holes_find(&inner, m->scene, &m->holes, m->run->arena, m->warnings) : ZR_NO_MEMORY;
    if (status == ZR_OK) zr_hole_notes_list(&m->placed, &m->holes, m->notes);
    return status;
}

/* Chooses scale and places. Notes have up to four rows above each view; others are beside it. */
static enum zr_status lay_out(struct making *m)
{
    enum { ROWS_MOST = 4 };
    struct zr_placed_views *placed = &m->placed;
    struct zr_page_request request = {.asked = m->options->scale};
    struct zr_page_scale largest;
    uint32_t notes[ZR_PAGE_VIEWS] = {0};
    char asked[ZR_PAGE_SCALE_SIZE], fitting[ZR_PAGE_SCALE_SIZE];
    for (uint32_t i = 0; i < m->notes->count; i++)
        notes[m->notes->at[i].view]++;
    for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
        request.notes[view] = (notes[view] + 1) / 2 < ROWS_MOST ? (notes[view] + 1) / 2 : ROWS_MOST;
        for (int k = 0; k < 2; k++)
            request.sizes[view][k] = placed->unit * (placed->views[view].high[k] - placed->views[view].low[k]);
    }
    if (placed->is_cut) {
        request.has_label[placed->cut] = request.has_label[placed->shown] = true;
        request.has_cut_below = placed->cut == ZR_PAGE_RIGHT;
        request.has_cut_beside = placed->cut != ZR_PAGE_RIGHT;
    }
    if (zr_page_lay_out(&placed->page, &request, &placed->layout, &largest)) return ZR_OK;
    zr_page_scale_write(request.asked, asked);
    zr_page_scale_write(largest, fitting);
    if (!(largest.paper > 0.0))
        return zr_error_add(m->run->error, ZR_BAD_SCENE, NULL, "the views fit on the paper at no scale");
    return zr_error_add(m->run->error, ZR_BAD_SCENE, NULL,
                        "the views do not fit on %s at %s; the largest standard scale that fits is %s",
                        zr_page_names[placed->page.size], asked, fitting);
}

static enum zr_plot_pen pen_of(const struct zr_polyline *line)
{
    return line->class == ZR_STROKE_HIDDEN ? ZR_PLOT_HIDDEN : ZR_PLOT_VISIBLE;
}

/* True if points lie within a square of half a millimetre: a hidden line as short is a speck on the paper. */
static bool are_near(const struct zr_point *points, uint32_t count)
{
    const double most = 0.5;
    struct zr_point low = points[0], high = points[0];
    for (uint32_t i = 1; i < count; i++) {
        low = (struct zr_point){fmin(low.x, points[i].x), fmin(low.y, points[i].y)};
        high = (struct zr_point){fmax(high.x, points[i].x), fmax(high.y, points[i].y)};
    }
    return high.x - low.x < most && high.y - low.y < most;
}

/* Adds the lines of a view that have a pen. */
static enum zr_status add_lines(struct making *m, enum zr_page_view view, enum zr_plot_pen pen)
{
    enum { LINES_PER_CANCEL_CHECK = 1 << 10 };
    const struct zr_polylines *lines = &m->placed.views[view].lines;
    struct zr_point *points = zr_arena_alloc(m->run->scratch, lines->point_count, sizeof *points);
    if (!points) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < lines->count; i++) {
        const struct zr_polyline *line = &lines->at[i];
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->run->cancel)) return ZR_CANCELLED;
        if (pen_of(line) != pen || line->count < 2) continue;
        for (uint32_t k = 0; k < line->count; k++)
            points[k] = zr_placed_point(&m->placed, view, lines->points[line->first + k]);
        if (pen == ZR_PLOT_HIDDEN && are_near(points, line->count)) continue;
        const double *first = lines->points[line->first], *last = lines->points[line->first + line->count - 1];
        const bool is_ring = line->count > 3 && first[0] == last[0] && first[1] == last[1];
        if (is_ring)
            zr_plot_add_ring(m->plot, pen, points, line->count - 1);
        else
            zr_plot_add_line(m->plot, pen, points, line->count);
    }
    return ZR_OK;
}

static enum zr_status add_view(struct making *m, enum zr_page_view view)
{
    const struct zr_run inner = zr_run_in(m->run, m->run->scratch);
    enum zr_status status = ZR_OK;
    zr_plot_begin(m->plot, zr_page_view_names[view]);
    if (m->placed.is_cut && m->placed.cut == view) STAGE(zr_cut_view_hatch(&inner, m->plot, &m->placed, m->cut->scene));
    STAGE(add_lines(m, view, ZR_PLOT_HIDDEN));
    STAGE(add_lines(m, view, ZR_PLOT_VISIBLE));
    if (status == ZR_OK && !zr_center_lines_add(m->plot, m->run->scratch, &m->placed, view, &m->holes))
        status = ZR_NO_MEMORY;
    return status;
}

/* Adds section, dimensions and notes. Returns how many holes have a note. */
static uint32_t add_marks(struct making *m)
{
    enum { DIMENSIONS = 3 };
    struct zr_page_box boxes[DIMENSIONS + ZR_CUT_BOXES];
    uint32_t count = DIMENSIONS;
    zr_overall_add(m->plot, &m->placed, boxes);
    if (m->placed.is_cut) {
        zr_cut_view_mark(m->plot, &m->placed, boxes + count);
        count += ZR_CUT_BOXES;
    }
    return zr_hole_notes_add(m->run, m->plot, &m->placed, &m->holes, m->notes, boxes, count, m->warnings);
}

/* ---- the title block ---- */

static void add_title(struct making *m)
{
    const struct zr_technical_options *options = m->options;
    const double *sizes = m->placed.sizes, largest = fmax(sizes[0], fmax(sizes[1], sizes[2]));
    char lengths[3][ZR_LENGTH_SIZE], size[3 * ZR_LENGTH_SIZE + 16];
    for (int k = 0; k < 3; k++)
        zr_length_write(sizes[k], largest, "", lengths[k]);
    snprintf(size, sizeof size, "%s \xc3\x97 %s \xc3\x97 %s", lengths[0], lengths[2], lengths[1]);
    zr_page_scale_write(m->placed.layout.scale, m->plot->scale);
    const struct zr_title_texts texts = {.title = options->title,
                                         .scale = m->plot->scale,
                                         .unit = m->scene->file.unit ? "mm" : "none in file (1 = 1 mm)",
                                         .size = size,
                                         .date = options->date};
    zr_title_block_add(m->plot, &m->placed.page, &texts);
}

enum zr_status zr_technical_drawing_make(const struct zr_run *run, const struct zr_scene *scene,
                                         const struct zr_technical_options *options, struct zr_plot *out,
                                         struct zr_technical_facts *facts, struct zr_warning_list *warnings)
{
    const double millimetres = zr_unit_millimetres(scene->file.unit);
    struct zr_scene edited;
    struct making m = {.run = run, .scene = &edited, .options = options, .plot = out, .warnings = warnings};
    m.placed.page = zr_page_make(options->page, options->is_first_angle);
    m.placed.has_hidden = options->has_hidden;
    m.placed.unit = millimetres > 0.0 ? millimetres : 1.0;
    *out = (struct zr_plot){
        .arena = run->arena, .width = m.placed.page.width, .height = m.placed.page.height, .title = options->title};
    enum zr_status status = check(scene, run->error);
    if (status == ZR_OK && !zr_scene_edit_materials(run->scratch, scene, draw_both_sides, &edited))
        status = ZR_NO_MEMORY;
    STAGE(measure(&m));
    STAGE(cut(&m));
    STAGE(make_views(&m));
    STAGE(find_holes(&m));
    STAGE(lay_out(&m));
    if (status != ZR_OK) return status;
    add_title(&m);
    for (int view = 0; view < ZR_PAGE_VIEWS; view++)
        STAGE(add_view(&m, (enum zr_page_view)view));
    *facts = (struct zr_technical_facts){.holes = m.holes.count, .noted = add_marks(&m), .unit = scene->file.unit};
    memcpy(facts->sizes, m.placed.sizes, sizeof facts->sizes);
    if (out->boxed > 0)
        zr_warning_list_add(run->arena, warnings, "title or date has characters that have no glyph: drawn as boxes");
    if (status == ZR_OK && zr_is_cancelled(run->cancel)) status = ZR_CANCELLED;
    if (status == ZR_OK && (out->has_failed || !zr_arena_ok(run->scratch))) status = ZR_NO_MEMORY;
    return status;
}
