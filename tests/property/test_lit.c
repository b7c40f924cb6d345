/* Colours and points of surfaces are made if they are wanted, and left whole if their making was cancelled. */
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "geometry/build.h"
#include "scene/camera/resolved_view.h"
#include "shade/draw_attributes.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

enum { WIDTH = 400, HEIGHT = 260 };

static struct zr_arena arena;

static const struct zr_window window = {WIDTH, HEIGHT, 1, 1.0f};

/* What lit triangles that show their backs show, flat and drawn from both sides, as many as are a draw by themselves,
 * and one that the window cuts. */
static struct zr_scene_attributes surfaces_of(bool colored, bool singly, struct zr_geometry *geometry)
{
    enum { WHOLE = 20 };
    static const zr_vec4 whole[3] = {{0, 0, 0, 1}, {0, 0.5f, 0, 1}, {0.5f, 0, 0, 1}},
                         cut[3] = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0, 2, 0, 1}};
    static zr_vec4 p[WHOLE + 1][3];
    static struct test_scene test;
    struct zr_scene_attributes surfaces;
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    for (int i = 0; i <= WHOLE; i++)
        memcpy(p[i], i < WHOLE ? whole : cut, sizeof p[i]);
    scene_of_triangles(&test, WIDTH, HEIGHT, p[0], WHOLE + 1);
    test.material.shading = ZR_SHADING_FLAT;
    test.material.double_sided = true;
    if (!colored) {
        test.scene.views[0].outputs++;
        test.scene.views[0].output_count--;
    }
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test.scene, &test.scene.views[0], NULL, &camera), ZR_OK);
    const struct zr_attribute_wants wants = {.colors = colored};
    assert_int_equal(
        zr_geometry_build(&(struct zr_run){.arena = &arena}, &test.scene, &camera, &window, singly, geometry), ZR_OK);
    assert_int_equal(
        zr_scene_attributes_make(&(struct zr_run){.arena = &arena}, &test.scene, &camera, geometry, &wants, &surfaces),
        ZR_OK);
    return surfaces;
}

TEST(nothing_is_lit_where_no_picture_is_wanted)
{
    zr_arena_init(&arena, 1 << 24);
    for (int singly = 0; singly <= 1; singly++) {
        struct zr_geometry geometry;
        const struct zr_scene_attributes none = surfaces_of(false, singly, &geometry);
        assert_int_equal(geometry.draw_count, 2 - singly);
        for (uint32_t i = 0; i < geometry.draw_count; i++) {
            assert_false(none.of_draw[i].packed);
            for (int k = 0; k < ZR_ATTRIBUTE_COUNT; k++)
                assert_false(none.of_draw[i].attributes[k].values);
        }
    }
    zr_arena_free(&arena);
}

/* Raised before points are made: a surface that wants them has some nevertheless. */
TEST(points_are_there_though_their_making_was_cancelled)
{
    static const zr_vec4 p[3] = {{0, 0, 0, 1}, {0, 0.5f, 0, 1}, {0.5f, 0, 0, 1}};
    static struct test_scene test;
    const struct zr_cancel cancel = {.raised = true};
    struct zr_scene_attributes surfaces;
    struct zr_geometry geometry;
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    zr_arena_init(&arena, 1 << 24);
    scene_of_triangles(&test, WIDTH, HEIGHT, p, 1);
    test.material.shading = ZR_SHADING_PHONG;
    const struct zr_attribute_wants wants = {.colors = true};
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test.scene, &test.scene.views[0], NULL, &camera), ZR_OK);
    assert_int_equal(
        zr_geometry_build(&(struct zr_run){.arena = &arena}, &test.scene, &camera, &window, false, &geometry), ZR_OK);
    assert_int_equal(zr_scene_attributes_make(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &test.scene,
                                              &camera, &geometry, &wants, &surfaces),
                     ZR_CANCELLED);
    assert_non_null(surfaces.of_draw[0].attributes[ZR_ATTRIBUTE_POINT].values);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
