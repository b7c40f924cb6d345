/* scenes.h - support: small scenes made in memory, for tests of one stage. */
#ifndef ZR_TEST_SCENES_H
#define ZR_TEST_SCENES_H

#include "core.h"
#include "cost/cost.h"
#include "scene/output.h"
#include "scene/picture.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "support/pictures/look.h"

/* One mesh of triangles in clip space (all matrices are the identity), unlit and double-sided. Contains pointers to
 * itself: do not copy. Tests change members after scene_of_triangles. */
struct test_scene {
    struct zr_scene scene;
    struct zr_picture picture;
    struct zr_mesh mesh;
    struct zr_instance instance;
    struct zr_material material;
    struct zr_output outputs[4]; /* color, depth, windowDepth, faceId */
    uint32_t face_offsets[4097], indices[4096 * 3];
};

enum { TEST_TRIANGLES_MAX = 4096 };

/* Makes the scene from 3 positions per triangle; `positions` must outlive it. */
void scene_of_triangles(struct test_scene *test, uint32_t width, uint32_t height, const zr_vec4 *positions,
                        uint32_t triangles);

/* Makes a scene of one polygon, of up to 3 * TEST_TRIANGLES_MAX corners. */
void scene_of_polygon(struct test_scene *test, uint32_t width, uint32_t height, const zr_vec4 *positions,
                      uint32_t corners);

/* Renders the scene; fails the running test on an error. */
const struct zr_frame *scene_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene);

/* The same, and encodes all outputs of the scene. */
struct zr_answer scene_encode(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene);

/* Returns zr_scene_cost; fails the running test if the view cannot be resolved. */
struct zr_cost scene_cost(const struct zr_scene *scene);

#endif
