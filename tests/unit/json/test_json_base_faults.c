/* Scenes with a base that are refused, and what is said of them. */
#include "unit/common/base_scenes.h"
#include "support/tests.h"

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
    assert_int_equal(zr_render(&reading->arena, NULL, reading->scene, NULL, NULL, &frame, &error), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/base/depth");
    assert_non_null(strstr(error.items[0].detail, "give windowDepth"));
    reading_free(reading);
}

TEST(ids_that_clash_or_do_not_fit_are_refused)
{
    const uint32_t highest[PIXELS] = {UINT32_MAX}, last_but_one[PIXELS] = {UINT32_MAX - 1};
    const char *text =
        HEAD BASE("\"color\":{\"asset\":\"c\"},\"windowDepth\":{\"asset\":\"w\"},\"faceId\":{\"asset\":\"x\"}") "}";
    refuses_with(text, npy_asset("x", ZR_NPY_UINT32, highest), "/base/firstFaceId", "do not fit 32 bits");
    struct reading *reading = read_with(text, npy_asset("x", ZR_NPY_UINT32, last_but_one), NULL);
    assert_read(reading);
    assert_int_equal(reading->scene->base->first_face_id, UINT32_MAX);
    reading_free(reading);
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":7") "}", NO_EXTRA, "/base/firstFaceId", "base.faceId has 7 already");
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":0") "}", NO_EXTRA, "/base/firstFaceId", "the id of nothing");
    refuses_with(HEAD BASE(ALL ",\"firstFaceId\":-1") "}", NO_EXTRA, "/base/firstFaceId", "outside of 0");
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
    refuses_with(HEAD BASE("\"color\":{\"asset\":\"c\"}") "}", NO_EXTRA, "/base", "windowDepth is missing");
    refuses_with(HEAD BASE("") "}", NO_EXTRA, "/base", "windowDepth is missing");
}

TEST(bases_that_are_not_one_are_refused_where_it_shows)
{
    static const struct {
        const char *text, *pointer, *detail;
    } cases[] = {
        {HEAD "\"base\":7}", "/base", "expected an object"},
        {HEAD BASE(ALL ",\"colour\":1") "}", "/base/colour", "unknown key"},
        {HEAD BASE(ALL ",\"ties\":\"new\"") "}", "/base/ties", "'new' is unknown; allowed: base, scene"},
        {HEAD BASE("\"windowDepth\":7") "}", "/base/windowDepth", "expected a data: URI"},
        {HEAD BASE("\"windowDepth\":{}") "}", "/base/windowDepth", "one of uri and asset"},
        {HEAD BASE("\"windowDepth\":{\"uri\":\"data:,\",\"asset\":\"w\"}") "}", "/base/windowDepth", "only one"},
        {HEAD BASE("\"windowDepth\":{\"asset\":7}") "}", "/base/windowDepth/asset", "expected a string"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"z\"}") "}", "/base/windowDepth/asset", "has the name 'z'"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"sha256:00\"}") "}", "/base/windowDepth/asset",
         "64 lower-case hexadecimal digits"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"sha256:" HASH_W "\"}") "}", "/base/windowDepth/asset",
         "no assets are kept here"},
        {HEAD BASE("\"windowDepth\":{\"url\":\"x\"}") "}", "/base/windowDepth/url", "unknown key"},
        {HEAD BASE("\"windowDepth\":\"http://a/b.npy\"") "}", "/base/windowDepth", "nothing is fetched"},
        {HEAD BASE("\"windowDepth\":{\"uri\":\"data:;base64,Zm9\"}") "}", "/base/windowDepth/uri", "cut short"},
        {HEAD BASE("\"windowDepth\":\"data:;base64,Zm9v\"") "}", "/base/windowDepth", "not an NPY file"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"f\"}") "}", "/base/windowDepth", "float32 is needed"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"color\":{\"asset\":\"w\"}") "}", "/base/color", "not a PNG"},
        {HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"faceId\":{\"asset\":\"w\"}") "}", "/base/faceId",
         "uint32 is needed"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuses_with(cases[i].text, NO_EXTRA, cases[i].pointer, cases[i].detail);
}

TEST(values_outside_of_their_range_are_refused_by_pixel)
{
    static const char depth_text[] = HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"depth\":{\"asset\":\"x\"}") "}";
    static const char window_text[] = HEAD BASE("\"windowDepth\":{\"asset\":\"x\"}") "}";
    const float bad[] = {NAN, INFINITY, -INFINITY, -0.001f, 1.0000001f};
    for (size_t i = 0; i < 5; i++) {
        float values[PIXELS] = {0, 1, -0.0f};
        values[6] = values[7] = bad[i];
        refuses_with(window_text, npy_asset("x", ZR_NPY_FLOAT32, values), "/base/windowDepth",
                     "pixel (2, 1), counted from the top left");
    }
    const float values[PIXELS] = {0, 0, 0, 0, 0, -INFINITY};
    refuses_with(depth_text, npy_asset("x", ZR_NPY_FLOAT32, values), "/base/depth", "pixel (1, 1)");
}

TEST(picture_of_another_size_is_refused)
{
    refuses_with(HEAD BASE("\"windowDepth\":{\"asset\":\"w\"},\"color\":{\"asset\":\"x\"}") "}",
                 png_asset("x", ZR_PNG_RGB, 64, 64), "/base/color", "64 x 64 pixels, not the window's 4 x 2");
}

TEST(window_beyond_its_limits_is_refused_for_itself)
{
    refuses_with("{\"window\":{\"width\":0},\"view\":{\"znear\":1,\"zfar\":9},\"polygons\":[{\"vertices\":[[0,0,0],[1,"
                 "0,0],[0,1,0]]}]," BASE(ALL) "}",
                 NO_EXTRA, "/window/width", "0 pixels");
}

TEST(memory_that_is_short_is_said_so)
{
    static const char text[] = HEAD OUTPUTS "," BASE(ALL) "}";
    struct zr_request request = {.format = ZR_FORMAT_JSON, .assets = assets, .asset_count = ASSETS - 1};
    assert_in_range(smallest_ceiling(request, text, sizeof text - 1, 1 << 18), 10000, 1 << 18);
}

RUN_TESTS(make_assets, free_assets)
