/* render.c - the pipeline, from top to bottom: one STAGE per step. Those of a pass are in render/pass.c, those of
 * pictures in linear light in render/picture.c. */
#include "core.h"

#include <inttypes.h>

#include "base/cancel.h"
#include "overlay/color_bar.h"
#include "raster/textbook/algorithms.h"
#include "render/flow.h"
#include "render/frame_parts.h"
#include "render/instance_masks.h"
#include "render/layer_channels.h"
#include "render/lens.h"
#include "render/lens_masks.h"
#include "render/mesh_lines.h"
#include "render/pass.h"
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
static enum zr_status draw_channels(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                    const struct zr_cancel *cancel, struct zr_frame *frame)
{
    const struct zr_pass_desc desc = {.scene = scene,
                                      .camera = &frame->camera,
                                      .window = zr_window_of(scene, frame->width, frame->height, 1),
                                      .wants = {.colors = frame->color, .normals = frame->channels[ZR_CHANNEL_NORMALS]},
                                      .base = frame->base};
    enum zr_status status = ZR_OK;
    struct zr_pass pass;
    if (frame->channels[ZR_CHANNEL_POSITION] && zr_view_space(frame->view, ZR_CHANNEL_POSITION) == ZR_SPACE_NOCS) {
        frame->nocs = zr_nocs_make(arena, scene, cancel);
        if (!frame->nocs) return zr_is_cancelled(cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    }
    if (frame->channels[ZR_CHANNEL_FLOW]) STAGE(zr_flow_target_draw(arena, team, scene, cancel, frame));
    STAGE(zr_pass_make(arena, team, &desc, cancel, &pass));
    STAGE(zr_tiles_draw(arena, team, &pass.tiles, cancel, frame));
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
static enum zr_status draw_picture_and_channels(struct zr_arena *arena, struct zr_team *team,
                                                const struct zr_scene *scene, const struct zr_cancel *cancel,
                                                struct zr_frame *frame)
{
    struct zr_frame picture = *frame;
    enum zr_status status = ZR_OK;
    frame->color = NULL;
    STAGE(zr_picture_draw(arena, team, scene, cancel, &picture));
    if (has_channels(frame)) {
        STAGE(draw_channels(arena, team, scene, cancel, frame));
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
static enum zr_status make_lines(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                 const struct zr_scene *scene, const struct zr_cancel *cancel, struct zr_frame *frame)
{
    struct zr_scene edited;
    const struct zr_scene *shown;
    if (!zr_picture_scene(scratch, scene, &edited, &shown)) return ZR_NO_MEMORY;
    return zr_mesh_lines_keep(arena, scratch, team, shown, cancel, frame);
}

/* Only masks and the lines of a file stay in `arena`. */
static enum zr_status draw_frame(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                 const struct zr_scene *scene, const struct zr_cancel *cancel, struct zr_frame *frame)
{
    const bool has_picture = frame->color && zr_picture_has_own_passes(&scene->picture);
    enum zr_status status = ZR_OK;
    STAGE(has_picture ? draw_picture_and_channels(scratch, team, scene, cancel, frame)
                      : draw_channels(scratch, team, scene, cancel, frame));
    if (zr_layer_channels_are_wanted(frame)) STAGE(zr_layer_channels_draw(scratch, team, scene, cancel, frame));
    if (zr_view_has_masks(frame->view)) STAGE(zr_instance_masks_find(arena, scratch, team, scene, cancel, frame));
    if (zr_view_encodes(frame->view, ZR_ENCODING_SVG)) STAGE(make_lines(arena, scratch, team, scene, cancel, frame));
    return status;
}

/* Lists the fragments of the pixel that an output asks for. Only they stay in `arena`. */
static enum zr_status list_fragments(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                     const struct zr_scene *scene, const struct zr_cancel *cancel,
                                     struct zr_frame *frame)
{
    const struct zr_output *pixel = zr_view_output(frame->view, ZR_CHANNEL_FRAGMENTS);
    return pixel ? zr_pixel_fragments_find(arena, scratch, team, scene, pixel->x, pixel->y, cancel, frame) : ZR_OK;
}

/* Makes a frame without channels. */
static enum zr_status draw_nothing(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                   const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                   const struct zr_cancel *cancel, struct zr_frame *frame, struct zr_error *error)
{
    const struct zr_scene *drawn;
    zr_frame_open(resolved, frame);
    frame->base = scene->base;
    return zr_render_sections(arena, scratch, team, scene, resolved, cancel, frame, &drawn, error);
}

static enum zr_status draw(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                           const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                           const struct zr_cancel *cancel, struct zr_frame *frame, struct zr_error *error)
{
    const struct zr_scene *drawn;
    enum zr_status status = ZR_OK;
    STAGE(zr_frame_make(arena, resolved, frame));
    STAGE(zr_base_place(arena, scene, frame->view, &frame->camera, &frame->base, error));
    STAGE(zr_render_sections(arena, scratch, team, scene, resolved, cancel, frame, &drawn, error));
    STAGE(draw_frame(arena, scratch, team, drawn, cancel, frame));
    if (status == ZR_OK) zr_color_bar_draw(drawn, frame);
    STAGE(list_fragments(arena, scratch, team, drawn, cancel, frame));
    STAGE(zr_render_sections_restore(arena, cancel, frame));
    if (zr_view_wants(frame->view, ZR_CHANNEL_TRACE))
        STAGE(zr_trace_make(arena, scratch, team, scene, cancel, frame, error));
    return status;
}

/* The same through a lens: the frame of the pinhole picture, in `scratch`, then that of the view. */
static enum zr_status draw_through_lens(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                        const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                        const struct zr_cancel *cancel, struct zr_frame *frame, struct zr_error *error)
{
    const struct zr_scene *drawn;
    struct zr_frame pinhole = {.width = 0};
    struct zr_lens_drawing drawing;
    struct zr_remap remap;
    enum zr_status status = ZR_OK;
    STAGE(zr_frame_make(arena, resolved, frame));
    STAGE(zr_remap_make(scratch, team, resolved->lens, cancel, &remap));
    STAGE(zr_render_sections(arena, scratch, team, scene, resolved, cancel, &pinhole, &drawn, error));
    if (status != ZR_OK) return status;
    zr_lens_drawing_open(drawn, resolved, &drawing);
    STAGE(zr_frame_make(scratch, &drawing.resolved, &pinhole));
    STAGE(draw_frame(scratch, scratch, team, &drawing.scene, cancel, &pinhole));
    STAGE(zr_lens_list_fragments(arena, scratch, team, &drawing, &remap, cancel, &pinhole));
    STAGE(zr_render_sections_restore(arena, cancel, &pinhole));
    STAGE(zr_lens_take(team, scene, &remap, &pinhole, cancel, frame));
    if (pinhole.masks) STAGE(zr_lens_masks_take(arena, scratch, team, &remap, pinhole.masks, cancel, frame));
    if (status == ZR_OK) zr_color_bar_draw(scene, frame);
    return status;
}

static enum zr_status run_pipeline(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                                   const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                   const struct zr_cancel *cancel, struct zr_frame *frame, struct zr_error *error)
{
    enum zr_status status = ZR_OK;
    if (!resolved) STAGE(zr_resolved_view_find(arena, team, scene, cancel, &resolved, error));
    STAGE(scene->is_undrawn ? draw_nothing(arena, scratch, team, scene, resolved, cancel, frame, error)
          : resolved->lens  ? draw_through_lens(arena, scratch, team, scene, resolved, cancel, frame, error)
                            : draw(arena, scratch, team, scene, resolved, cancel, frame, error));
    if (status == ZR_OK && zr_view_wants(frame->view, ZR_CHANNEL_INFO))
        STAGE(zr_frame_parts_find(arena, scratch, team, scene, cancel, frame));
    return status;
}

enum zr_status zr_render_apart(struct zr_arena *arena, struct zr_arena *scratch, struct zr_team *team,
                               const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                               const struct zr_cancel *cancel, const struct zr_frame **out, struct zr_error *error)
{
    struct zr_frame *frame = zr_arena_zero(arena, 1, sizeof *frame);
    arena->cancel = scratch->cancel = cancel;
    enum zr_status status =
        frame ? run_pipeline(arena, scratch, team, scene, resolved, cancel, frame, error) : ZR_NO_MEMORY;
    arena->cancel = scratch->cancel = NULL;
    if (status == ZR_NO_MEMORY && zr_is_cancelled(cancel)) status = ZR_CANCELLED;
    if (status == ZR_BAD_SCENE && error->count == 0)
        zr_error_add(error, status, NULL,
                     "the algorithm painter compares more than the %" PRIu64 " spans and samples that are allowed: too "
                     "many of its faces overlap or cut one another; other algorithms, and fewer faces, take less",
                     ZR_PAINTER_WORK_MAX);
    if (status == ZR_NO_MEMORY)
        zr_error_add(error, status, NULL, "rendering needs more than the %zu bytes a request may use%s", arena->ceiling,
                     zr_any_is_see_through(scene->materials, scene->material_count) ||
                             zr_any_is_xray(scene->materials, scene->material_count)
                         ? ": all layers of translucent surfaces are kept, 8 bytes per pixel and layer"
                         : "");
    if (status == ZR_CANCELLED) zr_error_add(error, status, NULL, "rendering was stopped before it was done");
    if (status == ZR_INTERNAL) zr_error_add(error, status, NULL, "the algorithm failed");
    *out = frame;
    return status;
}

enum zr_status zr_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                         const struct zr_resolved_view *resolved, const struct zr_cancel *cancel,
                         const struct zr_frame **frame, struct zr_error *error)
{
    return zr_render_apart(arena, arena, team, scene, resolved, cancel, frame, error);
}
