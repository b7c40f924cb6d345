/* subject.h - reference: the renderer under test, the real core, drawing a
 * drawing. The scene is built in memory, past input/, so that every float gets
 * there untouched. */
#ifndef ZR_TEST_SUBJECT_H
#define ZR_TEST_SUBJECT_H

#include "reference/drawing.h"
#include "zraster.h"

/* The frame has color, window_depth and face_id, and stands until the arena's
 * next reset. NULL on failure, explained on stderr. */
const struct zr_frame *subject_render(struct zr_arena *arena, struct zr_team *team, const struct drawing *drawing);

#endif
