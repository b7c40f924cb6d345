/* Bare meshes: the axis that points up, and the view of flat meshes. */
#include "unit/common/looks_check.h"

#include "support/tests.h"

#define BOX(x, y, z)                                                                                                   \
    "v 0 0 0\nv " #x " 0 0\nv 0 " #y " 0\nv " #x " " #y " 0\nv 0 0 " #z "\nv " #x " 0 " #z "\nv 0 " #y " " #z          \
    "\nv " #x " " #y " " #z "\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"

/* Tents over a rectangle with the sides 4 and 3, with a ridge of length 3. No other side is flat. */
#define TENT_ON_Z    "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv .5 1.5 2\nv 3.5 1.5 2\n" TENT
#define TENT_ON_Y    "v 0 0 0\nv 0 0 4\nv 3 0 4\nv 3 0 0\nv 1.5 2 .5\nv 1.5 2 3.5\n" TENT
#define TENT_ON_X    "v 0 0 0\nv 0 4 0\nv 0 4 3\nv 0 0 3\nv 2 .5 1.5\nv 2 3.5 1.5\n" TENT
#define TENT_BELOW_Z "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv .5 1.5 -2\nv 3.5 1.5 -2\n" TENT
#define TENT         "f 4 3 2 1\nf 1 2 6 5\nf 2 3 6\nf 3 4 5 6\nf 4 1 5\n"

/* A small flat foot: a twelfth of the side of the box. */
#define FOOT_ON_Z "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 4 3 2\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"

static struct reading *read_mesh(struct zr_request request, const char *text)
{
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 24);
    assert_read(reading);
    return reading;
}

static bool is_vec(zr_vec4 v, float x, float y, float z)
{
    return v.x == x && v.y == y && v.z == z;
}

TEST(each_axis_can_point_up)
{
    static const struct {
        const char *up;
        zr_vec4 axis, front; /* in the mesh: they become y and z */
    } cases[] = {{"x", {1, 0, 0, 0}, {0, 0, 1, 0}},  {"-x", {-1, 0, 0, 0}, {0, 0, 1, 0}},
                 {"y", {0, 1, 0, 0}, {0, 0, 1, 0}},  {"-y", {0, -1, 0, 0}, {0, 0, 1, 0}},
                 {"z", {0, 0, 1, 0}, {0, -1, 0, 0}}, {"-z", {0, 0, -1, 0}, {0, -1, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_OBJ, .up = cases[i].up};
        struct reading *reading = read_mesh(request, TENT_ON_Y);
        const zr_mat4 *turn = &reading->scene->instances[0].object_to_world;
        const zr_vec4 x = zr_mat4_apply(turn, (zr_vec4){1, 0, 0, 0}), y = zr_mat4_apply(turn, (zr_vec4){0, 1, 0, 0}),
                      z = zr_mat4_apply(turn, (zr_vec4){0, 0, 1, 0});
        assert_true(is_vec(zr_mat4_apply(turn, cases[i].axis), 0, 1, 0));
        assert_true(is_vec(zr_mat4_apply(turn, cases[i].front), 0, 0, 1));
        assert_true(is_vec(z, x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x)); /* no mirror */
        reading_free(reading);
    }
}

TEST(auto_takes_the_axis_of_the_flat_end)
{
    static const struct {
        const char *text;
        zr_vec4 axis; /* becomes y */
    } cases[] = {{TENT_ON_X, {1, 0, 0, 0}},
                 {TENT_ON_Y, {0, 1, 0, 0}},
                 {TENT_ON_Z, {0, 0, 1, 0}},
                 {TENT_BELOW_Z, {0, 0, 1, 0}}, /* never upside down */
                 {BOX(1, 5, 2), {0, 1, 0, 0}}, /* all ends are alike: the format's axis */
                 {FOOT_ON_Z, {0, 1, 0, 0}},
                 {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {0, 0, 1, 0}},
                 {"v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", {0, 1, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_OBJ, .up = "auto"};
        struct reading *reading = read_mesh(request, cases[i].text);
        assert_true(is_vec(zr_mat4_apply(&reading->scene->instances[0].object_to_world, cases[i].axis), 0, 1, 0));
        reading_free(reading);
    }
}

/* A relief: its back is one face on the negative side, its front has four. */
#define RELIEF_OF(corners) corners "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"
#define RELIEF             RELIEF_OF("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 2 2 .1\n")
#define RELIEF_BELOW       RELIEF_OF("v 0 4 0\nv 4 4 0\nv 4 0 0\nv 0 0 0\nv 2 2 -.1\n")
#define SHEET              "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

TEST(flat_meshes_are_seen_face_on)
{
    enum { NOT = -1 };
    static const struct {
        const char *text, *up;
        int preset;
    } cases[] = {{BOX(1, 0.039, 1), NULL, ZR_PRESET_TOP},
                 {BOX(1, 0.041, 1), NULL, NOT},
                 {BOX(0.1, 4, 4), NULL, ZR_PRESET_RIGHT},
                 {BOX(4, 4, 0.1), NULL, ZR_PRESET_FRONT},
                 {BOX(4, 4, 0.1), "z", ZR_PRESET_TOP},
                 {BOX(4, 4, 0.1), "-z", ZR_PRESET_TOP},
                 {BOX(100, 1, 1), NULL, NOT}, /* a stick */
                 {RELIEF, NULL, ZR_PRESET_FRONT},
                 {RELIEF, "-z", ZR_PRESET_BOTTOM},
                 {RELIEF, "-y", ZR_PRESET_FRONT},
                 {RELIEF_BELOW, NULL, ZR_PRESET_BACK},
                 {RELIEF_BELOW, "z", ZR_PRESET_BOTTOM},
                 {RELIEF_BELOW, "x", ZR_PRESET_BACK},
                 {SHEET "f 1 2 3\n", NULL, ZR_PRESET_FRONT},
                 {SHEET "f 1 3 2\n", NULL, ZR_PRESET_BACK},
                 {SHEET "f 1 2 3\n", "auto", ZR_PRESET_TOP},
                 {SHEET "v 0 0 9\nf 1 2 3\n", NULL, ZR_PRESET_FRONT}, /* a position that no face uses */
                 {TENT_ON_Y, NULL, NOT}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_OBJ, .up = cases[i].up};
        struct reading *reading = read_mesh(request, cases[i].text);
        const struct zr_view *view = &reading->scene->views[0];
        if ((view->pose == ZR_POSE_PRESET ? (int)view->preset : NOT) != cases[i].preset)
            fail_msg("case %zu: pose %d, preset %d", i, (int)view->pose, (int)view->preset);
        assert_int_equal(view->projection, ZR_PROJECTION_PERSPECTIVE);
        assert_true(view->fit_padding == 0.05f);
        reading_free(reading);
    }
}

TEST(a_view_of_the_query_overrides_it)
{
    static const struct zr_request requests[] = {{.preset = "isometric"}, {.azimuth = "35"}, {.elevation = "28"}};
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        struct zr_request request = requests[i];
        request.format = ZR_FORMAT_OBJ;
        struct reading *reading = read_mesh(request, RELIEF);
        const struct zr_view *view = &reading->scene->views[0];
        assert_int_equal(view->pose, i == 0 ? ZR_POSE_PRESET : ZR_POSE_ORBIT);
        assert_true(i == 0 ? view->preset == ZR_PRESET_ISOMETRIC : view->azimuth_degrees == 35);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
