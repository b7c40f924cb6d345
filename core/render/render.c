/* render.c - the pipeline, from top to bottom: one STAGE per step. Those of a pass are in render/pass.c, those of
 * pictures in linear light in render/picture.c. */
#include "core.h"

#include <inttypes.h>

#include "base/cancel.h"
#include "base/memory_error.h"
#include "base/run.h"
#include "measure/combined.h"
#include "measure/part_distance.h"
#include "overlay/annotate/annotate.h"
#include "overlay/color_bar.h"
#include "raster/textbook/algorithms.h"
#include "render/flow.h"
#include "render/frame_parts.h"
#include "render/instance_masks.h"
#include "render/layer_channels.h"
#include "render/layers/wall_channel.h"
#include "render/lens.h"
#include "render/lens_masks.h"
#include "render/mesh_lines.h"
#include "render/pass.h"
#include "render/picks.h"
#include "render/picture.h"
#include "render/pixel_fragments.h"
#include "render/section_pass.h"
#include "render/stage.h"
#include "render/trace.h"
#include "scene/camera/resolved_view.h"
#include "scene/output.h"
#include "scene/scene.h"
#include "shade/nocs.h"

/* Draws the data channels at pixel centres, and the colours if they need no passes of their own. */
static enum zr_status draw_channels(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_pass_desc desc = {.scene = scene,
                                      .camera = &frame->camera,
                                      .window = zr_window_of(scene, frame->width, frame->height, 1),
                                      .wants = {.colors = frame->color, .normals = frame->channels[ZR_CHANNEL_NORMALS]},
                                      .base = frame->base};
    enum zr_status status = ZR_OK;
    struct zr_pass pass;
    if (frame->channels[ZR_CHANNEL_POSITION] && zr_view_space(frame->view, ZR_CHANNEL_POSITION) == ZR_SPACE_NOCS) {
        frame->nocs = zr_nocs_make(run->arena, scene, run->cancel);
        if (!frame->nocs) return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    }
    if (frame->channels[ZR_CHANNEL_FLOW]) STAGE(zr_flow_target_draw(run, scene, frame));
    STAGE(zr_pass_make(run, &desc, &pass));
    STAGE(zr_tiles_draw(run, &pass.tiles, frame));
    frame->nocs = NULL;
    frame->flow = NULL;
    if (status == ZR_OK) frame->counts = zr_pass_counts(&pass);
    return status;
}

static bool has_channels(const struct zr_frame *frame)
{
    for (int c = 0; c < ZR_CHANNEL_COUNT; c++)
        if (frame->channels[c]) return true;
    return false;
}

/* Draws the picture with its samples and effects, then the data channels in a pass without them. */
static enum zr_status draw_picture_and_channels(const struct zr_run *run, const struct zr_scene *scene,
                                                struct zr_frame *frame)
{
    struct zr_frame picture = *frame;
    enum zr_status status = ZR_OK;
    frame->color = NULL;
    STAGE(zr_picture_draw(run, scene, &picture));
    if (has_channels(frame)) {
        STAGE(draw_channels(run, scene, frame));
    } else {
        frame->counts = picture.counts;
    }
    frame->color = picture.color;
    frame->covered_samples = picture.covered_samples;
    frame->samples_a_pixel = picture.samples_a_pixel;
    frame->spans = NULL;
    return status;
}

/* Makes the lines of a file. */
static enum zr_status make_lines(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    struct zr_scene edited;
    const struct zr_scene *shown;
    if (!zr_picture_scene(run->scratch, scene, &edited, &shown)) return ZR_NO_MEMORY;
    return zr_mesh_lines_keep(run, shown, frame);
}

static enum zr_status draw_wall(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    return zr_wall_channel_draw(run, scene, frame, frame->channels[ZR_CHANNEL_WALL]);
}

/* An optional pass of a frame. Masks and the lines of a file stay in `arena`; passes that write pixels of the frame
 * work in `scratch` alone, whose memory the next pass uses again. */
struct optional_pass {
    bool wanted, stays;
    enum zr_status (*run)(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);
};

static enum zr_status draw_frame(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const bool has_picture = frame->color && zr_picture_has_own_passes(scene->picture);
    const struct optional_pass passes[] = {
        {!has_picture, false, draw_channels},
        {has_picture, false, draw_picture_and_channels},
        {zr_layer_channels_are_wanted(frame), false, zr_layer_channels_draw},
        {frame->channels[ZR_CHANNEL_WALL] != NULL, false, draw_wall},
        {zr_view_has_masks(frame->view), true, zr_instance_masks_find},
        {zr_view_encodes(frame->view, ZR_ENCODING_SVG), true, make_lines},
    };
    const struct zr_run inner = zr_run_in(run, run->scratch);
    enum zr_status status = ZR_OK;
    for (size_t i = 0; status == ZR_OK && i < sizeof passes / sizeof passes[0]; i++) {
        if (!passes[i].wanted) continue;
        if (passes[i].stays && run->scratch == run->arena) {
            status = passes[i].run(run, scene, frame);
            continue;
        }
        const struct zr_arena_step step = zr_arena_open_step(run->scratch);
        status = passes[i].run(passes[i].stays ? run : &inner, scene, frame);
        zr_arena_close_step(run->scratch, &step);
    }
    return status;
}

/* Lists the fragments of the pixel that an output asks for. Only they stay in `arena`. */
static enum zr_status list_fragments(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame)
{
    const struct zr_output *pixel = zr_view_output(frame->view, ZR_CHANNEL_FRAGMENTS);
    return zr_pixel_fragments_find(run, scene, pixel->x, pixel->y, frame);
}

/* Makes a frame without channels. */
static enum zr_status draw_nothing(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    const struct zr_scene *drawn;
    zr_frame_open(resolved, frame);
    frame->base = scene->base;
    frame->origin = scene->adds_origin ? scene->origin : NULL;
    return zr_render_sections(run, scene, resolved, frame, &drawn);
}

/* Draws colour bar and marks over the finished picture. `scene`: the drawn one, which may be cut open. */
static enum zr_status draw_overlay(const struct zr_run *run, const struct zr_scene *whole, const struct zr_scene *scene,
                                   struct zr_frame *frame)
{
    enum zr_status status = ZR_OK;
    if (zr_view_annotates(frame->view) && frame->view->lens.model == ZR_LENS_NONE)
        STAGE(zr_pick_ends_find(run, scene, frame));
    if (zr_view_notes_holes(frame->view)) STAGE(zr_frame_features_find(run, whole, frame));
    if (scene->color_bar.is_on) zr_color_bar_draw(scene, frame);
    if (zr_view_wants(frame->view, ZR_CHANNEL_COLOR))
        STAGE(zr_annotations_make(run, scene, frame, &frame->annotations));
    STAGE(zr_annotations_draw(run, frame->annotations, frame));
    return status;
}

static enum zr_status draw(const struct zr_run *run, const struct zr_scene *scene,
                           const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    const struct zr_scene *drawn = scene;
    enum zr_status status = ZR_OK;
    STAGE(zr_frame_make(run->arena, resolved, frame));
    frame->origin = scene->adds_origin ? scene->origin : NULL;
    if (scene->base) STAGE(zr_base_place(run, scene, frame->view, &frame->camera, &frame->base));
    if (scene->sections.count > 0) STAGE(zr_render_sections(run, scene, resolved, frame, &drawn));
    STAGE(draw_frame(run, drawn, frame));
    STAGE(draw_overlay(run, scene, drawn, frame));
    if (zr_view_wants(frame->view, ZR_CHANNEL_FRAGMENTS)) STAGE(list_fragments(run, drawn, frame));
    if (zr_view_picks(frame->view)) STAGE(zr_picks_find(run, drawn, NULL, &frame->view->picks, frame, &frame->picks));
    if (frame->sections) STAGE(zr_render_sections_restore(run->arena, run->cancel, frame));
    if (zr_view_wants(frame->view, ZR_CHANNEL_TRACE)) STAGE(zr_trace_make(run, scene, frame));
    return status;
}

/* The same through a lens: the frame of the pinhole picture, in `scratch`, then that of the view. */
static enum zr_status draw_through_lens(const struct zr_run *run, const struct zr_scene *scene,
                                        const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    const struct zr_run inner = zr_run_in(run, run->scratch);
    const struct zr_scene *drawn;
    struct zr_frame pinhole = {.width = 0};
    struct zr_lens_drawing drawing;
    struct zr_remap remap;
    enum zr_status status = ZR_OK;
    STAGE(zr_frame_make(run->arena, resolved, frame));
    STAGE(zr_remap_make(&inner, resolved->lens, &remap));
    STAGE(zr_render_sections(run, scene, resolved, &pinhole, &drawn));
    if (status != ZR_OK) return status;
    zr_lens_drawing_open(drawn, resolved, &drawing);
    STAGE(zr_frame_make(run->scratch, &drawing.resolved, &pinhole));
    STAGE(draw_frame(&inner, &drawing.scene, &pinhole));
    STAGE(zr_lens_list_fragments(run, &drawing, &remap, &pinhole));
    if (zr_view_picks(pinhole.view)) STAGE(zr_picks_find(run, &drawing.scene, &remap, &pinhole.view->picks, &pinhole, &pinhole.picks));
    STAGE(zr_render_sections_restore(run->arena, run->cancel, &pinhole));
    STAGE(zr_lens_take(run, scene, &remap, &pinhole, frame));
    if (pinhole.masks) STAGE(zr_lens_masks_take(run, &remap, pinhole.masks, frame));
    STAGE(draw_overlay(run, scene, scene, frame));
    return status;
}

static enum zr_status run_pipeline(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_resolved_view *resolved, struct zr_frame *frame)
{
    enum zr_status status = ZR_OK;
    if (!resolved) STAGE(zr_resolved_view_find(run, scene, &resolved));
    STAGE(scene->is_undrawn ? draw_nothing(run, scene, resolved, frame)
          : resolved->lens  ? draw_through_lens(run, scene, resolved, frame)
                            : draw(run, scene, resolved, frame));
    if (status == ZR_OK && zr_view_wants(frame->view, ZR_CHANNEL_INFO)) STAGE(zr_frame_parts_find(run, scene, frame));
    if (scene->csg && zr_view_wants(frame->view, ZR_CHANNEL_INFO))
        STAGE(zr_combined_find(run, scene, &frame->combined));
    if (scene->distance_count > 0 && zr_view_wants(frame->view, ZR_CHANNEL_INFO))
        STAGE(zr_part_distances_find(run, scene, &frame->distances));
    if (frame->distances) frame->distance_count = scene->distance_count;
    if (frame->fragments.count > 0) STAGE(zr_fragment_parts_find(run, scene, frame));
    if (frame->picks.count > 0) STAGE(zr_pick_parts_find(run, scene, frame));
    return status;
}

enum zr_status zr_render_apart(const struct zr_run *run, const struct zr_scene *scene,
                               const struct zr_resolved_view *resolved, const struct zr_frame **out)
{
    struct zr_frame *frame = zr_arena_zero(run->arena, 1, sizeof *frame);
    run->arena->cancel = run->scratch->cancel = run->cancel;
    enum zr_status status = frame ? run_pipeline(run, scene, resolved, frame) : ZR_NO_MEMORY;
    run->arena->cancel = run->scratch->cancel = NULL;
    if (status == ZR_NO_MEMORY && zr_is_cancelled(run->cancel)) status = ZR_CANCELLED;
    if (status == ZR_BAD_SCENE && run->error->count == 0)
        zr_error_add(run->error, status, NULL,
                     "the algorithm painter compares more than the %" PRIu64 " spans and samples that are allowed: too "
                     "many of its faces overlap or cut one another; other algorithms, and fewer faces, take less",
                     ZR_PAINTER_WORK_MAX);
    if (status == ZR_NO_MEMORY)
        zr_memory_error_add(run->error, run->scratch->failed ? run->scratch : run->arena, "rendering",
                            zr_any_is_see_through(scene->materials, scene->material_count) ||
                                    zr_any_is_xray(scene->materials, scene->material_count) ||
                                    zr_any_is_glass(scene->materials, scene->material_count)
                                ? ": all layers of translucent surfaces are kept, 8 bytes per pixel and layer"
                                : "");
    if (status == ZR_CANCELLED) zr_error_add(run->error, status, NULL, "rendering was stopped before it was done");
    if (status == ZR_INTERNAL) zr_error_add(run->error, status, NULL, "the algorithm failed");
    *out = frame;
    return status;
}

enum zr_status zr_render(const struct zr_run *run, const struct zr_scene *scene,
                         const struct zr_resolved_view *resolved, const struct zr_frame **frame)
{
    struct zr_run alone = *run;
    alone.scratch = run->arena;
    return zr_render_apart(&alone, scene, resolved, frame);
}
