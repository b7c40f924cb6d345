/* What pictures of several samples, in linear light and with effects cost, in time and memory. */
#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"
#include <math.h>

enum { WIDTH = 200, HEIGHT = 100, PIXELS = WIDTH * HEIGHT };

static const struct zr_output color_alone = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};

/* A square over half of the window, in the scene of `test`, to be changed; the color is the only output. */
static void half_a_window(struct test_scene *test)
{
    static const zr_vec4 p[] = {{-1, -1, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1},
                                {-1, -1, 0, 1}, {0, 1, 0, 1},  {-1, 1, 0, 1}};
    scene_of_triangles(test, WIDTH, HEIGHT, p, 2);
    test->scene.views[0].outputs = &color_alone;
    test->scene.views[0].output_count = 1;
    test->scene.picture = (struct zr_picture){.side = 1, .line_width = 1, .crease_degrees = 180, .exposure = 1};
}

static void each_sample_is_drawn_and_lit(void **state)
{
    (void)state;
    static struct test_scene test;
    half_a_window(&test);
    const struct zr_cost textbook = scene_cost(&test.scene, 1024);
    assert_true(fabs(textbook.fragments - PIXELS / 2) < 1 && textbook.samples == 0);
    test.scene.picture.side = 4;
    const struct zr_cost bytes = scene_cost(&test.scene, 1024);
    assert_true(fabs(bytes.fragments - 16 * PIXELS / 2) < 1);
    assert_true(bytes.samples > 0 && bytes.samples < 16 * PIXELS);
    test.scene.picture.is_linear = true;
    const struct zr_cost unlit = scene_cost(&test.scene, 1024);
    assert_true(fabs(unlit.fragments - 16 * PIXELS / 2) < 1);
    assert_true(unlit.samples >= 16 * PIXELS / 2 && unlit.samples < 16 * PIXELS / 2 + 2 * PIXELS);
    test.material.shading = ZR_SHADING_PBR;
    test.scene.picture.environment.name = ZR_ENVIRONMENT_STUDIO;
    assert_true(scene_cost(&test.scene, 1024).samples > 1.5 * unlit.samples);
    test.scene.picture.side = 8;
    assert_true(scene_cost(&test.scene, 1024).samples > 5 * unlit.samples);
}

/* A corner that has next to no w is so far away that the bounds' diagonal is infinite. */
static void maps_of_endless_scenes_cost_something_finite(void **state)
{
    (void)state;
    static const zr_vec4 p[] = {{-1, -1, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1},
                                {-1, -1, 0, 1}, {0, 1, 0, 1},  {-1, 1, 1, 1e-30f}};
    static struct test_scene test;
    half_a_window(&test);
    test.mesh.positions = p;
    test.scene.picture.is_linear = true;
    test.scene.picture.has_ground = true;
    const struct zr_cost cost = scene_cost(&test.scene, 1024);
    assert_true(isfinite(cost.fragments) && cost.fragments > PIXELS / 4);
}

static void only_pictures_that_are_asked_for_cost(void **state)
{
    (void)state;
    static struct test_scene test;
    const struct zr_output info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    half_a_window(&test);
    const struct zr_cost textbook = scene_cost(&test.scene, 1024);
    test.scene.picture.side = 8;
    test.scene.picture.is_linear = true;
    test.scene.picture.occlusion = (struct zr_occlusion){true, 0.2f, 2};
    test.scene.picture.has_ground = true;
    test.scene.views[0].outputs = &info;
    const struct zr_cost cost = scene_cost(&test.scene, 1024);
    assert_true(cost.samples == 0 && fabs(cost.fragments - textbook.fragments) < 1);
    assert_true(cost.triangles == textbook.triangles && cost.window_bytes == 4.0 * PIXELS); /* of faceId */
}

static void channels_beside_a_picture_and_its_occlusion_are_drawn_for_themselves(void **state)
{
    (void)state;
    static struct test_scene test;
    half_a_window(&test);
    test.scene.picture.side = 2;
    test.scene.picture.is_linear = true;
    const struct zr_cost alone = scene_cost(&test.scene, 1024);
    test.scene.picture.occlusion = (struct zr_occlusion){true, 0.2f, 2};
    const struct zr_cost occluded = scene_cost(&test.scene, 1024);
    assert_true(fabs(occluded.fragments - alone.fragments - PIXELS / 2) < 1);
    assert_true(occluded.samples > alone.samples + 10 * PIXELS / 2);
    test.scene.views[0].outputs = test.outputs; /* depth and others */
    test.scene.views[0].output_count = 4;
    const struct zr_cost all = scene_cost(&test.scene, 1024);
    assert_true(fabs(all.fragments - occluded.fragments - PIXELS / 2) < 1);
    assert_true(all.triangles > occluded.triangles + 1);
}

static void effects_without_linear_light_cost_nothing(void **state)
{
    (void)state;
    static struct test_scene test;
    half_a_window(&test);
    test.scene.picture.occlusion = (struct zr_occlusion){true, 0.2f, 2}; /* not linear: there is none */
    test.scene.picture.has_ground = true;
    test.scene.picture.edges.is_on = true;
    const struct zr_cost cost = scene_cost(&test.scene, 1024);
    assert_true(cost.samples == 0 && fabs(cost.fragments - PIXELS / 2) < 1);
}

static enum zr_alpha_mode alpha_mode; /* of the faces below */

/* So many lamps in a scene of two triangles that have an area of 2 each, and bounds with a diagonal of sqrt(5). */
static struct zr_cost cost_of_lamps(uint32_t count, bool have_shadows, enum zr_shading shading, uint32_t side)
{
    static struct test_scene test;
    static struct zr_light lights[ZR_LIGHTS_MAX];
    for (uint32_t i = 0; i < count; i++)
        lights[i] = (struct zr_light){.direction = {0, 0, -1}, .color = {1, 1, 1}, .has_shadows = have_shadows};
    half_a_window(&test);
    test.material.shading = shading;
    test.material.alpha_mode = alpha_mode;
    test.scene.picture.side = side;
    test.scene.picture.is_linear = true;
    test.scene.lights = lights;
    test.scene.light_count = count;
    return scene_cost(&test.scene, 1024);
}

static void lamps_cost_at_each_sample(void **state)
{
    (void)state;
    const enum zr_shading shadings[] = {ZR_SHADING_FLAT, ZR_SHADING_GOURAUD, ZR_SHADING_PHONG, ZR_SHADING_PBR};
    for (size_t i = 0; i < sizeof shadings / sizeof shadings[0]; i++) {
        const double none = cost_of_lamps(0, false, shadings[i], 2).samples;
        const double hundred = cost_of_lamps(100, false, shadings[i], 2).samples - none;
        const double thousand = cost_of_lamps(1000, false, shadings[i], 2).samples - none;
        assert_true(hundred > 5 * (4 * PIXELS / 2)); /* as many unlit ones in the time of each */
        assert_true(fabs(thousand / hundred - 10) < 0.01);
        const double finer =
            cost_of_lamps(100, false, shadings[i], 8).samples - cost_of_lamps(0, false, shadings[i], 8).samples;
        assert_true(fabs(finer / hundred - 16) < 0.01);
    }
    const double none = cost_of_lamps(0, false, ZR_SHADING_GOOCH, 2).samples;
    assert_true(cost_of_lamps(100, false, ZR_SHADING_GOOCH, 2).samples == none); /* it sees none of them */
}

static void scene_is_drawn_once_for_each_lamp_that_casts_shadows(void **state)
{
    (void)state;
    const struct zr_cost none = cost_of_lamps(100, false, ZR_SHADING_PBR, 1);
    const struct zr_cost all = cost_of_lamps(100, true, ZR_SHADING_PBR, 1),
                         one = cost_of_lamps(1, true, ZR_SHADING_PBR, 1);
    const double texels = 1024.0 * 1024.0;
    assert_true(fabs(all.triangles - none.triangles - 100 * 2) < 1);
    /* An area of 2 seen by a lamp in a map as wide as the diagonal. */
    assert_true(fabs((all.fragments - none.fragments) / (100 * texels * 2 / 5) - 1) < 0.05);
    assert_true(all.samples - none.samples > 100 * (PIXELS / 2 + 0.25 * texels));
    assert_true(all.window_bytes - one.window_bytes > 99 * 2 * 4 * texels - 1); /* all of them at once */
    const double maps = all.window_bytes - one.window_bytes;
    assert_true(maps > 99 * 2 * 4 * texels && maps < 1.02 * 99 * 2 * 4 * texels);
    assert_true(all.lamp_maps == 100 && fabs(all.lamp_map_bytes - maps * 100 / 99) < 1 && none.lamp_map_bytes == 0);
}

/* So many spots, so far before two triangles that face them. */
static struct zr_cost cost_of_spots(uint32_t count, bool have_shadows, float distance)
{
    static struct test_scene test;
    static struct zr_light lights[ZR_LIGHTS_MAX];
    for (uint32_t i = 0; i < count; i++)
        lights[i] = (struct zr_light){.type = ZR_LIGHT_SPOT,
                                      .position = {0, 0, distance},
                                      .direction = {0, 0, -1},
                                      .color = {1, 1, 1},
                                      .outer_degrees = 45,
                                      .has_shadows = have_shadows};
    half_a_window(&test);
    test.material.shading = ZR_SHADING_PBR;
    test.material.alpha_mode = alpha_mode;
    test.scene.picture.side = 1;
    test.scene.picture.is_linear = true;
    test.scene.lights = lights;
    test.scene.light_count = count;
    return scene_cost(&test.scene, 1024);
}

static void spots_cost_their_maps_and_what_lamps_cost(void **state)
{
    (void)state;
    const double texels = 1024.0 * 1024.0;
    const struct zr_cost none = cost_of_spots(100, false, 3), all = cost_of_spots(100, true, 3),
                         one = cost_of_spots(1, true, 3), near = cost_of_spots(100, true, 1.5f);
    assert_true(none.samples > cost_of_lamps(100, false, ZR_SHADING_PBR, 1).samples);
    assert_true(fabs(all.triangles - none.triangles - 100 * 2) < 1);
    const double maps = all.window_bytes - one.window_bytes;
    assert_true(maps > 99 * 2 * 4 * texels && maps < 1.02 * 99 * 2 * 4 * texels);
    assert_true(all.lamp_maps == 100 && fabs(all.lamp_map_bytes - maps * 100 / 99) < 1 && none.lamp_map_bytes == 0);
    assert_true(all.samples - none.samples > 100 * (PIXELS / 2 + 0.25 * texels));
    /* An area of 2 at a depth of 3 or 1.5, where the map is 6 or 3 wide, on both sides. */
    assert_true(fabs((all.fragments - none.fragments) / (100 * 2 * texels * 2 / 36) - 1) < 0.1);
    assert_true(fabs((near.fragments - none.fragments) / (all.fragments - none.fragments) - 4) < 0.1);
}

/* All layers of what is masked are kept in maps, too. What is blended casts no shadow. */
static void masks_cost_their_layers_in_maps(void **state)
{
    (void)state;
    double lamp[2], spot[2];
    for (int masked = 0; masked < 2; masked++) {
        alpha_mode = masked ? ZR_ALPHA_MASK : ZR_ALPHA_OPAQUE;
        lamp[masked] = cost_of_lamps(1, true, ZR_SHADING_PBR, 1).fragments -
                       cost_of_lamps(1, false, ZR_SHADING_PBR, 1).fragments;
        spot[masked] = cost_of_spots(1, true, 3).fragments - cost_of_spots(1, false, 3).fragments;
    }
    alpha_mode = ZR_ALPHA_OPAQUE;
    assert_true(lamp[1] > 20 * lamp[0] && lamp[1] < 100 * lamp[0]);
    assert_true(spot[1] > 20 * spot[0] && spot[1] < 100 * spot[0]);
}

/* Of two triangles, of which one has a corner far away, or at infinity: it covers a map at most. */
static void no_face_covers_more_than_a_map(void **state)
{
    static const zr_vec4 corners[] = {{1e6f, 0, 0, 1}, {1, 0, 0, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof corners / sizeof corners[0]; i++) {
        zr_vec4 p[6] = {{0, 0, 0, 1}, corners[i], {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
        static struct test_scene test;
        struct zr_light light = {.direction = {0, 0, -1}, .color = {1, 1, 1}, .has_shadows = true};
        scene_of_triangles(&test, WIDTH, HEIGHT, p, 2);
        test.scene.views[0].outputs = &color_alone;
        test.scene.views[0].output_count = 1;
        test.scene.picture.is_linear = true;
        test.scene.picture.side = 1;
        test.scene.lights = &light;
        test.scene.light_count = 1;
        const double with = scene_cost(&test.scene, 1024).fragments;
        light.has_shadows = false;
        const double maps = with - scene_cost(&test.scene, 1024).fragments;
        assert_true(maps > 0 && maps <= 2 * 1024.0 * 1024.0);
    }
}

/* Of a window with `side` squared samples a pixel: bytes a pixel. */
static double bytes_a_pixel(enum zr_algorithm algorithm, uint32_t side, bool occluded, bool has_edges)
{
    static struct test_scene test;
    half_a_window(&test);
    test.scene.algorithm = algorithm;
    test.scene.picture.side = side;
    test.scene.picture.is_linear = true;
    test.scene.picture.occlusion = (struct zr_occlusion){occluded, 0.2f, 2};
    test.scene.picture.edges = (struct zr_edges){has_edges, {0, 0, 0}, 1.5f, 30};
    return scene_cost(&test.scene, 1024).window_bytes / PIXELS;
}

static void memory_of_whole_windows_is_told(void **state)
{
    (void)state;
    assert_true(bytes_a_pixel(ZR_ALGORITHM_HALFSPACE, 8, false, false) == 4 + 16); /* tile by tile */
    assert_true(bytes_a_pixel(ZR_ALGORITHM_HALFSPACE, 8, true, false) == 4 + 16 + 28 + 4);
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT;
         a++) { /* the window at once, at its size and at that of samples */
        assert_true(bytes_a_pixel((enum zr_algorithm)a, 1, false, false) == 4 + 16 + 8);
        assert_true(bytes_a_pixel((enum zr_algorithm)a, 8, true, false) == 4 + 16 + 28 + 4 + 8 + 64 * 8);
    }
    const double edges = bytes_a_pixel(ZR_ALGORITHM_HALFSPACE, 4, false, true) - (4 + 16);
    assert_true(edges > 4 + 16 * 1.75 && edges < 4 + 16 * 2.1);
}

/* What is told beforehand is what rendering takes, and no more. */
static void told_memory_is_needed(void **state)
{
    (void)state;
    static struct test_scene test;
    struct zr_arena arena;
    for (int i = 0; i < 8; i++) {
        half_a_window(&test);
        test.material.shading = ZR_SHADING_PBR;
        test.scene.views[0].width = 1000;
        test.scene.views[0].height = 700;
        test.scene.algorithm = i & 1 ? ZR_ALGORITHM_SCANLINE : ZR_ALGORITHM_HALFSPACE;
        test.scene.picture.side = i & 2 ? 4 : 1;
        test.scene.picture.is_linear = true;
        test.scene.picture.occlusion = (struct zr_occlusion){i & 4, 0.2f, 2};
        test.scene.picture.edges = (struct zr_edges){i & 2, {0, 0, 0}, 1.5f, 30};
        const double told = scene_cost(&test.scene, 1024).window_bytes;
        zr_arena_init(&arena, (size_t)1 << 30);
        scene_render(&arena, NULL, &test.scene);
        if (told > (double)arena.peak || told < 0.6 * (double)arena.peak)
            fail_msg("case %d: %.0f bytes told, %zu taken", i, told, arena.peak);
        zr_arena_free(&arena);
    }
}

static void wide_lines_cost_their_pixels_and_samples(void **state)
{
    (void)state;
    static struct test_scene test;
    static const uint32_t ends[2] = {0, 2};
    double last = 0.0;
    for (uint32_t side = 1; side <= 8; side *= 2)
        for (float width = 1; width <= 64; width *= 8) {
            half_a_window(&test);
            test.mesh.face_count = 0;
            test.mesh.line_count = 1;
            test.mesh.lines = ends;
            test.scene.picture.side = side;
            test.scene.picture.line_width = width;
            const double fragments = scene_cost(&test.scene, 1024).fragments;
            const double samples = 100.0 * (double)side, wide = (double)width * (double)side;
            assert_true(fragments > samples * (wide + 5) && fragments < samples * (3 * wide + 10));
            if (width > 1) assert_true(fragments > 1.5 * last);
            last = fragments;
        }
}

/* Samples are lit many at once, for each material among them. */
static void many_materials_of_small_faces_cost_more(void **state)
{
    (void)state;
    static struct test_scene test;
    static struct zr_material materials[64];
    for (int i = 0; i < 64; i++)
        materials[i] =
            (struct zr_material){.base_color = {1, 1, 1, 1}, .shading = ZR_SHADING_PBR, .double_sided = true};
    double cost[2][2];
    for (int small = 0; small < 2; small++)
        for (int many = 0; many < 2; many++) {
            half_a_window(&test);
            if (small) test.scene.views[0].width = test.scene.views[0].height = 2;
            test.scene.picture.is_linear = true;
            test.scene.materials = materials;
            test.scene.material_count = many ? 64 : 1;
            cost[small][many] = scene_cost(&test.scene, 1024).samples;
        }
    assert_true(cost[0][1] == cost[0][0]);
    assert_true(cost[1][1] > 3 * cost[1][0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_sample_is_drawn_and_lit),
        cmocka_unit_test(maps_of_endless_scenes_cost_something_finite),
        cmocka_unit_test(only_pictures_that_are_asked_for_cost),
        cmocka_unit_test(channels_beside_a_picture_and_its_occlusion_are_drawn_for_themselves),
        cmocka_unit_test(effects_without_linear_light_cost_nothing),
        cmocka_unit_test(lamps_cost_at_each_sample),
        cmocka_unit_test(scene_is_drawn_once_for_each_lamp_that_casts_shadows),
        cmocka_unit_test(spots_cost_their_maps_and_what_lamps_cost),
        cmocka_unit_test(masks_cost_their_layers_in_maps),
        cmocka_unit_test(no_face_covers_more_than_a_map),
        cmocka_unit_test(memory_of_whole_windows_is_told),
        cmocka_unit_test(told_memory_is_needed),
        cmocka_unit_test(wide_lines_cost_their_pixels_and_samples),
        cmocka_unit_test(many_materials_of_small_faces_cost_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
