/* warnings.h - output: collects the warnings about a drawn scene. */
#ifndef ZR_WARNINGS_H
#define ZR_WARNINGS_H

#include "base/arena.h"
#include "base/warning_list.h"
#include "core.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Returns the warnings of reading, of dropped or invisible primitives, and of `misfits` pixels whose depth does not fit
 * 16 bits. Texts lie in the arena. */
struct zr_warning_list zr_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_frame *frame, uint64_t misfits);

/* Returns one line of less than ZR_WARNINGS_SIZE bytes (core.h): whole warnings, separated by "; ", and the number
 * of those left out for lack of room. "" if the arena has failed. */
const char *zr_warnings_join(struct zr_arena *arena, const struct zr_warning_list *warnings);

#endif
