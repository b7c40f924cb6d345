/* compare_scene.h - request: a scene that shows where two models differ, drawn as any other one.
 *
 * difference: what both share is grey, what only the first one has amber, what only the second one has red.
 *             Regions of change have their numbers (up to 24).
 * deviation:  the second one, coloured by its signed distance from the first one, with a colour bar.
 * side:       the first one, and the second one beside it along x, in the colours of `difference`.
 */
#ifndef ZR_COMPARE_SCENE_H
#define ZR_COMPARE_SCENE_H

#include "core.h"
#include "measure/comparison.h"

struct zr_kept; /* input/scene/kept.h */

enum { ZR_COMPARE_WORD_SIZE = 64 };

/* Kind and appearance of the picture. "": the default. */
struct zr_compare_picture {
    int show;                                                    /* enum zr_compare_show */
    char look[ZR_COMPARE_WORD_SIZE], view[ZR_COMPARE_WORD_SIZE]; /* a look; a preset of the view */
};

enum zr_compare_show { ZR_SHOW_NONE, ZR_SHOW_DIFFERENCE, ZR_SHOW_DEVIATION, ZR_SHOW_SIDE, ZR_SHOW_COUNT };

/* Their names, by enum zr_compare_show. */
extern const char *const zr_compare_show_words[ZR_SHOW_COUNT];

/* Makes the scene in run->arena. run->scratch, another arena, holds the rest. The comparison has trees.
 * `z_is_up`: in the first file. Fails with
 * ZR_BAD_SCENE if the models cannot be searched, ZR_NO_MEMORY or ZR_CANCELLED; *run->error explains it. */
enum zr_status zr_compare_scene_make(const struct zr_run *run, const struct zr_comparison *comparison,
                                     const struct zr_compare_picture *picture, bool z_is_up, struct zr_kept **scene);

#endif
