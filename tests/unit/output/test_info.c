/* The channel info of scenes: what it lists, and the memory that it takes. */
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "output/info.h"
#include "render/frame_parts.h"
#include "support/scenes.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 27)
static const struct zr_output info_output = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};

static struct zr_answer info_of(struct test_scene *test)
{
    test->scene.views[0].outputs = &info_output;
    test->scene.views[0].output_count = 1;
    return scene_encode(&arena, NULL, &test->scene);
}

TEST_AROUND(info_counts_pixels_and_boxes_and_warns, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}, {5, 5, 0, 1}, {6, 5, 0, 1}, {5, 6, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 2);
    const char *const warnings[] = {"something odd"};
    test.scene.warnings = warnings;
    test.scene.warning_count = 1;
    struct zr_answer answer = info_of(&test);
    assert_string_equal(answer.content_type, "application/json");
    assert_string_equal(answer.warnings, "something odd");
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    cJSON *face = cJSON_GetObjectItem(info, "faces")->child, *box = cJSON_GetObjectItem(face, "box");
    assert_null(face->next); /* the other one is outside */
    assert_true(cJSON_GetObjectItem(face, "id")->valuedouble == 1);
    assert_true(cJSON_GetObjectItem(face, "pixels")->valuedouble == 28); /* of 8 x 8, half without the diagonal */
    const double want[4] = {0, 1, 7, 8};
    for (int i = 0; i < 4; i++)
        assert_true(cJSON_GetArrayItem(box, i)->valuedouble == want[i]);
    assert_true(cJSON_GetObjectItem(info, "rules")->valuedouble == 3);
    assert_true(cJSON_GetObjectItem(info, "backgroundPixels")->valuedouble == 256 - 28);
    assert_true(cJSON_GetObjectItem(cJSON_GetObjectItem(info, "counts"), "outside")->valuedouble == 1);
    cJSON_Delete(info);
}

TEST_AROUND(info_has_the_origin_in_double_precision, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static const double origin[] = {408205.123456789, -4080925, 0.1};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    assert_null(strstr(info_of(&test).bytes, "\"origin\""));
    test.scene.origin = origin;
    assert_non_null(strstr(info_of(&test).bytes, "\"origin\":[408205.123456789,-4080925,0.1],"));
}

TEST_AROUND(info_has_the_least_wall_of_closed_parts, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    const struct zr_mesh cube = solid_make(&arena, SOLID_CUBE);
    test.scene.meshes = &cube;
    const struct zr_answer answer = info_of(&test);
    static const char keys[] = "\"leastWall\":2,\"leastWallAt\":[";
    const char *found = strstr(answer.bytes, keys);
    double at[3];
    assert_non_null(found);
    assert_int_equal(sscanf(found + strlen(keys), "%lf,%lf,%lf", &at[0], &at[1], &at[2]), 3);
    assert_true(at[0] == 0.0 || at[1] == 0.0 || at[2] == 0.0); /* half way between two faces */
}

TEST_AROUND(info_has_the_features_of_parts_if_asked, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    const struct zr_mesh cube = solid_make(&arena, SOLID_CUBE);
    test.scene.meshes = &cube;
    assert_null(strstr(info_of(&test).bytes, "\"features\""));
    test.scene.has_features = true;
    const struct zr_answer answer = info_of(&test);
    assert_non_null(strstr(answer.bytes, "\"features\":{\"holes\":[],\"bosses\":[],\"fillets\":[],\"rounds\":[],"
                                         "\"planes\":[{\"normal\":["));
    assert_non_null(strstr(answer.bytes, "\"offset\":1,\"area\":4}],\"boundingCylinder\":{\"diameter\":2.82842"));
    assert_non_null(strstr(answer.bytes, "\"turn\":[{\"axis\":[1,0,0],\"at\":[0,0,0],\"order\":4},"));
}

TEST_AROUND(nothing_seen_says_why, open_arena, close_arena)
{
    static const struct {
        zr_vec4 p[3];
        const char *warning;
    } cases[] = {
        {{{0, 0, 0, 1}, {0.1f, 0.2f, 0.3f, 1}, {0.2f, 0.4f, 0.6f, 1}},
         "nothing is visible: the corners of each polygon are collinear"},
        {{{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0.25f, 0, 0.5f, 1}}, "nothing is visible: the polygons in view are edge-on"},
        {{{5, 5, 0, 1}, {6, 5, 0, 1}, {5, 6, 0, 1}}, "nothing is visible: all geometry is outside the view"},
        {{{0.02f, 0.02f, 0, 1}, {0.03f, 0.02f, 0, 1}, {0.02f, 0.03f, 0, 1}}, "nothing is visible: no pixel is covered"},
        {{{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0, 0.5f, 0, 1}}, ""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        static struct test_scene test;
        scene_of_triangles(&test, 16, 16, cases[i].p, 1);
        const struct zr_answer answer = info_of(&test);
        if (*cases[i].warning ? !strstr(answer.warnings, cases[i].warning) : *answer.warnings != '\0')
            fail_msg("case %zu: %s", i, answer.warnings);
    }
}

TEST_AROUND(room_that_a_fitted_view_leaves_for_rounding_is_warned_of, open_arena, close_arena)
{
    static struct test_scene test;
    for (int i = 0; i < 2; i++) {
        const float x = i ? 500000.0f : 5.0f;
        const zr_vec4 p[] = {{x, 0, 0, 1}, {x + 4, 0, 0, 1}, {x, 4, 0, 1}};
        scene_of_triangles(&test, 16, 16, p, 1);
        scene_look(&test.scene, (struct zr_view){.preset = ZR_PRESET_FRONT, .projection = ZR_PROJECTION_ORTHOGRAPHIC});
        const struct zr_answer answer = info_of(&test);
        assert_int_equal(strstr(answer.warnings, "small and far from the origin: rounding may move it by 0.17") != NULL,
                         i == 1);
    }
}

TEST_AROUND(info_names_meshes_and_the_nodes_that_place_them, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    struct zr_instance instances[2];
    scene_of_triangles(&test, 16, 16, p, 1);
    instances[0] = instances[1] = test.instance;
    instances[1].node = "wheel";
    test.scene.instances = instances;
    test.scene.instance_count = 2;
    const struct zr_answer answer = info_of(&test);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size), *mesh = cJSON_GetObjectItem(info, "meshes")->child;
    assert_string_equal(cJSON_GetObjectItem(mesh, "name")->valuestring, "test");
    assert_null(cJSON_GetObjectItem(mesh, "node"));
    assert_string_equal(cJSON_GetObjectItem(mesh->next, "name")->valuestring, "test");
    assert_string_equal(cJSON_GetObjectItem(mesh->next, "node")->valuestring, "wheel");
    cJSON_Delete(info);
}

/* Of meshes and nodes: as they are, so that a reader finds what he wrote. */
TEST_AROUND(names_in_info_keep_quotes_and_utf8, open_arena, close_arena)
{
    static const char quoted[] = "a \"b\" \\ \n c", greek[] = "\xce\xbb \xf0\x9f\x90\xb0"; /* lambda, rabbit */
    static const struct {
        const char *name, *node;
    } cases[] = {{quoted, greek}, {greek, quoted}, {"", quoted}, {greek, NULL}, {"", NULL}};
    enum { PLACED = sizeof cases / sizeof cases[0] };
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    struct zr_mesh meshes[PLACED];
    struct zr_instance instances[PLACED];
    scene_of_triangles(&test, 16, 16, p, 1);
    for (uint32_t i = 0; i < PLACED; i++) {
        meshes[i] = test.mesh;
        meshes[i].name = cases[i].name;
        instances[i] = test.instance;
        instances[i].mesh = i;
        instances[i].node = cases[i].node;
    }
    test.scene.meshes = meshes;
    test.scene.mesh_count = PLACED;
    test.scene.instances = instances;
    test.scene.instance_count = PLACED;
    const struct zr_answer answer = info_of(&test);
    assert_non_null(memmem(answer.bytes, answer.size, "\"a \\\"b\\\" \\\\ \\n c\"", 17));
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    const cJSON *mesh = cJSON_GetObjectItem(info, "meshes")->child;
    for (size_t i = 0; i < PLACED; i++, mesh = mesh->next) {
        const cJSON *name = cJSON_GetObjectItem(mesh, "name"), *node = cJSON_GetObjectItem(mesh, "node");
        assert_non_null(name);
        assert_string_equal(name->valuestring, cases[i].name);
        assert_int_equal(node != NULL, cases[i].node != NULL);
        if (node) assert_string_equal(node->valuestring, cases[i].node);
        assert_true(cJSON_GetObjectItem(mesh, "firstFaceId")->valuedouble == 1 + (double)i);
        assert_non_null(cJSON_GetObjectItem(mesh, "pixels"));
    }
    assert_null(mesh);
    cJSON_Delete(info);
}

TEST_AROUND(info_lists_the_first_thousand_instances, open_arena, close_arena)
{
    enum { PLACED = ZR_INFO_MESHES_MAX + 234 };
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    static struct zr_instance instances[PLACED];
    scene_of_triangles(&test, 16, 16, p, 1);
    for (int i = 0; i < PLACED; i++)
        instances[i] = test.instance;
    test.scene.instances = instances;
    test.scene.instance_count = PLACED;
    struct zr_answer answer = info_of(&test);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    assert_true(cJSON_GetObjectItem(info, "instances")->valuedouble == PLACED);
    const cJSON *meshes = cJSON_GetObjectItem(info, "meshes");
    assert_int_equal(cJSON_GetArraySize(meshes), ZR_INFO_MESHES_MAX);
    const cJSON *last = cJSON_GetArrayItem(meshes, ZR_INFO_MESHES_MAX - 1);
    assert_true(cJSON_GetObjectItem(last, "firstFaceId")->valuedouble == ZR_INFO_MESHES_MAX);
    assert_true(cJSON_GetObjectItem(meshes->child, "pixels")->valuedouble == 28); /* the first of all is seen */
    const cJSON *parts = cJSON_GetObjectItem(info, "parts");
    assert_int_equal(cJSON_GetArraySize(parts), ZR_FRAME_PARTS_MAX);
    assert_true(cJSON_GetObjectItem(info, "partsOmitted")->valuedouble == PLACED - ZR_FRAME_PARTS_MAX);
    assert_string_equal(cJSON_GetObjectItem(parts->child->next, "name")->valuestring, "test.2");
    cJSON_Delete(info);
}

/* ---- parts ---- */

/* A mesh with three parts: no faces; the left triangle and a line; the right triangle. A mesh of one part is above. */
TEST_AROUND(pixels_are_counted_for_each_part, open_arena, close_arena)
{
    static const char want[] =
        "\"parts\":["
        "{\"name\":\"none\",\"id\":1,\"box\":null,\"triangles\":0,\"area\":0,\"volume\":null,\"centerOfMass\":null,"
        "\"leastWall\":null,"
        "\"closed\":false,\"shells\":{\"outward\":0,\"inward\":0,\"open\":0},\"pixels\":0,\"color\":\"#000000\"},"
        "{\"name\":\"left\",\"id\":2,\"instanceId\":1,\"box\":{\"min\":[-1,-1,0],\"max\":[0,0,0]},\"triangles\":1,"
        "\"area\":0.5,\"volume\":null,\"centerOfMass\":null,\"leastWall\":null,\"closed\":false,\"shells\":{"
        "\"outward\":0,\"inward\":0,\"open\":1},\"openEdges\":{\"count\":3,\"at\":[-1,-0.5,0]},\"pixels\":28,"
        "\"color\":\"#ff8000\"},"
        "{\"name\":\"right\",\"id\":3,\"instanceId\":1,\"box\":{\"min\":[0,-1,0],\"max\":[1,0,0]},\"triangles\":1,"
        "\"area\":0.5,\"volume\":null,\"centerOfMass\":null,\"leastWall\":null,\"closed\":false,\"shells\":{"
        "\"outward\":0,\"inward\":0,\"open\":1},\"openEdges\":{\"count\":3,\"at\":[0,-0.5,0]},\"pixels\":28,"
        "\"color\":\"#ff8000\"},"
        "{\"name\":\"above\",\"id\":4,\"instanceId\":2,\"box\":{\"min\":[-1,0,0],\"max\":[1,1,0]},\"triangles\":2,"
        "\"area\":1,\"volume\":null,\"centerOfMass\":null,\"leastWall\":null,\"closed\":false,\"shells\":{\"outward\":"
        "0,\"inward\":0,\"open\":2},\"openEdges\":{\"count\":6,\"at\":[-1,0.5,0]},\"pixels\":64,\"color\":"
        "\"#ff8000\"}],";
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {0, -1, 0, 1}, {-1, 0, 0, 1}, {0, -1, 0, 1}, {1, -1, 0, 1}, {0, 0, 0, 1}};
    static const uint32_t face_parts[2] = {1, 2}, line[2] = {2, 5};
    static const char *const names[3] = {"none", "left", "right"};
    static struct test_scene test;
    struct zr_mesh meshes[2];
    struct zr_instance instances[2];
    scene_of_triangles(&test, 16, 16, p, 2);
    test.material.base_color = (zr_vec4){1, 0.5f, 0, 1};
    test.mesh.lines = line;
    test.mesh.line_count = 1;
    meshes[0] = meshes[1] = test.mesh;
    meshes[0].face_parts = face_parts;
    meshes[0].part_count = 3;
    meshes[0].part_names = names;
    instances[0] = instances[1] = test.instance;
    instances[1] = (struct zr_instance){
        .mesh = 1, .node = "above", .object_to_world = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}};
    test.scene.meshes = meshes;
    test.scene.mesh_count = 2;
    test.scene.instances = instances;
    test.scene.instance_count = 2;
    const struct zr_answer answer = info_of(&test);
    const char *parts = strstr(answer.bytes, "\"parts\"");
    assert_non_null(parts);
    if (strncmp(parts, want, strlen(want)) != 0) fail_msg("%.*s", (int)strlen(want) + 100, parts);
}

/* ---- what tells a useless picture from others ---- */

static const struct zr_output with_color[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                              {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON}};

/* The info of a frame that has colours, too. */
static cJSON *info_beside_color(struct test_scene *test)
{
    struct zr_buffer out = {.arena = &arena};
    const struct zr_warning_list none = {.count = 0};
    test->scene.views[0].outputs = with_color;
    test->scene.views[0].output_count = 2;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test->scene);
    assert_int_equal(zr_info_write(&test->scene, frame, 0, 0, &none, "", NULL, &out), ZR_OK);
    cJSON *info = cJSON_ParseWithLength((const char *)out.bytes, out.size);
    assert_non_null(info);
    return info;
}

TEST_AROUND(picture_says_how_much_is_covered_and_whether_that_leaves_the_window, open_arena, close_arena)
{
    static const struct {
        float x0, y0, x1, y1; /* of a rectangle's lower left and upper right corner, in a window of 16 x 16 */
        double share;
        bool touches, blank;
    } cases[] = {{-0.5f, -0.5f, 0.5f, 0.5f, 0.25, false, false},
                 {-1, -0.5f, 0, 0.5f, 0.25, true, false},
                 {0, -0.5f, 1, 0.5f, 0.25, true, false},
                 {-0.5f, -1, 0.5f, 0, 0.25, true, false},
                 {-0.5f, 0, 0.5f, 1, 0.25, true, false},
                 {-0.875f, -0.875f, 0.875f, 0.875f, 0.765625, false, false},
                 {-2, -2, 2, 2, 1, true, true},
                 {2, 2, 3, 3, 0, false, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const float x0 = cases[i].x0, y0 = cases[i].y0, x1 = cases[i].x1, y1 = cases[i].y1;
        const zr_vec4 p[] = {{x0, y0, 0, 1}, {x1, y0, 0, 1}, {x1, y1, 0, 1},
                             {x0, y0, 0, 1}, {x1, y1, 0, 1}, {x0, y1, 0, 1}};
        static struct test_scene test;
        scene_of_triangles(&test, 16, 16, p, 2);
        cJSON *info = info_beside_color(&test);
        const cJSON *picture = cJSON_GetObjectItem(info, "picture");
        const cJSON *share = cJSON_GetObjectItem(picture, "coveredShare");
        assert_true(cJSON_IsNumber(share) && share->valuedouble == cases[i].share);
        assert_int_equal(cJSON_IsTrue(cJSON_GetObjectItem(picture, "touchesBorder")), cases[i].touches);
        assert_int_equal(cJSON_IsFalse(cJSON_GetObjectItem(picture, "touchesBorder")), !cases[i].touches);
        assert_int_equal(cJSON_IsTrue(cJSON_GetObjectItem(picture, "blank")), cases[i].blank);
        assert_int_equal(cJSON_IsFalse(cJSON_GetObjectItem(picture, "blank")), !cases[i].blank);
        assert_true(cJSON_GetObjectItem(picture, "colors")->valuedouble == (cases[i].blank ? 1 : 2));
        assert_string_equal(cJSON_GetObjectItem(info, "look")->valuestring, "textbook@1");
        cJSON_Delete(info);
    }
}

/* A thin rectangle beside the centres of row 9, on the lower of its two rows of samples. */
TEST_AROUND(what_no_pixel_centre_is_on_is_not_blank, open_arena, close_arena)
{
    const float low = 9.15f / 8.0f - 1.0f, high = 9.35f / 8.0f - 1.0f; /* that are at 9.25 */
    const zr_vec4 p[] = {{-1, low, 0, 1}, {1, low, 0, 1},  {-1, high, 0, 1},
                         {1, low, 0, 1},  {1, high, 0, 1}, {-1, high, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 2);
    for (uint32_t side = 1; side <= 2; side++) {
        test.picture.side = side;
        cJSON *info = info_beside_color(&test);
        const cJSON *picture = cJSON_GetObjectItem(info, "picture");
        assert_true(cJSON_IsTrue(cJSON_GetObjectItem(picture, "blank")) == (side == 1));
        assert_true(cJSON_GetObjectItem(picture, "coveredShare")->valuedouble == (side == 1 ? 0.0 : 1.0 / 32));
        cJSON_Delete(info);
        const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
        const struct zr_drawing_warnings warnings = zr_drawing_warnings_make(&arena, &test.scene, frame);
        assert_int_equal(zr_warnings_list(&arena, &warnings, 0).count, side == 1);
    }
}

/* A row of triangles, each with a colour of its own, beside a background of another. */
static double colors_of(uint32_t triangles)
{
    static struct test_scene test;
    static zr_vec4 p[3 * TEST_TRIANGLES_MAX], colors[TEST_TRIANGLES_MAX];
    for (uint32_t t = 0; t < triangles; t++) {
        const float x = (float)(t % 32) / 16.0f - 1.0f, y = (float)(t / 32) / 16.0f - 1.0f, size = 1.0f / 16.0f;
        p[3 * t] = (zr_vec4){x, y, 0, 1};
        p[3 * t + 1] = (zr_vec4){x + size, y, 0, 1};
        p[3 * t + 2] = (zr_vec4){x, y + size, 0, 1};
        colors[t] = (zr_vec4){(float)(t % 16) / 15.0f, (float)(t / 16 % 16) / 15.0f, t < 256 ? 0.5f : 0.75f, 1};
    }
    scene_of_triangles(&test, 256, 256, p, triangles);
    test.mesh.face_colors = colors;
    cJSON *info = info_beside_color(&test);
    const double count = cJSON_GetObjectItem(cJSON_GetObjectItem(info, "picture"), "colors")->valuedouble;
    cJSON_Delete(info);
    return count;
}

TEST_AROUND(colors_are_counted_up_to_256, open_arena, close_arena)
{
    assert_true(colors_of(1) == 2);
    assert_true(colors_of(100) == 101);
    assert_true(colors_of(255) == 256);
    assert_true(colors_of(256) == 257);
    assert_true(colors_of(400) == 257);
}

TEST_AROUND(picture_is_missing_where_color_is_no_output, open_arena, close_arena)
{
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 16, 16, p, 1);
    const struct zr_answer answer = info_of(&test);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_null(cJSON_GetObjectItem(info, "picture"));
    assert_non_null(cJSON_GetObjectItem(info, "backgroundPixels"));
    cJSON_Delete(info);
}

/* ---- memory ---- */

/* Places a mesh 1200 times. Its names have 2000 bytes, and each byte takes six in JSON. */
TEST_AROUND(info_takes_no_memory_that_a_request_may_not_have, open_arena, close_arena)
{
    enum { PLACED = 1200, NAME_SIZE = 1000 };
    const zr_vec4 p[] = {{-1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 1, 0, 1}};
    static struct test_scene test;
    static struct zr_instance instances[PLACED];
    static char name[NAME_SIZE + 1];
    scene_of_triangles(&test, 16, 16, p, 1);
    memset(name, 1, NAME_SIZE);
    for (int i = 0; i < PLACED; i++) {
        instances[i] = test.instance;
        instances[i].node = name;
    }
    test.mesh.name = name;
    test.scene.instances = instances;
    test.scene.instance_count = PLACED;
    const struct zr_answer answer = info_of(&test);
    assert_true(answer.size > 2 * 6 * NAME_SIZE * ZR_INFO_MESHES_MAX);
    assert_true(answer.size <= arena.peak);

    struct zr_error error = {.count = 0};
    struct zr_answer none;
    zr_arena_reset(&arena, 0);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    arena.ceiling = arena.used + (8 << 20);
    assert_int_equal(zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, frame, &none),
                     ZR_NO_MEMORY);
}

RUN_TESTS(NULL, NULL)
