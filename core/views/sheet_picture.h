/* sheet_picture.h - views: one picture of all views, and its key in info. */
#ifndef ZR_SHEET_PICTURE_H
#define ZR_SHEET_PICTURE_H

#include "base/run.h"
#include "shade/frame.h"
#include "views/views.h"

struct zr_sheet_picture {
    const struct zr_views *views;
    struct zr_canvas canvas;
    struct zr_camera *cameras; /* by view */
    float *ymags;              /* by view: half of its height, scene units; 0: it has no scale */
    float *shares;             /* by view: covered share of its samples, or of its pixels; below 0: not drawn */
};

/* Makes an empty sheet in the arena. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_sheet_picture_make(struct zr_arena *arena, const struct zr_views *views,
                                     struct zr_sheet_picture *sheet);

/* Adds view `number`, with its caption. The frame may have no colours: then only its camera is noted. */
void zr_sheet_picture_add(struct zr_sheet_picture *sheet, uint32_t number, const struct zr_frame *frame);

/* Encodes the picture as the output `number` of the scene. */
enum zr_status zr_sheet_picture_encode(const struct zr_run *run, const struct zr_sheet_picture *sheet, uint32_t number,
                                       struct zr_files *files);

/* Appends the key "sheet" to the text of an info. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_sheet_info_add(const struct zr_sheet_picture *sheet, struct zr_buffer *info);

#endif
