/* alphaMode and alphaCutoff in JSON, and the warning of an alpha without an alphaMode. */
#include "json_check.h"
#include "support/tests.h"

TEST(alpha_gives_one_warning)
{
    static const char *const texts[] = {
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}, {" TRIANGLE ", \"color\": \"#ff000080\"}]}",
        "{\"polygons\": [{" TRIANGLE ", \"material\": \"glass\"}], \"materials\": [{\"name\": \"glass\", "
        "\"baseColorFactor\": [1,1,1,0.5]}]}",
        "{\"polygons\": [{" TRIANGLE ", \"colors\": [[1,1,1],[1,1,1],[1,1,1,0]]}]}",
        "{\"meshes\": [{" POSITIONS ", \"faces\": [[0,1,2]], \"faceColors\": [[0,0,0,0]]}]}",
        "{" POLYGONS ", \"outline\": \"#ff000080\"}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_scene(texts[i]);
        assert_int_equal(reading->scene->warning_count, 1);
        assert_non_null(strstr(reading->scene->warnings[0], "alpha below 1"));
        reading_free(reading);
    }
    struct reading *reading = read_rest("\"background\": \"#ffffff00\"");
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 0);
    assert_true(reading->scene->background.w == 0);
    reading_free(reading);
}

/* By the mesh, its material or the scene. */
TEST(explicit_opaque_ends_the_warning)
{
    static const char *const texts[] = {
        "{\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\", \"alphaMode\": \"OPAQUE\"}]}",
        "{\"alphaMode\": \"OPAQUE\", \"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}]}",
        "{\"polygons\": [{" TRIANGLE
        ", \"material\": \"m\", \"color\": \"#ff000080\"}], \"materials\": [{\"name\": \"m\", "
        "\"alphaMode\": \"OPAQUE\"}]}",
        "{\"alphaMode\": \"MASK\", \"meshes\": [{\"alphaMode\": \"OPAQUE\", " POSITIONS
        ", \"faces\": [[0,1,2]], \"faceColors\": [[1,0,0,0.3]]}]}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_scene(texts[i]);
        if (reading->scene->warning_count != 0) fail_msg("%s: %s", texts[i], reading->scene->warnings[0]);
        reading_free(reading);
    }
}

/* The nearest alphaMode counts; alpha is then nothing to warn of. */
TEST(alpha_modes_are_those_of_the_nearest_that_say_one)
{
    struct reading *reading = read_scene(
        "{\"alphaMode\": \"BLEND\", \"materials\": [{\"name\": \"m\", \"alphaMode\": \"MASK\", \"alphaCutoff\": "
        "0.25}], "
        "\"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}, {" TRIANGLE ", \"material\": \"m\"}, "
        "{" TRIANGLE ", \"material\": \"m\", \"alphaMode\": \"OPAQUE\"}, {" TRIANGLE ", \"alphaMode\": \"MASK\"}]}");
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    static const enum zr_alpha_mode want[] = {ZR_ALPHA_BLEND, ZR_ALPHA_MASK, ZR_ALPHA_OPAQUE, ZR_ALPHA_MASK};
    for (uint32_t f = 0; f < 4; f++) {
        const struct zr_material *material = zr_material_of_face(scene, &scene->meshes[0], f);
        assert_int_equal(material->alpha_mode, want[f]);
        if (want[f] == ZR_ALPHA_MASK) assert_true(material->alpha_cutoff == (f == 1 ? 0.25f : 0.5f));
    }
    assert_int_equal(scene->warning_count, 0);
    reading_free(reading);
}

TEST(alpha_modes_that_are_none_and_what_cannot_have_any_are_refused)
{
    static const struct {
        const char *rest, *pointer, *detail;
    } cases[] = {{"\"alphaMode\": \"blend\"", "/alphaMode", "BLEND"},
                 {"\"alphaMode\": \"MASK\", \"alphaCutoff\": 1.5", "/alphaCutoff", "1"},
                 {"\"alphaMode\": \"BLEND\", \"algorithm\": \"painter\"", "/algorithm", "painter keeps no fragments"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 640, \"y\": 0}]", "", "640, 0, beside the window"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 0, \"y\": 480}]", "", "0, 480, beside the window"},
                 {"\"outputs\": [{\"channel\": \"fragments\", \"x\": 639, \"y\": 479}], \"algorithm\": \"painter\"",
                  "/algorithm", "fragments needs"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_rest(cases[i].rest);
        assert_int_equal(reading->status, ZR_BAD_SCENE);
        assert_string_equal(reading->error.items[0].pointer, cases[i].pointer);
        assert_non_null(strstr(reading->error.items[0].detail, cases[i].detail));
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
