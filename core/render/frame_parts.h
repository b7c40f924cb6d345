/* frame_parts.h - render: the parts of a scene with their facts and visible pixels, for the channel info. */
#ifndef ZR_FRAME_PARTS_H
#define ZR_FRAME_PARTS_H

#include "base/run.h"
#include "base/team.h"
#include "shade/frame.h"

/* Maximum number of listed parts. Later parts are omitted. */
enum { ZR_FRAME_PARTS_MAX = 1000 };

/* Parts that are measured once for several views. */
struct zr_known_parts {
    struct zr_part_list list;
    const struct zr_part_facts *facts;       /* per listed part */
    const struct zr_part_features *features; /* likewise; NULL: not asked for, and neither picks nor notes need them */
};

/* Lists and measures the parts, and finds their features if the scene asks for them, in `arena`. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_known_parts_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_known_parts *out);

/* Finds the features of the parts, in `arena`, before the frame is annotated, and sets frame->known_parts. Fails with
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_frame_features_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

/* Fills in frame->parts; the list lies in `arena`, or is that of frame->known_parts or scene->known_parts. Counts pixels in frame->face_id, if there
 * is one. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_frame_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

/* Finds the parts and features of frame->picks, after zr_frame_parts_find. Fails with ZR_NO_MEMORY. */
enum zr_status zr_pick_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

/* Names the parts of frame->fragments, after zr_frame_parts_find if that runs. Names lie in `arena` or belong to the
 * scene. Fails with ZR_NO_MEMORY. */
enum zr_status zr_fragment_parts_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_frame *frame);

#endif
