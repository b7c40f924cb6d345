/* frame.h - shade: what a rendering is, channel by channel.
 *
 * Row 0 is the top of the picture. Every channel is derived from the same
 * samples, so that they always agree.
 */
#ifndef ZR_FRAME_H
#define ZR_FRAME_H

#include <stdint.h>

#include "base/column_span.h"
#include "geometry/counts.h"
#include "scene/camera.h"
#include "scene/channels.h"
#include "scene/scene.h"
#include "zraster.h"

/* What lies over a pixel's centre. */
struct zr_pixel_fragment {
    float depth;       /* as in the channel depth, scene units */
    float position[3]; /* world space */
    uint32_t face_id;  /* as in the channel */
    uint32_t instance; /* number of it, counted from 0 */
    enum zr_alpha_mode alpha_mode;
    int front_facing; /* as in the channel */
    bool is_shown;    /* not hidden by what is opaque, nor masked: it is a part of the pixel's colour */
};

/* Nearest first; at equal depth the earlier in the scene. */
struct zr_pixel_fragments {
    uint32_t x, y; /* the pixel */
    uint32_t count;
    const struct zr_pixel_fragment *at;
};

struct zr_frame {
    const struct zr_view *view; /* that it shows, of the scene that was rendered; NULL: it is a depth map */
    uint32_t width, height;
    union {
        void *channels[ZR_CHANNEL_COUNT]; /* scene/channels.h; NULL: not wanted */
        struct {                          /* the first of them */
            uint8_t *color;
            float *depth;
            float *window_depth;
            uint32_t *face_id;
        };
    };
    struct zr_pixel_fragments fragments; /* of a pixel, where they are wanted */
    const struct zr_base *base;          /* what is seen where no primitive is, its window_depth made; NULL: nothing */
    struct zr_camera camera;
    struct zr_bounds bounds; /* of the scene; looked for where the view needs them or info is asked for, else invalid */
    struct zr_counts counts;
    uint64_t covered_pixels;  /* whose centres belong to a primitive, not to the base; 0 where `color` alone is
                                 drawn, and has passes of its own */
    uint64_t covered_samples; /* of `color`, where that has passes of its own, with so many a pixel; else 0 of 0 */
    uint32_t samples_a_pixel;
    struct zr_column_span *reaches; /* of each row: outside of it nothing is, in no channel. NULL: not known */
    float deepest;                  /* of `depth`, infinity left out; 0 where nothing is */
};

struct zr_resolved_view;

/* Room for the channels that the outputs are made of, and what is known of the view. ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_frame_make(struct zr_arena *arena, const struct zr_resolved_view *resolved, struct zr_frame *frame);

/* The space of a channel that the view asks for. */
static inline enum zr_space zr_frame_space(const struct zr_frame *frame, enum zr_channel channel)
{
    return frame->view ? zr_view_space(frame->view, channel) : ZR_SPACE_CAMERA;
}

/* Fills in `reaches`, from which tiles show anything: tile 0 is at the window's lower left. */
void zr_frame_find_reaches(const struct zr_frame *frame, const uint8_t *occupied);

#endif
