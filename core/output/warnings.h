/* warnings.h - output: what was drawn, but perhaps not as it was meant. */
#ifndef ZR_WARNINGS_H
#define ZR_WARNINGS_H

#include "base/arena.h"
#include "base/warning_list.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "zraster.h"

/* Of the scene as it was read, of where its polygons went, and of `misfits` pixels
 * whose depth did not fit the PNG. Texts lie in the arena. */
struct zr_warning_list zr_warnings_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_frame *frame, uint64_t misfits);

/* One line of less than ZR_WARNINGS_SIZE bytes (zraster.h): whole warnings, "; " between, and how many more there are
 * where not all have room. "" where the arena has failed. */
const char *zr_warnings_join(struct zr_arena *arena, const struct zr_warning_list *warnings);

#endif
