/* Counts of known scenes, and memory: none is predicted that is not held. */
#include "cost/cost.h"

#include <math.h>

#include "support/scenes.h"
#include "support/tests.h"

enum { WIDTH = 200, HEIGHT = 100, PIXELS = WIDTH * HEIGHT };

static const zr_vec4 half[] = {{-1, -1, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1},
                               {-1, -1, 0, 1}, {0, 1, 0, 1},  {-1, 1, 0, 1}};
static struct test_scene test;

/* Pixels of the fine window of lines/window_view.h. */
#define FINE_PIXELS (PIXELS * 2048.0 * 2048.0 / (WIDTH * WIDTH + HEIGHT * HEIGHT))

/* A square over half of the window, whose colours are the only output. */
static void half_a_window(void)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    scene_of_triangles(&test, WIDTH, HEIGHT, half, 2);
    test.scene.views[0].outputs = &color;
    test.scene.views[0].output_count = 1;
    test.picture = (struct zr_picture){.side = 1, .line_width = 1, .crease_degrees = 180, .exposure = 1};
}

static double count(enum zr_cost_kind kind)
{
    return scene_cost(&test.scene).counts[kind];
}

static void assert_near(double value, double want)
{
    if (!(fabs(value - want) <= 1e-6 * want)) fail_msg("%g, not %g", value, want);
}

TEST(sizes_are_counted)
{
    half_a_window();
    const struct zr_cost cost = scene_cost(&test.scene);
    assert_near(cost.counts[ZR_COST_REQUEST], 1);
    assert_near(cost.counts[ZR_COST_INSTANCE], 1);
    assert_near(cost.counts[ZR_COST_VERTEX], 6);
    assert_near(cost.counts[ZR_COST_TRIANGLE], 2);
    assert_near(cost.counts[ZR_COST_FRAGMENT], PIXELS / 2);
    assert_near(cost.counts[ZR_COST_PNG_PIXEL], PIXELS);
    assert_near(cost.counts[ZR_COST_WINDOW_SAMPLE] + cost.counts[ZR_COST_LAYER] + cost.counts[ZR_COST_LIT_SAMPLE], 0);
    assert_near(cost.counts[ZR_COST_FACT], 0);
    assert_true(zr_cost_most(&cost).ms <= cost.ms);
}

TEST(info_measures_all_triangles_and_lists_up_to_a_thousand_parts)
{
    static const struct zr_output info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    static const uint32_t parts[2] = {0, 1};
    half_a_window();
    test.scene.views[0].outputs = &info;
    assert_near(count(ZR_COST_FACT), 2);
    assert_near(count(ZR_COST_PART), 1);
    test.mesh.face_parts = parts;
    test.mesh.part_count = 900;
    assert_near(count(ZR_COST_PART), 900);
    test.mesh.part_count = 1100;
    assert_near(count(ZR_COST_PART), 1000);
    assert_near(count(ZR_COST_INFO), 0); /* two triangles have no overlap */
    assert_near(count(ZR_COST_FEATURE), 0);
    test.scene.has_features = true;
    assert_near(count(ZR_COST_FEATURE), 2 + 1000 * 100);
    const zr_vec4 corners[3 * 6] = {{0, 0, 0, 1}};
    scene_of_triangles(&test, WIDTH, HEIGHT, corners, 6);
    test.scene.views[0].outputs = &info;
    test.scene.views[0].output_count = 1;
    assert_near(count(ZR_COST_INFO), 1);
}

TEST(what_is_not_drawn_costs_no_more_than_its_facts)
{
    static const struct zr_output info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    half_a_window();
    test.scene.views[0].outputs = &info;
    test.scene.is_undrawn = true;
    const struct zr_cost cost = scene_cost(&test.scene);
    for (int kind = 0; kind < ZR_COST_KINDS; kind++)
        assert_near(cost.counts[kind], kind == ZR_COST_FACT ? 2 : kind == ZR_COST_REQUEST || kind == ZR_COST_PART);
    assert_true(cost.window_bytes == 0.0);
}

/* The plane crosses one of the two triangles, the other one only in a corner and an edge. */
TEST(caps_are_foretold_by_the_faces_that_planes_cross)
{
    half_a_window();
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = (struct zr_section){.keep = ZR_SECTION_KEEP_POSITIVE, .normal = {2, 1, 0}};
    test.scene.sections.planes[0].point[0] = -0.5;
    assert_near(count(ZR_COST_SECTION_CORNER), 6 * 3);
    assert_near(count(ZR_COST_CAP_TILE), 2.0 * PIXELS / (64 * 64));
    test.scene.sections.planes[0].keep = ZR_SECTION_KEEP_NEGATIVE;
    test.scene.sections.planes[0].point[0] = -1;
    test.scene.sections.planes[0].normal[1] = 0;
    assert_near(count(ZR_COST_CAP_TILE), 0);
}

TEST(only_what_is_seen_in_the_window_has_fragments)
{
    /* A triangle around the whole window, which counts as half of it, since its box is twice as large; one beside the
     * window, one behind the eye, and half of the window turned away. */
    const zr_vec4 p[] = {{-9, -9, 0, 1}, {30, -9, 0, 1}, {-9, 30, 0, 1}, {5, 5, 0, 1},   {6, 5, 0, 1},  {5, 6, 0, 1},
                         {0, 0, 0, -1},  {1, 0, 0, -1},  {0, 1, 0, -1},  {-1, -1, 0, 1}, {-1, 1, 0, 1}, {1, -1, 0, 1}};
    scene_of_triangles(&test, WIDTH, HEIGHT, p, 4);
    assert_near(count(ZR_COST_FRAGMENT), PIXELS);
    test.material.double_sided = false;
    assert_near(count(ZR_COST_FRAGMENT), PIXELS / 2);
    const zr_vec4 odd[] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 1}, {NAN, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    scene_of_triangles(&test, WIDTH, HEIGHT, odd, 2);
    assert_true(isfinite(scene_cost(&test.scene).ms));
}

TEST(samples_lamps_shadows_and_effects_are_counted)
{
    static const struct zr_light lights[3] = {
        {.type = ZR_LIGHT_DIRECTIONAL, .direction = {0, 0, -1}, .has_shadows = true},
        {.type = ZR_LIGHT_POINT, .position = {0, 0, 1}},
        {.type = ZR_LIGHT_HEMISPHERE, .direction = {0, 1, 0}}};
    half_a_window();
    test.material.shading = ZR_SHADING_PBR;
    test.scene.lights = lights;
    test.scene.light_count = 3;
    test.picture.is_linear = true;
    test.picture.side = 4;
    test.picture.occlusion.is_on = true;
    test.picture.edges = (struct zr_edges){.is_on = true, .width = 2};
    const double samples = 16.0 * PIXELS / 2, lit = 2.0 * PIXELS / 2; /* surfaces, lit once in a pixel */
    const struct zr_cost cost = scene_cost(&test.scene);
    assert_near(cost.counts[ZR_COST_FRAGMENT], samples + PIXELS / 2); /* with a pass for occlusion */
    assert_near(cost.counts[ZR_COST_WINDOW_SAMPLE], 16 * PIXELS);
    assert_near(cost.counts[ZR_COST_LIT_SAMPLE], lit);
    assert_near(cost.counts[ZR_COST_LAMP_SAMPLE], 3 * lit);
    assert_near(cost.counts[ZR_COST_PLACED_LAMP_SAMPLE], lit);
    assert_near(cost.counts[ZR_COST_SHADOW_SAMPLE], lit);
    assert_near(cost.counts[ZR_COST_OCCLUSION_PIXEL], PIXELS / 2);
    assert_near(cost.counts[ZR_COST_EDGE_WIDTH_SAMPLE], 0.6 * 4 * 16 * PIXELS); /* lines of small windows are thinner */
    assert_near(cost.counts[ZR_COST_MAP_TEXEL], 1024 * 1024);
    assert_true(cost.lamp_maps == 1 && cost.lamp_map_bytes >= 2 * 4 * 1024 * 1024);
}

TEST(lines_of_the_mesh_are_counted)
{
    half_a_window();
    test.material.shading = ZR_SHADING_PBR;
    test.picture.is_linear = true;
    test.picture.side = 4;
    test.picture.edges = (struct zr_edges){.is_on = true, .width = 2};
    const struct zr_cost of_samples = scene_cost(&test.scene);
    test.picture.edges.is_from_mesh = true;
    const struct zr_cost of_mesh = scene_cost(&test.scene);
    assert_near(of_mesh.counts[ZR_COST_DRAWN_TRIANGLE], of_mesh.counts[ZR_COST_NORMAL]);
    assert_near(of_mesh.counts[ZR_COST_DRAWN_PIXEL], FINE_PIXELS / 2);
    assert_true(of_mesh.counts[ZR_COST_EDGE_SAMPLE] == 0 && of_mesh.counts[ZR_COST_EDGE_WIDTH_SAMPLE] == 0);
    assert_true(of_mesh.window_bytes < of_samples.window_bytes);
}

TEST(triangles_of_one_cell_are_counted_in_pairs)
{
    half_a_window();
    test.picture.is_linear = true;
    test.picture.edges = (struct zr_edges){.is_on = true, .is_from_mesh = true};
    const double cells = FINE_PIXELS / 4 / 256.0 + 1,
                 across = (WIDTH / 2 + HEIGHT) * sqrt(FINE_PIXELS / (double)PIXELS);
    const double of_face = fmin(1 + FINE_PIXELS / 4 / 256.0 + across / 16.0, cells);
    assert_near(count(ZR_COST_DRAWN_PAIR), 4 * of_face * of_face / cells);
    test.picture.edges.is_from_mesh = false;
    assert_true(count(ZR_COST_DRAWN_PAIR) == 0);
}

/* Upright needles through half of the window, in the cells of half of the fine window's rows. */
TEST(narrow_triangles_are_counted_along_their_cells)
{
    enum { COUNT = 50 };
    zr_vec4 needles[3 * COUNT];
    for (int i = 0; i < COUNT; i++) {
        const float x = -0.9f + 0.03f * (float)i;
        needles[3 * i] = (zr_vec4){x, -0.5f, 0, 1};
        needles[3 * i + 1] = (zr_vec4){x + 0.001f, -0.5f, 0, 1};
        needles[3 * i + 2] = (zr_vec4){x, 0.5f, 0, 1};
    }
    half_a_window();
    test.picture.is_linear = true;
    test.picture.edges = (struct zr_edges){.is_on = true, .is_from_mesh = true};
    assert_near(count(ZR_COST_DRAWN_NARROW), 0);
    scene_of_triangles(&test, WIDTH, HEIGHT, needles, COUNT);
    test.picture = (struct zr_picture){.side = 1, .line_width = 1, .is_linear = true, .exposure = 1};
    test.picture.edges = (struct zr_edges){.is_on = true, .is_from_mesh = true};
    const double cells = COUNT * 0.5 * HEIGHT * sqrt(FINE_PIXELS / PIXELS) / 16, counted = count(ZR_COST_DRAWN_NARROW);
    if (!(counted > 0.5 * cells && counted < cells)) fail_msg("%g counted, of %g", counted, cells);
}

TEST(a_file_of_lines_is_counted_without_samples)
{
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_SVG},
                                               {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG}};
    half_a_window();
    test.picture.is_linear = true;
    test.picture.side = 4;
    test.picture.edges = (struct zr_edges){.is_on = true, .is_from_mesh = true};
    test.scene.views[0].outputs = outputs;
    const struct zr_cost of_file = scene_cost(&test.scene);
    assert_near(of_file.counts[ZR_COST_DRAWN_TRIANGLE], 2);
    assert_near(of_file.counts[ZR_COST_DRAWN_PIXEL], FINE_PIXELS / 2);
    assert_true(of_file.counts[ZR_COST_WINDOW_SAMPLE] == 0 && of_file.counts[ZR_COST_PNG_PIXEL] == 0);
    test.scene.views[0].output_count = 2;
    const struct zr_cost of_both = scene_cost(&test.scene);
    assert_near(of_both.counts[ZR_COST_DRAWN_TRIANGLE], 4);
    assert_near(of_both.counts[ZR_COST_DRAWN_PIXEL], FINE_PIXELS);
    assert_near(of_both.counts[ZR_COST_WINDOW_SAMPLE], 16 * PIXELS);
}

TEST(tries_of_qualities_are_counted)
{
    static struct zr_output output;
    static const struct {
        struct zr_output output;
        enum zr_cost_kind kind;
        double count;
    } cases[] = {{{.encoding = ZR_ENCODING_JPEG}, ZR_COST_JPEG_PIXEL, PIXELS},
                 {{.encoding = ZR_ENCODING_JPEG, .max_bytes = 9}, ZR_COST_JPEG_PIXEL, 6 * PIXELS},
                 {{.encoding = ZR_ENCODING_WEBP, .max_bytes = 9}, ZR_COST_WEBP_PIXEL, 6 * PIXELS},
                 {{.encoding = ZR_ENCODING_WEBP, .is_lossless = true}, ZR_COST_LOSSLESS_WEBP_PIXEL, PIXELS}};
    half_a_window();
    test.scene.views[0].outputs = &output;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        output = cases[i].output;
        const struct zr_cost cost = scene_cost(&test.scene);
        assert_near(cost.counts[cases[i].kind], cases[i].count);
        assert_near(cost.counts[ZR_COST_PNG_PIXEL], 0);
    }
}

/* By the textbook lamps light faces, vertices, or pixels. */
TEST(lamps_of_the_textbook_are_counted)
{
    static struct zr_light lamps[1024];
    static const struct {
        enum zr_shading shading;
        enum zr_cost_kind kind;
        double count;
    } cases[] = {{ZR_SHADING_FLAT, ZR_COST_VERTEX_PLACED_LAMP, 2.0 * 1024},
                 {ZR_SHADING_GOURAUD, ZR_COST_VERTEX_PLACED_LAMP, 6.0 * 1024},
                 {ZR_SHADING_PHONG, ZR_COST_PLACED_LAMP_SAMPLE, 0.2 * PIXELS / 2 * 1024.0}};
    half_a_window();
    for (int i = 0; i < 1024; i++)
        lamps[i].type = ZR_LIGHT_POINT;
    test.scene.lights = lamps;
    test.scene.light_count = 1024;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        test.material.shading = cases[i].shading;
        assert_near(count(cases[i].kind), cases[i].count);
    }
}

TEST(see_through_faces_and_points_are_counted)
{
    enum { POINTS = 300 };
    static zr_vec4 middles[POINTS];
    static uint32_t all[POINTS];
    half_a_window();
    test.material.alpha_mode = ZR_ALPHA_BLEND;
    assert_near(count(ZR_COST_LAYER), PIXELS / 2);
    for (uint32_t i = 0; i < POINTS; i++) {
        middles[i] = (zr_vec4){0, 0, 0, 1};
        all[i] = i;
    }
    test.mesh.positions = middles;
    test.mesh.position_count = POINTS;
    test.mesh.face_count = 0;
    test.mesh.points = all;
    test.mesh.point_count = POINTS;
    test.mesh.point_size = 64.0f;
    assert_near(count(ZR_COST_LINE_FRAGMENT), (double)POINTS * 64 * 64);
    assert_true(count(ZR_COST_LAYER) >= (double)POINTS * 64 * 64);
}

/* Of 4096 triangles, every so many-th large, about a quarter is looked at. */
TEST(sample_is_near_the_truth)
{
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    const zr_vec4 large[3] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    for (int every = 2; every <= 8; every++) {
        double truth = 0;
        for (int t = 0; t < TEST_TRIANGLES_MAX; t++) {
            const float size = t % every == 0 ? 1.0f : 0.01f;
            for (int k = 0; k < 3; k++)
                p[3 * t + k] = (zr_vec4){large[k].x * size, large[k].y * size, 0, 1};
            truth += (double)size * (double)size * PIXELS / 2;
        }
        scene_of_triangles(&test, WIDTH, HEIGHT, p, TEST_TRIANGLES_MAX);
        assert_true(fabs(count(ZR_COST_FRAGMENT) / truth - 1) < 0.25);
    }
}

/* A polygon of 2000 corners over the window; its edges cross half of the rows. */
TEST(corners_are_counted_in_a_trace)
{
    enum { CORNERS = 2000, SIDE = 64 };
    static const struct zr_output trace = {.channel = ZR_CHANNEL_TRACE, .encoding = ZR_ENCODING_JSON};
    static zr_vec4 p[CORNERS];
    for (uint32_t i = 0; i < CORNERS; i++) /* teeth */
        p[i] = (zr_vec4){-1 + 2 * (float)i / CORNERS, i == 0 || i + 1 == CORNERS ? -1 : i % 2 ? 1 : -0.9f, 0, 1};
    scene_of_polygon(&test, SIDE, SIDE, p, CORNERS);
    assert_true(count(ZR_COST_TRACED_EDGE) == 0 && count(ZR_COST_TRACED_SHAPE) == 0);
    test.scene.views[0].outputs = &trace;
    test.scene.views[0].output_count = 1;
    const struct zr_cost cost = scene_cost(&test.scene);
    assert_near(cost.counts[ZR_COST_TRACED_EDGE], CORNERS * SIDE / 2);
    assert_true(cost.counts[ZR_COST_TRACED_SHAPE] == cost.counts[ZR_COST_SHAPE_SAMPLE] / 2);
    test.scene.algorithm = ZR_ALGORITHM_SCANLINE;
    assert_true(count(ZR_COST_TRACED_SHAPE) == cost.counts[ZR_COST_SHAPE_SAMPLE]);
    assert_near(count(ZR_COST_TRACED_EDGE), CORNERS * SIDE / 2 + 2.0 * cost.counts[ZR_COST_TRACED_PIXEL]);
}

/* 64 faces over half of the window: each two are compared, again after each cut, up to the bound of steps. */
TEST(comparisons_are_counted_in_a_trace_of_the_painter)
{
    static const struct zr_output trace = {.channel = ZR_CHANNEL_TRACE, .encoding = ZR_ENCODING_JSON};
    static zr_vec4 p[3 * 64];
    for (int i = 0; i < 3 * 64; i++)
        p[i] = half[i % 3];
    for (int faces = 2; faces <= 64; faces *= 2) {
        scene_of_triangles(&test, 64, 64, p, (uint32_t)faces);
        test.scene.views[0].outputs = &trace;
        test.scene.views[0].output_count = 1;
        assert_true(count(ZR_COST_TRACED_COMPARISON) == 0);
        test.scene.algorithm = ZR_ALGORITHM_PAINTER;
        const double pairs = 0.5 * faces * faces;
        assert_near(count(ZR_COST_TRACED_COMPARISON), 64 * 64 / 4 * fmin(pairs * fmax(faces / 6.0, 1.0), 20000));
    }
}

/* Faces with two materials in turn are drawn one by one. */
TEST(changes_of_the_material_are_counted)
{
    static uint32_t materials[TEST_TRIANGLES_MAX];
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX];
    for (int i = 0; i < 3 * TEST_TRIANGLES_MAX; i++)
        p[i] = half[i % 3];
    for (int every = 1; every <= 4; every *= 2) {
        scene_of_triangles(&test, WIDTH, HEIGHT, p, TEST_TRIANGLES_MAX);
        const struct zr_material both[2] = {test.material, test.material};
        test.scene.materials = both;
        test.scene.material_count = 2;
        assert_near(count(ZR_COST_RUN), 0);
        for (uint32_t t = 0; t < TEST_TRIANGLES_MAX; t++)
            materials[t] = t / (uint32_t)every % 2;
        test.mesh.face_materials = materials;
        assert_true(fabs(count(ZR_COST_RUN) * every / TEST_TRIANGLES_MAX - 1) < 0.25);
        test.mesh.face_materials = NULL;
    }
}

TEST(predicted_memory_is_held)
{
    enum { LAYERS = 300 };
    static zr_vec4 many[3 * TEST_TRIANGLES_MAX];
    for (int i = 0; i < 3 * TEST_TRIANGLES_MAX; i++) { /* most are small */
        const float size = i / 3 < LAYERS ? 1.0f : 0.002f;
        many[i] = (zr_vec4){i % 3 == 1 ? size : -size, i % 3 == 2 ? size : -size, 0, 1};
    }
    for (int i = 0; i < 24; i++) {
        struct zr_arena arena;
        half_a_window();
        test.scene.views[0].width = 256;
        test.scene.views[0].height = 256;
        test.scene.algorithm = i & 1 ? ZR_ALGORITHM_SCANLINE : ZR_ALGORITHM_HALFSPACE;
        test.picture.side = i & 2 ? 2 : 1;
        test.picture.is_linear = i & 4;
        test.picture.occlusion = (struct zr_occlusion){i & 4, 0.2f, 2};
        test.picture.edges = (struct zr_edges){
            .is_on = i & 4, .width = 1.5f, .crease_degrees = 30, .silhouette_opacity = 1, .crease_opacity = 1};
        if (i >= 8) {
            scene_of_triangles(&test, 256, 256, many, i >= 16 ? TEST_TRIANGLES_MAX : LAYERS);
            test.scene.algorithm = i & 1 ? ZR_ALGORITHM_EDGELIST : ZR_ALGORITHM_HALFSPACE;
            test.material.alpha_mode = ZR_ALPHA_BLEND;
        }
        const double predicted = scene_cost(&test.scene).window_bytes;
        zr_arena_init(&arena, (size_t)1 << 30);
        scene_render(&arena, NULL, &test.scene);
        if (predicted > (double)arena.peak) fail_msg("case %d: %.0f bytes, %zu held", i, predicted, arena.peak);
        if (i < 16 && predicted < 0.5 * (double)arena.peak)
            fail_msg("case %d: %.0f bytes alone, %zu held", i, predicted, arena.peak);
        zr_arena_free(&arena);
    }
}

TEST(glass_that_refracts_is_predicted_with_its_backdrop)
{
    struct zr_arena arena;
    for (int i = 0; i < 2; i++) {
        half_a_window();
        test.picture.is_linear = true;
        test.scene.background = (zr_vec4){1, 1, 1, 1};
        test.material.shading = ZR_SHADING_PBR;
        test.material.roughness = i == 0 ? 0.0f : 0.5f;
        test.material.finish = (struct zr_finish){.transmission = 1, .ior = 1.5f, .attenuation = {1, 1, 1}};
        test.scene.views[0].width = test.scene.views[0].height = 512;
        assert_near(count(ZR_COST_LAYER), (1 + i) * 512 * 512 / 2);
        const double predicted = scene_cost(&test.scene).window_bytes;
        zr_arena_init(&arena, (size_t)1 << 30);
        scene_render(&arena, NULL, &test.scene);
        if (!(predicted <= (double)arena.peak && predicted >= 0.5 * (double)arena.peak))
            fail_msg("%.0f bytes, %zu held", predicted, arena.peak);
        zr_arena_free(&arena);
    }
}

/* Arrays of large windows have blocks of their own, whose free ends are held as well: a few huge pages. */
TEST(memory_of_large_windows_with_lines_of_the_mesh_is_nearly_all_predicted)
{
    static const uint32_t widths[] = {1021, 1531, 2048};
    for (int i = 0; i < 3; i++) {
        struct zr_arena arena;
        half_a_window();
        test.scene.views[0].width = widths[i];
        test.scene.views[0].height = 1024;
        test.picture.is_linear = true;
        test.picture.occlusion = (struct zr_occlusion){true, 0.2f, 2};
        test.picture.edges = (struct zr_edges){
            .is_on = true, .is_from_mesh = true, .width = 1, .crease_degrees = 30, .silhouette_opacity = 1};
        const double predicted = scene_cost(&test.scene).window_bytes;
        zr_arena_init(&arena, (size_t)1 << 30);
        scene_render(&arena, NULL, &test.scene);
        const double share = predicted / (double)arena.most, ends = 3.0 * ZR_ARENA_BLOCK;
        if (!(share <= 1.0 && predicted + ends > 0.95 * (double)arena.most))
            fail_msg("width %u: %.0f bytes, %zu held", widths[i], predicted, arena.most);
        zr_arena_free(&arena);
    }
}

RUN_TESTS(NULL, NULL)
