/* What concerns a scene as a whole. */
#include <string.h>

#include "scene/validate.h"
#include "support/scenes.h"
#include "support/tests.h"

static const zr_vec4 corners[3] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
static struct test_scene test;
static struct zr_error error;

static enum zr_status validate(void)
{
    struct zr_limits limits = zr_limits_default();
    memset(&error, 0, sizeof error);
    return zr_scene_validate(&test.scene, &limits, &error);
}

/* Only counts are looked at: no face of so many corners has to be there. */
TEST(corners_of_all_instances_are_up_to_two_to_the_31)
{
    enum { PLACED = 2048 };
    static const uint32_t offsets[2] = {0, 1 << 20};
    static struct zr_instance instances[PLACED + 1];
    scene_of_triangles(&test, 16, 16, corners, 1);
    test.mesh.face_offsets = offsets;
    test.scene.instances = instances;
    test.scene.instance_count = PLACED;
    assert_int_equal(validate(), ZR_OK);
    test.scene.instance_count = PLACED + 1;
    assert_int_equal(validate(), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "");
    assert_non_null(strstr(error.items[0].detail, "more than the limit of 2147483648 corners in all"));
    test.scene.instance_count = PLACED;
    test.mesh.line_count = 1; /* the ends of lines are corners, too */
    assert_int_equal(validate(), ZR_BAD_SCENE);
}

TEST(window_is_held_against_its_limits_side_by_side_and_over_all_outputs)
{
    scene_of_triangles(&test, 4096, 2048, corners, 1); /* four outputs of 8 Mpixel */
    assert_int_equal(validate(), ZR_OK);
    test.scene.views[0].height++;
    assert_int_equal(validate(), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/window");
    test.scene.views[0].width = 8193;
    test.scene.views[0].height = 0;
    assert_int_equal(validate(), ZR_BAD_SCENE);
    assert_int_equal(error.count, 2);
    assert_string_equal(error.items[0].pointer, "/window/width");
    assert_string_equal(error.items[1].pointer, "/window/height");
}

RUN_TESTS(NULL, NULL)
