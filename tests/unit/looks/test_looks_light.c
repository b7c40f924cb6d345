/* Looks: lamps, materials, views, and what needs linear light. */
#include "base/run.h"
#include "scene/camera/resolved_view.h"
#include "shade/frame.h"
#include "support/tests.h"
#include "unit/common/looks_check.h"

/* ---- lamps ---- */

TEST(lamps_of_a_scene_replace_those_of_the_look_and_its_environment)
{
    static const struct {
        const char *rest;
        uint32_t lights;
        float ambient;
        enum zr_environment_name environment;
    } cases[] = {
        {"\"lights\": []", 0, 0.2f, ZR_ENVIRONMENT_NONE},
        {"\"lights\": [{\"type\": \"directional\", \"direction\": [0,0,-1]}]", 1, 0.2f, ZR_ENVIRONMENT_NONE},
        {"\"ambient\": [0.5, 0.5, 0.5]", 0, 0.5f, ZR_ENVIRONMENT_NONE},
        {"\"ambient\": [0.5, 0.5, 0.5], \"lights\": []", 0, 0.5f, ZR_ENVIRONMENT_NONE},
        {"\"lights\": [], \"environment\": \"outdoor\"", 0, 0, ZR_ENVIRONMENT_OUTDOOR},
        {"\"lights\": [], \"environment\": {\"intensity\": 1}", 0, 0, ZR_ENVIRONMENT_STUDIO},
        {"\"ambient\": [0.5, 0.5, 0.5], \"environment\": \"studio\"", 0, 0.5f, ZR_ENVIRONMENT_STUDIO},
        {"\"lights\": [], \"environment\": false", 0, 0.2f, ZR_ENVIRONMENT_NONE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_look("studio@1", cases[i].rest);
        assert_int_equal(reading->scene->light_count, cases[i].lights);
        assert_true(reading->scene->ambient.y == cases[i].ambient);
        assert_int_equal(reading->scene->picture->environment.name, cases[i].environment);
        reading_free(reading);
    }
}

TEST(lamps_of_the_textbook_stay_in_linear_light_and_beside_ambient)
{
    static const char *const rests[] = {"\"colorManagement\": \"srgb\"", "\"shading\": \"pbr\"",
                                        "\"ambient\": [0.34, 0.34, 0.34]", "\"environment\": false"};
    for (size_t i = 0; i < sizeof rests / sizeof rests[0]; i++) {
        struct reading *reading = read_rest(rests[i]);
        assert_read(reading);
        assert_ptr_equal(reading->scene->lights, zr_look_textbook()->lights);
        assert_int_equal(reading->scene->light_count, 2);
        assert_true(reading->scene->ambient.x == 0.34f);
        reading_free(reading);
    }
}

TEST(lamps_go_with_the_environment)
{
    struct reading *reading = read_look("studio", "\"environment\": \"outdoor\"");
    assert_ptr_equal(reading->scene->lights, zr_look_find("outdoor@1")->lights);
    reading_free(reading);
    reading = read_look("textbook", "\"environment\": \"studio\"");
    assert_ptr_equal(reading->scene->lights, zr_look_find("studio@1")->lights);
    assert_true(reading->scene->ambient.x == 0);
    reading_free(reading);
    /* Without it they light what it lit. */
    reading = read_look("studio", "\"environment\": false");
    assert_int_equal(reading->scene->light_count, zr_look_find("studio")->light_count);
    for (uint32_t i = 0; i < reading->scene->light_count; i++)
        assert_int_equal(reading->scene->lights[i].lit, ZR_LIT_ALL);
    reading_free(reading);
    /* The sun is there anyway. */
    reading = read_look("outdoor", "\"environment\": false");
    const struct zr_light *sun = &reading->scene->lights[reading->scene->light_count - 1];
    assert_ptr_equal(reading->scene->lights, zr_look_find("outdoor")->lights);
    assert_true(sun->has_shadows && sun->lit == ZR_LIT_PBR && sun->environment_frame && !sun->camera_frame);
    reading_free(reading);
}

TEST(lights_are_of_two_types)
{
    struct reading *reading =
        read_rest("\"up\": \"z\", \"lights\": [{\"type\": \"hemisphere\", \"sky\": [1, 0, 0], \"ground\": [0, 0.5, 0],"
                  " \"intensity\": 2}, {\"type\": \"hemisphere\", \"frame\": \"camera\"}, {\"type\": \"hemisphere\","
                  " \"up\": [3, 0, 4]}, {\"type\": \"directional\", \"direction\": [0, -2, 0], \"shadows\": true}]");
    assert_read(reading);
    const struct zr_light *lights = reading->scene->lights;
    assert_int_equal(reading->scene->light_count, 4);
    assert_true(lights[0].type == ZR_LIGHT_HEMISPHERE && lights[0].color.x == 2 && lights[0].ground.y == 1);
    assert_true(lights[0].direction.z == 1 && lights[0].direction.y == 0 && !lights[0].camera_frame);
    assert_true(lights[1].direction.y == 1 && lights[1].color.x == 1 && lights[1].ground.x == 0);
    assert_true(lights[2].direction.x == 3 * (1.0f / 5) && lights[2].lit == ZR_LIT_ALL);
    assert_true(lights[3].type == ZR_LIGHT_DIRECTIONAL && lights[3].has_shadows && lights[3].direction.y == -1);
    assert_true(reading->scene->picture->is_linear);
    reading_free(reading);
}

/* A lamp behind a surface whose normals turn away from the eye: half way between both is behind the normals, where
 * glTF's distribution of microfacets is 0. What is left is Lambert's light. */
TEST(a_lamp_behind_has_no_highlight)
{
    struct reading *reading = read_scene(
        "{\"window\": {\"width\": 8, \"height\": 8}, \"background\": \"black\", \"shading\": \"pbr\", \"ambient\": [0, "
        "0, 0], "
        "\"lights\": [{\"type\": \"directional\", \"direction\": [0, -0.1, 1]}], \"view\": {\"preset\": \"front\"}, "
        "\"polygons\": [{\"vertices\": [[-1,-1,0],[1,-1,0],[0,1,0]], "
        "\"normals\": [[0,-0.96,-0.25],[0,-0.96,-0.25],[0,-0.96,-0.25]]}]}");
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame), ZR_OK);
    int most = 0;
    for (int i = 0; i < 4 * 8 * 8; i++)
        if (i % 4 < 3 && frame->color[i] > most) most = frame->color[i];
    assert_in_range(most, 1, 120);
    reading_free(reading);
}

/* ---- materials ---- */

TEST(what_a_material_says_goes_before_the_look_key_by_key)
{
    struct reading *reading = read_scene(
        "{\"materials\": [{\"name\": \"m\", \"baseColorFactor\": \"red\", \"roughnessFactor\": 0.125,"
        " \"emissiveFactor\": [1, 2, 3], \"cool\": \"blue\"}, {\"name\": \"plain\"}], \"look\": \"metal\","
        " \"polygons\": [{" TRIANGLE ", \"material\": \"m\"}, {" TRIANGLE ", \"color\": \"lime\"}, {" TRIANGLE "},"
        " {" TRIANGLE ", \"material\": \"plain\"}]}");
    const uint32_t *numbers = reading->scene->meshes[0].face_materials;
    const struct zr_material *given = &reading->scene->materials[numbers[0]],
                             *coloured = &reading->scene->materials[numbers[1]],
                             *bare = &reading->scene->materials[numbers[2]];
    assert_true(given->base_color.x == 1 && given->base_color.y == 0);
    assert_true(given->metallic == 1 && given->roughness == 0.125f && given->emissive.z == 3 && given->cool.z == 1);
    assert_true(given->specular.x == 0.12f && given->shininess == 32 && given->shading == ZR_SHADING_PBR);
    assert_true(coloured->base_color.x == 1 && coloured->base_color.y == 1 && coloured->roughness == 0.32f);
    assert_true(zr_vec4_equal(bare->base_color, zr_look_find("metal")->material.base_color));
    assert_ptr_equal(&reading->scene->materials[numbers[3]], bare);
    reading_free(reading);
}

/* ---- views ---- */

TEST(a_view_of_its_own_replaces_that_of_the_look)
{
    struct reading *reading = read_look("studio", "\"view\": {\"preset\": \"top\"}");
    assert_int_equal(reading->scene->views[0].pose, ZR_POSE_PRESET);
    assert_int_equal(reading->scene->views[0].projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(reading->scene->views[0].fit_padding == 0.05f);
    reading_free(reading);
    reading = read_look("studio", "\"view\": {}");
    assert_int_equal(reading->scene->views[0].preset, ZR_PRESET_ISOMETRIC);
    assert_int_equal(reading->scene->views[0].pose, ZR_POSE_PRESET);
    reading_free(reading);
}

/* What is drawn with z up is what is drawn with y up, turned. */
TEST(views_with_z_up_are_turned_ones)
{
    static const struct {
        const char *with_y, *with_z;
    } pairs[] = {
        {"{\"preset\": \"front\"}", NULL},
        {"{\"preset\": \"back\"}", NULL},
        {"{\"preset\": \"left\"}", NULL},
        {"{\"preset\": \"right\"}", NULL},
        {"{\"preset\": \"top\"}", NULL},
        {"{\"preset\": \"bottom\"}", NULL},
        {"{\"preset\": \"isometric\"}", NULL},
        {"{\"azimuthDegrees\": 20, \"elevationDegrees\": 30}", NULL},
        {"{\"direction\": [0, -1, 0]}", "{\"direction\": [0, 0, -1]}"},
        {"{\"direction\": [0, 1, 0]}", "{\"direction\": [0, 0, 1]}"},
        {"{\"direction\": [1, -2, -3]}", "{\"direction\": [1, 3, -2]}"},
        {"{\"eye\": [1, 2, 3]}", "{\"eye\": [1, -3, 2]}"},
        {"{\"eye\": [0, 5, 0]}", "{\"eye\": [0, 0, 5]}"},
        {"{\"eye\": [1, -5, 0], \"target\": [1, 0, 0]}", "{\"eye\": [1, 0, -5], \"target\": [1, 0, 0]}"},
        {"{\"eye\": [1, 2, 3], \"up\": [0, 0, -1]}", "{\"eye\": [1, -3, 2], \"up\": [0, 1, 0]}"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        char texts[2][256];
        zr_vec4 seen[2][3];
        snprintf(texts[0], sizeof texts[0], "\"view\": %s", pairs[i].with_y);
        snprintf(texts[1], sizeof texts[1], "\"view\": %s, \"up\": \"z\"",
                 pairs[i].with_z ? pairs[i].with_z : pairs[i].with_y);
        for (int z = 0; z < 2; z++) {
            struct reading *reading = read_rest(texts[z]);
            const struct zr_resolved_view *resolved;
            struct zr_error error = {.count = 0};
            assert_read(reading);
            assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &reading->arena, .error = &error},
                                                   reading->scene, &resolved),
                             ZR_OK);
            const zr_vec4 points[2][3] = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}},
                                          {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}};
            for (int k = 0; k < 3; k++)
                seen[z][k] = zr_mat4_apply(&resolved->camera.world_to_eye, points[z][k]);
            reading_free(reading);
        }
        for (int k = 0; k < 3; k++)
            if (fabsf(seen[0][k].x - seen[1][k].x) > 1e-6f || fabsf(seen[0][k].y - seen[1][k].y) > 1e-6f ||
                fabsf(seen[0][k].z - seen[1][k].z) > 1e-6f)
                fail_msg("%s", texts[1]);
    }
}

/* ---- linear light ---- */

static const struct {
    const char *rest, *name;
} linear[] = {
    {"\"look\": \"studio\"", "look"},
    {"\"look\": \"blueprint\"", "look"},
    {"\"shading\": \"pbr\"", "shading"},
    {"\"shading\": \"gooch\"", "shading"},
    {"\"environment\": \"studio\"", "environment"},
    {"\"toneMapping\": \"neutral\"", "toneMapping"},
    {"\"exposure\": 1", "exposure"},
    {"\"occlusion\": true", "occlusion"},
    {"\"groundShadow\": true", "groundShadow"},
    {"\"edges\": true", "edges"},
    {"\"background\": {\"top\": \"red\", \"bottom\": \"red\"}", "background"},
    {"\"creaseDegrees\": 180", "creaseDegrees"},
    {"\"lights\": [{\"type\": \"hemisphere\"}]", "hemisphere"},
    {"\"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, 1], \"shadows\": true}]", "shadows"},
    {"\"materials\": [{\"name\": \"m\", \"metallicFactor\": 0}]", "metallicFactor"},
    {"\"materials\": [{\"name\": \"m\", \"roughnessFactor\": 1}]", "roughnessFactor"},
    {"\"materials\": [{\"name\": \"m\", \"emissiveFactor\": [0, 0, 0]}]", "emissiveFactor"},
    {"\"materials\": [{\"name\": \"m\", \"cool\": \"red\"}]", "cool"},
};
enum { LINEAR = sizeof linear / sizeof linear[0] };

TEST(keys_that_need_linear_light_switch_it_on)
{
    static const char *const others[] = {
        "\"toneMapping\": \"none\"",
        "\"occlusion\": false",
        "\"groundShadow\": false",
        "\"edges\": false",
        "\"environment\": false",
        "\"samples\": 16",
        "\"lineWidth\": 3",
        "\"up\": \"z\"",
        "\"background\": \"red\"",
        "\"look\": \"textbook\"",
        "\"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, 1], \"shadows\": false}]",
        "\"shading\": \"phong\"",
        "\"colorManagement\": \"none\""};
    for (int i = 0; i < LINEAR; i++) {
        struct reading *reading = read_rest(linear[i].rest);
        assert_read(reading);
        assert_true(reading->scene->picture->is_linear);
        reading_free(reading);
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        struct reading *reading = read_rest(others[i]);
        assert_read(reading);
        assert_false(reading->scene->picture->is_linear);
        reading_free(reading);
    }
}

/* ---- samples ---- */

TEST(samples_fit_the_window)
{
    static const struct {
        const char *rest;
        uint32_t side;
    } cases[] = {
        {"\"look\": \"studio\", \"window\": {\"width\": 4096, \"height\": 8}", 4},
        {"\"look\": \"studio\", \"window\": {\"width\": 4097, \"height\": 8}", 2},
        {"\"look\": \"studio\", \"window\": {\"width\": 8, \"height\": 8192}", 2},
        {"\"samples\": 64, \"window\": {\"width\": 2048, \"height\": 8}", 8},
        {"\"samples\": 4, \"window\": {\"width\": 8192, \"height\": 8}", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_rest(cases[i].rest);
        assert_read(reading);
        assert_int_equal(reading->scene->picture->side, cases[i].side);
        const bool is_less = i < 3 && cases[i].side < 4;
        assert_int_equal(reading->scene->warning_count, is_less);
        if (is_less)
            assert_non_null(strstr(reading->scene->warnings[0], "samples: 4 a pixel instead of the look's 16"));
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
