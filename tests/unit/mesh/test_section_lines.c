/* Outlines of caps, by edges from samples and from the mesh: drawn at any angle, and only around what is drawn. */
#include "sections/sections.h"
#include "support/scenes.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

enum { SIDE = 160 };

static struct test_scene test;

/* A white solid, with black edges. */
static void begin(enum solid solid, bool is_from_mesh)
{
    static const zr_vec4 unused[3];
    scene_of_triangles(&test, SIDE, SIDE, unused, 1);
    test.mesh = solid_make(&arena, solid);
    struct zr_view *view = &test.scene.views[0];
    view->pose = ZR_POSE_DIRECTION;
    view->direction = (zr_vec3){-0.4f, -0.3f, -1};
    view->up = (zr_vec3){0.1f, 1, 0};
    view->projection = ZR_PROJECTION_PERSPECTIVE;
    view->yfov_radians = 0.6f;
    test.picture.is_linear = true;
    test.picture.side = 2;
    test.picture.edges = (struct zr_edges){.is_on = true,
                                           .is_from_mesh = is_from_mesh,
                                           .width = 1.5f,
                                           .keeps_width = true,
                                           .crease_degrees = 30,
                                           .silhouette_opacity = 1,
                                           .crease_opacity = 1};
}

static int red_at(const struct zr_frame *frame, uint32_t at)
{
    return ((const uint8_t *)frame->color)[4 * (size_t)at];
}

/* Pairs of neighbours of which one is a cap and the other another face, and those of one cap; and how many are dark. */
struct pairs {
    uint32_t across, dark_across, within, dark_within;
};

static void count_pair(const struct zr_frame *frame, uint32_t a, uint32_t b, struct pairs *pairs)
{
    const uint32_t first = 1 + frame->sections->first_cap_id, x = frame->face_id[a], y = frame->face_id[b];
    const bool is_dark = red_at(frame, a) < 128 || red_at(frame, b) < 128;
    if (x == 0 || y == 0 || (x < first && y < first)) return;
    *(x == y ? &pairs->within : &pairs->across) += 1;
    *(x == y ? &pairs->dark_within : &pairs->dark_across) += is_dark;
}

static struct pairs count_pairs(void)
{
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    struct pairs pairs = {0, 0, 0, 0};
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x + 1 < SIDE; x++)
            count_pair(frame, y * SIDE + x, y * SIDE + x + 1, &pairs);
    return pairs;
}

/* The plane meets the front at 9 degrees, which is no crease. */
TEST_AROUND(a_cap_has_an_outline_at_any_angle, open_arena, close_arena)
{
    for (int from_mesh = 0; from_mesh < 2; from_mesh++) {
        begin(SOLID_CUBE, from_mesh);
        test.scene.sections.count = 1;
        test.scene.sections.planes[0] = (struct zr_section){.normal = {0.15, 0.05, 1}, .point = {0, 0, 0.95}};
        const struct pairs pairs = count_pairs();
        assert_true(pairs.across > 60 && pairs.within > 500);
        assert_int_equal(pairs.dark_across, pairs.across);
        assert_true(pairs.dark_within < pairs.within / 10);
    }
}

/* Three cubes of one part: their caps are a union. */
TEST_AROUND(outlines_are_those_of_the_union, open_arena, close_arena)
{
    for (int from_mesh = 0; from_mesh < 2; from_mesh++) {
        begin(SOLID_OVERLAPPING, from_mesh);
        test.scene.sections.count = 1;
        test.scene.sections.planes[0] = (struct zr_section){.normal = {0, 0, 1}, .point = {0, 0, 0.5}};
        const struct pairs pairs = count_pairs();
        assert_true(pairs.within > 1500);
        assert_true(pairs.dark_within < pairs.within / 25);
    }
}

/* Two parts that overlap, one of them turned: the first one has the samples of both, and the line between them. */
TEST_AROUND(caps_of_two_parts_have_a_line_between_them, open_arena, close_arena)
{
    for (int from_mesh = 0; from_mesh < 2; from_mesh++) {
        begin(SOLID_CUBE, from_mesh);
        struct zr_instance two[2] = {test.instance, test.instance};
        two[1].object_to_world = (zr_mat4){{0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 1, 0, 0.7f, 0.3f, 0, 1}};
        test.scene.instances = two;
        test.scene.instance_count = 2;
        test.scene.sections.count = 1;
        test.scene.sections.planes[0] = (struct zr_section){.normal = {0.1, 0.2, 1}, .point = {0.1, 0.2, 0.3}};
        const struct pairs pairs = count_pairs();
        assert_true(pairs.across > 60 && pairs.within > 4000);
        assert_int_equal(pairs.dark_across, pairs.across);
        assert_true(pairs.dark_within < pairs.within / 20);
    }
}

RUN_TESTS(NULL, NULL)
