/* Looks: what rows must have, and that what a scene or a query says goes before them, key by key. */
#include "json_check.h"

#include "scene/looks.h"
#include "scene/resolved_view.h"

#define MESH "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

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
    bool classic = false, pbr = look->picture.environment.name != ZR_ENVIRONMENT_NONE;
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

static void each_row_has_what_rows_must_have(void **state)
{
    (void)state;
    for (int i = 0; i < ZR_LOOKS; i++) {
        const struct zr_look *look = &zr_looks[i];
        const struct zr_picture *p = &look->picture;
        print_message("%s@%u\n", look->name, look->version);
        assert_true(look->version >= 1 && strlen(look->name) > 0);
        assert_true(p->side == 1 || p->side == 2 || p->side == 4 || p->side == ZR_SAMPLE_SIDE_MAX);
        assert_true(p->line_width == 1 && p->exposure > 0 && p->environment.intensity == 1);
        assert_true(p->crease_degrees > 0 && p->crease_degrees <= 180);
        assert_true(p->occlusion.radius > 0 && p->occlusion.strength > 0);
        assert_true(p->edges.width > 0 && p->edges.crease_degrees > 0 && is_color(p->edges.color));
        assert_true(is_color(p->top) && is_color(p->bottom) && look->background.w == 1);
        assert_true(look->material.base_color.w == 1 && look->material.shading < ZR_SHADING_COUNT);
        assert_true(look->material.roughness > 0 && look->material.shininess > 0 && is_color(look->material.cool));
        assert_true(look->view.padding > 0 && look->view.padding < 0.45f);
        assert_int_equal(look->view.projection == ZR_PROJECTION_PERSPECTIVE, look->view.fov_radians > 0);
        assert_good_lamps(look);
    }
}

static void effects_are_of_linear_light_only(void **state)
{
    (void)state;
    for (int i = 0; i < ZR_LOOKS; i++) {
        const struct zr_picture *p = &zr_looks[i].picture;
        if (p->is_linear) continue;
        assert_ptr_equal(&zr_looks[i], zr_look_textbook);
        assert_false(p->has_gradient || p->has_ground || p->occlusion.is_on || p->edges.is_on);
        assert_true(p->environment.name == ZR_ENVIRONMENT_NONE && p->tone == ZR_TONE_NONE && p->side == 1);
        assert_true(p->crease_degrees == 180 && zr_looks[i].material.shading < ZR_SHADING_PBR);
    }
}

static void lamps_of_an_environment_are_found_in_a_row_that_has_it(void **state)
{
    (void)state;
    for (int name = ZR_ENVIRONMENT_NONE; name < ZR_ENVIRONMENT_COUNT; name++) {
        int rows = 0;
        for (int i = 0; i < ZR_LOOKS; i++)
            rows += (int)zr_looks[i].picture.environment.name == name;
        assert_true(rows > 0);
    }
}

static void looks_are_found_by_name_and_version(void **state)
{
    (void)state;
    static const char *const strangers[] = {"",         "studi", "Studio",    "studio@",   "studio@0",  "studio@01",
                                            "studio@2", "@1",    "studio@1 ", "studio@@1", "studio@1@1"};
    for (int i = 0; i < ZR_LOOKS; i++) {
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
    assert_string_equal(zr_look_textbook->name, "textbook");
}

/* A released row does not change: its newest version may have another one behind it. */
static void version_1_has_the_values_that_it_was_released_with(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum zr_shading shading;
        uint32_t base;
        float metallic, roughness;
        uint32_t top, bottom;
        float exposure;
        enum zr_tone tone;
    } rows[] = {
        {"studio@1", ZR_SHADING_PBR, 0x8fa3b8, 0, 0.55f, 0xf4f6f8, 0xd3dae1, 1, ZR_TONE_NEUTRAL},
        {"clay@1", ZR_SHADING_PBR, 0xcbb29c, 0, 0.9f, 0xf7f4f0, 0xded6cc, 1, ZR_TONE_NEUTRAL},
        {"dark@1", ZR_SHADING_PBR, 0xc9ced4, 0, 0.45f, 0x3c444d, 0x191d22, 1, ZR_TONE_NEUTRAL},
        {"metal@1", ZR_SHADING_PBR, 0xd4d6da, 1, 0.32f, 0xf4f6f8, 0xd3dae1, 1, ZR_TONE_NEUTRAL},
        {"outdoor@1", ZR_SHADING_PBR, 0xb9b4aa, 0, 0.55f, 0xbcd6f0, 0xefe9de, 0.78f, ZR_TONE_NEUTRAL},
        {"technical@1", ZR_SHADING_GOOCH, 0xffffff, 0, 0.55f, 0, 0, 1, ZR_TONE_NONE},
        {"blueprint@1", ZR_SHADING_UNLIT, 0x1d4a86, 0, 0.55f, 0, 0, 1, ZR_TONE_NONE},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct zr_look *look = zr_look_find(rows[i].name);
        const zr_vec4 base = look->material.base_color;
        const float bytes[9] = {base.x,
                                base.y,
                                base.z,
                                look->picture.top.x,
                                look->picture.top.y,
                                look->picture.top.z,
                                look->picture.bottom.x,
                                look->picture.bottom.y,
                                look->picture.bottom.z};
        const uint32_t wanted[3] = {rows[i].base, rows[i].top, rows[i].bottom};
        for (int k = 0; k < 9; k++)
            assert_true(bytes[k] == (float)(wanted[k / 3] >> (16 - 8 * (k % 3)) & 255) / 255.0f);
        assert_int_equal(look->material.shading, rows[i].shading);
        assert_true(look->material.metallic == rows[i].metallic && look->material.roughness == rows[i].roughness);
        assert_true(look->picture.exposure == rows[i].exposure && look->picture.tone == rows[i].tone);
        assert_int_equal(look->picture.has_gradient, rows[i].top != 0);
        assert_true(look->picture.is_linear && look->picture.side == 4);
    }
}

/* ---- scenes ---- */

/* A polygon with "look": LOOK and the members `rest`. */
static struct reading *read_look(const char *look, const char *rest)
{
    char text[2048];
    snprintf(text, sizeof text, "\"look\": \"%s\"%s%s", look, *rest ? ", " : "", rest);
    struct reading *reading = read_rest(text);
    assert_read(reading);
    return reading;
}

static bool is_same_rgb(zr_vec3 a, zr_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Member by member: what is between them has no value. */
static bool is_same_picture(const struct zr_picture *a, const struct zr_picture *b)
{
    const struct zr_environment *ea = &a->environment, *eb = &b->environment;
    return a->is_linear == b->is_linear && a->side == b->side && a->line_width == b->line_width &&
           a->has_gradient == b->has_gradient && is_same_rgb(a->top, b->top) && is_same_rgb(a->bottom, b->bottom) &&
           ea->name == eb->name && ea->intensity == eb->intensity && ea->rotation_degrees == eb->rotation_degrees &&
           ea->camera_frame == eb->camera_frame && a->tone == b->tone && a->exposure == b->exposure &&
           a->occlusion.is_on == b->occlusion.is_on && a->occlusion.radius == b->occlusion.radius &&
           a->occlusion.strength == b->occlusion.strength && a->has_ground == b->has_ground &&
           a->edges.is_on == b->edges.is_on && is_same_rgb(a->edges.color, b->edges.color) &&
           a->edges.width == b->edges.width && a->edges.crease_degrees == b->edges.crease_degrees &&
           a->crease_degrees == b->crease_degrees && a->z_is_up == b->z_is_up;
}

static void every_look_dresses_a_scene(void **state)
{
    (void)state;
    for (int i = 0; i < ZR_LOOKS; i++) {
        const struct zr_look *look = &zr_looks[i];
        struct reading *reading = read_look(look->name, "");
        const struct zr_scene *scene = reading->scene;
        const struct zr_material *material = &scene->materials[0];
        assert_ptr_equal(scene->look, look);
        assert_true(is_same_picture(&scene->picture, &look->picture));
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

static void a_scene_without_a_look_is_the_textbooks(void **state)
{
    (void)state;
    struct reading *reading = read_rest("");
    assert_read(reading);
    assert_ptr_equal(reading->scene->look, zr_look_textbook);
    assert_false(reading->scene->picture.is_linear);
    assert_int_equal(reading->scene->picture.side, 1);
    reading_free(reading);
    refuses_rest("\"look\": \"stduio\"", "/look", "'stduio' is unknown (did you mean studio?); allowed: studio, tech");
    refuses_rest("\"look\": \"studio@2\"", "/look", "'studio@2' is unknown");
    refuses_rest("\"look\": 1", "/look", "expected a string");
}

static void an_upright_window_has_the_angle_across(void **state)
{
    (void)state;
    struct reading *reading = read_look("studio", "\"window\": {\"width\": 300, \"height\": 400}");
    assert_true(reading->scene->views[0].xfov_radians == zr_look_find("studio")->view.fov_radians);
    assert_true(reading->scene->views[0].yfov_radians == 0);
    reading_free(reading);
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
        if (!is_same_picture(&reading->scene->picture, &wanted)) fail_msg("%s", text);
        reading_free(reading);
    }
}

#define EXPECT(look, rest, ...)                                                                                        \
    do {                                                                                                               \
        struct zr_picture w = zr_look_find(look)->picture;                                                             \
        __VA_ARGS__;                                                                                                   \
        expect_picture(look, rest, w);                                                                                 \
    } while (0)

static void every_key_goes_before_the_look(void **state)
{
    (void)state;
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

static void keys_of_effects_go_before_the_look_one_by_one(void **state)
{
    (void)state;
    EXPECT("studio", "\"occlusion\": false", w.occlusion.is_on = false);
    EXPECT("blueprint", "\"occlusion\": true", w.occlusion.is_on = true);
    EXPECT("technical", "\"occlusion\": {\"radius\": 0.5}", w.occlusion.radius = 0.5f);
    EXPECT("studio", "\"occlusion\": {\"strength\": 1}", w.occlusion.strength = 1);
    EXPECT("textbook", "\"occlusion\": {}", w.occlusion.is_on = w.is_linear = true);
    EXPECT("technical", "\"edges\": false", w.edges.is_on = false);
    EXPECT("studio", "\"edges\": true", w.edges.is_on = true);
    EXPECT("blueprint", "\"edges\": {\"width\": 3}", w.edges.width = 3);
    EXPECT("studio", "\"edges\": {\"color\": \"lime\"}", w.edges.is_on = true, w.edges.color = (zr_vec3){0, 1, 0});
    EXPECT("technical", "\"edges\": {\"creaseDegrees\": 12}", w.edges.crease_degrees = 12);
}

static void keys_of_environments_go_before_the_look_one_by_one(void **state)
{
    (void)state;
    EXPECT("studio", "\"environment\": false", w.environment.name = ZR_ENVIRONMENT_NONE);
    EXPECT("studio", "\"environment\": \"outdoor\"", w.environment.name = ZR_ENVIRONMENT_OUTDOOR,
           w.environment.camera_frame = false);
    EXPECT("outdoor", "\"environment\": {\"name\": \"studio\", \"intensity\": 2}",
           w.environment = ((struct zr_environment){ZR_ENVIRONMENT_STUDIO, 2, 0, true}));
    EXPECT("outdoor", "\"environment\": {\"rotationDegrees\": 90}", w.environment.rotation_degrees = 90);
    EXPECT("studio", "\"environment\": {\"frame\": \"world\"}", w.environment.camera_frame = false);
    EXPECT("textbook", "\"environment\": \"studio\"", w.environment.name = ZR_ENVIRONMENT_STUDIO, w.is_linear = true);
    EXPECT("textbook", "\"environment\": false", w.is_linear = false);
    refuses_rest("\"environment\": {\"intensity\": 2}", "/environment", "name is missing: the look textbook has none");
    refuses_rest("\"environment\": true", "/environment", "expected false, a name or an object");
    refuses_rest("\"environment\": 1", "/environment", "expected false, a name or an object, found a number");
    refuses_rest("\"environment\": \"night\"", "/environment", "'night' is unknown; allowed: studio, outdoor");
    refuses_rest("\"environment\": {\"name\": \"none\"}", "/environment/name", "allowed: studio, outdoor");
    refuses_rest("\"environment\": {\"intensity\": -1}", "/environment/intensity", "-1 is outside of 0 to 1000000");
}

static void backgrounds_are_colours_or_gradients(void **state)
{
    (void)state;
    struct reading *reading = read_look("studio", "\"background\": \"#0000\"");
    assert_true(reading->scene->background.w == 0 && !reading->scene->picture.has_gradient);
    reading_free(reading);
    reading = read_look("textbook", "\"background\": {\"top\": \"red\", \"bottom\": \"blue\"}");
    assert_true(reading->scene->background.w == 1 && reading->scene->picture.has_gradient);
    assert_true(reading->scene->picture.is_linear);
    reading_free(reading);
    refuses_rest("\"background\": {\"top\": \"red\"}", "/background", "bottom is missing");
    refuses_rest("\"background\": {\"top\": \"red\", \"bottom\": \"#0000ff80\"}", "/background/bottom", "opaque");
}

static void values_out_of_bounds_are_refused(void **state)
{
    (void)state;
    refuses_rest("\"samples\": 2", "/samples", "2; 1, 4, 16 or 64 are allowed");
    refuses_rest("\"samples\": 0", "/samples", "0; 1, 4");
    refuses_rest("\"samples\": 256", "/samples", "256; 1, 4");
    refuses_rest("\"samples\": 4294967295", "/samples", "4294967295; 1, 4");
    refuses_rest("\"lineWidth\": 0", "/lineWidth", "0 is outside of 0.1 to 64");
    refuses_rest("\"toneMapping\": \"aces\"", "/toneMapping", "allowed: none, khronos-neutral, neutral");
    refuses_rest("\"exposure\": -1", "/exposure", "-1 is outside of 0 to 1000000");
    refuses_rest("\"creaseDegrees\": 181", "/creaseDegrees", "181 is outside of 0 to 180");
    refuses_rest("\"occlusion\": 1", "/occlusion", "expected true, false or an object, found a number");
    refuses_rest("\"occlusion\": {\"radius\": 0}", "/occlusion/radius", "0 is outside of 0.001 to 10");
    refuses_rest("\"edges\": \"red\"", "/edges", "expected true, false or an object, found a string");
    refuses_rest("\"edges\": {\"width\": 65}", "/edges/width", "65 is outside");
    refuses_rest("\"edges\": {\"color\": \"#0000\"}", "/edges/color", "an alpha of 0: it has to be opaque");
    refuses_rest("\"up\": \"x\"", "/up", "'x' is unknown; allowed: y, z");
    refuses_rest("\"materials\": [{\"name\": \"m\", \"metallicFactor\": 2}]", "/materials/0/metallicFactor", "2 is");
    refuses_rest("\"materials\": [{\"name\": \"m\", \"emissiveFactor\": [0, 1]}]", "/materials/0/emissiveFactor",
                 "expected 3 numbers, found 2");
}

/* ---- lamps ---- */

static void lamps_of_a_scene_replace_those_of_the_look_and_its_environment(void **state)
{
    (void)state;
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
        struct reading *reading = read_look("studio", cases[i].rest);
        assert_int_equal(reading->scene->light_count, cases[i].lights);
        assert_true(reading->scene->ambient.y == cases[i].ambient);
        assert_int_equal(reading->scene->picture.environment.name, cases[i].environment);
        reading_free(reading);
    }
}

static void lamps_of_the_textbook_stay_in_linear_light_and_beside_ambient(void **state)
{
    (void)state;
    static const char *const rests[] = {"\"colorManagement\": \"srgb\"", "\"shading\": \"pbr\"",
                                        "\"ambient\": [0.34, 0.34, 0.34]", "\"environment\": false"};
    for (size_t i = 0; i < sizeof rests / sizeof rests[0]; i++) {
        struct reading *reading = read_rest(rests[i]);
        assert_read(reading);
        assert_ptr_equal(reading->scene->lights, zr_look_textbook->lights);
        assert_int_equal(reading->scene->light_count, 2);
        assert_true(reading->scene->ambient.x == 0.34f);
        reading_free(reading);
    }
}

static void lamps_go_with_the_environment(void **state)
{
    (void)state;
    struct reading *reading = read_look("studio", "\"environment\": \"outdoor\"");
    assert_ptr_equal(reading->scene->lights, zr_look_find("outdoor")->lights);
    reading_free(reading);
    reading = read_look("textbook", "\"environment\": \"studio\"");
    assert_ptr_equal(reading->scene->lights, zr_look_find("studio")->lights);
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

static void lights_are_of_two_types(void **state)
{
    (void)state;
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
    assert_true(reading->scene->picture.is_linear);
    reading_free(reading);
    refuses_rest("\"lights\": [{\"type\": \"directional\"}]", "/lights/0", "direction is missing");
    refuses_rest("\"lights\": [{\"type\": \"hemisphere\", \"direction\": [0, 0, 1]}]", "/lights/0/direction",
                 "belongs to lights of the type directional only");
    refuses_rest("\"lights\": [{\"type\": \"hemisphere\", \"shadows\": true}]", "/lights/0/shadows", "directional");
    refuses_rest("\"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, 1], \"sky\": \"red\"}]",
                 "/lights/0/sky", "belongs to lights of the type hemisphere only");
    refuses_rest("\"lights\": [{\"type\": \"hemisphere\", \"up\": [0, 0, 0]}]", "/lights/0/up", "no length");
}

/* ---- materials ---- */

static void what_a_material_says_goes_before_the_look_key_by_key(void **state)
{
    (void)state;
    struct reading *reading = read_scene(
        "{\"materials\": [{\"name\": \"m\", \"baseColorFactor\": \"red\", \"roughnessFactor\": 0.125,"
        " \"emissiveFactor\": [1, 2, 3], \"cool\": \"blue\"}], \"look\": \"metal\","
        " \"polygons\": [{" TRIANGLE ", \"material\": \"m\"}, {" TRIANGLE ", \"color\": \"lime\"}, {" TRIANGLE "}]}");
    const uint32_t *numbers = reading->scene->meshes[0].face_materials;
    const struct zr_material *given = &reading->scene->materials[numbers[0]],
                             *coloured = &reading->scene->materials[numbers[1]],
                             *bare = &reading->scene->materials[numbers[2]];
    assert_true(given->base_color.x == 1 && given->base_color.y == 0);
    assert_true(given->metallic == 1 && given->roughness == 0.125f && given->emissive.z == 3 && given->cool.z == 1);
    assert_true(given->specular.x == 0.12f && given->shininess == 32 && given->shading == ZR_SHADING_PBR);
    assert_true(coloured->base_color.x == 1 && coloured->base_color.y == 1 && coloured->roughness == 0.32f);
    assert_true(zr_vec4_equal(bare->base_color, zr_look_find("metal")->material.base_color));
    reading_free(reading);
}

/* ---- views ---- */

static void a_view_of_its_own_replaces_that_of_the_look(void **state)
{
    (void)state;
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
static void views_with_z_up_are_turned_ones(void **state)
{
    (void)state;
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
            assert_int_equal(zr_resolved_view_find(&reading->arena, NULL, reading->scene, NULL, &resolved, &error),
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

static void keys_that_need_linear_light_switch_it_on(void **state)
{
    (void)state;
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
        assert_true(reading->scene->picture.is_linear);
        reading_free(reading);
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        struct reading *reading = read_rest(others[i]);
        assert_read(reading);
        assert_false(reading->scene->picture.is_linear);
        reading_free(reading);
    }
}

static void what_does_not_go_with_linear_light_is_refused_by_both_names(void **state)
{
    (void)state;
    for (int i = 0; i < LINEAR; i++) {
        char text[512];
        snprintf(text, sizeof text, "\"colorManagement\": \"none\", %s", linear[i].rest);
        refuses_rest(text, "/colorManagement", linear[i].name);
        snprintf(text, sizeof text, "\"fog\": {\"near\": 1, \"far\": 2}, %s", linear[i].rest);
        refuses_rest(text, "/fog", linear[i].name);
        snprintf(text, sizeof text, "\"base\": {}, %s", linear[i].rest);
        refuses_rest(text, "/base", linear[i].name);
    }
    refuses_rest("\"fog\": {\"near\": 1, \"far\": 2}, \"colorManagement\": \"srgb\"", "/fog", "colorManagement");
    refuses_rest("\"base\": {}, \"colorManagement\": \"srgb\"", "/base", "colorManagement");
    refuses_rest("\"base\": {}, \"samples\": 4", "/base", "samples");
    refuses_rest("\"base\": {}, \"samples\": 1", "/base", "windowDepth is missing");
}

static void a_shading_of_linear_light_is_found_wherever_it_is_said(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "{\"colorManagement\": \"none\", \"polygons\": [{" TRIANGLE ", \"shading\": \"pbr\"}]}",
        "{\"colorManagement\": \"none\", \"meshes\": [{" POSITIONS ", \"faces\": [[0,1,2]], \"shading\": \"gooch\"}]}",
        "{\"colorManagement\": \"none\", \"materials\": [{\"name\": \"m\", \"shading\": \"pbr\"}],"
        " \"polygons\": [{" TRIANGLE ", \"material\": \"m\"}]}"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        refuses_scene(texts[i], "/colorManagement", "shading");
}

/* ---- samples ---- */

static void samples_fit_the_window(void **state)
{
    (void)state;
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
        assert_int_equal(reading->scene->picture.side, cases[i].side);
        const bool is_less = i < 3 && cases[i].side < 4;
        assert_int_equal(reading->scene->warning_count, is_less);
        if (is_less)
            assert_non_null(strstr(reading->scene->warnings[0], "samples: 4 a pixel instead of the look's 16"));
        reading_free(reading);
    }
    refuses_rest("\"samples\": 64, \"window\": {\"width\": 8, \"height\": 2049}", "/samples", "up to 16 are allowed");
    refuses_rest("\"look\": \"studio\", \"samples\": 16, \"window\": {\"width\": 8192}", "/samples", "up to 4 are");
    refuses_rest("\"samples\": 64, \"window\": {\"width\": 8193}", "/window/width", "8193 pixels");
}

/* ---- bare meshes ---- */

static struct reading *read_mesh(struct zr_request request)
{
    request.format = ZR_FORMAT_OBJ;
    struct reading *reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), (size_t)1 << 24);
    assert_read(reading);
    return reading;
}

static void bare_meshes_have_the_look_studio(void **state)
{
    (void)state;
    const struct zr_look *studio = zr_look_find("studio");
    struct reading *reading = read_mesh((struct zr_request){.look = NULL});
    const struct zr_scene *scene = reading->scene;
    assert_ptr_equal(scene->look, studio);
    assert_true(is_same_picture(&scene->picture, &studio->picture));
    assert_ptr_equal(scene->lights, studio->lights);
    assert_true(scene->views[0].width == 640 && scene->views[0].height == 480);
    assert_true(scene->views[0].azimuth_degrees == 35 && scene->views[0].elevation_degrees == 28);
    assert_true(scene->views[0].yfov_radians == studio->view.fov_radians && scene->views[0].fit_padding == 0.07f);
    assert_int_equal(scene->views[0].pose, ZR_POSE_ORBIT);
    assert_true(zr_vec4_equal(scene->materials[0].base_color, studio->material.base_color));
    assert_true(scene->materials[0].double_sided && scene->materials[0].shading == ZR_SHADING_PBR);
    reading_free(reading);
}

static void every_look_dresses_a_bare_mesh(void **state)
{
    (void)state;
    for (int i = 0; i < ZR_LOOKS; i++) {
        char pinned[64];
        snprintf(pinned, sizeof pinned, "%s@%u", zr_looks[i].name, zr_looks[i].version);
        struct reading *reading = read_mesh((struct zr_request){.look = pinned});
        assert_ptr_equal(reading->scene->look, &zr_looks[i]);
        assert_true(is_same_picture(&reading->scene->picture, &zr_looks[i].picture));
        assert_true(zr_vec4_equal(reading->scene->background, zr_looks[i].background));
        assert_int_equal(reading->scene->views[0].pose, zr_looks[i].view.pose);
        reading_free(reading);
    }
}

static void every_parameter_goes_before_the_look(void **state)
{
    (void)state;
    struct reading *reading = read_mesh((struct zr_request){.samples = "64",
                                                            .preset = "top",
                                                            .projection = "orthographic",
                                                            .shading = "phong",
                                                            .color = "red",
                                                            .background = "transparent"});
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->picture.side, 8);
    assert_true(scene->views[0].pose == ZR_POSE_PRESET && scene->views[0].preset == ZR_PRESET_TOP);
    assert_true(scene->views[0].projection == ZR_PROJECTION_ORTHOGRAPHIC && scene->views[0].yfov_radians == 0);
    assert_true(scene->materials[0].shading == ZR_SHADING_PHONG && scene->materials[0].base_color.y == 0);
    assert_true(scene->background.w == 0 && !scene->picture.has_gradient && scene->picture.has_ground);
    assert_true(scene->picture.is_linear);
    reading_free(reading);
    reading = read_mesh((struct zr_request){.azimuth = "-35", .width = "300", .height = "400"});
    assert_true(reading->scene->views[0].azimuth_degrees == -35 && reading->scene->views[0].elevation_degrees == 28);
    assert_true(reading->scene->views[0].xfov_radians > 0.5f && reading->scene->views[0].yfov_radians == 0);
    reading_free(reading);
    reading = read_mesh((struct zr_request){.look = "technical", .projection = "perspective"});
    assert_true(reading->scene->views[0].yfov_radians == 0.78539816f);
    assert_int_equal(reading->scene->views[0].projection, ZR_PROJECTION_PERSPECTIVE);
    reading_free(reading);
    reading = read_mesh((struct zr_request){.look = "textbook", .shading = "pbr"});
    assert_true(reading->scene->picture.is_linear && reading->scene->light_count == 2);
    reading_free(reading);
}

static void samples_of_a_query_fit_the_window(void **state)
{
    (void)state;
    struct reading *reading = read_mesh((struct zr_request){.width = "8192", .height = "8"});
    assert_int_equal(reading->scene->picture.side, 2);
    assert_int_equal(reading->scene->warning_count, 1);
    reading_free(reading);
    const struct zr_request request = {.format = ZR_FORMAT_OBJ, .width = "8192", .height = "8", .samples = "16"};
    reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), (size_t)1 << 24);
    assert_complaint(reading, ZR_BAD_SCENE, "", "query parameter samples: 16; in a window of 8192 x 8 up to 4");
    reading_free(reading);
}

static void z_is_up_in_stl_unless_told_otherwise(void **state)
{
    (void)state;
    static const char stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                              "endloop\nendfacet\nendsolid\n";
    static const struct {
        enum zr_format format;
        const char *text, *up;
        bool z_is_up;
    } cases[] = {{ZR_FORMAT_STL, stl, NULL, true},
                 {ZR_FORMAT_STL, stl, "y", false},
                 {ZR_FORMAT_STL, stl, "z", true},
                 {ZR_FORMAT_OBJ, MESH, NULL, false},
                 {ZR_FORMAT_OBJ, MESH, "z", true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct zr_request request = {.format = cases[i].format, .up = cases[i].up};
        struct reading *reading =
            read_request(request, cases[i].text, strlen(cases[i].text), zr_limits_default(), (size_t)1 << 24);
        assert_read(reading);
        const zr_vec4 up = zr_mat4_apply(&reading->scene->instances[0].object_to_world, (zr_vec4){0, 0, 1, 0});
        assert_true(up.y == (cases[i].z_is_up ? 1 : 0));
        assert_false(reading->scene->picture.z_is_up); /* the world's y is up: the mesh is turned */
        reading_free(reading);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_row_has_what_rows_must_have),
        cmocka_unit_test(effects_are_of_linear_light_only),
        cmocka_unit_test(lamps_of_an_environment_are_found_in_a_row_that_has_it),
        cmocka_unit_test(looks_are_found_by_name_and_version),
        cmocka_unit_test(version_1_has_the_values_that_it_was_released_with),
        cmocka_unit_test(every_look_dresses_a_scene),
        cmocka_unit_test(a_scene_without_a_look_is_the_textbooks),
        cmocka_unit_test(an_upright_window_has_the_angle_across),
        cmocka_unit_test(every_key_goes_before_the_look),
        cmocka_unit_test(keys_of_effects_go_before_the_look_one_by_one),
        cmocka_unit_test(keys_of_environments_go_before_the_look_one_by_one),
        cmocka_unit_test(backgrounds_are_colours_or_gradients),
        cmocka_unit_test(values_out_of_bounds_are_refused),
        cmocka_unit_test(lamps_of_a_scene_replace_those_of_the_look_and_its_environment),
        cmocka_unit_test(lamps_of_the_textbook_stay_in_linear_light_and_beside_ambient),
        cmocka_unit_test(lamps_go_with_the_environment),
        cmocka_unit_test(lights_are_of_two_types),
        cmocka_unit_test(what_a_material_says_goes_before_the_look_key_by_key),
        cmocka_unit_test(a_view_of_its_own_replaces_that_of_the_look),
        cmocka_unit_test(views_with_z_up_are_turned_ones),
        cmocka_unit_test(keys_that_need_linear_light_switch_it_on),
        cmocka_unit_test(what_does_not_go_with_linear_light_is_refused_by_both_names),
        cmocka_unit_test(a_shading_of_linear_light_is_found_wherever_it_is_said),
        cmocka_unit_test(samples_fit_the_window),
        cmocka_unit_test(bare_meshes_have_the_look_studio),
        cmocka_unit_test(every_look_dresses_a_bare_mesh),
        cmocka_unit_test(every_parameter_goes_before_the_look),
        cmocka_unit_test(samples_of_a_query_fit_the_window),
        cmocka_unit_test(z_is_up_in_stl_unless_told_otherwise),
    };
    return cmocka_run_group_tests_name("looks", tests, NULL, NULL);
}
