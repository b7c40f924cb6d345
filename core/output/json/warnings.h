/* warnings.h - output: collects the warnings about a drawn scene. */
#ifndef ZR_WARNINGS_H
#define ZR_WARNINGS_H

#include "base/arena.h"
#include "base/warning_list.h"
#include "core.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Warnings of reading, and of dropped or invisible primitives. Those of encoding belong between both lists. */
struct zr_drawing_warnings {
    struct zr_warning_list first, last;
};

/* Makes the warnings of a frame. Texts lie in the arena. */
struct zr_drawing_warnings zr_drawing_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                                    const struct zr_frame *frame);

/* Joins both lists, with the warning of `clamped` pixels whose depth does not fit 16 bits between them. Texts are
 * copied to the arena. */
struct zr_warning_list zr_warnings_list(struct zr_arena *arena, const struct zr_drawing_warnings *drawing,
                                        uint64_t clamped);

/* Returns one line of less than ZR_WARNINGS_SIZE bytes (core.h): whole warnings, separated by "; ", and the number
 * of those left out for lack of room. "" if the arena has failed. */
const char *zr_warnings_join(struct zr_arena *arena, const struct zr_warning_list *warnings);

#endif
