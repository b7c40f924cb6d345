#include <math.h>

#include "scene/picture.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST(direction_of_a_light_may_have_any_length)
{
    struct reading *reading = read_text(ZR_FORMAT_JSON, "{\"lights\": [{\"type\": \"directional\", \"direction\": "
                                                        "[0,0,-1e-25]}], \"polygons\": [{" TRIANGLE "}]}");
    assert_int_equal(reading->status, ZR_OK);
    assert_true(reading->scene->lights[0].direction.z == -1.0f);
    reading_free(reading);
}

TEST(lights_are_normalised_and_scaled)
{
    struct reading *reading =
        read_rest("\"ambient\": [0, 0.5, 1], \"lights\": [{\"type\": \"directional\", \"direction\": [0,0,-4], "
                  "\"color\": [1,0.5,0], "
                  "\"intensity\": 2}, {\"type\": \"directional\", \"direction\": [3,4,0], \"frame\": \"camera\"}]");
    assert_read(reading);
    const struct zr_light *lights = reading->scene->lights;
    assert_int_equal(reading->scene->light_count, 2);
    assert_true(lights[0].direction.z == -1 && lights[0].color.x == 2 && lights[0].color.y == 1 &&
                !lights[0].camera_frame);
    assert_true(lights[1].direction.x == 3 * (1.0f / 5) && lights[1].color.z == 1 && lights[1].camera_frame);
    assert_true(reading->scene->ambient.y == 0.5f);
    reading_free(reading);
    reading = read_rest("\"lights\": []");
    assert_read(reading);
    assert_int_equal(reading->scene->light_count, 0);
    assert_true(reading->scene->ambient.y == 0.2f);
    reading_free(reading);
    reading = read_rest("\"ambient\": [0, 0.5, 1]");
    assert_read(reading);
    assert_int_equal(reading->scene->light_count, 2);
    assert_true(reading->scene->ambient.y == 0.5f);
    reading_free(reading);
}

/* "#808080" is sRGB-encoded, and 0.5 is not; names are texts, too. */
TEST(texts_of_light_are_decoded_where_light_is_linear)
{
    static const char *const lamps =
        "\"ambient\": \"#808080\", \"materials\": [{\"name\": \"m\", \"shading\": \"phong\", \"specular\": "
        "\"#808080\"},"
        "{\"name\": \"n\", \"shading\": \"phong\", \"specular\": [0.5, 0.5, 0.5]}], "
        "\"meshes\": [{" POSITIONS ", \"faces\": [[0,1,2]], \"material\": \"m\"},"
        "{" POSITIONS ", \"faces\": [[0,1,2]], \"material\": \"n\"}], \"lights\": ["
        "{\"type\": \"directional\", \"direction\": [0,0,-1], \"color\": \"#808080\", \"intensity\": 2},"
        "{\"type\": \"directional\", \"direction\": [0,0,-1], \"color\": [0.5, 0.5, 0.5]},"
        "{\"type\": \"point\", \"position\": [0,0,1], \"color\": \"white\"}]";
    static const char sky[] = ", \"sky\": \"#80ff00\", \"ground\": \"gray\"}]";
    for (int is_linear = 0; is_linear < 2; is_linear++) {
        const float grey = is_linear ? 0.21586051f : 128.0f / 255.0f;
        char text[2048];
        snprintf(text, sizeof text, "{%s, \"colorManagement\": \"%s\"}", lamps, is_linear ? "srgb" : "none");
        struct reading *reading = read_scene(text);
        const struct zr_scene *scene = reading->scene;
        assert_true(fabsf(scene->ambient.x - grey) < 1e-6f && fabsf(scene->ambient.z - grey) < 1e-6f);
        assert_true(fabsf(scene->lights[0].color.y - 2.0f * grey) < 1e-6f && scene->lights[1].color.y == 0.5f);
        assert_true(scene->lights[2].color.x == 1.0f);
        assert_true(fabsf(scene->materials[scene->meshes[0].material].specular.x - grey) < 1e-6f);
        assert_true(scene->materials[scene->meshes[1].material].specular.x == 0.5f);
        reading_free(reading);
    }
    char text[256];
    snprintf(text, sizeof text, "\"lights\": [{\"type\": \"hemisphere\"%s", sky);
    struct reading *reading = read_rest(text);
    assert_read(reading);
    const struct zr_light *light = &reading->scene->lights[0];
    assert_true(fabsf(light->color.x - 0.21586051f) < 1e-6f && light->color.y == 1.0f && light->color.z == 0.0f);
    assert_true(fabsf(light->ground.z - 0.21586051f) < 1e-6f);
    reading_free(reading);
}

#define POINT "\"lights\": [{\"type\": \"point\", \"position\": [1,2,3]"

TEST(lamps_have_places_ranges_and_cones)
{
    struct reading *reading =
        read_rest(POINT ", \"intensity\": 1e12, \"color\": [1,0.5,0]}, {\"type\": \"spot\", \"position\": [0,0,1],"
                        " \"direction\": [0,0,-2], \"range\": 5, \"frame\": \"camera\", \"innerConeAngle\": 0.5},"
                        " {\"type\": \"spot\", \"position\": [0,0,1], \"direction\": [0,0,-2],"
                        " \"innerConeAngleDegrees\": 10, \"outerConeAngle\": 1.5707963267948966}]");
    assert_read(reading);
    const struct zr_light *lights = reading->scene->lights;
    assert_true(lights[0].type == ZR_LIGHT_POINT && lights[0].position.z == 3 && lights[0].color.x == 1e12f &&
                lights[0].range == 0 && !reading->scene->picture->is_linear);
    assert_true(lights[1].type == ZR_LIGHT_SPOT && lights[1].camera_frame && lights[1].range == 5 &&
                lights[1].direction.z == -1 && lights[1].outer_degrees == 45);
    assert_true(fabs(lights[1].inner_degrees - 28.64788975654116) < 1e-12);
    assert_true(lights[2].inner_degrees == 10 && lights[2].outer_degrees == 90);
    reading_free(reading);
}

static struct reading *read_lights(uint32_t count)
{
    static const char light[] = "{\"type\": \"directional\", \"direction\": [0,0,-1]},";
    static char text[(ZR_LIGHTS_MAX + 1) * sizeof light + 100];
    char *end = stpcpy(text, "{" POLYGONS ", \"lights\": [");
    for (uint32_t i = 0; i < count; i++)
        end = stpcpy(end, light);
    strcpy(end - 1, "]}"); /* over the last comma */
    return read_text(ZR_FORMAT_JSON, text);
}

TEST(lights_are_up_to_1024)
{
    struct reading *reading = read_lights(1024);
    assert_read(reading);
    assert_int_equal(reading->scene->light_count, 1024);
    reading_free(reading);
    reading = read_lights(1025);
    assert_complaint(reading, ZR_BAD_SCENE, "/lights", "1025 lights; up to 1024 are allowed");
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
