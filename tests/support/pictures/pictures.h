/* pictures.h - support: draws scenes in JSON by several teams, which must give the same bytes. */
#ifndef ZR_TEST_PICTURES_H
#define ZR_TEST_PICTURES_H

#include "core.h"
#include "scene/scene.h"
#include "shade/frame.h"

struct drawn_picture {
    const struct zr_scene *scene;
    const struct zr_frame *frame;
};

/* Reads the scene and draws it; both live in the arena. Fails the running test on an error, if the predicted cost is
 * not finite, or if the predicted memory exceeds the used memory. */
struct drawn_picture picture_draw(struct zr_arena *arena, struct zr_team *team, const char *text);

/* Draws it in plain C on one thread, and by each team; returns the first. If bytes differ, fails the running test and
 * leaves the scene in build/test-pictures. */
struct drawn_picture picture_assert_same(struct zr_arena *arena, struct zr_team *const *teams, int count,
                                         const char *text);

#endif
