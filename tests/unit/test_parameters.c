/* input/parameters.c: what the query of a bare mesh says. */
#include "input_check.h"

static void query_replaces_defaults(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    struct zr_request request = {.format = ZR_FORMAT_OBJ,
                                 .channel = "depth",
                                 .encoding = "png16",
                                 .scale = "0.5",
                                 .preset = "top",
                                 .width = "320",
                                 .height = "200",
                                 .shading = "unlit"};
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), 1 << 20);
    assert_read(reading);
    assert_int_equal(reading->scene->views[0].width, 320);
    assert_int_equal(reading->scene->views[0].height, 200);
    assert_int_equal(reading->scene->views[0].preset, ZR_PRESET_TOP);
    assert_int_equal(reading->scene->materials[0].shading, ZR_SHADING_UNLIT);
    assert_int_equal(reading->scene->views[0].outputs[0].channel, ZR_CHANNEL_DEPTH);
    assert_int_equal(reading->scene->views[0].outputs[0].encoding, ZR_ENCODING_PNG16);
    assert_true(reading->scene->views[0].outputs[0].scale == 0.5f);
    reading_free(reading);
}

static const char TRIANGLE[] = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n";

static struct reading *read_triangle(struct zr_request request)
{
    request.format = ZR_FORMAT_OBJ;
    struct reading *reading = read_request(request, TRIANGLE, strlen(TRIANGLE), zr_limits_default(), 1 << 20);
    assert_read(reading);
    return reading;
}

static void query_says_where_a_mesh_is_seen_from(void **state)
{
    (void)state;
    struct reading *reading =
        read_triangle((struct zr_request){.look = "textbook", .azimuth = "-30.5", .projection = "perspective"});
    const struct zr_view *view = &reading->scene->views[0];
    assert_int_equal(view->pose, ZR_POSE_ORBIT);
    assert_true(view->azimuth_degrees == -30.5 && view->elevation_degrees == 0 && view->distance == 0.0f);
    assert_int_equal(view->projection, ZR_PROJECTION_PERSPECTIVE);
    assert_true(view->yfov_radians == (float)(45 * 3.14159265358979323846 / 180));
    reading_free(reading);
    reading = read_triangle((struct zr_request){.look = "textbook", .elevation = "90", .projection = "orthographic"});
    assert_int_equal(reading->scene->views[0].pose, ZR_POSE_ORBIT);
    assert_true(reading->scene->views[0].elevation_degrees == 90);
    assert_int_equal(reading->scene->views[0].projection, ZR_PROJECTION_ORTHOGRAPHIC);
    reading_free(reading);
}

static void mesh_whose_z_is_up_is_turned_upright(void **state)
{
    (void)state;
    static const char *const axes[] = {"y", "z"};
    for (int i = 0; i < 2; i++) {
        struct reading *reading = read_triangle((struct zr_request){.up = axes[i]});
        const zr_vec4 up = zr_mat4_apply(&reading->scene->instances[0].object_to_world, (zr_vec4){1, 2, 3, 1});
        assert_true(up.x == 1 && up.w == 1 && up.y == (i ? 3 : 2) && up.z == (i ? -2 : 3));
        reading_free(reading);
    }
}

static void query_says_how_a_mesh_looks(void **state)
{
    (void)state;
    struct reading *reading = read_triangle((struct zr_request){
        .color = "#ff0000", .background = "transparent", .outline = "blue", .doubleSided = "false", .fill = "true"});
    const struct zr_material *material = &reading->scene->materials[0];
    assert_true(material->base_color.x == 1 && material->base_color.y == 0 && material->base_color.w == 1);
    assert_true(reading->scene->background.w == 0);
    assert_int_equal(material->outline, ZR_OUTLINE_COLORED);
    assert_true(material->outline_color.z == 1 && material->outline_color.x == 0);
    assert_false(material->double_sided || material->unfilled);
    reading_free(reading);
    reading = read_triangle((struct zr_request){.outline = "true", .fill = "false", .background = "#0000"});
    material = &reading->scene->materials[0];
    assert_int_equal(material->outline, ZR_OUTLINE_OWN);
    assert_true(material->double_sided && material->unfilled);
    reading_free(reading);
    reading = read_triangle((struct zr_request){.outline = "false"});
    assert_int_equal(reading->scene->materials[0].outline, ZR_OUTLINE_NONE);
    reading_free(reading);
}

static void wrong_query_gives_bad_request_naming_the_parameter(void **state)
{
    (void)state;
    static const struct {
        struct zr_request request;
        const char *detail;
    } cases[] = {
        {{.format = ZR_FORMAT_OBJ, .channel = "colour"},
         "channel: 'colour' is unknown (did you mean color?); allowed: color, depth"},
        {{.format = ZR_FORMAT_OBJ, .channel = "overdraw"}, "channel: 'overdraw' is not supported"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png"}, "encoding: 'png' is not one"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .scale = "2"}, "scale: only the encoding png16"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .x = "2"}, "x: only the channel fragments"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments"}, "x: missing"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "2"}, "y: missing"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "2", .y = ""}, "y: '' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "-1", .y = "2"}, "x: '-1' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "4294967296", .y = "2"}, "x: '4294967296' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "0"}, "scale: '0' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "nan"}, "scale: 'nan'"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "1e39"}, "scale: '1e39'"},
        {{.format = ZR_FORMAT_OBJ, .preset = "up"}, "preset: 'up' is unknown; allowed: front"},
        {{.format = ZR_FORMAT_OBJ, .shading = "toon"}, "shading: 'toon' is"},
        {{.format = ZR_FORMAT_OBJ, .look = "stduio"},
         "look: 'stduio' is unknown (did you mean studio?); allowed: studio, technical, clay"},
        {{.format = ZR_FORMAT_STL, .look = "studio@01"}, "look: 'studio@01' is unknown"},
        {{.format = ZR_FORMAT_JSON, .look = "studio"}, "query parameter look belongs to bodies that are a bare mesh"},
        {{.format = ZR_FORMAT_OBJ, .samples = "9"}, "samples: '9' is unknown; allowed: 1, 4, 16, 64"},
        {{.format = ZR_FORMAT_JSON, .samples = "4"}, "query parameter samples belongs to bodies that are a bare mesh"},
        {{.format = ZR_FORMAT_OBJ, .compress = "best"}, "compress: 'best' is unknown; allowed: fast, small"},
        {{.format = ZR_FORMAT_JSON, .compress = ""}, "compress: '' is unknown; allowed: fast, small"},
        {{.format = ZR_FORMAT_OBJ, .width = "0"}, "width: '0'"},
        {{.format = ZR_FORMAT_OBJ, .width = "-5"}, "width: '-5'"},
        {{.format = ZR_FORMAT_OBJ, .height = "9x"}, "height: '9x' is not a whole number of pixels from 1 to 8192"},
        {{.format = ZR_FORMAT_OBJ, .height = ""}, "height: ''"},
        {{.format = ZR_FORMAT_OBJ, .azimuth = "left"}, "azimuth: 'left' is not a number of degrees"},
        {{.format = ZR_FORMAT_OBJ, .azimuth = "1e7"}, "from -1e+06 to 1e+06"},
        {{.format = ZR_FORMAT_OBJ, .azimuth = "nan"}, "azimuth: 'nan'"},
        {{.format = ZR_FORMAT_OBJ, .elevation = "90.1"}, "elevation: '90.1' is not a number of degrees from -90 to 90"},
        {{.format = ZR_FORMAT_OBJ, .elevation = "1", .preset = "top"}, "parameters preset and elevation: each says"},
        {{.format = ZR_FORMAT_OBJ, .up = "x"}, "up: 'x' is unknown; allowed: y, z"},
        {{.format = ZR_FORMAT_OBJ, .projection = "fisheye"}, "allowed: orthographic, perspective"},
        {{.format = ZR_FORMAT_OBJ, .color = "reddish"}, "color: 'reddish' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .color = "#ff000080"}, "color: '#ff000080' is not opaque"},
        {{.format = ZR_FORMAT_OBJ, .background = "none"}, "background: 'none' is not a colour: transparent"},
        {{.format = ZR_FORMAT_OBJ, .outline = "yes"}, "outline: 'yes' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .fill = "no"}, "fill: 'no' is unknown; allowed: false, true"},
        {{.format = ZR_FORMAT_OBJ, .doubleSided = ""}, "doubleSided: '' is unknown"},
        {{.format = ZR_FORMAT_JSON, .up = "z"}, "query parameter up belongs to bodies that are a bare mesh"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_request(cases[i].request, "", 0, zr_limits_default(), 1 << 20);
        assert_complaint(reading, ZR_BAD_REQUEST, "", cases[i].detail);
        reading_free(reading);
    }
}

static void window_beyond_the_limit_in_the_query_is_refused_as_in_a_scene(void **state)
{
    (void)state;
    const char *const heights[] = {"8193", "100000", "18446744073709551617"};
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        struct zr_request request = {.format = ZR_FORMAT_OBJ, .height = heights[i]};
        struct reading *reading = read_request(request, "", 0, zr_limits_default(), 1 << 20);
        char detail[100];
        snprintf(detail, sizeof detail, "height: '%s' pixels; 1 to 8192 are allowed", heights[i]);
        assert_complaint(reading, ZR_BAD_SCENE, "", detail);
        reading_free(reading);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(query_replaces_defaults),
        cmocka_unit_test(query_says_where_a_mesh_is_seen_from),
        cmocka_unit_test(mesh_whose_z_is_up_is_turned_upright),
        cmocka_unit_test(query_says_how_a_mesh_looks),
        cmocka_unit_test(wrong_query_gives_bad_request_naming_the_parameter),
        cmocka_unit_test(window_beyond_the_limit_in_the_query_is_refused_as_in_a_scene),
    };
    return cmocka_run_group_tests_name("parameters", tests, NULL, NULL);
}
