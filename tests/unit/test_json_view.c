/* What a scene says of its views and outputs. */
#include "json_check.h"

static struct zr_view view_of(const char *view)
{
    char rest[1024];
    snprintf(rest, sizeof rest, "\"view\": %s", view);
    struct reading *reading = read_rest(rest);
    assert_read(reading);
    struct zr_view result = reading->scene->view;
    reading_free(reading);
    return result;
}

static void views_are_read(void **state)
{
    (void)state;
    struct zr_view view = view_of("{\"eye\": [1,2,3]}");
    assert_int_equal(view.pose, ZR_POSE_LOOK_AT);
    assert_int_equal(view.projection, ZR_PROJECTION_PERSPECTIVE);
    assert_true(view.eye.z == 3 && view.target.x == 0 && view.up.y == 1);
    assert_true(view.yfov_radians == (float)(45 * 3.14159265358979323846 / 180));
    view = view_of("{\"preset\": \"left\", \"perspective\": {\"yfov\": 1}, \"znear\": 0.5, \"zfar\": 2, \"fit\": "
                   "{\"padding\": 0.25}}");
    assert_int_equal(view.preset, ZR_PRESET_LEFT);
    assert_true(view.yfov_radians == 1 && view.has_znear && view.has_zfar && view.znear == 0.5f && view.zfar == 2);
    assert_true(view.fit_padding == 0.25f);
    view = view_of("{\"orthographic\": {\"xmag\": 2, \"ymag\": 3}, \"znear\": -5, \"convention\": \"opengl\"}");
    assert_int_equal(view.pose, ZR_POSE_PRESET);
    assert_true(view.xmag == 2 && view.ymag == 3 && view.znear == -5 && !view.has_zfar);
    view = view_of("{\"eye\": [1,2,3], \"orthographic\": {}}");
    assert_int_equal(view.projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(view.xmag == 0 && view.ymag == 0);
}

static void matrices_are_rows_nested_and_columns_flat(void **state)
{
    (void)state;
    struct zr_view view = view_of("{\"worldToCamera\": [[1,0,0,7],[0,1,0,8],[0,0,1,9],[0,0,0,1]],"
                                  "\"projectionMatrix\": [1,2,3,4, 5,6,7,8, 9,10,11,12, 13,14,15,16]}");
    assert_int_equal(view.pose, ZR_POSE_MATRIX);
    assert_int_equal(view.projection, ZR_PROJECTION_MATRIX);
    assert_true(view.world_to_camera.m[12] == 7 && view.world_to_camera.m[14] == 9 && view.world_to_camera.m[3] == 0);
    for (int i = 0; i < 16; i++)
        assert_true(view.projection_matrix.m[i] == (float)(i + 1));
    view = view_of("{\"cameraToWorld\": [[1,0,0,7],[0,1,0,8],[0,0,1,9],[0,0,0,1]]}");
    assert_true(view.world_to_camera.m[12] == -7 && view.world_to_camera.m[14] == -9);
    assert_int_equal(view.projection, ZR_PROJECTION_PERSPECTIVE);
}

static void pose_written_row_by_row_is_told_so(void **state)
{
    (void)state;
    refuses_rest("\"view\": {\"cameraToWorld\": [1,0,0,5, 0,1,0,5, 0,0,1,5, 0,0,0,1]}", "/view/cameraToWorld",
                 "the bottom row is 5 5 5 1, not 0 0 0 1 (a flat list goes column by column)");
    refuses_rest("\"view\": {\"worldToCamera\": [2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,-6,2]}", "/view/worldToCamera",
                 "the bottom row is 0 0 0 2");
    refuses_rest("\"view\": {\"worldToCamera\": [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1]}", "/view/worldToCamera",
                 "the matrix has no inverse");
}

static void projection_matrix_alone_leads_from_world_to_clip_space(void **state)
{
    (void)state;
    struct zr_view view = view_of("{\"projectionMatrix\": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]}");
    zr_mat4 identity = zr_mat4_identity();
    assert_int_equal(view.pose, ZR_POSE_MATRIX);
    assert_memory_equal(&view.world_to_camera, &identity, sizeof identity);
    view = view_of("{\"preset\": \"top\", \"projectionMatrix\": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]}");
    assert_int_equal(view.pose, ZR_POSE_PRESET);
}

static void bad_views_give_pointer_and_names(void **state)
{
    (void)state;
    static const struct {
        const char *view, *pointer, *detail;
    } cases[] = {
        {"{\"eye\": [0,0,1], \"preset\": \"top\"}", "/view", "two poses: preset and eye"},
        {"{\"target\": [0,0,1], \"preset\": \"top\"}", "/view", "two poses: preset and target"},
        {"{\"preset\": \"top\", \"up\": [0,0,1]}", "/view/up", "belongs to the pose eye and target"},
        {"{\"target\": [0,0,1]}", "/view", "target needs eye"},
        {"{\"orthographic\": {}, \"perspective\": {\"yfov\": 1}}", "/view",
         "two projections: perspective and orthographic"},
        {"{\"perspective\": {}}", "/view/perspective", "yfov or yfovDegrees is missing"},
        {"{\"perspective\": {\"yfov\": 1, \"yfovDegrees\": 9}}", "/view/perspective", "two angles"},
        {"{\"perspective\": {\"yfovDegrees\": 180}}", "/view/perspective/yfovDegrees", "180: an angle between"},
        {"{\"perspective\": {\"yfovDegrees\": 0}}", "/view/perspective/yfovDegrees", "0: an angle between"},
        {"{\"perspective\": {\"yfov\": 3.2}}", "/view/perspective/yfov", "3.2 is outside"},
        {"{\"perspective\": {\"yfov\": 3.14159265358979}}", "/view/perspective/yfov", "an angle between"},
        {"{\"perspective\": {\"xfov\": 1}}", "/view/perspective/xfov", "not supported in this version"},
        {"{\"orthographic\": {\"xmag\": 1}}", "/view/orthographic", "ymag is missing"},
        {"{\"orthographic\": {\"xmag\": 0, \"ymag\": 1}}", "/view/orthographic/xmag", "0 is not greater than 0"},
        {"{\"orthographic\": {\"xmag\": 1e-60, \"ymag\": 1}}", "/view/orthographic/xmag", "1e-60 is not greater"},
        {"{\"eye\": [0,0,1], \"znear\": 0}", "/view/znear", "0 is not greater than 0"},
        {"{\"eye\": [0,0,1], \"znear\": 2, \"zfar\": 2}", "/view/zfar", "2 is not beyond znear, 2"},
        {"{\"projectionMatrix\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1], \"znear\": 1}", "/view/znear", "planes of its own"},
        {"{\"fit\": {\"padding\": 0.5}}", "/view/fit/padding", "0.5 is outside of 0 to 0.45"},
        {"{\"cameraToWorld\": [[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]}", "/view/cameraToWorld", "no inverse"},
        {"{\"worldToCamera\": [1,2,3]}", "/view/worldToCamera", "expected 16 numbers, found 3"},
        {"{\"worldToCamera\": [[1,0,0,0]]}", "/view/worldToCamera", "expected 4 rows, found 1"},
        {"{\"worldToCamera\": [[1,0,0,0],[1],[],[]]}", "/view/worldToCamera/1", "expected 4 numbers, found 1"},
        {"{\"eye\": [0,\"0\",1]}", "/view/eye/1", "expected a number, found a string"},
        {"{\"preset\": \"up\"}", "/view/preset", "allowed: front, back, left, right, top, bottom, isometric"},
        {"{\"K\": []}", "/view/K", "not supported in this version"},
        {"{\"azimuthDegrees\": 3}", "/view/azimuthDegrees", "not supported in this version"},
        {"{\"convention\": \"opencv\"}", "/view/convention", "not supported in this version"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char rest[512];
        snprintf(rest, sizeof rest, "\"view\": %s", cases[i].view);
        refuses_rest(rest, cases[i].pointer, cases[i].detail);
    }
}

static void outputs_are_read(void **state)
{
    (void)state;
    struct reading *reading =
        read_rest("\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": "
                  "\"depth\", \"encoding\": \"png16\", \"scale\": 0.001}, {\"channel\": \"windowDepth\"},"
                  "{\"channel\": \"faceId\"}, {\"channel\": \"info\", \"encoding\": \"json\"}]");
    assert_read(reading);
    const struct zr_output *outputs = reading->scene->outputs;
    static const enum zr_encoding encodings[6] = {ZR_ENCODING_PNG, ZR_ENCODING_NPY, ZR_ENCODING_PNG16,
                                                  ZR_ENCODING_NPY, ZR_ENCODING_NPY, ZR_ENCODING_JSON};
    assert_int_equal(reading->scene->output_count, 6);
    for (int i = 0; i < 6; i++)
        assert_int_equal(outputs[i].encoding, encodings[i]);
    assert_int_equal(outputs[3].channel, ZR_CHANNEL_WINDOW_DEPTH);
    assert_true(outputs[2].scale == 0.001f);
    reading_free(reading);
}

static void bad_outputs_give_pointer_and_what_is_allowed(void **state)
{
    (void)state;
    refuses_rest("\"outputs\": []", "/outputs", "an empty list");
    refuses_rest("\"outputs\": [{}]", "/outputs/0", "channel is missing");
    refuses_rest("\"outputs\": [{\"channel\": \"normals\"}]", "/outputs/0/channel", "not supported in this version");
    refuses_rest("\"outputs\": [{\"channel\": \"z\"}]", "/outputs/0/channel",
                 "allowed: color, depth, windowDepth, faceId, info");
    refuses_rest("\"outputs\": [{\"channel\": \"color\", \"encoding\": \"npy\"}]", "/outputs/0/encoding",
                 "the channel color cannot be had as npy; allowed: png");
    refuses_rest("\"outputs\": [{\"channel\": \"depth\", \"scale\": 1}]", "/outputs/0/scale",
                 "only the encoding png16");
    refuses_rest("\"outputs\": [{\"channel\": \"depth\", \"encoding\": \"png16\", \"scale\": 0}]", "/outputs/0/scale",
                 "0 is not greater than 0");
    refuses_rest("\"outputs\": [{\"channel\": \"depth\"}, {\"channel\": \"color\"}, {\"channel\": \"depth\"}]",
                 "/outputs/2", "the same file name as /outputs/0: depth");
}

static void query_output_replaces_those_of_the_scene(void **state)
{
    (void)state;
    static const char text[] = "{" POLYGONS ", \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"info\"}]}";
    struct zr_request request = {.format = ZR_FORMAT_JSON, .channel = "faceId"};
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), 1 << 20);
    assert_read(reading);
    assert_int_equal(reading->scene->output_count, 1);
    assert_int_equal(reading->scene->outputs[0].channel, ZR_CHANNEL_FACE_ID);
    assert_int_equal(reading->scene->outputs[0].encoding, ZR_ENCODING_NPY);
    reading_free(reading);
}

static void query_of_bare_meshes_is_refused(void **state)
{
    (void)state;
    static const struct {
        struct zr_request request;
        const char *detail;
    } cases[] = {{{.preset = "top"}, "query parameter preset belongs to bodies that are a bare mesh"},
                 {{.width = "4"}, "query parameter width belongs"},
                 {{.height = "4"}, "query parameter height belongs"},
                 {{.shading = "flat"}, "query parameter shading belongs"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_request(cases[i].request, "{", 1, zr_limits_default(), 1 << 20);
        assert_complaint(reading, ZR_BAD_REQUEST, "", cases[i].detail);
        reading_free(reading);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_are_read),
        cmocka_unit_test(matrices_are_rows_nested_and_columns_flat),
        cmocka_unit_test(pose_written_row_by_row_is_told_so),
        cmocka_unit_test(projection_matrix_alone_leads_from_world_to_clip_space),
        cmocka_unit_test(bad_views_give_pointer_and_names),
        cmocka_unit_test(outputs_are_read),
        cmocka_unit_test(bad_outputs_give_pointer_and_what_is_allowed),
        cmocka_unit_test(query_output_replaces_those_of_the_scene),
        cmocka_unit_test(query_of_bare_meshes_is_refused),
    };
    return cmocka_run_group_tests_name("json_view", tests, NULL, NULL);
}
