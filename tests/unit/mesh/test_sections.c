/* Scenes cut open by planes: ids, areas, facts and treatment of parts. */
#include "sections/sections.h"

#include <math.h>

#include "base/run.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

static struct random random_state = {{RANDOM_STATE_1}};

/* A solid seen by a fitted camera. */
static struct test_scene test;

static void begin(enum solid solid, uint32_t side)
{
    static const zr_vec4 unused[3];
    scene_of_triangles(&test, side, side, unused, 1);
    test.mesh = solid_make(&arena, solid);
    struct zr_view *view = &test.scene.views[0];
    view->pose = ZR_POSE_DIRECTION;
    view->up = (zr_vec3){0.1f, 1, 0};
    view->projection = ZR_PROJECTION_ORTHOGRAPHIC;
}

static void random_view(int round)
{
    struct zr_view *view = &test.scene.views[0];
    view->direction = (zr_vec3){(float)random_range(&random_state, -1, 1), (float)random_range(&random_state, -1, 1),
                                (float)random_range(&random_state, -1, 1)};
    view->projection = round % 2 ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    view->yfov_radians = round % 2 ? 0.6f : 0.0f;
}

/* ---- ids ---- */

/* Behind the plane, the cut scene shows the faces of the whole one, or more of them. */
TEST_AROUND(kept_faces_keep_their_ids_and_depths, open_arena, close_arena)
{
    begin(SOLID_TORUS, 64);
    test.scene.views[0].direction = (zr_vec3){-0.3f, -0.4f, -1};
    const struct zr_frame *whole = scene_render(&arena, NULL, &test.scene);
    struct zr_view *view = &test.scene.views[0]; /* fitted to the whole */
    view->pose = ZR_POSE_MATRIX;
    view->world_to_camera = whole->camera.world_to_eye;
    view->xmag = 1.0f / whole->camera.projection.m[0];
    view->ymag = 1.0f / whole->camera.projection.m[5];
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = (struct zr_section){.normal = {0.2, 0.3, 1}, .point = {0, 0, 0.1}};
    const struct zr_frame *cut = scene_render(&arena, NULL, &test.scene);
    uint32_t same = 0, caps_seen = 0, others = 0;
    for (uint32_t i = 0; i < 64 * 64; i++) {
        if (cut->face_id[i] == 0) continue;
        assert_true(whole->face_id[i] != 0 && cut->depth[i] >= whole->depth[i] - 1e-5f);
        if (cut->face_id[i] > test.mesh.face_count)
            caps_seen++;
        else if (cut->face_id[i] == whole->face_id[i] && fabsf(cut->depth[i] - whole->depth[i]) < 1e-5f)
            same++;
        else
            others++;
    }
    assert_true(same > 100 && caps_seen > 20 && others < 100);
    assert_memory_equal(&whole->camera.world_to_eye, &cut->camera.world_to_eye, sizeof cut->camera.world_to_eye);
}

TEST_AROUND(all_algorithms_and_teams_draw_the_same_caps, open_arena, close_arena)
{
    begin(SOLID_OVERLAPPING, 64);
    random_view(1);
    struct zr_sections *sections = &test.scene.sections;
    sections->count = 2;
    sections->is_corner = sections->has_hatch = true;
    sections->planes[0] = (struct zr_section){.normal = {1, 0, 0}, .point = {0.3, 0, 0}};
    sections->planes[1] = (struct zr_section){.normal = {0, 1, 0.5}, .has_fraction = false};
    const struct zr_frame *first = scene_render(&arena, NULL, &test.scene);
    for (int algorithm = 0; algorithm < ZR_ALGORITHM_COUNT; algorithm++) {
        test.scene.algorithm = (enum zr_algorithm)algorithm;
        const struct zr_frame *other = scene_render(&arena, NULL, &test.scene);
        assert_memory_equal(other->face_id, first->face_id, 64 * 64 * sizeof *first->face_id);
        assert_memory_equal(other->window_depth, first->window_depth, 64 * 64 * sizeof *first->window_depth);
        assert_memory_equal(other->color, first->color, (size_t)64 * 64 * 4);
    }
}

/* ---- facts ---- */

static double cap_area(enum solid solid, const struct zr_section *plane)
{
    begin(solid, 8);
    test.scene.views[0].direction = (zr_vec3){-1, -0.5f, -0.75f};
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = *plane;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    double area = 0.0;
    for (uint32_t i = 0; i < frame->sections->cap_count; i++)
        area += frame->sections->caps[i].area;
    return area;
}

TEST_AROUND(caps_have_the_areas_of_formulas, open_arena, close_arena)
{
    static const struct {
        enum solid solid;
        struct zr_section plane;
        double area;
    } cases[] = {{SOLID_CUBE, {.normal = {1, 0, 0}, .has_fraction = true, .fraction = 0.25}, 4},
                 {SOLID_CUBE, {.normal = {1, 1, 1}}, 6 * 0.8660254037844386}, /* a hexagon of side sqrt(2) */
                 {SOLID_HOLLOW, {.normal = {0, 0, 2}}, 4 - 1.1 * 0.9},
                 {SOLID_PLATE, {.normal = {0, 0, 1}}, 4 - 0.6 * 1.2 - 0.6 * 1.2},
                 {SOLID_PLATE, {.normal = {0, 1, 0}}, 2 * 0.5 - 0.5 * 0.6 - 0.5 * 0.6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double area = cap_area(cases[i].solid, &cases[i].plane);
        if (fabs(area - cases[i].area) > 1e-6) fail_msg("case %zu: %.9g, not %.9g", i, area, cases[i].area);
    }
}

/* Two boxes of 1 x 1 x 1 in one part, the second from x on; turned: inside out. */
TEST_AROUND(areas_of_caps_count_what_is_inside_once, open_arena, close_arena)
{
    static const struct {
        float x;
        bool is_turned;
        double area;
    } cases[] = {{0.5f, false, 1.5}, {3, false, 2}, {1, false, 2}, {3, true, 2}, {0, false, 1}, {0.25f, false, 1.25}};
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    static const struct zr_section planes[] = {{.normal = {0, 0, 1}, .point = {0, 0, 0.5}},
                                               {.normal = {0, 1, 0}, .point = {0, 0.25, 0}}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        zr_vec4 positions[16];
        uint32_t indices[48], offsets[13];
        const float x = cases[i / 2].x;
        begin(SOLID_CUBE, 8);
        for (int k = 0; k < 16; k++)
            positions[k] = (zr_vec4){(k < 8 ? 0 : x) + (float)(k & 1), (float)(k >> 1 & 1), (float)(k >> 2 & 1), 1};
        for (uint32_t k = 0; k <= 12; k++)
            offsets[k] = 4 * k;
        for (uint32_t k = 0; k < 48; k++)
            indices[k] = k < 24                   ? faces[k / 4][k % 4]
                         : cases[i / 2].is_turned ? 8 + faces[k / 4 - 6][3 - k % 4]
                                                  : 8 + faces[k / 4 - 6][k % 4];
        test.mesh.positions = positions;
        test.mesh.position_count = 16;
        test.mesh.face_count = 12;
        test.mesh.face_offsets = offsets;
        test.mesh.indices = indices;
        test.scene.views[0].direction = (zr_vec3){-1, -0.5f, -0.75f};
        test.scene.sections.count = 1;
        test.scene.sections.planes[0] = planes[i % 2];
        const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
        assert_int_equal(frame->sections->cap_count, 1);
        const double area = frame->sections->caps[0].area;
        if (fabs(area - cases[i / 2].area) > 1e-5) fail_msg("case %zu: %.9g, not %.9g", i, area, cases[i / 2].area);
    }
}

TEST_AROUND(info_has_areas_of_caps_and_counts_their_pixels, open_arena, close_arena)
{
    begin(SOLID_HOLLOW, 32);
    test.scene.views[0].direction = (zr_vec3){-1, -0.5f, -0.75f};
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = (struct zr_section){.normal = {1, 0, 0}};
    test.outputs[1] = (struct zr_output){.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    uint64_t covered = 0;
    for (uint32_t i = 0; i < 32 * 32; i++)
        covered += frame->face_id[i] != 0;
    assert_int_equal(frame->parts.pixels[0], covered);
    assert_true(fabs(frame->parts.cap_areas[0] - (4 - 0.9 * 0.7)) < 1e-6);
    test.scene.views[0].output_count = 1;
    test.scene.views[0].outputs = &test.outputs[1];
    const struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_non_null(memmem(answer.bytes, answer.size, "\"capArea\":3.3", strlen("\"capArea\":3.3")));
}

/* Facts of parts and meshes are those of the whole scene. Counts are of what is drawn: pieces of faces, and caps. */
TEST_AROUND(facts_are_those_of_the_whole_scene_and_counts_those_of_the_cut_one, open_arena, close_arena)
{
    const struct zr_frame *frames[2];
    begin(SOLID_CUBE, 32);
    test.scene.views[0].direction = (zr_vec3){-1, -0.5f, -0.75f};
    test.outputs[1] = (struct zr_output){.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    test.scene.sections.planes[0] = (struct zr_section){.normal = {1, 0, 0}, .point = {0.5, 0, 0}};
    for (uint32_t i = 0; i < 2; i++) {
        test.scene.sections.count = i;
        frames[i] = scene_render(&arena, NULL, &test.scene);
        assert_true(fabs(frames[i]->parts.facts[0].volume - 8) < 1e-6);
        assert_true(fabs(frames[i]->parts.facts[0].area - 24) < 1e-6);
        assert_int_equal(frames[i]->parts.facts[0].triangles, 12);
        assert_true(frames[i]->parts.facts[0].max.x == 1.0f && frames[i]->bounds.max.x == 1.0f);
    }
    assert_int_equal(frames[0]->counts.polygons, 6);
    assert_int_equal(frames[1]->counts.polygons, 6); /* without the face at x = 1, with the cap */
    assert_int_equal(frames[1]->counts.concave_polygons, 1);
}

/* ---- parts ---- */

static struct zr_error render_error(void)
{
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, &frame),
                     ZR_BAD_SCENE);
    return error;
}

TEST_AROUND(parts_that_are_not_closed_have_no_caps_and_a_warning, open_arena, close_arena)
{
    begin(SOLID_CUBE, 16);
    random_view(0);
    test.mesh.face_count--;
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = (struct zr_section){.normal = {1, 0.5, 0.25}};
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    assert_int_equal(frame->sections->cap_count, 0);
    assert_string_equal(frame->sections->warning, "the part solid is cut, but has no cap, since it is not closed");
    test.scene.is_strict = true;
    assert_string_equal(render_error().items[0].detail, frame->sections->warning);
}

TEST_AROUND(named_parts_stay_whole, open_arena, close_arena)
{
    static const char *const names[] = {"solid"}, *const unknown[] = {"bolt"};
    begin(SOLID_CUBE, 16);
    random_view(0);
    struct zr_instance two[2] = {test.instance, test.instance};
    two[1].object_to_world.m[12] = 3;
    test.scene.instances = two;
    test.scene.instance_count = 2;
    test.scene.sections.count = 1;
    test.scene.sections.planes[0] = (struct zr_section){.normal = {0, 1, 0}};
    assert_int_equal(scene_render(&arena, NULL, &test.scene)->sections->cap_count, 2);
    test.scene.sections.uncut_count = 1;
    test.scene.sections.uncut = names;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    assert_int_equal(frame->sections->cap_count, 1);
    assert_int_equal(frame->sections->caps[0].instance, 1);
    test.scene.sections.uncut = unknown;
    const struct zr_error error = render_error();
    assert_string_equal(error.items[0].pointer, "/sections/uncut/0");
    assert_string_equal(error.items[0].detail, "the scene has no part \"bolt\"; the first is \"solid\"");
}

TEST_AROUND(planes_beside_the_scene_or_seen_edge_on_are_refused, open_arena, close_arena)
{
    begin(SOLID_CUBE, 16);
    test.scene.views[0].direction = (zr_vec3){0, 0, -1};
    test.scene.sections.count = 2;
    test.scene.sections.planes[0] = (struct zr_section){.normal = {0, 0, 1}};
    test.scene.sections.planes[1] = (struct zr_section){.normal = {0, 0, 2}, .point = {0, 0, 1.5}};
    struct zr_error error = render_error();
    assert_string_equal(error.items[0].pointer, "/sections/planes/1");
    assert_string_equal(error.items[0].detail,
                        "the plane does not meet the scene: distances along its normal are -2.5 to -0.5");
    test.scene.sections.planes[1] = (struct zr_section){.normal = {1, 0, 0}};
    error = render_error();
    assert_string_equal(error.items[0].pointer, "/sections/planes/1");
    assert_string_equal(error.items[0].detail, "the camera sees the plane edge-on, so neither side is far: keep "
                                               "\"positive\" or \"negative\"");
    test.scene.sections.planes[1].keep = ZR_SECTION_KEEP_NEGATIVE;
    assert_int_equal(scene_render(&arena, NULL, &test.scene)->sections->cap_count, 2);
}

RUN_TESTS(NULL, NULL)
