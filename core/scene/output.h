/* output.h - scene: outputs of a view: channels, each with its encoding. */
#ifndef ZR_OUTPUT_H
#define ZR_OUTPUT_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/channels.h"
#include "scene/view.h"

struct zr_output {
    enum zr_channel channel;
    enum zr_encoding encoding;
    float scale;         /* png16: scene units per step; 0: the far plane is 65535 */
    enum zr_space space; /* of channels with a choice; the same for all outputs of one channel */
    uint32_t x, y;       /* fragments: the pixel, from the top left corner */
    bool has_range;      /* depth: nearer depths are 0, farther ones the greatest value of the encoding */
    float range[2];      /* nearest and farthest depth, scene units */
    uint32_t quality;    /* jpeg and webp: 1..100; 0: ZR_QUALITY_DEFAULT */
    uint32_t max_bytes;  /* most bytes of the file; 0: any */
    bool is_lossless;    /* webp */
    float dpi;           /* pixels per inch that the file names; 0: none */
};

#define ZR_QUALITY_DEFAULT 85

/* Returns the view's first output of the channel; NULL: none. */
static inline const struct zr_output *zr_view_output(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel) return &view->outputs[i];
    return NULL;
}

static inline bool zr_view_wants(const struct zr_view *view, enum zr_channel channel)
{
    return zr_view_output(view, channel) != NULL;
}

/* True if an output has the encoding. */
static inline bool zr_view_encodes(const struct zr_view *view, enum zr_encoding encoding)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].encoding == encoding) return true;
    return false;
}

/* True if an output has pixels of the channel. */
static inline bool zr_view_has_pixels(const struct zr_view *view, enum zr_channel channel)
{
    for (uint32_t i = 0; i < view->output_count; i++)
        if (view->outputs[i].channel == channel && view->outputs[i].encoding != ZR_ENCODING_SVG) return true;
    return false;
}

/* True if marks are drawn over the color: in windows that are large enough. */
static inline bool zr_view_annotates(const struct zr_view *view)
{
    return zr_annotate_fits(&view->annotate, view->width, view->height) && zr_view_wants(view, ZR_CHANNEL_COLOR);
}

/* True if the marks need holes. */
static inline bool zr_view_notes_holes(const struct zr_view *view)
{
    return zr_view_annotates(view) && zr_annotate_needs_features(&view->annotate) &&
           view->lens.model == ZR_LENS_NONE;
}

/* True if info describes picked pixels. */
static inline bool zr_view_picks(const struct zr_view *view)
{
    return view->picks.count > 0 && zr_view_wants(view, ZR_CHANNEL_INFO);
}

/* True if masks of instances are made. */
static inline bool zr_view_has_masks(const struct zr_view *view)
{
    return view->has_visibility || zr_view_wants(view, ZR_CHANNEL_MASKS);
}

/* True if an output has pixels of the channel, or if `info`, picks, notes of holes, `fragments` or the covered pixels
 * of a `trace` are computed from them. */
static inline bool zr_view_needs(const struct zr_view *view, enum zr_channel channel)
{
    const bool lists = zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) || zr_view_picks(view) ||
                       (zr_view_annotates(view) && view->annotate.dimension_count > 0);
    return zr_view_has_pixels(view, channel) || (lists && channel == ZR_CHANNEL_WINDOW_DEPTH) ||
           (channel == ZR_CHANNEL_DEPTH && (zr_view_notes_holes(view) || zr_view_wants(view, ZR_CHANNEL_WALL))) ||
           (channel == ZR_CHANNEL_INSTANCE_ID && zr_view_has_masks(view)) ||
           (channel == ZR_CHANNEL_FACE_ID &&
            (lists || zr_view_annotates(view) || zr_view_wants(view, ZR_CHANNEL_INFO) ||
             zr_view_wants(view, ZR_CHANNEL_TRACE)));
}

/* Returns the space of the view's outputs of a channel. `view` may be NULL. */
static inline enum zr_space zr_view_space(const struct zr_view *view, enum zr_channel channel)
{
    const struct zr_output *output = view ? zr_view_output(view, channel) : NULL;
    return output ? output->space : ZR_SPACE_CAMERA;
}

#endif
