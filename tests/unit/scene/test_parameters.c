/* input/query/parameters.c: what the query of a bare mesh says. */
#include "scene/output.h"
#include "unit/common/triangle_query.h"

#include "support/tests.h"

TEST(query_replaces_defaults)
{
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

TEST(query_says_where_a_mesh_is_seen_from)
{
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

TEST(mesh_whose_z_is_up_is_turned_upright)
{
    static const char *const axes[] = {"y", "z"};
    for (int i = 0; i < 2; i++) {
        struct reading *reading = read_triangle((struct zr_request){.up = axes[i]});
        const zr_vec4 up = zr_mat4_apply(&reading->scene->instances[0].object_to_world, (zr_vec4){1, 2, 3, 1});
        assert_true(up.x == 1 && up.w == 1 && up.y == (i ? 3 : 2) && up.z == (i ? -2 : 3));
        reading_free(reading);
    }
}

TEST(query_says_how_a_mesh_looks)
{
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

TEST(channels_with_commas_are_outputs)
{
    struct zr_request request = {
        .channel = "color,depth,fragments,normals", .encoding = "png16", .scale = "0.5", .x = "3", .y = "4"};
    static const struct zr_output wanted[] = {
        {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
        {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_PNG16, .scale = 0.5f},
        {.channel = ZR_CHANNEL_FRAGMENTS, .encoding = ZR_ENCODING_JSON, .x = 3, .y = 4},
        {.channel = ZR_CHANNEL_NORMALS, .encoding = ZR_ENCODING_NPY}};
    static const char scene[] = "{\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}], "
                                "\"outputs\": [{\"channel\": \"faceId\"}]}";
    for (int is_scene = 0; is_scene < 2; is_scene++) {
        request.format = is_scene ? ZR_FORMAT_JSON : ZR_FORMAT_OBJ;
        const char *text = is_scene ? scene : MESH;
        struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), 1 << 20);
        assert_read(reading);
        const struct zr_view *view = &reading->scene->views[0];
        assert_int_equal(view->output_count, 4);
        for (uint32_t i = 0; i < view->output_count; i++) {
            const struct zr_output *output = &view->outputs[i];
            assert_int_equal(output->channel, wanted[i].channel);
            assert_int_equal(output->encoding, wanted[i].encoding);
            assert_true(output->scale == wanted[i].scale && output->x == wanted[i].x && output->y == wanted[i].y);
        }
        reading_free(reading);
    }
}

static void assert_place(zr_vec3 place, float x, float y, float z)
{
    if (place.x != x || place.y != y || place.z != z)
        fail_msg("%.9g %.9g %.9g", (double)place.x, (double)place.y, (double)place.z);
}

/* The box of the mesh is from (1, 2, 3) to (3, 4, 3). */
TEST(eye_and_target_are_places_of_the_file)
{
    static const char stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 3 2 3\nvertex 3 4 3\n"
                              "endloop\nendfacet\nendsolid a\n";
    static const struct {
        const char *eye, *target, *up;
        float places[3][3]; /* of eye, target and up in the world */
    } cases[] = {{"10,2,4", "1,2,3", NULL, {{10, 4, -2}, {1, 3, -2}, {0, 1, 0}}},
                 {"10,2,4", NULL, NULL, {{10, 4, -2}, {2, 3, -3}, {0, 1, 0}}},
                 {"10,2,4", "1,2,3", "y", {{10, 2, 4}, {1, 2, 3}, {0, 1, 0}}},
                 {"2,3,9", NULL, NULL, {{2, 9, -3}, {2, 3, -3}, {0, 0, -1}}},
                 {"2,3,-9", NULL, NULL, {{2, -9, -3}, {2, 3, -3}, {0, 0, 1}}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {
            .format = ZR_FORMAT_STL, .eye = cases[i].eye, .target = cases[i].target, .up = cases[i].up};
        struct reading *reading = read_request(request, stl, strlen(stl), zr_limits_default(), 1 << 20);
        assert_read(reading);
        const struct zr_view *view = &reading->scene->views[0];
        const zr_vec3 places[] = {view->eye, view->target, view->up};
        for (int k = 0; k < 3; k++)
            assert_place(places[k], cases[i].places[k][0], cases[i].places[k][1], cases[i].places[k][2]);
        reading_free(reading);
    }
}

TEST(an_eye_far_from_the_origin_keeps_its_digits)
{
    static const char obj[] = "v 500000 0 0\nv 500001 0 0\nv 500001 1 0\nf 1 2 3\n";
    const struct zr_request request = {.format = ZR_FORMAT_OBJ, .eye = "500000.71,0.5,4", .target = "500000.51,0.5,0"};
    struct reading *reading = read_request(request, obj, strlen(obj), zr_limits_default(), 1 << 20);
    assert_read(reading);
    assert_place(reading->scene->views[0].eye, (float)(500000.71 - 500000.5), 0, 4);
    assert_place(reading->scene->views[0].target, (float)(500000.51 - 500000.5), 0, 0);
    reading_free(reading);
}

TEST(keys_of_encodings_belong_to_the_channels_that_have_them)
{
    const struct zr_request request = {
        .format = ZR_FORMAT_OBJ, .channel = "color,depth", .encoding = "webp", .quality = "40", .maxBytes = "2000"};
    struct reading *reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), 1 << 20);
    assert_read(reading);
    const struct zr_output *outputs = reading->scene->views[0].outputs;
    assert_int_equal(outputs[0].encoding, ZR_ENCODING_WEBP);
    assert_true(outputs[0].quality == 40 && outputs[0].max_bytes == 2000 && !outputs[0].is_lossless);
    assert_int_equal(outputs[1].encoding, ZR_ENCODING_NPY);
    assert_true(outputs[1].quality == 0 && outputs[1].max_bytes == 0);
    reading_free(reading);
}

TEST(wrong_query_gives_bad_request_naming_the_parameter)
{
    static const struct {
        struct zr_request request;
        const char *detail;
    } cases[] = {
        {{.format = ZR_FORMAT_OBJ, .channel = "colour"},
         "channel: 'colour' is unknown (did you mean color?); allowed: color, depth"},
        {{.format = ZR_FORMAT_OBJ, .channel = "overdraw"}, "channel: 'overdraw' is not supported"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png"},
         "encoding: the channel depth cannot be encoded as png; allowed: npy, png16"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .scale = "2"}, "scale: only the encoding png16"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .x = "2"}, "x: only the channel fragments"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments"}, "channel: missing the keys x and y"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "2"}, "channel: missing the key y"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .y = "2"}, "channel: missing the key x"},
        {{.format = ZR_FORMAT_JSON, .channel = "fragments"}, "channel: missing the keys x and y"},
        {{.format = ZR_FORMAT_OBJ, .x = "2"}, "x: only the channel fragments"},
        {{.format = ZR_FORMAT_OBJ, .channel = "1"}, "channel: '1' is unknown; allowed: color, depth"},
        {{.format = ZR_FORMAT_OBJ, .channel = "q\"\\\x01\xff"}, "channel: 'q\"\\?"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "2", .y = ""}, "y: '' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "-1", .y = "2"}, "x: '-1' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "fragments", .x = "4294967296", .y = "2"}, "x: '4294967296' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "0"}, "scale: '0' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "nan"}, "scale: 'nan'"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth", .encoding = "png16", .scale = "1e39"}, "scale: '1e39'"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,dept"}, "channel: 'dept' is unknown (did you mean depth?)"},
        {{.format = ZR_FORMAT_JSON, .channel = "color,"}, "channel: '' is unknown; allowed: color, depth"},
        {{.format = ZR_FORMAT_OBJ, .channel = ","}, "channel: '' is unknown"},
        {{.format = ZR_FORMAT_OBJ, .channel = "depth,depth"}, "channel: the same file name as"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,fragments"}, "channel: missing the keys x and y"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,depth", .x = "2"}, "x: only the channel fragments"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,depth", .scale = "2"}, "scale: only the encoding png16"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,depth", .encoding = "json"},
         "encoding: the channel color cannot be encoded as json"},
        {{.format = ZR_FORMAT_OBJ, .channel = "color,depth", .encoding = "png16", .scale = "0"}, "scale: '0' is not"},
        {{.format = ZR_FORMAT_OBJ, .channel = ",,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,"}, "channel: 32 channels; up to "},
        {{.format = ZR_FORMAT_OBJ, .preset = "up"}, "preset: 'up' is unknown; allowed: front"},
        {{.format = ZR_FORMAT_OBJ, .shading = "toon"}, "shading: 'toon' is"},
        {{.format = ZR_FORMAT_OBJ, .look = "stduio"},
         "look: 'stduio' is unknown (did you mean studio?); allowed: studio, technical, clay"},
        {{.format = ZR_FORMAT_STL, .look = "studio@01"}, "look: 'studio@01' is unknown; versions of studio: studio@1"},
        {{.format = ZR_FORMAT_JSON, .look = "studio"}, "parameter look belongs to bodies that are a bare mesh"},
        {{.format = ZR_FORMAT_OBJ, .samples = "9"}, "samples: '9' is unknown; allowed: 1, 4, 16, 64"},
        {{.format = ZR_FORMAT_OBJ, .samples = "4.0"}, "samples: '4.0' is unknown; allowed: 1, 4, 16, 64"},
        {{.format = ZR_FORMAT_OBJ, .samples = "016"}, "samples: '016' is unknown"},
        {{.format = ZR_FORMAT_OBJ, .width = "+7"}, "width: '+7'"},
        {{.format = ZR_FORMAT_OBJ, .width = "1e2"}, "width: '1e2'"},
        {{.format = ZR_FORMAT_OBJ, .color = "1,0,0"}, "color: '1,0,0' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .background = "0,0,1"}, "background: '0,0,1' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .outline = "#00ff0080"}, "outline: '#00ff0080' is not opaque"},
        {{.format = ZR_FORMAT_OBJ, .colorBar = "maybe"}, "colorBar: 'maybe' is unknown; allowed: false, true"},
        {{.format = ZR_FORMAT_OBJ, .edges = "thick"}, "edges: 'thick' is unknown; allowed: false, true"},
        {{.format = ZR_FORMAT_OBJ, .exposure = "-1"}, "exposure: '-1' is not a number from 0 to 1e+06"},
        {{.format = ZR_FORMAT_OBJ, .lineWidth = "0"}, "lineWidth: '0' is not a number of pixels from 0.1 to 64"},
        {{.format = ZR_FORMAT_OBJ, .padding = "0.5"}, "padding: '0.5' is not a number from 0 to 0.45"},
        {{.format = ZR_FORMAT_OBJ, .environment = "true"},
         "environment: 'true' is unknown; allowed: studio, metal, outdoor; or false for none"},
        {{.format = ZR_FORMAT_OBJ, .lightDirection = "1,2"}, "lightDirection: '1,2' is not three numbers"},
        {{.format = ZR_FORMAT_OBJ, .lightDirection = "0,0,0"}, "lightDirection: the direction has the length 0"},
        {{.format = ZR_FORMAT_OBJ, .light = "spot"}, "light: lightDirection is missing"},
        {{.format = ZR_FORMAT_OBJ, .light = "point"}, "light: lightPosition is missing"},
        {{.format = ZR_FORMAT_OBJ, .lightColor = "red"}, "lightColor: lightDirection is missing"},
        {{.format = ZR_FORMAT_OBJ, .lightIntensity = "2"}, "lightIntensity: lightDirection is missing"},
        {{.format = ZR_FORMAT_OBJ, .shadows = "true"}, "shadows: lightDirection is missing"},
        {{.format = ZR_FORMAT_OBJ, .scale = "2e9", .channel = "depth", .encoding = "png16"},
         "scale: 2000000000 is outside"},
        {{.format = ZR_FORMAT_JSON, .samples = "4"}, "parameter samples belongs to bodies that are a bare mesh"},
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
        {{.format = ZR_FORMAT_OBJ, .elevation = "1", .preset = "top"}, "preset: two poses: preset and elevation"},
        {{.format = ZR_FORMAT_OBJ, .azimuth = "1", .preset = "top"}, "preset: two poses: preset and azimuth"},
        {{.format = ZR_FORMAT_OBJ, .up = "w"}, "up: 'w' is unknown; allowed: x, -x, y, -y, z, -z, auto"},
        {{.format = ZR_FORMAT_OBJ, .projection = "fisheye"}, "allowed: orthographic, perspective"},
        {{.format = ZR_FORMAT_OBJ, .color = "reddish"}, "color: 'reddish' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .color = "#ff000080"}, "color: '#ff000080' is not opaque"},
        {{.format = ZR_FORMAT_OBJ, .background = "none"}, "background: 'none' is not a colour: transparent"},
        {{.format = ZR_FORMAT_OBJ, .outline = "yes"}, "outline: 'yes' is not a colour"},
        {{.format = ZR_FORMAT_OBJ, .fill = "no"}, "fill: 'no' is unknown; allowed: false, true"},
        {{.format = ZR_FORMAT_OBJ, .doubleSided = ""}, "doubleSided: '' is unknown"},
        {{.format = ZR_FORMAT_JSON, .up = "z"}, "parameter up belongs to bodies that are a bare mesh"},
        {{.format = ZR_FORMAT_OBJ, .section = ""}, "section: '' is not a list of planes such as x, y:0.25"},
        {{.format = ZR_FORMAT_OBJ, .section = "u:0.5"}, "section: 'u:0.5' is not a list of planes"},
        {{.format = ZR_FORMAT_OBJ, .section = "x:0.5,"}, "section: 'x:0.5,' is not a list of planes"},
        {{.format = ZR_FORMAT_OBJ, .section = "x:1.5"}, "section: 'x:1.5' is not a list of planes"},
        {{.format = ZR_FORMAT_OBJ, .section = "x:0.5:near"}, "section: 'x:0.5:near' is not a list of planes"},
        {{.format = ZR_FORMAT_OBJ, .section = "x,x,x,x,x,x,x"},
         "section: 'x,x,x,x,x,x,x' is not a list of up to 6 planes"},
        {{.format = ZR_FORMAT_OBJ, .sectionCorner = "true"}, "sectionCorner: section is missing"},
        {{.format = ZR_FORMAT_OBJ, .turntableElevation = "20"}, "parameter turntableElevation: turntable is missing"},
        {{.format = ZR_FORMAT_JSON, .turntableSeconds = "2"}, "parameter turntableSeconds: turntable is missing"},
        {{.format = ZR_FORMAT_JSON, .sheetColumns = "2", .views = "top,front"},
         "parameter sheetColumns: sheet is missing"},
        {{.format = ZR_FORMAT_STL, .sectionHatch = "true"},
         "parameter sectionHatch: section is missing, which is needed here: planes that cut the mesh open: x, y or z, "
         "a "
         "share "
         "of its bounds and a side, such as x:0.5"},
        {{.format = ZR_FORMAT_JSON, .section = "x"}, "parameter section belongs to bodies that are a bare mesh"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_request(cases[i].request, "", 0, zr_limits_default(), 1 << 20);
        assert_complaint(reading, ZR_BAD_REQUEST, "", cases[i].detail);
        reading_free(reading);
    }
}

TEST(all_faults_of_one_object_are_reported)
{
    static const struct {
        struct zr_request request;
        const char *details[3];
    } cases[] = {
        {{.channel = "depht", .encoding = "png17", .x = "a"},
         {"x: 'a' is not", "channel: 'depht'", "encoding: 'png17'"}},
        {{.channel = "color,depth", .encoding = "png16", .scale = "a"}, {"scale: 'a' is not"}},
        {{.preset = "zz", .azimuth = "x"}, {"azimuth: 'x' is not", "preset: 'zz'", "two poses: preset and azimuth"}},
        {{.light = "spot", .lightDirection = "1,2"},
         {"lightDirection: '1,2' is not", "light: lightPosition is missing"}},
        {{.color = "zz", .metallic = "7"}, {"color: 'zz'", "metallic: '7'"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct zr_request request = cases[i].request;
        request.format = ZR_FORMAT_OBJ;
        struct reading *reading = read_request(request, "", 0, zr_limits_default(), 1 << 20);
        assert_complaint(reading, ZR_BAD_REQUEST, "", cases[i].details[0]);
        size_t count = 0;
        for (; count < 3 && cases[i].details[count]; count++)
            if (!strstr(reading->error.items[count].detail, cases[i].details[count]))
                fail_msg("case %zu: %s", i, reading->error.items[count].detail);
        assert_int_equal(reading->error.count, count);
        reading_free(reading);
    }
}

TEST(window_beyond_the_limit_in_the_query_is_refused_as_in_a_scene)
{
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

TEST(parameters_without_effect_are_warned_of_by_name)
{
    static const struct {
        struct zr_request request;
        const char *warning; /* NULL: none */
    } cases[] = {
        {{.shading = "gooch", .exposure = "2"},
         "no effect of exposure: no face has the shading flat, gouraud, phong, pbr"},
        {{.look = "technical", .toneMapping = "neutral"},
         "no effect of toneMapping: no face has the shading flat, gouraud, phong, pbr"},
        {{.look = "technical", .exposure = "1", .toneMapping = "none"}, NULL},
        {{.exposure = "2"}, NULL},
        {{.roughness = "0.5"}, NULL},
        {{.roughness = "0.5", .metallic = "1", .shading = "phong"},
         "no effect of metallic, roughness with the shading phong"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_triangle(cases[i].request);
        const uint32_t count = reading->scene->warning_count;
        if (count != (cases[i].warning != NULL)) fail_msg("case %zu: %u warnings", i, count);
        if (count && !strstr(reading->scene->warnings[0], cases[i].warning))
            fail_msg("case %zu: %s", i, reading->scene->warnings[0]);
        reading_free(reading);
    }
}

TEST(faults_of_the_whole_scene_name_the_parameter)
{
    struct zr_request request = {.format = ZR_FORMAT_OBJ, .channel = "layers", .algorithm = "painter"};
    struct reading *reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), 1 << 20);
    assert_complaint(reading, ZR_BAD_SCENE, "", "parameter algorithm: painter keeps no fragments");
    reading_free(reading);
    request = (struct zr_request){.format = ZR_FORMAT_OBJ, .look = "studio"};
    reading = read_request(request, "o empty\n", 8, zr_limits_default(), 1 << 20);
    assert_complaint(reading, ZR_BAD_SCENE, "", "no geometry");
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
