/* pictures.h - support: scenes in JSON, drawn by several teams, which must give the same bytes.
 */
#ifndef ZR_TEST_PICTURES_H
#define ZR_TEST_PICTURES_H

#include "scene/scene.h"
#include "shade/frame.h"
#include "zraster.h"

struct drawn_picture {
    const struct zr_scene *scene;
    const struct zr_frame *frame;
};

/* Reads the scene and draws it; both live in the arena. The running test fails where that does not work, where the cost
 * that is predicted is no number, or where memory is predicted that it did not take. */
struct drawn_picture picture_draw(struct zr_arena *arena, struct zr_team *team, const char *text);

/* Draws it in plain C on one thread, which is what it returns, and by each team. Where one has other bytes the running
 * test fails, and the scene is left in build/test-pictures. */
struct drawn_picture picture_assert_same(struct zr_arena *arena, struct zr_team *const *teams, int count,
                                         const char *text);

#endif
