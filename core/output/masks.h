/* masks.h - output: the masks of instances as files: a ZIP of PNGs, and a list with run lengths. */
#ifndef ZR_MASKS_H
#define ZR_MASKS_H

#include "output/json/json_print.h"
#include "shade/frame.h"

/* Append to `out`. Fail with ZR_NO_MEMORY, ZR_CANCELLED, or ZR_BAD_SCENE for a ZIP of 4 GiB or more. */
enum zr_status zr_masks_zip_write(const struct zr_frame *frame, const struct zr_cancel *cancel, struct zr_error *error,
                                  struct zr_buffer *out);
enum zr_status zr_masks_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                   const struct zr_cancel *cancel, struct zr_buffer *out);

/* Prints the key "visibility". */
enum zr_status zr_masks_print(struct zr_print *print, const struct zr_scene *scene, const struct zr_frame *frame,
                              const struct zr_cancel *cancel);

#endif
