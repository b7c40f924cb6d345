#include "overlay/annotate/annotate.h"

#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "base/rgba.h"
#include "overlay/annotate/box_dimensions.h"
#include "overlay/annotate/corner_marks.h"
#include "overlay/annotate/hole_notes.h"
#include "overlay/annotate/length_text.h"
#include "overlay/annotate/part_labels.h"
#include "overlay/annotate/place_dimensions.h"
#include "overlay/annotate/place_marks.h"
#include "overlay/color_bar.h"
#include "parameter_kinds.h"
#include "scene/camera/mesh_up.h"

static const char *const words[ZR_ANNOTATE_COUNT] = {ZR_ANNOTATE_WORDS};

/* Returns the rotation of a bare mesh's file to the world. */
static zr_mat4 turn_of(const struct zr_scene *scene)
{
    static const char *const ups[] = {"x", "-x", "y", "-y", "z", "-z"};
    for (int i = 0; scene->file.up && i < ZR_MESH_UP_AUTO; i++)
        if (strcmp(scene->file.up, ups[i]) == 0) return zr_mesh_up_turn((enum zr_mesh_up)i);
    return zr_mat4_identity();
}

static void set_camera(struct zr_layout *l)
{
    const struct zr_matrix eye = zr_matrix_of(&l->frame->camera.world_to_eye),
                           projection = zr_matrix_of(&l->frame->camera.projection);
    const zr_vec4 center = zr_camera_eye(&l->frame->camera);
    const double in_eye[4] = {(double)center.x, (double)center.y, (double)center.z, (double)center.w};
    const zr_mat4 turn = turn_of(l->scene);
    struct zr_matrix back;
    l->to_clip = zr_matrix_mul(&projection, &eye);
    if (zr_matrix_invert(&eye, &back)) zr_matrix_apply(&back, in_eye, l->eye);
    for (int a = 0; a < 3; a++)
        l->axes[a] = (zr_dvec3){(double)turn.m[4 * a], (double)turn.m[4 * a + 1], (double)turn.m[4 * a + 2]};
}

/* Chooses inks that are legible on the paper: the median along the upper border, or the background. */
static void set_colors(struct zr_layout *l)
{
    const struct zr_frame *frame = l->frame;
    const zr_vec4 background = l->scene->background;
    l->paper = zr_rgba_opaque(background.w > 0.0f ? background : (zr_vec4){1.0f, 1.0f, 1.0f, 1.0f});
    if (frame->color) {
        const struct zr_canvas canvas = {(uint32_t *)(void *)frame->color, (int32_t)frame->width,
                                         (int32_t)frame->height};
        l->paper = zr_canvas_median(&canvas, (struct zr_box){0, 0, canvas.width, 2 + (int32_t)l->letters});
    }
    const bool is_dark = l->is_dark = zr_canvas_ink(l->paper) != zr_rgba_make((zr_vec4){0.0f, 0.0f, 0.0f, 1.0f});
    l->ink = zr_rgba_make(is_dark ? (zr_vec4){0.88f, 0.91f, 0.94f, 1.0f} : (zr_vec4){0.149f, 0.196f, 0.267f, 1.0f});
    l->dimension = zr_rgba_make(is_dark ? (zr_vec4){0.6f, 0.78f, 1.0f, 1.0f} : (zr_vec4){0.078f, 0.275f, 0.549f, 1.0f});
}

static struct zr_layout *open_layout(const struct zr_run *run, const struct zr_scene *scene,
                                     const struct zr_frame *frame, struct zr_marks *marks)
{
    struct zr_layout *l = zr_arena_zero(run->arena, 1, sizeof *l);
    if (!l) return NULL;
    l->arena = run->arena;
    l->cancel = run->cancel;
    l->marks = marks;
    l->scene = scene;
    l->frame = frame;
    l->ids = frame->face_id;
    l->width = (double)frame->width;
    l->height = (double)frame->height;
    l->letters = zr_type_height((int32_t)frame->width, (int32_t)frame->height);
    l->line = fmax(1.0, 1.5 * sqrt(fmin(l->width, l->height) / 480.0));
    set_camera(l);
    set_colors(l);
    return l;
}

/* Keeps the colour bar's place free. */
static void take_color_bar(struct zr_layout *l)
{
    const struct zr_scene *scene = l->scene;
    const struct zr_color_scale *scale = scene->color_bar.is_on ? zr_color_bar_scale(scene) : NULL;
    struct zr_color_bar_layout bar;
    if (!scale || !l->frame->color ||
        !zr_color_bar_lay_out(&scene->color_bar, scale, l->frame->width, l->frame->height, &bar))
        return;
    const struct zr_box all = bar.all;
    zr_layout_take_rect(
        l, (struct zr_rect){(double)all.x, (double)all.y, (double)(all.x + all.width), (double)(all.y + all.height)});
}

/* Notes that no dimension and no mark of the view is drawn. */
static void leave_out_given(struct zr_layout *l, const char *why, enum zr_left_out_cause cause)
{
    const struct zr_annotate *annotate = &l->frame->view->annotate;
    if (annotate->dimension_count > 0) zr_layout_leave_out(l, "dimensions", why, cause);
    if (annotate->mark_count > 0) zr_layout_leave_out(l, "marks", why, cause);
}

/* Places what the view asks for. */
static void place_all(struct zr_layout *l, struct zr_annotations *made)
{
    const struct zr_annotate *annotate = &l->frame->view->annotate;
    const bool has_title = zr_annotate_has(annotate, ZR_ANNOTATE_TITLE);
    const char *unit = has_title ? "" : zr_unit_sign(l->scene->file.unit);
    const bool has_lens = l->frame->view->lens.model != ZR_LENS_NONE, has_bounds = l->frame->bounds.valid;
    for (int i = 0; i < ZR_ANNOTATE_COUNT; i++) {
        const bool is_fixed = i == ZR_ANNOTATE_TITLE || i == ZR_ANNOTATE_TRIAD;
        if (zr_annotate_has(annotate, (enum zr_annotation)i) && !is_fixed && (has_lens || !has_bounds))
            zr_layout_leave_out(l, words[i], has_lens ? "the view has a lens" : "the scene has no points",
                                ZR_LEFT_OUT_BY_VIEW);
    }
    if (has_lens || !has_bounds)
        leave_out_given(l, has_lens ? "the view has a lens" : "the scene has no points", ZR_LEFT_OUT_BY_VIEW);
    take_color_bar(l);
    if (has_title) zr_title_place(l);
    if (zr_annotate_has(annotate, ZR_ANNOTATE_TRIAD)) zr_triad_place(l);
    if (has_lens || !has_bounds) return;
    if (zr_annotate_has(annotate, ZR_ANNOTATE_SCALE)) zr_scale_place(l);
    l->corner_count = l->rect_count;
    if (zr_annotate_has(annotate, ZR_ANNOTATE_BOX)) zr_box_dimensions_place(l, unit);
    zr_place_dimensions_place(l, unit);
    if (zr_annotate_has(annotate, ZR_ANNOTATE_HOLES)) zr_hole_notes_place(l, unit);
    zr_place_marks_place(l);
    if (zr_annotate_has(annotate, ZR_ANNOTATE_LABELS)) zr_part_labels_place(l, &made->numbered, &made->numbered_count);
}

enum zr_status zr_annotations_make(const struct zr_run *run, const struct zr_scene *scene, const struct zr_frame *frame,
                                   const struct zr_annotations **out)
{
    static const char small[] = "the window has a side below 200 pixels";
    *out = NULL;
    if (!zr_annotate_is_on(&frame->view->annotate)) return ZR_OK;
    struct zr_annotations *made = zr_arena_zero(run->arena, 1, sizeof *made);
    if (!made) return ZR_NO_MEMORY;
    made->marks.arena = run->arena;
    struct zr_layout *l = open_layout(run, scene, frame, &made->marks);
    if (!l) return ZR_NO_MEMORY;
    if (zr_annotate_fits(&frame->view->annotate, frame->width, frame->height)) {
        place_all(l, made);
    } else {
        for (int i = 0; i < ZR_ANNOTATE_COUNT; i++)
            if (zr_annotate_has(&frame->view->annotate, (enum zr_annotation)i))
                zr_layout_leave_out(l, words[i], small, ZR_LEFT_OUT_NO_ROOM);
        leave_out_given(l, small, ZR_LEFT_OUT_NO_ROOM);
    }
    made->left_out = l->left_out;
    made->left_out_count = l->left_out_count;
    memcpy(made->causes, l->causes, sizeof made->causes);
    *out = made;
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return made->marks.has_failed || !zr_arena_ok(run->arena) ? ZR_NO_MEMORY : ZR_OK;
}

enum zr_status zr_annotations_draw(const struct zr_run *run, const struct zr_annotations *annotations,
                                   struct zr_frame *frame)
{
    if (!annotations || !frame->color) return ZR_OK;
    const struct zr_canvas canvas = {(uint32_t *)(void *)frame->color, (int32_t)frame->width, (int32_t)frame->height};
    if (annotations->marks.count > 0) frame->spans = NULL; /* marks lie beside the model */
    return zr_marks_draw(&annotations->marks, run->cancel, &canvas);
}
