/* subject.h - reference: the renderer under test, the real core. */
#ifndef ZR_TEST_SUBJECT_H
#define ZR_TEST_SUBJECT_H

#include "core.h"
#include "reference/drawing.h"
#include "scene/output.h"
#include "scene/picture.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* A drawing as a scene, built in memory, so that every float gets there untouched.
 * Points into itself and into the drawing: do not copy. */
struct subject {
    struct zr_scene scene;
    struct zr_picture picture;
    struct zr_material materials[ZR_ALPHA_NAMES]; /* by alphaMode */
    struct zr_mesh mesh;
    struct zr_instance instance;
};

void subject_make(struct subject *subject, const struct drawing *drawing);

/* Renders color, window_depth and face_id, whatever the scene asks for. The frame stands until
 * the arena's next reset. NULL on failure, explained on stderr. */
const struct zr_frame *subject_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene);

/* One channel, in a space that it has, of a rendering that makes nothing else; stands and fails likewise. */
const void *subject_channel(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                            enum zr_channel channel, enum zr_space space);

#endif
