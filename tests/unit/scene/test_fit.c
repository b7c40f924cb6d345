/* Views that leave the place of the camera to the geometry: known corners on known pixels, worked
 * out by hand, in a window of 40 x 20. */
#include "support/tests.h"
#include "unit/common/view_check.h"

#define SMALL "{\"width\": 40, \"height\": 20}"

TEST(fitted_cube_touches_the_borders)
{
    static const struct sight sights[] = {
        /* 5 % free above: 1 unit is 9 of the 10 pixels to the top. */
        {"\"preset\": \"front\"", {1, 1, 1}, {29, 1}},
        {"\"azimuthDegrees\": 0", {1, 1, 1}, {29, 1}},
        {"\"direction\": [0,0,-1], \"fit\": {\"padding\": 0.25}", {1, 1, 1}, {25, 5}},
        /* 90 degrees: 1 away from the near face, where y / z is 1; with half of the room, 2 away. */
        {"\"preset\": \"front\", \"fit\": {\"padding\": 0}," P90, {1, 1, 1}, {30, 0}},
        {"\"preset\": \"front\", \"fit\": {\"padding\": 0.25}," P90, {1, 1, 1}, {25, 5}},
        {"\"preset\": \"front\", \"fit\": {\"padding\": 0.25}," P90, {1, 1, -1}, {22.5, 7.5}},
        /* The target stays in the middle: the cube is from -2 to 0, and touches top and left. */
        {"\"azimuthDegrees\": 0, \"target\": [1,0,0], \"fit\": {\"padding\": 0}," P90, {1, 1, 1}, {20, 0}},
        {"\"azimuthDegrees\": 0, \"target\": [1,0,0], \"fit\": {\"padding\": 0}," P90, {-1, -1, 1}, {0, 20}},
        {"\"azimuthDegrees\": 0, \"target\": [1,0,0], \"fit\": {\"padding\": 0}", {-1, -1, 1}, {0, 20}},
    };
    assert_seen(SMALL, CUBE, sights, sizeof sights / sizeof *sights);
}

/* fx = 10: x / z is seen from (0 - cx) / 10 to (40 - cx) / 10; cy = 10: y / z from -1 to 1, for which the eye
 * must be 1 away from the near face, at z = 2. */
TEST(fitted_cube_is_seen_whole_wherever_the_principal_point_is)
{
#define K_AT(cx)                                                                                                       \
    "\"preset\": \"front\", \"fit\": {\"padding\": 0}, \"intrinsics\": {\"fx\": 10, \"cx\": " cx ", \"cy\": 10}"
#define SKEWED(cy) "\"preset\": \"front\", \"fit\": {\"padding\": 0}, \"K\": [20,10,20, 0,10," cy ", 0,0,1]"
    static const struct sight sights[] = {
        {K_AT("20"), {1, 1, 1}, {30, 0}},
        /* From -1 to 3: an eye at x = -2 would have the cube on the right border, one at 0 on the left, so -1. */
        {K_AT("10"), {1, 1, 1}, {30, 0}},
        {K_AT("10"), {-1, -1, 1}, {10, 20}},
        /* From 1 to 5: only from x = -4 is the near right corner at 5 / 1 and the far left one at 3 / 3. */
        {K_AT("-10"), {1, 1, 1}, {40, 0}},
        {K_AT("-10"), {-1, 1, -1}, {0, 10 - 10.0 / 3}},
        /* fx = 20, skew = 10: x - y / 2 counts, from -1.5 to 1.5, seen from -1 to 1: so 1.5 from the near face. */
        {SKEWED("10"), {1, -1, 1}, {40, 10 + 10 / 1.5}},
        {SKEWED("10"), {-1, 1, 1}, {0, 10 - 10 / 1.5}},
        /* y / z from -2 to 0: an eye at y = 1 would have the cube on the upper border, one at 2 on the lower, so
         * 1.5, and x = 0.75 to be in the middle as before. */
        {SKEWED("0"), {1, -1, 1}, {40, 10 * 2.5 / 1.5}},
        {SKEWED("0"), {-1, 1, 1}, {0, 10 * 0.5 / 1.5}},
    };
    assert_seen(SMALL, CUBE, sights, sizeof sights / sizeof *sights);
}

TEST(views_without_a_solution_are_refused)
{
    static const struct {
        const char *view, *pointer, *detail;
    } cases[] = {
        {"\"azimuthDegrees\": 0, \"target\": [0,0,0], \"intrinsics\": {\"fx\": 10, \"cx\": -1}", "/view/target",
         "the principal point is outside of the window"},
        {"\"azimuthDegrees\": 0, \"target\": [0,0,0], \"intrinsics\": {\"fx\": 10, \"cy\": 20}", "/view/target",
         "the principal point is outside of the window"},
        {"\"azimuthDegrees\": 0, \"up\": [0,0,0]", "/view/up", "there is no axis to turn around"},
        {"\"direction\": [1,2,3], \"up\": [2,4,6]", "/view/up", "up is zero or along the line of sight"},
        {"\"direction\": [1,2,3], \"up\": [0,0,0]", "/view/up", "up is zero or along the line of sight"},
        {"\"azimuthDegrees\": 0, \"distance\": 1e6, \"perspective\": {\"yfov\": 1e-30}", "/view",
         "numbers of the camera overflow"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct shot shot = shoot(SMALL, CUBE, cases[i].view);
        assert_int_equal(shot.status, ZR_BAD_SCENE);
        assert_string_equal(shot.error.items[0].pointer, cases[i].pointer);
        assert_non_null(strstr(shot.error.items[0].detail, cases[i].detail));
        reading_free(shot.reading);
    }
}

TEST(fit_to_a_mesh_shows_it_alone_but_keeps_all_between_the_planes)
{
    static const struct sight sights[] = {
        /* Half a unit is 8 of the 10 pixels to the top. */
        {"\"preset\": \"front\", \"fit\": {\"mesh\": \"nut\", \"padding\": 0.1}", {10.5f, 0.5f, 0.5f}, {28, 2}},
        {"\"preset\": \"front\", \"fit\": {\"mesh\": \"nut\", \"padding\": 0.1}", {9.5f, -0.5f, 0.5f}, {12, 18}},
        {"\"eye\": [0,0,10], \"orthographic\": {}, \"fit\": {\"mesh\": \"cube\", \"padding\": 0}", {1, 1, 1}, {30, 0}},
        {"\"azimuthDegrees\": 0, \"fit\": {\"mesh\": \"nut\", \"padding\": 0}," P90, {10.5f, 0.5f, 0.5f}, {30, 0}},
        {"\"azimuthDegrees\": 0, \"target\": [10,0,0], \"fit\": {\"mesh\": \"nut\", \"padding\": 0}," P90,
         {10.5f, 0.5f, 0.5f},
         {30, 0}},
    };
    assert_seen(SMALL, CUBE "," NUT, sights, sizeof sights / sizeof *sights);
    /* From +x the nut hides the cube; from -x it is the other way round. */
    static const char *const presets[] = {"right", "left"};
    for (int i = 0; i < 4; i++) {
        char view[128];
        snprintf(view, sizeof view, "\"preset\": \"%s\", \"fit\": {\"mesh\": \"nut\"}%s", presets[i % 2],
                 i < 2 ? "" : ",\"perspective\": {\"yfovDegrees\": 4}");
        struct shot shot = shoot(SMALL, CUBE "," NUT, view);
        const float *m = shot.camera.world_to_eye.m;
        for (int x = -1; x <= 11; x += 12) { /* beyond both ends */
            float depth = -(m[2] * (float)x + m[14]);
            assert_true(shot.camera.znear < depth + 0.5f && shot.camera.zfar > depth - 0.5f && shot.camera.znear > 0);
        }
        reading_free(shot.reading);
    }
}

TEST(fit_to_a_tiny_mesh_is_not_cut_by_a_near_plane_made_for_a_large_scene)
{
#define TINY  "{\"name\": \"tiny\", \"positions\": [[0,0,0],[0.001,0,0],[0,0.001,0.001]], \"faces\": [[0,1,2]]}"
#define LARGE "{\"positions\": [[-1000,0,-1000],[1000,0,-1000],[0,0,1000]], \"faces\": [[0,1,2]]}"
    static const zr_vec4 corners[3] = {{0, 0, 0, 1}, {0.001f, 0, 0, 1}, {0, 0.001f, 0.001f, 1}};
    struct shot shot = shoot(SMALL, TINY "," LARGE, "\"preset\": \"front\", \"fit\": {\"mesh\": \"tiny\"}," P90);
    zr_mat4 matrix = zr_mat4_mul(&shot.camera.projection, &shot.camera.world_to_eye);
    for (int i = 0; i < 3; i++) {
        zr_vec4 p = zr_mat4_apply(&matrix, corners[i]);
        assert_true(fabsf(p.x) <= p.w && fabsf(p.y) <= p.w && fabsf(p.z) <= p.w);
    }
    assert_true(shot.camera.zfar > 1000.0f);
    reading_free(shot.reading);
#undef LARGE
#undef TINY
}

TEST(azimuth_and_direction_fit_as_the_presets_do)
{
    static const char *const same[][3] = {
        {"\"preset\": \"front\"", "\"azimuthDegrees\": 0", "\"direction\": [0,0,-3]"},
        {"\"preset\": \"right\"", "\"azimuthDegrees\": 90", "\"direction\": [-1,0,0]"},
        {"\"preset\": \"back\"", "\"azimuthDegrees\": -180", "\"direction\": [0,0,1]"},
        {"\"preset\": \"left\"", "\"azimuthDegrees\": 270", "\"direction\": [1,0,0]"},
        {"\"preset\": \"top\"", "\"elevationDegrees\": 90", "\"direction\": [0,-1,0]"},
        {"\"preset\": \"bottom\"", "\"elevationDegrees\": -90", "\"direction\": [0,1,0]"}};
    for (int i = 0; i < 12; i++) {
        struct shot shots[3];
        for (int k = 0; k < 3; k++) {
            char view[128];
            snprintf(view, sizeof view, "%s%s", same[i / 2][k], i % 2 ? "," P90 : "");
            shots[k] = shoot(SMALL, CUBE "," NUT, view);
        }
        for (int k = 1; k < 3; k++)
            for (int e = 0; e < 16; e++) {
                assert_true(shots[k].camera.world_to_eye.m[e] == shots[0].camera.world_to_eye.m[e]);
                assert_true(shots[k].camera.projection.m[e] == shots[0].camera.projection.m[e]);
            }
        for (int k = 0; k < 3; k++)
            reading_free(shots[k].reading);
    }
}

/* A cube of 2 units, moved along x: each fit warns of the room that it leaves for rounding. */
TEST(fit_far_from_the_origin_warns_of_room_for_rounding)
{
    static const struct {
        const char *view;
        bool fitted;
    } views[] = {{"\"preset\": \"front\"", true},
                 {"\"preset\": \"front\"," P90, true},
                 {"\"azimuthDegrees\": 10", true},
                 {"\"eye\": [1,2,3], \"orthographic\": {}", true},
                 {"\"preset\": \"front\", \"orthographic\": {\"xmag\": 2, \"ymag\": 1}", false},
                 {"\"azimuthDegrees\": 10, \"target\": [0,0,0], \"distance\": 9", false},
                 {"\"eye\": [1,2,3]", false},
                 {"\"projectionMatrix\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", false}};
    static const int far[] = {0, 500, 1000, 1900}; /* from 1000 sizes on, the origin is moved */
    for (size_t i = 0; i < sizeof views / sizeof *views * 4; i++) {
        const int x = far[i % 4];
        char cube[512];
        snprintf(cube, sizeof cube,
                 "{\"positions\": [[%d,-1,-1],[%d,-1,-1],[%d,1,1],[%d,1,1]], \"faces\": [[0,1,2,3]]}", x - 1, x + 1,
                 x + 1, x - 1);
        struct shot shot = shoot(SMALL, cube, views[i / 4].view);
        assert_int_equal(shot.status, ZR_OK);
        const double want = views[i / 4].fitted ? 16 * 1.1920929e-7 * (x + 1) / sqrt(12) : 0;
        assert_true((double)shot.camera.fit_margin >= 0.99 * want);
        assert_true((double)shot.camera.fit_margin <= 1.01 * want + (views[i / 4].fitted ? 1e-5 : 0));
        reading_free(shot.reading);
    }
}

RUN_TESTS(NULL, NULL)
