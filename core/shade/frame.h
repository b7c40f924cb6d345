/* frame.h - shade: the result of a rendering, channel by channel.
 *
 * Row 0 is on top. All channels come from the same samples and therefore agree.
 */
#ifndef ZR_FRAME_H
#define ZR_FRAME_H

#include <stdint.h>

#include "base/column_span.h"
#include "core.h"
#include "geometry/counts.h"
#include "mesh/facts/part_facts.h"
#include "mesh/features/feature_at.h"
#include "scene/camera/camera.h"
#include "scene/scene.h"

/* A fragment at a pixel's centre. */
struct zr_pixel_fragment {
    float depth;       /* as in the channel depth, scene units */
    float position[3]; /* world space */
    uint32_t face_id;  /* as in the channel */
    uint32_t instance; /* number, from 0 */
    enum zr_alpha_mode alpha_mode;
    int front_facing; /* as in the channel */
    const char *part; /* its name; NULL: none of the listed parts has it */
    bool is_shown;    /* contributes to the pixel's colour: neither masked nor hidden by an opaque surface */
    bool is_culled;   /* the back of a face that is drawn from its front only */
    uint8_t solid;    /* 1 + number of the part of a combined solid (scene/csg.h) that the face belongs to, or 0 */
    double normal[3]; /* of the triangle, unit length, to either side; world space. 0: line or point, or no area */
    double corner[3]; /* of the triangle, in world space */
};

/* The fragments of a pixel, nearest first; at equal depth in scene order. */
struct zr_pixel_fragments {
    uint32_t x, y; /* the pixel */
    uint32_t count;
    struct zr_pixel_fragment *at;
};

/* A surface at a picked pixel. */
struct zr_picked {
    double point[3];   /* world space */
    double normal[3];  /* of the face, towards the eye if picked, else to its front; 0: line or point */
    float depth;       /* as in the channel depth */
    uint32_t face_id;  /* as in the channel */
    uint32_t instance; /* number, from 0 */
    uint32_t part;     /* number in the list of parts; UINT32_MAX: none of the listed parts has it */
    bool is_cap;       /* of a section */
    bool has_feature;
    struct zr_feature_at feature; /* then: in frame.parts.features[part] */
};

/* A picked pixel. */
struct zr_pick {
    uint32_t x, y;
    bool is_hit; /* false: background */
    struct zr_picked at;
    uint32_t behind_count, behind_omitted;
    struct zr_picked *behind; /* surfaces behind it, nearest first */
};

struct zr_picks {
    uint32_t count;
    struct zr_pick *at;
};

struct zr_part_features; /* mesh/features/part_features.h */

/* The parts of the scene, for the channel info. */
struct zr_frame_parts {
    struct zr_part_list list;
    const struct zr_part_facts *facts;       /* per listed part */
    const struct zr_part_features *features; /* likewise; NULL: not asked for */
    const uint64_t *pixels;  /* per listed part: pixel centres at which it is visible; NULL: nothing is drawn */
    const double *cap_areas; /* per listed part: area of its caps, world units; NULL: the scene is not cut open */
};

/* Number of pixels and their box, x0, y0, x1, y1; the last two are exclusive. The box of no pixels is undefined. */
struct zr_mask_extent {
    uint64_t pixels;
    uint32_t box[4];
};

/* Pixels of an instance that has some in the window. Bit k of word i of a row is column left + 64 i + k. Rows are those
 * of amodal.box. */
struct zr_instance_mask {
    uint32_t instance; /* number, from 0 */
    uint32_t left;     /* a multiple of 64 */
    uint32_t words;    /* of a row */
    struct zr_mask_extent amodal, visible;
    uint64_t *amodal_bits, *visible_bits; /* drawn alone; not hidden by others */
};

/* In the order of instances. */
struct zr_instance_masks {
    uint32_t count;
    const struct zr_instance_mask *at;
};

struct zr_annotations; /* overlay/annotate/annotate.h */
struct zr_trace;      /* raster/textbook/trace.h */
struct zr_line_sheet; /* lines/line_sheet.h */
struct zr_nocs_list;  /* shade/nocs.h */
struct zr_geometry;
struct zr_frame;

/* The picture that the channel flow leads to. */
struct zr_flow_target {
    const struct zr_geometry *geometry; /* with the instances of the frame's scene */
    const struct zr_frame *frame;       /* has `owners` */
};

struct zr_frame {
    const struct zr_view *view; /* view of the rendered scene; NULL: this is a depth map */
    uint32_t width, height;
    union {
        void *channels[ZR_CHANNELS_MAX]; /* by enum zr_channel (scene/channels.h); NULL: not wanted */
        struct {                         /* names of the first ones */
            uint8_t *color;
            float *depth;
            float *window_depth;
            uint32_t *face_id;
        };
    };
    struct zr_pixel_fragments fragments;    /* only if wanted */
    struct zr_frame_parts parts;            /* only if info is wanted */
    const struct zr_known_parts *known_parts; /* render/frame_parts.h; found for notes of holes; NULL: none */
    struct zr_picks ends;                   /* picked ends of dimensions, in order; while the overlay is drawn */
    const struct zr_part_distance *distances; /* measure/part_distance.h; one per pair of the scene; NULL: none */
    uint32_t distance_count;
    struct zr_picks picks;                  /* only if info of a view with picks is wanted */
    const struct zr_combined *combined;     /* measure/combined.h; only if info of a scene with csg is wanted */
    const struct zr_instance_masks *masks;  /* only if wanted */
    const struct zr_annotations *annotations; /* only if the view asks for some */
    const struct zr_trace *trace;           /* only if wanted */
    const struct zr_line_sheet *lines;      /* only if an SVG is wanted */
    const struct zr_sections_cut *sections; /* sections/sections.h; NULL: the scene is not cut open */
    uint32_t *owners;                       /* per pixel: 1 + number of the visible primitive; NULL: not wanted */
    const struct zr_flow_target *flow;      /* render/flow.h; only while the channel flow is drawn */
    const struct zr_nocs_list *nocs;        /* of the drawn scene; only while positions are drawn in that space */
    const double *origin;                   /* three numbers added to places in world space by outputs; NULL: none */
    const struct zr_base *base;             /* background pixels, with window_depth filled in; NULL: none */
    struct zr_camera camera, flow_camera;   /* flow_camera: see struct zr_resolved_view */
    struct zr_bounds bounds;                /* bounds of the scene; invalid unless the view or the info needs them */
    struct zr_counts counts;
    uint64_t covered_pixels;  /* pixels that a primitive covers, not the base; 0 if only `color` is drawn, in passes of
                               * its own */
    uint64_t covered_samples; /* covered samples of `color`, if it has passes of its own; else 0 */
    uint32_t samples_a_pixel; /* of `color`, likewise; else 0 */
    struct zr_column_span *spans; /* per row: columns outside hold the clear value in all channels; NULL: unknown */
    uint64_t pixels_without_ray;  /* of a lens: they have the clear value in all channels */
    float deepest;                /* greatest finite value of `depth`; 0: none */
};

struct zr_resolved_view;

/* Copies the view's data. The frame has no channels, and no spans. */
void zr_frame_open(const struct zr_resolved_view *resolved, struct zr_frame *frame);

/* Copies the view's data, and allocates the channels that the outputs need. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_frame_make(struct zr_arena *arena, const struct zr_resolved_view *resolved, struct zr_frame *frame);

/* Fills in `spans` from the tiles with covered pixels; tile 0 is at the window's lower left. */
void zr_frame_find_spans(const struct zr_frame *frame, const uint8_t *occupied);

#endif
