/* What a scene says of its views and outputs. */
#include "scene/output.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

static struct zr_view view_of(const char *view)
{
    char rest[1024];
    snprintf(rest, sizeof rest, "\"view\": %s", view);
    struct reading *reading = read_rest(rest);
    assert_read(reading);
    struct zr_view result = reading->scene->views[0];
    reading_free(reading);
    return result;
}

TEST(views_are_read)
{
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

TEST(matrices_are_rows_nested_and_columns_flat)
{
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

/* By one factor; what is less than a thousandth off, or depends on the direction, stays as it is. */
TEST(pose_that_scales_is_made_a_rigid_one)
{
    static const struct {
        const char *view;
        float x, z, tz; /* of the matrix: its first and its third diagonal entry, and how far it moves along z */
    } cases[] = {
        {"{\"worldToCamera\": [[2,0,0,1],[0,2,0,1],[0,0,2,-9],[0,0,0,1]]}", 1, 1, -4.5f},
        {"{\"cameraToWorld\": [[0.5,0,0,1],[0,0.5,0,1],[0,0,0.5,9],[0,0,0,1]]}", 1, 1, -9},
        {"{\"worldToCamera\": [[-2,0,0,1],[0,2,0,1],[0,0,2,-9],[0,0,0,1]]}", -1, 1, -4.5f},
        {"{\"worldToCamera\": [[2,0,0,1],[0,2,0,1],[0,0,2,9],[0,0,0,1]], \"convention\": \"opencv\"}", 1, -1, -4.5f},
        {"{\"worldToCamera\": [[1.0005,0,0,1],[0,1.0005,0,1],[0,0,1.0005,-9],[0,0,0,1]]}", 1.0005f, 1.0005f, -9},
        {"{\"worldToCamera\": [[2,0,0,1],[0,2,0,1],[0,0,3,-9],[0,0,0,1]]}", 2, 3, -9},
        {"{\"worldToCamera\": [[2,0,1,1],[0,2,0,1],[0,0,2,-9],[0,0,0,1]]}", 2, 2, -9},
        {"{\"worldToCamera\": [[2,0,0,1],[0,2,0,1],[0,0,2,-9],[0,0,0,1]], "
         "\"projectionMatrix\": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]}",
         2, 2, -9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_view view = view_of(cases[i].view);
        const float *m = view.world_to_camera.m;
        if (m[0] != cases[i].x || m[10] != cases[i].z || m[14] != cases[i].tz)
            fail_msg("%s: %g %g %g", cases[i].view, (double)m[0], (double)m[10], (double)m[14]);
    }
}

TEST(projection_matrix_alone_leads_from_world_to_clip_space)
{
    struct zr_view view = view_of("{\"projectionMatrix\": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]}");
    zr_mat4 identity = zr_mat4_identity();
    assert_int_equal(view.pose, ZR_POSE_MATRIX);
    assert_memory_equal(&view.world_to_camera, &identity, sizeof identity);
    view = view_of("{\"preset\": \"top\", \"projectionMatrix\": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]}");
    assert_int_equal(view.pose, ZR_POSE_PRESET);
}

TEST(poses_are_read)
{
    struct zr_view view = view_of("{\"direction\": [1,2,3]}");
    assert_int_equal(view.pose, ZR_POSE_DIRECTION);
    assert_int_equal(view.projection, ZR_PROJECTION_ORTHOGRAPHIC); /* fitted, as presets are */
    assert_true(view.direction.y == 2 && view.up.y == 1);
    view = view_of("{\"direction\": [0,-4,0]}"); /* no y can be up there: as in the preset top */
    assert_true(view.up.x == 0 && view.up.y == 0 && view.up.z == -1);
    view = view_of("{\"direction\": [0,4,0]}");
    assert_true(view.up.x == 0 && view.up.y == 0 && view.up.z == 1);
    view = view_of("{\"direction\": [0,-4,0], \"up\": [1,0,0]}");
    assert_true(view.up.x == 1 && view.up.z == 0);
    view = view_of("{\"eye\": [0.5,5,0], \"target\": [0.5,0,0]}");
    assert_true(view.up.x == 0 && view.up.y == 0 && view.up.z == -1);
    view = view_of("{\"eye\": [0,0,0], \"target\": [0,2,0]}");
    assert_true(view.up.x == 0 && view.up.y == 0 && view.up.z == 1);
    view = view_of("{\"eye\": [0,5,0], \"up\": [1,0,0]}");
    assert_true(view.up.x == 1 && view.up.z == 0);
    view = view_of("{\"eye\": [0,5,0], \"target\": [0,5,0]}"); /* looks nowhere, and is refused later */
    assert_true(view.up.y == 1);
    view = view_of("{\"azimuthDegrees\": -12.5}");
    assert_int_equal(view.pose, ZR_POSE_ORBIT);
    assert_int_equal(view.projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(view.azimuth_degrees == -12.5 && view.elevation_degrees == 0 && view.distance == 0 && !view.has_target);
    view = view_of("{\"elevationDegrees\": 90, \"distance\": 3, \"target\": [1,2,3], \"up\": [0,0,2]}");
    assert_int_equal(view.projection, ZR_PROJECTION_PERSPECTIVE); /* a distance asks for one */
    assert_true(view.yfov_radians == (float)(45 * 3.14159265358979323846 / 180));
    assert_true(view.elevation_degrees == 90 && view.distance == 3 && view.has_target && view.target.z == 3 &&
                view.up.z == 2);
}

TEST(conventions_differ_in_the_axes_y_and_z_of_the_camera)
{
    /* X_camera = R X_world + t in opencv; the rows y and z change sign for opengl. */
    static const float want[16] = {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 7, -8, -9, 1};
    static const char *const same[] = {
        "{\"R\": [[0,1,0],[0,0,-1],[-1,0,0]], \"t\": [7,8,9]}",
        "{\"R\": [0,1,0, 0,0,-1, -1,0,0], \"t\": [7,8,9], \"convention\": \"opencv\"}",
        "{\"R\": [0,1,0, 0,0,1, 1,0,0], \"t\": [7,-8,-9], \"convention\": \"opengl\"}",
        "{\"worldToCamera\": [[0,1,0,7],[0,0,-1,8],[-1,0,0,9],[0,0,0,1]], \"convention\": \"opencv\"}",
        "{\"worldToCamera\": [[0,1,0,7],[0,0,1,-8],[1,0,0,-9],[0,0,0,1]], \"convention\": \"opengl\"}",
        "{\"cameraToWorld\": [[0,0,-1,9],[1,0,0,-7],[0,-1,0,8],[0,0,0,1]], \"convention\": \"opencv\"}",
        "{\"cameraToWorld\": [[0,0,1,9],[1,0,0,-7],[0,1,0,8],[0,0,0,1]]}",
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        struct zr_view view = view_of(same[i]);
        assert_int_equal(view.pose, ZR_POSE_MATRIX);
        for (int k = 0; k < 16; k++)
            assert_true(view.world_to_camera.m[k] == want[k]);
    }
    struct zr_view view = view_of("{\"R\": [1,0,0, 0,1,0, 0,0,1]}"); /* t is 0, and no zero is -0 */
    static const float flipped[16] = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    assert_memory_equal(view.world_to_camera.m, flipped, sizeof flipped);
}

TEST(convention_opengl_goes_with_every_pose_and_leaves_every_bit)
{
    static const char *const poses[] = {"\"preset\": \"top\"", "\"eye\": [0,0,1]", "\"direction\": [0,0,1]",
                                        "\"azimuthDegrees\": 3", "\"znear\": 1"};
    for (size_t i = 0; i < sizeof poses / sizeof *poses; i++) {
        char text[128];
        snprintf(text, sizeof text, "{%s, \"convention\": \"opengl\"}", poses[i]);
        view_of(text);
    }
    struct zr_view view = view_of("{\"worldToCamera\": [0.1,0.2,0.3,0, 0.4,-0.0,0.6,0, -0.7,0.8,0.9,0, 1,2,3,1],"
                                  "\"convention\": \"opengl\"}");
    static const float want[16] = {0.1f, 0.2f, 0.3f, 0, 0.4f, -0.0f, 0.6f, 0, -0.7f, 0.8f, 0.9f, 0, 1, 2, 3, 1};
    assert_memory_equal(view.world_to_camera.m, want, sizeof want);
}

TEST(projections_are_read)
{
    struct zr_view view = view_of("{\"eye\": [0,0,1], \"perspective\": {\"xfov\": 1.25}}");
    assert_true(view.xfov_radians == 1.25f && view.yfov_radians == 0);
    view = view_of("{\"perspective\": {\"xfovDegrees\": 90}}");
    assert_true(view.xfov_radians == (float)(3.14159265358979323846 / 2) && view.yfov_radians == 0);
    view = view_of("{\"intrinsics\": {\"fx\": 500}}");
    assert_int_equal(view.projection, ZR_PROJECTION_INTRINSICS);
    assert_int_equal(view.pose, ZR_POSE_PRESET);
    assert_true(view.intrinsics.fx == 500 && view.intrinsics.fy == 500 && view.intrinsics.skew == 0);
    assert_false(view.intrinsics.has_cx || view.intrinsics.has_cy);
    view = view_of("{\"intrinsics\": {\"fx\": 500.25, \"fy\": 400, \"cx\": 0, \"cy\": -7, \"skew\": -2}}");
    assert_true(view.intrinsics.fx == 500.25 && view.intrinsics.fy == 400 && view.intrinsics.skew == -2);
    assert_true(view.intrinsics.has_cx && view.intrinsics.has_cy);
    assert_true(view.intrinsics.cx == 0 && view.intrinsics.cy == -7);
    static const char *const same[] = {"{\"K\": [[5,1,30],[0,6,40],[0,0,1]], \"pixelCenter\": 0.5}",
                                       "{\"K\": [5,1,30, 0,6,40, 0,0,1]}",
                                       "{\"K\": [5,1,29.5, 0,6,39.5, 0,0,1], \"pixelCenter\": 0}"};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        struct zr_intrinsics k = view_of(same[i]).intrinsics;
        assert_true(k.fx == 5 && k.skew == 1 && k.cx == 30 && k.fy == 6 && k.cy == 40 && k.has_cx && k.has_cy);
    }
}

TEST(fit_finds_its_mesh_by_name)
{
#define MESH(name) "{\"name\": \"" name "\", " POSITIONS ", \"faces\": [[0,1,2]]}"
    struct reading *reading =
        read_scene("{\"view\": {\"fit\": {\"mesh\": \"nut\"}}, \"meshes\": [" MESH("bolt") ", " MESH("nut") "]}");
    assert_true(reading->scene->views[0].fit_to_mesh);
    assert_int_equal(reading->scene->views[0].fit_mesh, 1);
    reading_free(reading);
#undef MESH
}

TEST(outputs_are_read)
{
    struct reading *reading =
        read_rest("\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": "
                  "\"depth\", \"encoding\": \"png16\", \"scale\": 0.001}, {\"channel\": \"windowDepth\"},"
                  "{\"channel\": \"faceId\"}, {\"channel\": \"info\", \"encoding\": \"json\"}]");
    assert_read(reading);
    const struct zr_output *outputs = reading->scene->views[0].outputs;
    static const enum zr_encoding encodings[6] = {ZR_ENCODING_PNG, ZR_ENCODING_NPY, ZR_ENCODING_PNG16,
                                                  ZR_ENCODING_NPY, ZR_ENCODING_NPY, ZR_ENCODING_JSON};
    assert_int_equal(reading->scene->views[0].output_count, 6);
    for (int i = 0; i < 6; i++)
        assert_int_equal(outputs[i].encoding, encodings[i]);
    assert_int_equal(outputs[3].channel, ZR_CHANNEL_WINDOW_DEPTH);
    assert_true(outputs[2].scale == 0.001f);
    reading_free(reading);
}

TEST(query_output_replaces_those_of_the_scene)
{
    static const char text[] = "{" POLYGONS ", \"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"info\"}]}";
    struct zr_request request = {.format = ZR_FORMAT_JSON, .channel = "faceId", .compress = "small"};
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), 1 << 20);
    assert_read(reading);
    assert_int_equal(reading->scene->views[0].output_count, 1);
    assert_int_equal(reading->scene->views[0].outputs[0].channel, ZR_CHANNEL_FACE_ID);
    assert_int_equal(reading->scene->views[0].outputs[0].encoding, ZR_ENCODING_NPY);
    assert_int_equal(reading->scene->compress, ZR_COMPRESS_SMALL);
    reading_free(reading);
}

TEST(query_of_bare_meshes_is_refused)
{
    static const struct {
        struct zr_request request;
        const char *detail;
    } cases[] = {{{.preset = "top"}, "parameter preset belongs to bodies that are a bare mesh"},
                 {{.shading = "flat"}, "parameter shading belongs"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_request(cases[i].request, "{", 1, zr_limits_default(), 1 << 20);
        assert_complaint(reading, ZR_BAD_REQUEST, "", cases[i].detail);
        reading_free(reading);
    }
}

TEST(sides_in_the_query_override_the_window)
{
    static const char scene[] =
        "{\"window\":{\"width\":9,\"height\":8},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}";
    static const struct {
        struct zr_request request;
        uint32_t width, height;
    } cases[] = {
        {{0}, 9, 8}, {{.width = "4"}, 4, 8}, {{.height = "5"}, 9, 5}, {{.width = "640", .height = "480"}, 640, 480}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_request(cases[i].request, scene, strlen(scene), zr_limits_default(), 1 << 20);
        assert_read(reading);
        assert_int_equal(reading->scene->views[0].width, cases[i].width);
        assert_int_equal(reading->scene->views[0].height, cases[i].height);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
