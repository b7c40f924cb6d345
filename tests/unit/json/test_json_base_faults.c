/* Scenes with a base that are refused for their view, outputs or size. Other refusals: tests/refusals/json-base.txt. */
#include "base/run.h"
#include "support/tests.h"
#include "unit/common/base_scenes.h"

/* A z-buffer means nothing without the planes that it was drawn between; eye-space depth needs none. */
TEST(window_depth_without_its_planes_is_refused)
{
    static const struct {
        const char *view;
        bool good;
    } cases[] = {{"\"preset\":\"front\"", false},
                 {"\"eye\":[0,0,2],\"znear\":1", false},
                 {"\"eye\":[0,0,2],\"zfar\":9", false},
                 {"\"eye\":[0,0,2],\"znear\":1,\"zfar\":9", true},
                 {"\"projectionMatrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", true}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const bool metric = i % 2;
        char text[512];
        snprintf(text, sizeof text,
                 "{\"window\":{\"width\":4,\"height\":2},\"view\":{%s},\"outputs\":[{\"channel\":\"depth\"}],"
                 "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"base\":{%s\"depth\":{\"asset\":\"d\"}}}",
                 cases[i / 2].view, metric ? "" : "\"windowDepth\":{\"asset\":\"w\"},");
        if (cases[i / 2].good || metric)
            reading_free(read_good(text));
        else
            refuses_with(text, NO_EXTRA, "/view", "znear and zfar are missing");
    }
    refuses_with(
        "{\"window\":{\"width\":4,\"height\":2},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]," BASE(ALL) "}",
        NO_EXTRA, "/view", "znear and zfar are missing");
}

TEST(depth_in_an_oblique_projection_is_refused)
{
    struct reading *reading = read_good(
        "{\"window\":{\"width\":4,\"height\":2},\"view\":{\"projectionMatrix\":[1,0,0.5,0,0,1,0,0,0,0,1,0,0,0,0,"
        "1]},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}],\"outputs\":[{\"channel\":\"depth\"}]," BASE(
            "\"depth\":{\"asset\":\"d\"}") "}");
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame),
        ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/base/depth");
    assert_non_null(strstr(error.items[0].detail, "give windowDepth"));
    reading_free(reading);
}

TEST(last_id_of_a_base_may_be_the_highest_but_one)
{
    const uint32_t last_but_one[PIXELS] = {UINT32_MAX - 1};
    struct reading *reading = read_with(
        HEAD BASE("\"color\":{\"asset\":\"c\"},\"windowDepth\":{\"asset\":\"w\"},\"faceId\":{\"asset\":\"x\"}") "}",
        npy_asset("x", ZR_NPY_UINT32, last_but_one), NULL);
    assert_read(reading);
    assert_int_equal(reading->scene->base->first_face_id, UINT32_MAX);
    reading_free(reading);
}

TEST(what_the_outputs_need_must_be_there)
{
    static const char only_depth[] = HEAD BASE("\"windowDepth\":{\"asset\":\"w\"}") "}";
    static const struct {
        const char *channel, *pointer;
    } cases[] = {{NULL, "/base/color"},
                 {"color", "/base/color"},
                 {"depth", "/base/depth"},
                 {"faceId", "/base/faceId"},
                 {"info", "/base/faceId"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_with(only_depth, NO_EXTRA, cases[i].channel);
        assert_complaint(reading, ZR_BAD_SCENE, cases[i].pointer, "missing");
        reading_free(reading);
    }
    struct reading *reading = read_with(only_depth, NO_EXTRA, "windowDepth");
    assert_read(reading);
    reading_free(reading);
}

TEST(picture_of_another_size_is_refused)
{
    refuses_with(HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"color\":{\"asset\":\"x\"}") "}",
                 png_asset("x", ZR_PNG_RGB, 64, 64), "/base/color", "64 x 64 pixels, not the window's 4 x 2");
}

TEST(memory_that_is_short_is_said_so)
{
    static const char text[] = HEAD OUTPUTS "," BASE(ALL) "}";
    struct zr_request request = {.format = ZR_FORMAT_JSON, .assets = assets, .asset_count = ASSETS - 1};
    assert_in_range(smallest_ceiling(request, text, sizeof text - 1, 1 << 18), 10000, 1 << 18);
}

RUN_TESTS(make_assets, free_assets)
