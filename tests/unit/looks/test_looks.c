/* Looks: what rows must have, and that what a scene says of its picture goes before them, key by key. */
#include "scene/parsed_picture.h"
#include "unit/common/looks_check.h"

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "support/tests.h"

/* ---- rows ---- */

static bool is_unit(zr_vec3 v)
{
    return fabsf(zr_vec3_dot(v, v) - 1.0f) < 1e-6f;
}

static bool is_color(zr_vec3 v)
{
    return v.x >= 0 && v.x <= 1 && v.y >= 0 && v.y <= 1 && v.z >= 0 && v.z <= 1;
}

static void assert_good_lamps(const struct zr_look *look)
{
    bool classic = false, pbr = look->picture->environment.name != ZR_ENVIRONMENT_NONE;
    for (uint32_t i = 0; i < look->light_count; i++) {
        const struct zr_light *light = &look->lights[i];
        assert_true(is_unit(light->direction));
        assert_true(light->color.x >= 0 && light->color.x < 2 && light->ground.x >= 0 && light->ground.x < 1);
        assert_false(light->has_shadows && light->type == ZR_LIGHT_HEMISPHERE);
        classic |= light->lit != ZR_LIT_PBR;
        pbr |= light->lit != ZR_LIT_CLASSIC;
    }
    assert_true(classic && pbr); /* no shading is left in the dark */
}

TEST(each_row_has_what_rows_must_have)
{
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look *look = &zr_looks[i];
        const struct zr_picture *p = look->picture;
        print_message("%s@%u\n", look->name, look->version);
        assert_true(look->version >= 1 && strlen(look->name) > 0);
        assert_true(p->side == 1 || p->side == 2 || p->side == 4 || p->side == ZR_SAMPLE_SIDE_MAX);
        assert_true(p->line_width == 1 && p->exposure > 0 && p->environment.intensity == 1);
        assert_true(p->crease_degrees > 0 && p->crease_degrees <= 180);
        assert_true(p->occlusion.radius > 0 && p->occlusion.strength > 0);
        assert_true((p->edges.width > 0 || p->edges.is_from_mesh) && p->edges.crease_degrees > 0 &&
                    is_color(p->edges.color));
        assert_true(p->edges.silhouette_opacity >= 0 && p->edges.silhouette_opacity <= 1);
        assert_true(p->edges.crease_opacity > 0 && p->edges.crease_opacity <= 1);
        assert_true(p->gooch.least > 0 && fabsf(p->gooch.least + p->gooch.rise - 1) < 1e-6f);
        assert_true(is_color(p->top) && is_color(p->bottom) && look->background.w == 1);
        assert_true(look->material.base_color.w == 1 && look->material.shading < ZR_SHADING_COUNT);
        assert_true(look->material.roughness > 0 && look->material.shininess > 0 && is_color(look->material.cool));
        assert_true(look->view.padding > 0 && look->view.padding < 0.45f);
        assert_int_equal(look->view.projection == ZR_PROJECTION_PERSPECTIVE, look->view.fov_radians > 0);
        assert_good_lamps(look);
    }
}

TEST(effects_are_of_linear_light_only)
{
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_picture *p = zr_looks[i].picture;
        if (p->is_linear) continue;
        assert_ptr_equal(&zr_looks[i], zr_look_textbook());
        assert_false(p->has_gradient || p->has_ground || p->occlusion.is_on || p->edges.is_on);
        assert_true(p->environment.name == ZR_ENVIRONMENT_NONE && p->tone == ZR_TONE_NONE && p->side == 1);
        assert_true(p->crease_degrees == 180 && !zr_shading_is_linear(zr_looks[i].material.shading));
    }
}

TEST(lamps_of_an_environment_are_found_in_a_row_that_has_it)
{
    for (int name = ZR_ENVIRONMENT_NONE; name < ZR_ENVIRONMENT_COUNT; name++) {
        int rows = 0;
        for (int i = 0; i < zr_look_count; i++)
            rows += (int)zr_looks[i].picture->environment.name == name;
        assert_true(rows > 0);
    }
}

TEST(looks_are_found_by_name_and_version)
{
    static const char *const strangers[] = {"",         "studi", "Studio",    "studio@",   "studio@0",  "studio@01",
                                            "studio@2", "@1",    "studio@1 ", "studio@@1", "studio@1@1"};
    for (int i = 0; i < zr_look_count; i++) {
        char pinned[64];
        snprintf(pinned, sizeof pinned, "%s@%u", zr_looks[i].name, zr_looks[i].version);
        assert_ptr_equal(zr_look_find(pinned), &zr_looks[i]);
        const struct zr_look *newest = zr_look_find(zr_looks[i].name);
        assert_string_equal(newest->name, zr_looks[i].name);
        assert_true(newest->version >= zr_looks[i].version);
        for (int k = 0; k < i; k++)
            assert_true(strcmp(zr_looks[k].name, zr_looks[i].name) != 0 || zr_looks[k].version < zr_looks[i].version);
    }
    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++)
        assert_null(zr_look_find(strangers[i]));
    assert_string_equal(zr_look_textbook()->name, "textbook");
}

/* ---- scenes ---- */

TEST(every_look_dresses_a_scene)
{
    for (int i = 0; i < zr_look_count; i++) {
        const struct zr_look *look = &zr_looks[i];
        struct reading *reading = read_look(zr_look_pin_of(look).text, "");
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *material = &scene->materials[0];
        assert_ptr_equal(scene->look, look);
        assert_true(is_same_picture(scene->picture, look->picture));
        assert_ptr_equal(scene->lights, look->lights);
        assert_int_equal(scene->light_count, look->light_count);
        assert_true(zr_vec4_equal(scene->background, look->background) && scene->ambient.x == look->ambient.x);
        assert_true(zr_vec4_equal(material->base_color, look->material.base_color));
        assert_int_equal(material->shading, look->shades_by_mesh ? ZR_SHADING_FLAT : look->material.shading);
        assert_true(material->roughness == look->material.roughness && material->metallic == look->material.metallic);
        assert_int_equal(scene->views[0].pose, look->view.pose);
        assert_int_equal(scene->views[0].projection, look->view.projection);
        assert_true(scene->views[0].azimuth_degrees == look->view.azimuth_degrees);
        assert_true(scene->views[0].fit_padding == look->view.padding);
        assert_true(scene->views[0].yfov_radians == look->view.fov_radians && scene->views[0].xfov_radians == 0);
        assert_int_equal(scene->warning_count, 0);
        reading_free(reading);
    }
}

TEST(a_scene_without_a_look_is_the_textbooks)
{
    struct reading *reading = read_rest("");
    assert_read(reading);
    assert_ptr_equal(reading->scene->look, zr_look_textbook());
    assert_false(reading->scene->picture->is_linear);
    assert_int_equal(reading->scene->picture->side, 1);
    reading_free(reading);
}

TEST(an_upright_window_has_the_angle_across)
{
    struct reading *reading = read_look("studio", "\"window\": {\"width\": 300, \"height\": 400}");
    assert_true(reading->scene->views[0].xfov_radians == zr_look_find("studio")->view.fov_radians);
    assert_true(reading->scene->views[0].yfov_radians == 0);
    reading_free(reading);
}

/* Beyond 16:9 the larger side has the angle that 16:9 gives it. Angles that are given stay. */
TEST(a_wide_window_holds_the_angle_of_its_larger_side)
{
    static const struct {
        const char *rest;
        float xfov, yfov;
    } cases[] = {
        {"\"window\": {\"width\": 1600, \"height\": 900}", 0, 0.52359878f},
        {"\"window\": {\"width\": 1601, \"height\": 900}", 0.88910519f, 0},
        {"\"window\": {\"width\": 900, \"height\": 1600}", 0.52359878f, 0},
        {"\"window\": {\"width\": 330, \"height\": 1200}", 0, 0.88910519f},
        {"\"window\": {\"width\": 1200, \"height\": 330}, \"view\": {\"perspective\": {\"yfov\": 0.5}}", 0, 0.5f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_look("studio", cases[i].rest);
        assert_true(reading->scene->views[0].xfov_radians == cases[i].xfov);
        assert_true(reading->scene->views[0].yfov_radians == cases[i].yfov);
        reading_free(reading);
    }
    assert_true(fabs(tan(0.88910519 / 2) - 16.0 / 9 * tan(0.52359878 / 2)) < 1e-7);
}

/* The picture of a scene with a look and the members `rest`. */
static void expect_picture(const char *look, const char *rest, struct zr_picture wanted)
{
    for (int behind = 0; behind < 2; behind++) { /* a look may be named before and after */
        char text[2048];
        if (behind)
            snprintf(text, sizeof text, "%s, \"look\": \"%s\"", rest, look);
        else
            snprintf(text, sizeof text, "\"look\": \"%s\", %s", look, rest);
        struct reading *reading = read_rest(text);
        assert_read(reading);
        if (!is_same_picture(reading->scene->picture, &wanted)) fail_msg("%s", text);
        reading_free(reading);
    }
}

#define EXPECT(look, rest, ...)                                                                                        \
    do {                                                                                                               \
        struct zr_picture w = *zr_look_find(look)->picture;                                                            \
        __VA_ARGS__;                                                                                                   \
        expect_picture(look, rest, w);                                                                                 \
    } while (0)

TEST(every_key_goes_before_the_look)
{
    EXPECT("studio", "\"samples\": 1", w.side = 1);
    EXPECT("studio", "\"samples\": 4", w.side = 2);
    EXPECT("textbook", "\"samples\": 64", w.side = 8);
    EXPECT("studio", "\"lineWidth\": 2.5", w.line_width = 2.5f);
    EXPECT("studio", "\"toneMapping\": \"none\"", w.tone = ZR_TONE_NONE);
    EXPECT("studio", "\"toneMapping\": \"khronos-neutral\"", w.tone = ZR_TONE_KHRONOS);
    EXPECT("technical", "\"toneMapping\": \"neutral\"", w.tone = ZR_TONE_NEUTRAL);
    EXPECT("outdoor", "\"exposure\": 2", w.exposure = 2);
    EXPECT("studio", "\"creaseDegrees\": 60", w.crease_degrees = 60);
    EXPECT("studio", "\"groundShadow\": false", w.has_ground = false);
    EXPECT("technical", "\"groundShadow\": true", w.has_ground = true);
    EXPECT("studio", "\"up\": \"z\"", w.z_is_up = true);
    EXPECT("studio", "\"up\": \"y\"", w.z_is_up = false);
    EXPECT("studio", "\"background\": \"#00ff00\"", w.has_gradient = false, w.top = w.bottom = (zr_vec3){0, 0, 0});
    EXPECT("studio", "\"background\": {\"top\": \"red\", \"bottom\": [0, 0, 1]}", w.top = (zr_vec3){1, 0, 0},
           w.bottom = (zr_vec3){0, 0, 1});
    EXPECT("studio", "\"colorManagement\": \"srgb\"", w.is_linear = true);
    EXPECT("textbook", "\"colorManagement\": \"none\"", w.is_linear = false);
    EXPECT("textbook", "\"colorManagement\": \"srgb\"", w.is_linear = true);
}

TEST(keys_of_effects_go_before_the_look_one_by_one)
{
    EXPECT("studio", "\"occlusion\": false", w.occlusion.is_on = false);
    EXPECT("blueprint", "\"occlusion\": true", w.occlusion.is_on = true);
    EXPECT("technical", "\"occlusion\": {\"radius\": 0.5}", w.occlusion.radius = 0.5f);
    EXPECT("studio", "\"occlusion\": {\"strength\": 1}", w.occlusion.strength = 1);
    EXPECT("textbook", "\"occlusion\": {}", w.occlusion.is_on = w.is_linear = true);
    EXPECT("technical", "\"edges\": false", w.edges.is_on = false);
    EXPECT("studio", "\"edges\": true", w.edges.is_on = true);
    EXPECT("blueprint", "\"edges\": {\"width\": 3}", w.edges.width = 3, w.edges.keeps_width = true);
    EXPECT("studio", "\"edges\": {\"color\": \"lime\"}", w.edges.is_on = true, w.edges.color = (zr_vec3){0, 1, 0});
    EXPECT("studio", "\"edges\": {\"from\": \"samples\"}", w.edges.width = 1.5f);
    EXPECT("studio", "\"edges\": {\"from\": \"mesh\"}", w.edges.is_from_mesh = true, w.edges.width = 0);
    EXPECT("studio", "\"edges\": {\"from\": \"mesh\", \"width\": 3, \"hiddenLines\": true}",
           w.edges.is_from_mesh = true, w.edges.width = 3, w.edges.keeps_width = true, w.edges.has_hidden = true);
    EXPECT("studio", "\"edges\": {\"creaseDegrees\": 12}", w.edges.crease_degrees = 12, w.edges.ignores_normals = true);
    EXPECT("technical", "\"edges\": {\"from\": \"samples\"}", w.edges.is_from_mesh = false, w.edges.width = 1.5f);
    EXPECT("technical", "\"edges\": {\"width\": 3}", w.edges.width = 3, w.edges.keeps_width = true);
    EXPECT("studio", "\"edges\": {\"width\": 1}", w.edges.keeps_width = true); /* in pixels, as it says */
}

TEST(keys_of_environments_go_before_the_look_one_by_one)
{
    EXPECT("studio", "\"environment\": false", w.environment.name = ZR_ENVIRONMENT_NONE);
    EXPECT("studio", "\"environment\": \"outdoor\"", w.environment.name = ZR_ENVIRONMENT_OUTDOOR,
           w.environment.camera_frame = false);
    EXPECT("outdoor", "\"environment\": {\"name\": \"studio\", \"intensity\": 2}",
           w.environment = ((struct zr_environment){ZR_ENVIRONMENT_STUDIO, 2, 0, true, NULL}));
    EXPECT("outdoor", "\"environment\": {\"rotationDegrees\": 90}", w.environment.rotation_degrees = 90);
    EXPECT("studio", "\"environment\": {\"frame\": \"world\"}", w.environment.camera_frame = false);
    EXPECT("textbook", "\"environment\": \"studio\"", w.environment.name = ZR_ENVIRONMENT_STUDIO, w.is_linear = true);
    EXPECT("textbook", "\"environment\": false", w.is_linear = false);
    EXPECT("studio", "\"environment\": \"metal\"", w.environment.name = ZR_ENVIRONMENT_METAL);
}

TEST(backgrounds_are_colours_or_gradients)
{
    struct reading *reading = read_look("studio", "\"background\": \"#0000\"");
    assert_true(reading->scene->background.w == 0 && !reading->scene->picture->has_gradient);
    reading_free(reading);
    reading = read_look("textbook", "\"background\": {\"top\": \"red\", \"bottom\": \"blue\"}");
    assert_true(reading->scene->background.w == 1 && reading->scene->picture->has_gradient);
    assert_true(reading->scene->picture->is_linear);
    reading_free(reading);
}

/* ---- keys of the picture ---- */

static bool is_picture_key(const char *object, const char *key)
{
    struct zr_parsed_picture given = {.keys = 0};
    zr_picture_give_key(&given, object, key);
    return given.keys != 0;
}

/* Without a row there, what a scene gives would be lost without a word. */
TEST(each_key_that_is_read_into_the_picture_has_a_row)
{
    static const struct zr_json_object *const objects[] = {&zr_json_object_gradient, &zr_json_object_environment,
                                                           &zr_json_object_occlusion, &zr_json_object_edges};
    int found = 0;
    for (size_t i = 0; i < zr_json_object_scene.count; i++) {
        const struct zr_json_field *field = &zr_json_object_scene.fields[i];
        if (field->through != offsetof(struct zr_parsed_scene, picture)) continue;
        if (!is_picture_key("", field->key)) fail_msg("%s has no row in scene/picture_keys.h", field->key);
        found++;
    }
    assert_true(found >= 6);
    for (size_t i = 0; i < sizeof objects / sizeof *objects; i++)
        for (size_t k = 0; k < objects[i]->count; k++)
            if (!is_picture_key(objects[i]->name, objects[i]->fields[k].key))
                fail_msg("%s of %s has no row in scene/picture_keys.h", objects[i]->fields[k].key, objects[i]->name);
}

/* A row whose key nobody reads is never given. */
TEST(each_row_of_a_key_of_the_picture_is_read)
{
    static const struct {
        const char *object, *key;
    } rows[] = {
#define ROW(ID, object, key, member, is_linear) {object, key},
        ZR_PICTURE_KEYS(ROW)
#undef ROW
    };
    static const struct zr_json_object *const objects[] = {
#define ROW(name) &zr_json_object_##name,
        ZR_JSON_OBJECTS(ROW)
#undef ROW
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *object = *rows[i].object ? rows[i].object : "scene";
        bool found = false;
        for (size_t o = 0; o < sizeof objects / sizeof *objects; o++)
            for (size_t k = 0; strcmp(objects[o]->name, object) == 0 && k < objects[o]->count; k++)
                found |= strcmp(objects[o]->fields[k].key, rows[i].key) == 0;
        if (!found) fail_msg("no reader has the key %s of %s", rows[i].key, object);
    }
}

RUN_TESTS(NULL, NULL)
