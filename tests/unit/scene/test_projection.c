/* Every pose and every projection: known points, and the pixels worked out by hand.
 *
 * Pixels are measured from the top left corner of the picture, y down. Unless a test says
 * otherwise, the scene is a cube from -1 to 1, and the window 400 x 200: its middle is
 * (200, 100), and under a yfov of 90 degrees a place y above the axis and z in front of the
 * camera is 100 y / z pixels above the middle. */
#include <cjson/cJSON.h>

#include "geometry/clip.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/view_check.h"

#define O50   "\"orthographic\": {\"xmag\": 4, \"ymag\": 2}" /* 50 pixels a unit */
#define EYE10 "\"eye\": [0,0,10]"
#define SAME  "\"R\": [1,0,0, 0,1,0, 0,0,1]" /* X_camera = X_world, as OpenCV has it */

#define ASSERT_SEEN(sights) assert_seen(WINDOW, CUBE, sights, sizeof(sights) / sizeof *(sights))
#define WINDOW              "{\"width\": 400, \"height\": 200}"

/* ---- poses ---- */

/* Of (1, 0.5, 0.25), at 50 pixels a unit: 50, 25 and 12.5 pixels from the middle. */
static const zr_vec3 POINT = {1.0f, 0.5f, 0.25f};
static const struct pixel FRONT = {250, 75}, BACK = {150, 75} /* -x right */, LEFT = {212.5, 75} /* z right */,
                          RIGHT = {187.5, 75} /* -z right */, TOP = {250, 112.5} /* -z up */,
                          BOTTOM = {250, 87.5} /* z up */;
/* Right is (1, 0, -1) / sqrt 2, of which the point has 0.75 / sqrt 2; up is (-1, 2, -1) / sqrt 6, -0.25 / sqrt 6. */
static const struct pixel ISOMETRIC = {200 + 50 * 0.53033009, 100 + 50 * 0.10206207};

TEST(azimuth_goes_round_and_elevation_over_the_target)
{
    const struct sight sights[] = {
        {"\"azimuthDegrees\": 0," O50, POINT, FRONT},
        {"\"azimuthDegrees\": 90," O50, POINT, RIGHT},
        {"\"azimuthDegrees\": 180," O50, POINT, BACK},
        {"\"azimuthDegrees\": 270," O50, POINT, LEFT},
        {"\"azimuthDegrees\": -90," O50, POINT, LEFT},
        {"\"azimuthDegrees\": 810," O50, POINT, RIGHT},
        {"\"elevationDegrees\": 90," O50, POINT, TOP},
        {"\"elevationDegrees\": -90," O50, POINT, BOTTOM},
        {"\"azimuthDegrees\": 45, \"elevationDegrees\": 35.264389682754654," O50, POINT, ISOMETRIC},
        /* From above, having come from +x: -z is to the right and -x up. */
        {"\"azimuthDegrees\": 90, \"elevationDegrees\": 90," O50, POINT, {187.5, 150}},
        /* Right is (cos 30, 0, -sin 30): 0.8660254 - 0.125. */
        {"\"azimuthDegrees\": 30," O50, POINT, {200 + 50 * 0.7410254, 75}},
        /* Up is (0, cos 30, -sin 30): 0.4330127 - 0.125. */
        {"\"elevationDegrees\": 30," O50, POINT, {250, 100 - 50 * 0.3080127}},
    };
    ASSERT_SEEN(sights);
}

TEST(azimuth_goes_round_any_up)
{
    const struct sight sights[] = {
        /* With +z up: from -y, x is to the right; from +x, y is; from above y is up. */
        {"\"azimuthDegrees\": 0, \"up\": [0,0,1]," O50, POINT, {250, 87.5}},
        {"\"azimuthDegrees\": 90, \"up\": [0,0,7]," O50, POINT, {225, 87.5}},
        {"\"elevationDegrees\": 90, \"up\": [0,0,1]," O50, POINT, {250, 75}},
        /* +x up: y turns to x and x to -y; the camera stays on +z. */
        {"\"azimuthDegrees\": 0, \"up\": [1,0,0]," O50, POINT, {175, 50}},
        /* -y up: half a turn about x; the camera is on -z, upside down. */
        {"\"azimuthDegrees\": 0, \"up\": [0,-1,0]," O50, POINT, {250, 125}},
        /* All but half a turn, about x, gives the same; and so does all but none. */
        {"\"azimuthDegrees\": 0, \"up\": [0,-1,1e-7]," O50, POINT, {250, 125}},
        {"\"azimuthDegrees\": 0, \"up\": [0,1,1e-7]," O50, POINT, FRONT},
    };
    ASSERT_SEEN(sights);
}

TEST(distance_is_measured_from_the_target)
{
    static const struct sight sights[] = {
        /* The eye is at (6, 2, 3); from there the point is 5 away, 2 to the right (-z), 1 up. */
        {"\"azimuthDegrees\": 90, \"distance\": 5, \"target\": [1,2,3]," P90, {1, 3, 1}, {240, 80}},
        /* Over the centre of the bounds: 8 away, 1 to the right, 2 down (z). */
        {"\"elevationDegrees\": 90, \"distance\": 8," P90, {1, 0, 2}, {212.5, 125}},
        /* A yfov of 45 degrees where nothing is said: 100 / tan 22.5 = 241.42136 pixels. */
        {"\"azimuthDegrees\": 0, \"distance\": 10", {1, 2, 0}, {200 + 24.142136, 100 - 48.284271}},
    };
    ASSERT_SEEN(sights);
    /* The centre of the mesh that is fitted to: the nut's (10, 0, 0), so the eye is at (10, 0, 5). */
    static const struct sight of_nut = {
        "\"azimuthDegrees\": 0, \"distance\": 5, \"fit\": {\"mesh\": \"nut\"}," P90, {11, 2, 0}, {220, 60}};
    assert_seen(WINDOW, CUBE "," NUT, &of_nut, 1);
}

TEST(matrices_place_the_camera_in_both_conventions)
{
    static const struct sight sights[] = {
        /* opengl, from (1, 2, 13): 1 to the right, 2 up, 10 away. */
        {"\"cameraToWorld\": [[1,0,0,1],[0,1,0,2],[0,0,1,13],[0,0,0,1]]," P90, {2, 4, 3}, {210, 80}},
        {"\"cameraToWorld\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,13,1]," P90, {2, 4, 3}, {210, 80}},
        {"\"worldToCamera\": [[1,0,0,-1],[0,1,0,-2],[0,0,1,-13],[0,0,0,1]]," P90, {2, 4, 3}, {210, 80}},
        /* opencv, from (1, 2, -7), looking along +z: 1 to the right, 2 down, 10 away. */
        {"\"convention\": \"opencv\", \"cameraToWorld\": [[1,0,0,1],[0,1,0,2],[0,0,1,-7],[0,0,0,1]]," P90,
         {2, 4, 3},
         {210, 120}},
        {"\"convention\": \"opencv\", \"worldToCamera\": [[1,0,0,-1],[0,1,0,-2],[0,0,1,7],[0,0,0,1]]," P90,
         {2, 4, 3},
         {210, 120}},
        {SAME ", \"t\": [-1,-2,7]," P90, {2, 4, 3}, {210, 120}},
        /* X_camera = (y, z, x) + t = (1, 2, 10). */
        {"\"R\": [[0,1,0],[0,0,1],[1,0,0]], \"t\": [0,0,10]," P90, {0, 1, 2}, {210, 120}},
        {"\"R\": [0,1,0, 0,0,1, 1,0,0]," P90, {10, 1, 2}, {210, 120}},
        /* opengl: (1, 2, -10), y up and -z away. */
        {"\"R\": [0,1,0, 0,0,1, 1,0,0], \"t\": [0,0,-10], \"convention\": \"opengl\"," P90, {0, 1, 2}, {210, 80}},
    };
    ASSERT_SEEN(sights);
}

/* R turns by the angle whose sine is 0.6 about x and then by the same about y; cameraToWorld is its
 * inverse: R transposed, and -R transposed t = -(0.8 - 1.8, -0.36 + 1.6 - 1.44, -0.48 - 1.2 - 1.92). */
TEST(camera_to_world_in_opencv_is_the_inverse_of_r_and_t)
{
    struct shot rt = shoot(WINDOW, CUBE, "\"R\": [[0.8,-0.36,-0.48],[0,0.8,-0.6],[0.6,0.48,0.64]], \"t\": [1,2,3]");
    struct shot inverse =
        shoot(WINDOW, CUBE,
              "\"convention\": \"opencv\", \"cameraToWorld\": [[0.8,0,0.6,-2.6],[-0.36,0.8,0.48,-2.68],"
              "[-0.48,-0.6,0.64,-0.24],[0,0,0,1]]");
    for (int i = 0; i < 16; i++)
        assert_true(fabsf(rt.camera.world_to_eye.m[i] - inverse.camera.world_to_eye.m[i]) < 1e-6f);
    reading_free(rt.reading);
    reading_free(inverse.reading);
}

/* ---- projections ---- */

TEST(fields_of_view_are_those_of_the_whole_window)
{
    static const struct sight sights[] = {
        {EYE10 ",\"perspective\": {\"yfov\": 1.5707963267948966}", {1, 2, 0}, {210, 80}},
        /* Across 400 pixels: 200 pixels where x is as far as z. */
        {EYE10 ",\"perspective\": {\"xfovDegrees\": 90}", {1, 2, 0}, {220, 60}},
        {EYE10 ",\"perspective\": {\"xfov\": 1.5707963267948966}", {1, 2, 0}, {220, 60}},
        /* 200 / tan 30 = 346.41016. */
        {EYE10 ",\"perspective\": {\"xfovDegrees\": 60}", {1, 2, 0}, {234.641016, 100 - 69.282032}},
        {EYE10 "," O50, {1, 1, 0}, {250, 50}},
    };
    ASSERT_SEEN(sights);
}

TEST(intrinsics_are_pixels_from_the_corner_of_the_picture)
{
    static const struct sight sights[] = {
        /* u = 300 * 1 / 10 + 180, v = 250 * 2 / 10 + 90 */
        {SAME ",\"intrinsics\": {\"fx\": 300, \"fy\": 250, \"cx\": 180, \"cy\": 90}", {1, 2, 10}, {210, 140}},
        {SAME ",\"K\": [[300,0,180],[0,250,90],[0,0,1]]", {1, 2, 10}, {210, 140}},
        {SAME ",\"K\": [300,0,180, 0,250,90, 0,0,1]", {1, 2, 10}, {210, 140}},
        /* Skew adds 20 * 2 / 10 to u. */
        {SAME ",\"intrinsics\": {\"fx\": 300, \"fy\": 250, \"cx\": 180, \"cy\": 90, \"skew\": 20}",
         {1, 2, 10},
         {214, 140}},
        {SAME ",\"K\": [300,20,180, 0,250,90, 0,0,1]", {1, 2, 10}, {214, 140}},
        /* fy is fx, and the principal point is the middle. */
        {SAME ",\"intrinsics\": {\"fx\": 300}", {1, 2, 10}, {230, 160}},
        {SAME ",\"intrinsics\": {\"fx\": 300, \"cy\": 0}", {1, 2, 10}, {230, 60}},
        /* On the axis: the very corner, and a place outside of the picture. */
        {SAME ",\"intrinsics\": {\"fx\": 300, \"cx\": 0, \"cy\": 0}", {0, 0, 7}, {0, 0}},
        {SAME ",\"intrinsics\": {\"fx\": 300, \"cx\": -50, \"cy\": 210}", {0, 0, 7}, {-50, 210}},
        /* Half a pixel further where (0, 0) is the centre of the first; the middle stays the middle. */
        {SAME ",\"pixelCenter\": 0, \"K\": [300,0,180, 0,250,90, 0,0,1]", {1, 2, 10}, {210.5, 140.5}},
        {SAME ",\"pixelCenter\": 0.5, \"K\": [300,0,180, 0,250,90, 0,0,1]", {1, 2, 10}, {210, 140}},
        {SAME ",\"pixelCenter\": 0, \"intrinsics\": {\"fx\": 300}", {1, 2, 10}, {230, 160}},
        /* With a pose as in OpenGL: 2 up is -2 down. */
        {EYE10 ",\"K\": [300,20,180, 0,250,90, 0,0,1]", {1, 2, 0}, {206, 40}},
    };
    ASSERT_SEEN(sights);
}

TEST(projection_matrix_leads_to_clip_space)
{
    static const struct sight sights[] = {
        /* Clip space (0.25, 0.5, 0, 1). */
        {"\"projectionMatrix\": [0.25,0,0,0, 0,0.5,0,0, 0,0,-1,0, 0,0,0,1]", {1, 1, 0}, {250, 50}},
        /* Clip space (1, 4, ., 10). */
        {EYE10 ",\"projectionMatrix\": [[1,0,0,0],[0,2,0,0],[0,0,-1,-1],[0,0,-1,0]]", {1, 2, 0}, {220, 60}},
    };
    ASSERT_SEEN(sights);
}

/* ---- what is reported ---- */

TEST(info_gives_back_the_k_that_was_given)
{
    static const char text[] =
        "{\"window\": {\"width\": 641, \"height\": 479}, \"meshes\": [" CUBE
        "], \"outputs\": [{\"channel\": \"info\"}],"
        "\"view\": {\"R\": [1,0,0,0,1,0,0,0,1], \"t\": [0,0,5], \"K\": [525.5,-3.25,319.75, 0,520.25,1.5, 0,0,1]}}";
    static const double want[3][3] = {{525.5, -3.25, 319.75}, {0, 520.25, 1.5}, {0, 0, 1}};
    struct reading *reading = read_scene(text);
    const struct zr_answer answer = scene_encode(&reading->arena, NULL, reading->scene);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    const cJSON *k = cJSON_GetObjectItem(cJSON_GetObjectItem(info, "camera"), "K");
    assert_int_equal(cJSON_GetArraySize(k), 3);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) /* a principal point is half a window beside its middle, in float */
            assert_true(fabs(cJSON_GetArrayItem(cJSON_GetArrayItem(k, i), j)->valuedouble - want[i][j]) < 5e-5);
    cJSON_Delete(info);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
