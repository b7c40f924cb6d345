/* change.h - input: makes the request of a changed scene. */
#ifndef ZR_INPUT_CHANGE_H
#define ZR_INPUT_CHANGE_H

#include "input/scene/kept.h"

/* Fills *request and *keeping, which point to the arena, to `kept` and to `change`. Fails with ZR_BAD_SYNTAX,
 * ZR_BAD_SCENE, ZR_CANCELLED, or ZR_NO_MEMORY without a fault. */
enum zr_status zr_change_read(struct zr_arena *arena, const struct zr_kept *kept, const struct zr_request *change,
                              struct zr_request *request, struct zr_keeping *keeping, struct zr_error *error);

#endif
