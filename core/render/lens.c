#include "render/lens.h"

#include <math.h>

#include "base/rgba.h"
#include "base/run.h"
#include "effects/edges.h"
#include "lines/strokes.h"
#include "render/pixel_fragments.h"
#include "scene/output.h"
#include "scene/parsed_picture.h"

/* ---- the pinhole picture ---- */

/* Lines get the width that the view's window gives them, in finer pixels. */
static void scale_lines(const struct zr_lens_plan *plan, struct zr_picture *picture)
{
    struct zr_edges *edges = &picture->edges;
    const uint32_t width = plan->view_width, height = plan->view_height;
    const float wide =
        edges->is_from_mesh ? zr_stroke_width(edges->width, width, height) : zr_edges_width_in(edges, width, height);
    const float scale = (float)plan->scale;
    picture->line_width = picture->line_width * scale;
    if (!edges->is_on) return;
    edges->width = wide * scale;
    edges->keeps_width = true;
}

void zr_lens_drawing_open(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                          struct zr_lens_drawing *drawing)
{
    const struct zr_lens_plan *plan = resolved->lens;
    struct zr_view *view = &drawing->scene.views[0];
    struct zr_picture *picture = &drawing->picture;
    drawing->scene = *scene;
    drawing->scene.picture = picture;
    *picture = *scene->picture;
    view->width = plan->width;
    view->height = plan->height;
    picture->side = zr_picture_side_in(picture->side, plan->width, plan->height);
    scale_lines(plan, picture);
    drawing->resolved = (struct zr_resolved_view){
        .view = view, .bounds = resolved->bounds, .camera = zr_lens_pinhole(plan, &resolved->camera)};
}

enum zr_status zr_lens_list_fragments(const struct zr_run *run, const struct zr_lens_drawing *drawing,
                                      const struct zr_remap *remap, struct zr_frame *pinhole)
{
    const struct zr_output *output = zr_view_output(pinhole->view, ZR_CHANNEL_FRAGMENTS);
    struct zr_remap_pixel pixel;
    enum zr_status status = ZR_OK;
    if (!output) return ZR_OK;
    if (zr_remap_nearest_pixel(remap, output->x, output->y, &pixel))
        status = zr_pixel_fragments_find(run, &drawing->scene, pixel.x, pixel.y, pinhole);
    pinhole->fragments.x = output->x;
    pinhole->fragments.y = output->y;
    return status;
}

/* ---- the frame of the view ---- */

/* Returns the first channel of the frame that shows whether a pixel has a primitive; ZR_CHANNEL_COUNT: none does. */
static int covered_channel(const struct zr_frame *frame)
{
    static const enum zr_channel shows[] = {ZR_CHANNEL_FACE_ID, ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH,
                                            ZR_CHANNEL_DISTANCE, ZR_CHANNEL_INSTANCE_ID};
    for (size_t i = 0; i < sizeof shows / sizeof *shows; i++)
        if (frame->channels[shows[i]]) return (int)shows[i];
    return ZR_CHANNEL_COUNT;
}

/* Counts covered pixels and finds the greatest depth. Without a channel that shows covered pixels, the counts are those
 * of the pinhole picture. */
static enum zr_status measure(const struct zr_frame *pinhole, const struct zr_cancel *cancel, struct zr_frame *frame)
{
    const int channel = covered_channel(frame);
    frame->covered_pixels = channel == ZR_CHANNEL_COUNT ? pinhole->covered_pixels : 0;
    frame->covered_samples = channel == ZR_CHANNEL_COUNT ? pinhole->covered_samples : 0;
    frame->deepest = 0.0f;
    for (size_t y = 0; channel != ZR_CHANNEL_COUNT && y < frame->height; y++) {
        const size_t first = y * frame->width;
        const uint32_t *words = (const uint32_t *)frame->channels[channel] + first;
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        for (uint32_t x = 0; x < frame->width; x++)
            frame->covered_pixels += words[x] != zr_channel_rows[channel].clear_value;
        for (uint32_t x = 0; frame->depth && x < frame->width; x++)
            if (frame->depth[first + x] > frame->deepest && frame->depth[first + x] < INFINITY)
                frame->deepest = frame->depth[first + x];
    }
    return ZR_OK;
}

enum zr_status zr_lens_take(const struct zr_run *run, const struct zr_scene *scene, const struct zr_remap *remap,
                            const struct zr_frame *pinhole, struct zr_frame *frame)
{
    enum zr_status status = ZR_OK;
    for (int c = 0; status == ZR_OK && c < ZR_CHANNEL_COUNT; c++) {
        const struct zr_channel_row *row = &zr_channel_rows[c];
        if (!frame->channels[c]) continue;
        status =
            c == ZR_CHANNEL_COLOR
                ? zr_remap_color(run, remap, zr_rgba_make(scene->background), pinhole->channels[c], frame->channels[c])
                : zr_remap_nearest(run, remap, row->words, row->clear_value, pinhole->channels[c], frame->channels[c]);
    }
    frame->spans = NULL;
    frame->counts = pinhole->counts;
    frame->sections = pinhole->sections;
    frame->fragments = pinhole->fragments;
    frame->picks = pinhole->picks;
    frame->pixels_without_ray = remap->nowhere;
    return status == ZR_OK ? measure(pinhole, run->cancel, frame) : status;
}
