/* Tests the lights of glTF files: units, places, and the parameter that uses them. */
#include "scene/picture.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
static struct zr_asset parts[] = {{.name = "b", .bytes = corners, .size = sizeof corners}};

#define FILE_OF(lights, nodes)                                                                                         \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{"                   \
    "\"KHR_lights_punctual\":{\"lights\":[" lights                                                                     \
    "]}},\"buffers\":[{\"byteLength\":36,\"uri\":\"b\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"          \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"meshes\":[{"            \
    "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}" nodes "]}"
#define LIGHT(number) "\"extensions\":{\"KHR_lights_punctual\":{\"light\":" #number "}}"

#define SUN  "{\"type\":\"directional\",\"intensity\":3.14159265,\"color\":[1,0.5,0]}"
#define LAMP "{\"type\":\"point\",\"intensity\":31.4159265,\"range\":4}"
#define CONE "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.1,\"outerConeAngle\":0.5}}"
#define NODES                                                                                                          \
    ",{" LIGHT(0) ",\"rotation\":[0.70710678,0,0,-0.70710678]},{" LIGHT(                                               \
        1) ",\"translation\":[1,2,3],"                                                                                 \
           "\"scale\":[2,2,2]},{" LIGHT(2) ",\"translation\":[0,0,9]},{" LIGHT(1) "}"

static const char text[] = FILE_OF(SUN "," LAMP "," CONE, NODES);

static struct reading *read_over(struct zr_request request, const char *of)
{
    return read_with_part(ZR_FORMAT_GLTF, request, parts, of);
}

static void assert_vector(zr_vec3 v, float x, float y, float z)
{
    if (!(fabsf(v.x - x) < 1e-5f && fabsf(v.y - y) < 1e-5f && fabsf(v.z - z) < 1e-5f))
        fail_msg("%g %g %g", (double)v.x, (double)v.y, (double)v.z);
}

TEST(the_lights_of_the_file_replace_those_of_the_look)
{
    struct reading *reading = read_over((struct zr_request){.fileLights = "1"}, text);
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    const struct zr_light *lights = scene->lights;
    assert_int_equal(scene->warning_count, 0);
    assert_int_equal(scene->light_count, 4);
    assert_int_equal(scene->picture->environment.name, ZR_ENVIRONMENT_NONE);
    assert_int_equal(lights[0].type, ZR_LIGHT_DIRECTIONAL);
    assert_vector(lights[0].color, 1, 0.5f, 0); /* pi lux make white white */
    assert_vector(lights[0].direction, 0, -1, 0);
    assert_int_equal(lights[1].type, ZR_LIGHT_POINT);
    assert_vector(lights[1].color, 10, 10, 10);
    assert_vector(lights[1].position, 1, 2, 3);
    assert_true(lights[1].range == 4.0f);
    assert_int_equal(lights[2].type, ZR_LIGHT_SPOT);
    assert_vector(lights[2].direction, 0, 0, -1);
    assert_true(fabs(lights[2].outer_degrees - 28.6478898) < 1e-5 && fabs(lights[2].inner_degrees - 5.72957795) < 1e-5);
    reading_free(reading);
    reading = read_over((struct zr_request){.fileLights = "1", .up = "z"}, text);
    assert_read(reading);
    assert_vector(reading->scene->lights[1].position, 1, 3, -2);
    assert_vector(reading->scene->lights[0].direction, 0, 0, 1);
    reading_free(reading);
}

TEST(other_lights_are_said)
{
    static const struct {
        const char *wish, *of, *warning;
        uint32_t lights;
    } cases[] = {{NULL, text, "left out: 4 lights of the file; the parameter fileLights uses them", 0},
                 {"1", FILE_OF("", ""), "the parameter fileLights has no effect: the file has no lights", 0},
                 {"1", FILE_OF(SUN ",{\"type\":\"area\"}", ",{" LIGHT(0) "},{" LIGHT(1) "}"),
                  "/extensions/KHR_lights_punctual/lights/1: this light cannot be used, and is left out", 1},
                 {"1",
                  FILE_OF(SUN ",{\"type\":\"point\",\"color\":[2,0,0]},{\"type\":\"point\",\"intensity\":-1}",
                          ",{" LIGHT(0) "}"),
                  "2 lights cannot be used and are left out, the first is /extensions/KHR_lights_punctual/lights/1", 1},
                 {"1", FILE_OF(SUN, ",{" LIGHT(0) "},{" LIGHT(0) ",\"scale\":[0,0,0]}"),
                  "/nodes/2: this light cannot be used, and is left out", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading =
            read_over((struct zr_request){.fileLights = cases[i].wish, .channel = "color"}, cases[i].of);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, 1);
        assert_string_equal(reading->scene->warnings[0], cases[i].warning);
        if (cases[i].lights) assert_int_equal(reading->scene->light_count, cases[i].lights);
        reading_free(reading);
    }
}

TEST(wrong_lights_are_refused)
{
    struct reading *reading = read_over((struct zr_request){.fileLights = "1", .light = "point"}, text);
    assert_complaint(reading, ZR_BAD_REQUEST, "", "parameter light");
    reading_free(reading);
    reading = read_over((struct zr_request){.fileLights = "1", .lightDirection = "0,0,-1"}, text);
    assert_complaint(reading, ZR_BAD_SCENE, "", "parameter fileLights: cannot be combined with lights of the query");
    reading_free(reading);
    reading = read_over((struct zr_request){.color = NULL}, FILE_OF(SUN, ",{" LIGHT(1) "}"));
    assert_complaint(reading, ZR_BAD_SCENE, "/nodes/1/extensions/KHR_lights_punctual/light", "index 1 of 1 lights");
    reading_free(reading);
}

TEST(angles_of_spot_lights_are_clamped)
{
    static const struct {
        const char *spot;
        double inner, outer; /* degrees */
        const char *warning; /* NULL: none */
    } cases[] = {
        {"\"innerConeAngle\":0.5,\"outerConeAngle\":0.25", 14.32394, 14.32394, "lights/0: its cone angles are beyond"},
        {"\"innerConeAngle\":0.25,\"outerConeAngle\":0.25", 14.32394, 14.32394, "lights/0: its cone angles are beyond"},
        {"\"innerConeAngle\":1,\"outerConeAngle\":0.99", 56.72282, 56.72282, "lights/0: its cone angles are beyond"},
        {"\"innerConeAngle\":1", 45, 45, "lights/0: its cone angles are beyond their ranges, and clamped"},
        {"\"outerConeAngle\":2", 0, 90, "lights/0: its cone angles are beyond"},
        {"\"innerConeAngle\":1.8,\"outerConeAngle\":2", 90, 90, "lights/0: its cone angles are beyond"},
        {"\"innerConeAngle\":-1", 0, 45, "lights/0: its cone angles are beyond"},
        {"\"outerConeAngle\":1.5707963705062866", 0, 90, NULL}, /* pi / 2 as float */
        {"\"outerConeAngle\":-1", 0, 0, "lights/0: this light cannot be used, and is left out"},
        {"\"outerConeAngle\":0", 0, 0, "lights/0: this light cannot be used, and is left out"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char of[1024];
        snprintf(of, sizeof of,
                 FILE_OF("{\"type\":\"spot\",\"spot\":{%s}}"
                         "," SUN,
                         ",{" LIGHT(0) "},{" LIGHT(1) "}"),
                 cases[i].spot);
        struct reading *reading = read_over((struct zr_request){.fileLights = "1"}, of);
        assert_read(reading);
        const struct zr_scene *scene = reading->scene;
        const struct zr_light *light = &scene->lights[0];
        const char *says = scene->warning_count > 0 ? scene->warnings[0] : "";
        const bool is_bad = cases[i].warning ? !strstr(says, cases[i].warning) : *says != '\0';
        if (is_bad || scene->warning_count > 1) fail_msg("case %zu: %s", i, says);
        if (cases[i].outer > 0)
            if (fabs(light->inner_degrees - cases[i].inner) > 1e-4 ||
                fabs(light->outer_degrees - cases[i].outer) > 1e-4 || light->inner_degrees >= light->outer_degrees)
                fail_msg("case %zu: %g %g", i, light->inner_degrees, light->outer_degrees);
        reading_free(reading);
        reading = read_over((struct zr_request){.fileLights = "1", .strict = "1"}, of);
        if (cases[i].warning) assert_complaint(reading, ZR_BAD_SCENE, "", cases[i].warning);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
