/* picks_json.h - output: the keys picks and between of info (render/picks.h). */
#ifndef ZR_PICKS_JSON_H
#define ZR_PICKS_JSON_H

#include "output/json/json_print.h"
#include "shade/frame.h"

/* Prints both keys, or nothing without picks. Places are those of the world plus frame->origin. */
void zr_picks_print(struct zr_print *print, const struct zr_frame *frame);

/* Prints the key distances of info (measure/part_distance.h), or nothing without pairs. */
void zr_distances_print(struct zr_print *print, const struct zr_frame *frame);

#endif
