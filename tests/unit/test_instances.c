/* Instances: what their matrices do to pictures. */
#include <string.h>

#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"

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
            assert_true(scene_cost(&a.scene, 100).fragments == scene_cost(&b.scene, 100).fragments);
            zr_arena_reset(&arena, 1 << 25);
        }
    zr_arena_free(&arena);
}

static void placed_mesh_equals_the_mesh_with_moved_vertices(void **state)
{
    (void)state;
    zr_vec4 solid[12], moved[12];
    make_solid(solid);
    for (int i = 0; i < 12; i++)
        moved[i] = (zr_vec4){solid[i].x * 2 + 0.25f, solid[i].y * 2 - 0.5f, solid[i].z * 2 - 0.125f, 1};
    assert_placed_equals_moved(solid, (zr_mat4){{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0.25f, -0.5f, -0.125f, 1}}, moved);
}

/* What the mirror makes of a mesh is the mesh reflected and, so that fronts stay fronts,
 * its corners in the other direction. */
static void mirrored_instance_keeps_its_fronts(void **state)
{
    (void)state;
    zr_vec4 solid[12], moved[12];
    make_solid(solid);
    for (int i = 0; i < 12; i++) {
        zr_vec4 p = solid[i % 3 == 2 ? i : i - i % 3 + 1 - i % 3];
        moved[i] = (zr_vec4){-p.x + 0.25f, p.y, p.z, 1};
    }
    zr_mat4 mirror = zr_mat4_identity();
    mirror.m[0] = -1;
    mirror.m[12] = 0.25f;
    assert_placed_equals_moved(solid, mirror, moved);
}

static void mirrors_are_told_by_the_determinant(void **state)
{
    (void)state;
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
static void matrices_at_their_limits_draw_something_or_nothing(void **state)
{
    (void)state;
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

/* On a sphere that is stretched to twice its width, the normal (1, 0, 1) leans to (1/2, 0, 1):
 * light along z falls on it at an angle whose cosine is 1 / sqrt(5/4). */
static void stretched_sphere_is_lit_by_the_normals_of_an_ellipsoid(void **state)
{
    (void)state;
    const zr_vec4 facet[3] = {{-0.25f, -0.5f, 0, 1}, {0.25f, -0.5f, 0, 1}, {0, 0.5f, 0, 1}};
    const zr_vec3 normals[3] = {{1, 0, 1}, {2, 0, 2}, {0.5f, 0, 0.5f}};
    const struct zr_light headlight = {.direction = {0, 0, -1}, .color = {1, 1, 1}, .camera_frame = true};
    static struct test_scene test;
    scene_of_triangles(&test, 33, 33, facet, 1);
    test.mesh.normals = normals;
    test.mesh.normal_count = 3;
    test.material = (struct zr_material){.base_color = {1, 0.5f, 1, 1}, .shading = ZR_SHADING_GOURAUD};
    test.scene.lights = &headlight;
    test.scene.light_count = 1;
    test.instance.object_to_world.m[0] = 2;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    const uint8_t *middle = frame->color + (size_t)4 * (16 * 33 + 16);
    assert_int_equal(middle[0], 228); /* 255 * 0.894427 = 228.08 */
    assert_int_equal(middle[1], 114);
    assert_true(frame->face_id[23 * 33 + 10] == 1); /* stretched: beyond the facet's own width */
    zr_arena_free(&arena);
}

static void face_ids_count_over_instances(void **state)
{
    (void)state;
    zr_vec4 solid[12];
    make_solid(solid);
    static struct test_scene test;
    scene_of_triangles(&test, 64, 32, solid, 4);
    struct zr_instance instances[3];
    for (int i = 0; i < 3; i++) {
        instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
        instances[i].object_to_world.m[0] = 0.25f;
        instances[i].object_to_world.m[12] = (float)i * 0.5f - 0.5f;
    }
    test.scene.instances = instances;
    test.scene.instance_count = 3;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t id = frame->face_id[16 * 64 + 16 * (i + 1)];
        assert_in_range(id, 4 * i + 1, 4 * i + 4);
    }
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(placed_mesh_equals_the_mesh_with_moved_vertices),
        cmocka_unit_test(mirrored_instance_keeps_its_fronts),
        cmocka_unit_test(mirrors_are_told_by_the_determinant),
        cmocka_unit_test(matrices_at_their_limits_draw_something_or_nothing),
        cmocka_unit_test(stretched_sphere_is_lit_by_the_normals_of_an_ellipsoid),
        cmocka_unit_test(face_ids_count_over_instances),
    };
    return cmocka_run_group_tests_name("instances", tests, NULL, NULL);
}
