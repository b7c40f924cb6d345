/* Instances: what their matrices do to pictures. */
#include <string.h>

#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

/* A tetrahedron, its sides all turned the same way. */
static void make_solid(zr_vec4 out[12])
{
    static const zr_vec4 corners[4] = {
        {-0.5f, -0.5f, 0.25f, 1}, {0.5f, -0.25f, 0.25f, 1}, {0, 0.5f, 0.25f, 1}, {0.125f, 0, -0.5f, 1}};
    static const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (int f = 0; f < 4; f++)
        for (int k = 0; k < 3; k++)
            out[3 * f + k] = corners[faces[f][k]];
}

static void light(struct test_scene *test, enum zr_shading shading, bool double_sided)
{
    static const struct zr_light lamp = {.direction = {-0.5f, -0.25f, 0.75f}, .color = {0.75f, 0.5f, 1}};
    test->material.shading = shading;
    test->material.double_sided = double_sided;
    test->scene.lights = &lamp;
    test->scene.light_count = 1;
    test->scene.ambient = (zr_vec3){0.125f, 0.125f, 0.125f};
}

static void assert_same_picture(const struct zr_frame *a, const struct zr_frame *b)
{
    size_t pixels = (size_t)a->width * a->height;
    assert_memory_equal(a->color, b->color, pixels * 4);
    assert_memory_equal(a->depth, b->depth, pixels * sizeof(float));
    assert_memory_equal(a->window_depth, b->window_depth, pixels * sizeof(float));
    assert_memory_equal(a->face_id, b->face_id, pixels * sizeof(uint32_t));
    assert_memory_equal(&a->counts, &b->counts, sizeof a->counts);
    assert_true(a->covered_pixels > 100);
}

/* Renders `solid` placed by `matrix` and `moved` as it is, one-sided and two-sided, with and
 * without light, and wants the same bytes. */
static void assert_placed_equals_moved(const zr_vec4 *solid, zr_mat4 matrix, const zr_vec4 *moved)
{
    static struct test_scene a, b;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 25);
    for (int shading = ZR_SHADING_UNLIT; shading <= ZR_SHADING_GOURAUD; shading++)
        for (int double_sided = 0; double_sided < 2; double_sided++) {
            scene_of_triangles(&a, 96, 80, solid, 4);
            scene_of_triangles(&b, 96, 80, moved, 4);
            a.instance.object_to_world = matrix;
            light(&a, (enum zr_shading)shading, double_sided);
            light(&b, (enum zr_shading)shading, double_sided);
            const struct zr_frame *placed = scene_render(&arena, NULL, &a.scene);
            assert_int_equal(placed->counts.culled + placed->counts.culled_pieces > 0, !double_sided);
            assert_same_picture(placed, scene_render(&arena, NULL, &b.scene));
            assert_true(scene_cost(&a.scene).counts[ZR_COST_FRAGMENT] == scene_cost(&b.scene).counts[ZR_COST_FRAGMENT]);
            zr_arena_reset(&arena, 1 << 25);
        }
    zr_arena_free(&arena);
}

TEST(placed_mesh_equals_the_mesh_with_moved_vertices)
{
    zr_vec4 solid[12], moved[12];
    make_solid(solid);
    for (int i = 0; i < 12; i++)
        moved[i] = (zr_vec4){solid[i].x * 2 + 0.25f, solid[i].y * 2 - 0.5f, solid[i].z * 2 - 0.125f, 1};
    assert_placed_equals_moved(solid, (zr_mat4){{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0.25f, -0.5f, -0.125f, 1}}, moved);
}

TEST(mirrors_are_told_by_the_determinant)
{
    zr_mat4 m = zr_mat4_identity();
    assert_false(zr_mat4_is_mirror(&m));
    m.m[5] = -1e-15f;
    m.m[0] = 1e-15f;
    m.m[10] = 1e-15f; /* too small for the product as a float */
    assert_true(zr_mat4_is_mirror(&m));
    m.m[0] = -1;
    assert_false(zr_mat4_is_mirror(&m));
    m.m[0] = 0;
    assert_false(zr_mat4_is_mirror(&m));
    m = (zr_mat4){{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}; /* x and y change places */
    assert_true(zr_mat4_is_mirror(&m));
}

/* Three matrices at their limits multiply to more than a float can hold. */
TEST(matrices_at_their_limits_draw_something_or_nothing)
{
    struct random random = random_seeded(7);
    zr_vec4 solid[12];
    make_solid(solid);
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 25);
    for (int round = 0; round < 200; round++) {
        scene_of_triangles(&test, 24, 24, solid, 4);
        light(&test, (enum zr_shading)(round % 3), round % 2);
        zr_mat4 *matrices[3] = {&test.instance.object_to_world, &test.scene.views[0].world_to_camera,
                                &test.scene.views[0].projection_matrix};
        for (int m = 0; m < 3; m++)
            for (int k = 0; k < 16; k++)
                if (random_below(&random, 2)) matrices[m]->m[k] = ZR_MATRIX_MAX * (random_below(&random, 2) ? 1 : -1);
        const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
        const struct zr_counts *c = &frame->counts;
        assert_int_equal(c->outside + c->clipped + c->culled + c->zero_area + c->drawn_whole, c->triangles);
        zr_arena_reset(&arena, 1 << 25);
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
