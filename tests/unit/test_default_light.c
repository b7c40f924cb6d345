/* What is lit by nobody's lights: how its faces look, from many sides. */
#include "json_check.h"
#include "shade/frame.h"

#define CUBE                                                                                                           \
    "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "                               \
    "\"faces\": [[4,5,6,7],[1,0,3,2],[5,1,2,6],[0,4,7,3],[7,6,2,3],[0,1,5,4]]"

enum { FACES = 6, IDS = FACES + 1 };

/* Colours of the cube's faces by their ids; alpha is 0 where one is not seen. */
struct look {
    uint8_t colors[IDS][4];
    int visible;
};

static void look_at(struct reading *reading, struct look *look)
{
    const struct zr_frame *frame;
    struct zr_error error = {0};
    *look = (struct look){.visible = 0};
    assert_read(reading);
    assert_int_equal(zr_render(&reading->arena, NULL, reading->scene, NULL, NULL, &frame, &error), ZR_OK);
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        uint32_t id = frame->face_id[i];
        if (id == 0) continue;
        assert_true(id < IDS);
        look->visible += look->colors[id][3] == 0;
        memcpy(look->colors[id], frame->color + 4 * i, 4);
    }
}

static void look_at_cube(const char *color, const char *view, struct look *look)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"window\": {\"width\": 80, \"height\": 60}, \"outputs\": [{\"channel\": \"color\"}, {\"channel\": "
             "\"faceId\"}], \"meshes\": [{" CUBE ", \"material\": \"m\"}], "
             "\"materials\": [{\"name\": \"m\", \"baseColorFactor\": %s}], \"view\": {%s}}",
             color, view);
    struct reading *reading = read_text(ZR_FORMAT_JSON, text);
    look_at(reading, look);
    reading_free(reading);
}

/* Of the base colour, which is white. */
static double share(const struct look *look, int id)
{
    return look->colors[id][0] / 255.0;
}

/* Prints a row of the table that is quoted in core/scene/looks.c. */
static void assert_distinct_faces(const char *view, const struct look *look, double least)
{
    double difference = 1;
    print_message("%-50s", view);
    for (int a = 1; a < IDS; a++) {
        if (look->colors[a][3] == 0) continue;
        print_message(" %.3f", share(look, a));
        if (share(look, a) < 0.33 || share(look, a) > 0.98) fail_msg("%s: a face of %.3f", view, share(look, a));
        for (int b = 1; b < a; b++)
            if (look->colors[b][3] != 0 && fabs(share(look, a) - share(look, b)) < difference)
                difference = fabs(share(look, a) - share(look, b));
    }
    print_message("%s\n", look->visible > 1 ? "" : " (alone)");
    if (difference < least) fail_msg("%s: faces that differ by %.3f", view, difference);
}

static void three_faces_of_a_cube_differ_in_ten_views(void **state)
{
    static const char *const views[] = {
        "\"preset\": \"isometric\"",
        "\"direction\": [-1, 1, -1]", /* from below */
        "\"azimuthDegrees\": 45, \"elevationDegrees\": 20",
        "\"azimuthDegrees\": 45, \"elevationDegrees\": 50",
        "\"azimuthDegrees\": 30, \"elevationDegrees\": 20",
        "\"azimuthDegrees\": 30, \"elevationDegrees\": 35",
        "\"azimuthDegrees\": 30, \"elevationDegrees\": 50",
        "\"azimuthDegrees\": 60, \"elevationDegrees\": 20",
        "\"azimuthDegrees\": 60, \"elevationDegrees\": 35",
        "\"azimuthDegrees\": 60, \"elevationDegrees\": 50",
    };
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        struct look look;
        look_at_cube("[1, 1, 1]", views[i], &look);
        assert_int_equal(look.visible, 3);
        assert_distinct_faces(views[i], &look, 0.2);
    }
}

static void every_preset_shows_faces_that_differ_and_are_neither_black_nor_burnt(void **state)
{
    static const char *const presets[] = {"front", "back", "left", "right", "top", "bottom", "isometric"};
    (void)state;
    for (size_t i = 0; i < sizeof presets / sizeof presets[0]; i++)
        for (int fov = 0; fov <= 60; fov += 30) {
            char view[128];
            struct look look;
            if (fov)
                snprintf(view, sizeof view, "\"preset\": \"%s\", \"perspective\": {\"yfovDegrees\": %d}", presets[i],
                         fov);
            else
                snprintf(view, sizeof view, "\"preset\": \"%s\"", presets[i]);
            look_at_cube("[1, 1, 1]", view, &look);
            assert_int_equal(look.visible, strcmp(presets[i], "isometric") == 0 ? 3 : 1);
            assert_distinct_faces(view, &look, 0.2);
        }
}

static void red_looks_red_on_every_face(void **state)
{
    (void)state;
    struct look look;
    look_at_cube("\"#cc3333\"", "\"preset\": \"isometric\"", &look);
    for (int id = 1; id < IDS; id++) {
        const uint8_t *c = look.colors[id];
        if (c[3] == 0) continue;
        assert_true(c[0] >= 0.33 * 0xcc && c[0] <= 0.98 * 0xcc);
        assert_true(abs(c[0] - 4 * c[1]) <= 4 && c[1] == c[2]); /* 0xcc is 4 times 0x33 */
    }
}

static void a_bare_mesh_gets_the_same_light_by_the_textbook(void **state)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                              "f 5 6 7 8\nf 2 1 4 3\nf 6 2 3 7\nf 1 5 8 4\nf 8 7 3 4\nf 1 2 6 5\n";
    (void)state;
    struct look json, bare;
    look_at_cube("[0.7, 0.7, 0.7]", "\"preset\": \"isometric\"", &json);
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .look = "textbook"}, obj,
                                           sizeof obj - 1, zr_limits_default(), (size_t)1 << 28);
    struct zr_scene scene = *reading->scene;
    const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                        {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
    scene.views[0].outputs = outputs;
    scene.views[0].output_count = 2;
    reading->scene = &scene;
    look_at(reading, &bare);
    assert_memory_equal(bare.colors, json.colors, sizeof json.colors);
    reading_free(reading);
}

/* A ball has normals of all directions: none is lit to more than its own colour, none is black. */
static void no_direction_burns_out(void **state)
{
    (void)state;
    struct reading *reading = read_rest("");
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    double most = 0, least = 9;
    for (int i = 0; i < 10000; i++) {
        double z = 1 - (i + 0.5) / 5000, r = sqrt(1 - z * z), turn = i * 2.399963229728653; /* the golden angle */
        double normal[3] = {r * cos(turn), r * sin(turn), z}, sum = (double)scene->ambient.x;
        for (uint32_t l = 0; l < scene->light_count; l++) {
            zr_vec3 d = scene->lights[l].direction;
            double facing = 0 - ((double)d.x * normal[0] + (double)d.y * normal[1] + (double)d.z * normal[2]);
            if (facing > 0) sum += facing * (double)scene->lights[l].color.x;
            assert_true(scene->lights[l].camera_frame);
            assert_true(fabsf(zr_vec3_dot(d, d) - 1.0f) < 1e-6f);
        }
        if (sum > most) most = sum;
        if (sum < least) least = sum;
    }
    print_message("of all directions: %.3f to %.3f\n", least, most);
    assert_true(least >= 0.33 && most < 1);
    reading_free(reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_faces_of_a_cube_differ_in_ten_views),
        cmocka_unit_test(every_preset_shows_faces_that_differ_and_are_neither_black_nor_burnt),
        cmocka_unit_test(red_looks_red_on_every_face),
        cmocka_unit_test(a_bare_mesh_gets_the_same_light_by_the_textbook),
        cmocka_unit_test(no_direction_burns_out),
    };
    return cmocka_run_group_tests_name("default light", tests, NULL, NULL);
}
