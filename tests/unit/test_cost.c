#include <math.h>

#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"

static void whole_window_costs_its_pixels(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 200, 100, p, 2);
    struct zr_cost cost = scene_cost(&test.scene, 1024);
    assert_true(cost.triangles >= 2 && cost.triangles < 10 && fabs(cost.fragments - 20000) < 1);
    assert_true(cost.pixels == 80000 && cost.png_pixels == 20000); /* four outputs, one of them PNG */
}

static void only_what_is_in_the_window_counts(void **state)
{
    (void)state;
    /* A triangle around the whole window, one beside it, one behind the eye. */
    const zr_vec4 p[] = {{-9, -9, 0, 1}, {30, -9, 0, 1}, {-9, 30, 0, 1}, {5, 5, 0, 1}, {6, 5, 0, 1},
                         {5, 6, 0, 1},   {0, 0, 0, -1},  {1, 0, 0, -1},  {0, 1, 0, -1}};
    static struct test_scene test;
    scene_of_triangles(&test, 100, 100, p, 3);
    assert_true(fabs(scene_cost(&test.scene, 1024).fragments - 10000) < 1);
}

static void what_faces_away_counts_only_where_it_is_drawn(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {-1, 1, 0, 1}, {1, -1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 100, 100, p, 1);
    assert_true(fabs(scene_cost(&test.scene, 1024).fragments - 5000) < 1);
    test.material.double_sided = false;
    assert_true(scene_cost(&test.scene, 1024).fragments == 0);
}

static void mirrored_instance_counts_where_its_front_is_seen(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 100, 100, p, 1);
    test.material.double_sided = false;
    test.instance.object_to_world.m[0] = -1; /* one mirror leaves a front a front */
    assert_true(fabs(scene_cost(&test.scene, 1024).fragments - 5000) < 1);
    test.instance.object_to_world.m[10] = -1; /* two are half a turn about y, which shows the back */
    assert_true(scene_cost(&test.scene, 1024).fragments == 0);
}

static void sample_of_a_large_scene_is_near_the_truth(void **state)
{
    (void)state;
    struct random random = random_seeded(3);
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    double truth = 0;
    for (int t = 0; t < TEST_TRIANGLES_MAX; t++) {
        double x = random_range(&random, -1, 0.9), y = random_range(&random, -1, 0.9),
               size = random_range(&random, 0, 0.1);
        p[3 * t] = (zr_vec4){(float)x, (float)y, 0, 1};
        p[3 * t + 1] = (zr_vec4){(float)(x + size), (float)y, 0, 1};
        p[3 * t + 2] = (zr_vec4){(float)x, (float)(y + size), 0, 1};
        truth += size * size / 2 * 500 * 500;
    }
    static struct test_scene test;
    scene_of_triangles(&test, 1000, 1000, p, TEST_TRIANGLES_MAX);
    assert_true(fabs(scene_cost(&test.scene, 1024).fragments / truth - 1) < 0.1);
}

static void large_faces_at_regular_places_do_not_mislead_the_sample(void **state)
{
    (void)state;
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    const zr_vec4 large[3] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    for (int every = 2; every <= 8; every++) {
        double truth = 0;
        for (int t = 0; t < TEST_TRIANGLES_MAX; t++)
            for (int k = 0; k < 3; k++) {
                float size = t % every == 0 ? 1.0f : 0.01f;
                p[3 * t + k] = (zr_vec4){large[k].x * size, large[k].y * size, 0, 1};
                if (k == 0) truth += (double)size * (double)size * 5000;
            }
        scene_of_triangles(&test, 100, 100, p, TEST_TRIANGLES_MAX);
        assert_true(fabs(scene_cost(&test.scene, 1024).fragments / truth - 1) < 0.25);
        assert_true(fabs(scene_cost(&test.scene, UINT32_MAX).fragments / truth - 1) < 0.001);
    }
}

/* A square of half the window's side, with one of a quarter in it or beside it that turns the same way or the other. */
static void face_of_two_rings_costs_what_it_covers_at_least_and_its_box_at_most(void **state)
{
    (void)state;
    zr_vec4 p[] = {{-0.5f, -0.5f, 0, 1},   {0.5f, -0.5f, 0, 1},   {0.5f, 0.5f, 0, 1},   {-0.5f, 0.5f, 0, 1},
                   {-0.25f, -0.25f, 0, 1}, {0.25f, -0.25f, 0, 1}, {0.25f, 0.25f, 0, 1}, {-0.25f, 0.25f, 0, 1}};
    static const uint32_t same_way[8] = {0, 1, 2, 3, 4, 5, 6, 7}, other_way[8] = {0, 1, 2, 3, 7, 6, 5, 4},
                          offsets[2] = {0, 8}, face_rings[2] = {0, 2}, ring_offsets[3] = {0, 4, 8};
    static struct test_scene test;
    for (int round = 0; round < 4; round++) {
        bool in_it = round < 2;
        for (int i = 4; i < 8 && round == 2; i++)
            p[i].x += 0.75f;
        scene_of_triangles(&test, 100, 100, p, 1);
        test.mesh.position_count = 8;
        test.mesh.face_offsets = offsets;
        test.mesh.face_rings = face_rings;
        test.mesh.ring_offsets = ring_offsets;
        test.mesh.indices = round % 2 ? other_way : same_way;
        test.material.double_sided = false;
        double fragments = scene_cost(&test.scene, 1024).shape_fragments;
        double low = in_it ? 1875 : 3125, high = in_it ? 2500 : 3750; /* pixels, which take some ten times longer */
        assert_true(fragments > 10 * (low - 1) && fragments < 10.5 * (high + 1));
        test.instance.object_to_world.m[0] = test.instance.object_to_world.m[10] = -1; /* its back is seen */
        assert_true(scene_cost(&test.scene, 1024).shape_fragments == 0);
        test.material.double_sided = true;
        assert_true(fabs(scene_cost(&test.scene, 1024).shape_fragments - fragments) < 1);
    }
}

static void odd_numbers_cost_something_finite(void **state)
{
    (void)state;
    const zr_vec4 p[] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 1}, {NAN, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 100, 100, p, 2);
    assert_true(isfinite(scene_cost(&test.scene, 1024).fragments));
}

/* The scene of one square over a quarter of the window, as a mesh of its own kind. */
static struct zr_cost cost_of_square(bool dented, bool outlined, uint32_t lines)
{
    static struct test_scene test;
    static const zr_vec4 positions[5] = {
        {-1, -1, 0, 1}, {0, -1, 0, 1}, {0, 0, 0, 1}, {-0.5f, -0.25f, 0, 1}, {-1, 0, 0, 1}};
    static const uint32_t ends[2] = {0, 2};
    scene_of_triangles(&test, 200, 200, positions, 1);
    test.mesh.position_count = 5;
    test.face_offsets[1] = dented ? 5 : 4;
    for (uint32_t i = 0; i < 5; i++)
        test.indices[i] = !dented && i == 3 ? 4 : i;
    test.mesh.line_count = lines;
    test.mesh.lines = ends;
    test.material.outline = outlined ? ZR_OUTLINE_COLORED : ZR_OUTLINE_NONE;
    return scene_cost(&test.scene, UINT32_MAX);
}

static void dents_outlines_and_lines_cost_more_than_a_plain_face(void **state)
{
    (void)state;
    struct zr_cost plain = cost_of_square(false, false, 0), dented = cost_of_square(true, false, 0);
    struct zr_cost outlined = cost_of_square(false, true, 0), crossed = cost_of_square(false, false, 1);
    assert_true(fabs(plain.fragments - 10000) < 1 && plain.triangles >= 2 && plain.triangles < 10);
    assert_true(dented.shape_fragments > 4 * plain.fragments &&
                dented.triangles + dented.shape_triangles > plain.triangles);
    assert_true(plain.shape_fragments == 0 && plain.shape_triangles == 0);
    assert_true(outlined.fragments > plain.fragments + 3 * 100 && outlined.triangles > plain.triangles);
    assert_true(crossed.fragments > plain.fragments + 100 && crossed.triangles > plain.triangles);
}

static void points_without_faces_and_other_algorithms_cost_too(void **state)
{
    (void)state;
    static struct test_scene test;
    static zr_vec4 positions[10000];
    for (int i = 0; i < 10000; i++)
        positions[i] = (zr_vec4){i % 3 == 1, i % 3 == 2, 0, 1};
    scene_of_triangles(&test, 100, 100, positions, 1);
    double alone = scene_cost(&test.scene, UINT32_MAX).triangles;
    test.mesh.position_count = 10000;
    double among_points = scene_cost(&test.scene, UINT32_MAX).triangles;
    assert_true(among_points > alone + 1000);
    test.scene.algorithm = ZR_ALGORITHM_PAINTER;
    assert_true(scene_cost(&test.scene, UINT32_MAX).triangles > 2 * among_points);
}

/* `count` triangles over much of the window; `flat`: each at a depth of its own, so that none runs through another. */
static struct zr_cost cost_of_crowd(enum zr_algorithm algorithm, uint32_t count, bool flat)
{
    static struct test_scene test;
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    struct random random = random_seeded(7);
    for (uint32_t i = 0; i < 3 * count; i++) {
        const double x = random_range(&random, -1, 1), y = random_range(&random, -1, 1);
        const double z = random_range(&random, -0.9, 0.9);
        p[i] = (zr_vec4){(float)x, (float)y, flat ? (float)(i / 3) / (float)count : (float)z, 1};
    }
    scene_of_triangles(&test, 512, 512, p, count);
    test.scene.algorithm = algorithm;
    return scene_cost(&test.scene, 4096);
}

static void painter_is_to_cut_what_runs_through_one_another(void **state)
{
    (void)state;
    const double flat = cost_of_crowd(ZR_ALGORITHM_PAINTER, 400, true).fragments;
    const double few = cost_of_crowd(ZR_ALGORITHM_PAINTER, 100, false).fragments;
    const double many = cost_of_crowd(ZR_ALGORITHM_PAINTER, 400, false).fragments;
    const double all = cost_of_crowd(ZR_ALGORITHM_PAINTER, TEST_TRIANGLES_MAX, false).fragments;
    assert_true(many > 15 * flat); /* seconds against hundredths */
    assert_true(many > 20 * few);  /* and it grows by the cube */
    assert_true(all > 200 * many); /* from a sample of its triangles */
    const double others = cost_of_crowd(ZR_ALGORITHM_SCANLINE, 400, false).fragments;
    assert_true(fabs(others / cost_of_crowd(ZR_ALGORITHM_HALFSPACE, 400, false).fragments - 16) < 0.1);
}

/* `count` tilted triangles that all reach through the same depths, none of which cuts another: needles that overlap
 * here and there, layers of the whole window, or parallels that only their boxes have in common. */
enum crowd { NEEDLES, LAYERS, PARALLELS };

static double cost_of_uncut(enum crowd crowd, uint32_t count)
{
    static struct test_scene test;
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    struct random random = random_seeded(11);
    for (uint32_t i = 0; i < count; i++) {
        const float t = (float)i / (float)count;
        zr_vec4 *v = p + 3 * (size_t)i;
        v[0] = (zr_vec4){-1, -1, 0.4f * t - 0.6f, 1};
        v[1] = (zr_vec4){1, -1, 0.4f * t + 0.2f, 1};
        v[2] = (zr_vec4){0, 1, 0.4f * t - 0.2f, 1};
        if (crowd == PARALLELS) {
            v[0] = (zr_vec4){-1, t - 1, -0.5f, 1};
            v[1] = (zr_vec4){1, t, 0.5f, 1};
            v[2] = (zr_vec4){1, t + 0.002f / (float)count, 0.5f, 1};
        }
        if (crowd != NEEDLES) continue;
        for (int k = 0; k < 2; k++)
            v[k] = (zr_vec4){(float)random_range(&random, -1, 1), (float)random_range(&random, -1, 1),
                             (float)random_range(&random, -0.9, 0.9), 1};
        v[2] = (zr_vec4){v[1].x + 0.01f, v[1].y + 0.01f, v[1].z, 1};
    }
    scene_of_triangles(&test, 512, 512, p, count);
    test.scene.algorithm = ZR_ALGORITHM_PAINTER;
    return scene_cost(&test.scene, 4096).fragments;
}

static void painter_is_to_compare_what_meets_without_being_cut(void **state)
{
    (void)state;
    /* Four times as many: painting takes four times as long at most, all pairs 16 times, and chains 64 times. */
    assert_true(cost_of_uncut(NEEDLES, 512) > 24 * cost_of_uncut(NEEDLES, 128));
    assert_true(cost_of_uncut(LAYERS, 512) > 10 * cost_of_uncut(LAYERS, 128));
    assert_true(cost_of_uncut(PARALLELS, 512) > 8 * cost_of_uncut(PARALLELS, 128));
}

/* 64 discs that run through one another, each with so many corners. */
static double cost_of_discs(uint32_t corners)
{
    static struct test_scene test;
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    struct random random = random_seeded(13);
    for (uint32_t i = 0; i < 64; i++) {
        const double a = random_range(&random, -0.4, 0.4), b = random_range(&random, -0.4, 0.4);
        for (uint32_t k = 0; k < corners; k++) {
            const double turn = 2 * 3.14159265 * k / corners, x = 0.9 * cos(turn), y = 0.9 * sin(turn);
            p[i * corners + k] = (zr_vec4){(float)x, (float)y, (float)(a * x + b * y), 1};
        }
    }
    scene_of_triangles(&test, 512, 512, p, 64);
    test.mesh.position_count = 64 * corners;
    for (uint32_t i = 0; i <= 64; i++)
        test.face_offsets[i] = i * corners;
    for (uint32_t i = 0; i < 64 * corners; i++)
        test.indices[i] = i;
    test.scene.algorithm = ZR_ALGORITHM_PAINTER;
    return scene_cost(&test.scene, UINT32_MAX).fragments;
}

static void painter_cuts_whole_polygons_however_many_corners_they_have(void **state)
{
    (void)state;
    const double few = cost_of_discs(12), many = cost_of_discs(96);
    assert_true(many > few && many < 1.5 * few); /* the more corners, the larger the disc */
}

/* A pixel of one, and texels of its levels, which are made once. */
static void textures_cost_pixels_and_levels(void **state)
{
    (void)state;
    enum { SIDE = 256 };
    static uint8_t texels[SIDE * SIDE * 4];
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    const struct zr_image image = {SIDE, SIDE, 8, texels};
    struct zr_texture texture = {.magnify = ZR_FILTER_NEAREST, .minify = ZR_FILTER_NEAREST};
    scene_of_triangles(&test, 200, 100, p, 2);
    const struct zr_cost plain = scene_cost(&test.scene, 1024);
    test.scene.images = &image;
    test.scene.textures = &texture;
    test.scene.image_count = test.scene.texture_count = 1;
    test.material.textures[ZR_TEXTURE_BASE_COLOR] = 1;
    const struct zr_cost nearest = scene_cost(&test.scene, 1024);
    texture.minify = ZR_FILTER_LINEAR_MIPMAP_LINEAR;
    const struct zr_cost levels = scene_cost(&test.scene, 1024);
    test.scene.picture.is_linear = true;
    test.scene.picture.side = 1;
    const struct zr_cost lit = scene_cost(&test.scene, 1024);
    test.material.textures[ZR_TEXTURE_NORMAL] = 1;
    const struct zr_cost two = scene_cost(&test.scene, 1024);
    assert_true(nearest.fragments >= plain.fragments + 20000 && nearest.window_bytes < plain.window_bytes + 4096);
    assert_true(levels.fragments >= nearest.fragments + 20000 + SIDE * SIDE / 3.0);
    assert_true(levels.window_bytes >= nearest.window_bytes + SIDE * SIDE * 4 / 3.0);
    assert_true(two.samples >= lit.samples + 20000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_cost_pixels_and_levels),
        cmocka_unit_test(whole_window_costs_its_pixels),
        cmocka_unit_test(only_what_is_in_the_window_counts),
        cmocka_unit_test(what_faces_away_counts_only_where_it_is_drawn),
        cmocka_unit_test(mirrored_instance_counts_where_its_front_is_seen),
        cmocka_unit_test(sample_of_a_large_scene_is_near_the_truth),
        cmocka_unit_test(large_faces_at_regular_places_do_not_mislead_the_sample),
        cmocka_unit_test(dents_outlines_and_lines_cost_more_than_a_plain_face),
        cmocka_unit_test(points_without_faces_and_other_algorithms_cost_too),
        cmocka_unit_test(face_of_two_rings_costs_what_it_covers_at_least_and_its_box_at_most),
        cmocka_unit_test(painter_is_to_cut_what_runs_through_one_another),
        cmocka_unit_test(painter_is_to_compare_what_meets_without_being_cut),
        cmocka_unit_test(painter_cuts_whole_polygons_however_many_corners_they_have),
        cmocka_unit_test(odd_numbers_cost_something_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
