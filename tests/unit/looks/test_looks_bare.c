/* Looks of bare meshes. */
#include "base/team.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/looks_check.h"

#define MESH "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n"

static struct reading *read_mesh(struct zr_request request)
{
    request.format = ZR_FORMAT_OBJ;
    struct reading *reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), (size_t)1 << 24);
    assert_read(reading);
    return reading;
}

TEST(bare_meshes_have_the_look_studio)
{
    const struct zr_look *studio = zr_look_find("studio");
    struct reading *reading = read_mesh((struct zr_request){.look = NULL});
    const struct zr_scene *scene = reading->scene;
    assert_ptr_equal(scene->look, studio);
    assert_true(is_same_picture(scene->picture, studio->picture));
    assert_ptr_equal(scene->lights, studio->lights);
    assert_true(scene->views[0].width == 640 && scene->views[0].height == 480);
    assert_true(scene->views[0].azimuth_degrees == 35 && scene->views[0].elevation_degrees == 28);
    assert_true(scene->views[0].yfov_radians == studio->view.fov_radians && scene->views[0].fit_padding == 0.05f);
    assert_int_equal(scene->views[0].pose, ZR_POSE_ORBIT);
    assert_true(zr_vec4_equal(scene->materials[0].base_color, studio->material.base_color));
    assert_true(scene->materials[0].double_sided && scene->materials[0].shading == ZR_SHADING_PBR);
    reading_free(reading);
}

TEST(every_look_dresses_a_bare_mesh)
{
    for (int i = 0; i < zr_look_count; i++) {
        char pinned[64];
        snprintf(pinned, sizeof pinned, "%s@%u", zr_looks[i].name, zr_looks[i].version);
        struct reading *reading = read_mesh((struct zr_request){.look = pinned});
        assert_ptr_equal(reading->scene->look, &zr_looks[i]);
        assert_true(is_same_picture(reading->scene->picture, zr_looks[i].picture));
        assert_true(zr_vec4_equal(reading->scene->background, zr_looks[i].background));
        assert_int_equal(reading->scene->views[0].pose, zr_looks[i].view.pose);
        reading_free(reading);
    }
}

TEST(every_parameter_goes_before_the_look)
{
    struct reading *reading = read_mesh((struct zr_request){.samples = "64",
                                                            .preset = "top",
                                                            .projection = "orthographic",
                                                            .shading = "phong",
                                                            .color = "red",
                                                            .background = "transparent"});
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->picture->side, 8);
    assert_true(scene->views[0].pose == ZR_POSE_PRESET && scene->views[0].preset == ZR_PRESET_TOP);
    assert_true(scene->views[0].projection == ZR_PROJECTION_ORTHOGRAPHIC && scene->views[0].yfov_radians == 0);
    assert_true(scene->materials[0].shading == ZR_SHADING_PHONG && scene->materials[0].base_color.y == 0);
    assert_true(scene->background.w == 0 && !scene->picture->has_gradient && scene->picture->has_ground);
    assert_true(scene->picture->is_linear);
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
    assert_true(reading->scene->picture->is_linear && reading->scene->light_count == 2);
    reading_free(reading);
}

TEST(samples_of_a_query_fit_the_window)
{
    struct reading *reading = read_mesh((struct zr_request){.width = "8192", .height = "8"});
    assert_int_equal(reading->scene->picture->side, 2);
    assert_int_equal(reading->scene->warning_count, 1);
    reading_free(reading);
    const struct zr_request request = {.format = ZR_FORMAT_OBJ, .width = "8192", .height = "8", .samples = "16"};
    reading = read_request(request, MESH, strlen(MESH), zr_limits_default(), (size_t)1 << 24);
    assert_complaint(reading, ZR_BAD_SCENE, "", "parameter samples: 16 samples per pixel are 4 x 4; up to 4");
    reading_free(reading);
}

TEST(z_is_up_in_stl_unless_told_otherwise)
{
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
        assert_false(reading->scene->picture->z_is_up); /* the world's y is up: the mesh is turned */
        reading_free(reading);
    }
}

/* ---- eye-dome lighting ---- */

enum { SIDE = 40, STEP = 12, WIDTH = 160, HEIGHT = 120 };

/* Draws a plane of points with a higher square in its middle, seen from the front. */
static const uint8_t *draw_step(struct reading **reading, struct zr_team *team, const char *occlusion)
{
    char text[SIDE * SIDE * 16], *at = text;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            at += sprintf(at, "v %d %d %d\n", x, y, abs(2 * x - SIDE) < STEP && abs(2 * y - SIDE) < STEP ? 4 : 0);
    const struct zr_request request = {.format = ZR_FORMAT_OBJ,
                                       .width = "160",
                                       .height = "120",
                                       .preset = "front",
                                       .projection = "orthographic",
                                       .groundShadow = "false",
                                       .channel = "color",
                                       .occlusion = occlusion};
    *reading = read_request(request, text, (size_t)(at - text), zr_limits_default(), (size_t)1 << 28);
    assert_read(*reading);
    return (const uint8_t *)scene_render(&(*reading)->arena, team, (*reading)->scene)->color;
}

/* Points beside a nearer square are darker than without the lighting; the rest are equal. */
TEST(clouds_have_eye_dome_lighting)
{
    struct reading *lit, *flat, *by_team;
    struct zr_team *team = zr_team_create(3);
    const uint8_t *color = draw_step(&lit, NULL, NULL), *without = draw_step(&flat, NULL, "false");
    const uint8_t *same = draw_step(&by_team, team, NULL);
    int equal = 0, darker = 0, brighter = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int green = color[4 * i + 1], before = without[4 * i + 1];
        equal += green == before;
        darker += green * 4 < before * 3;
        brighter += green > before;
    }
    assert_true(equal > WIDTH * HEIGHT * 3 / 4);
    assert_in_range(darker, 40, WIDTH * HEIGHT / 20);
    assert_int_equal(brighter, 0);
    assert_memory_equal(same, color, (size_t)4 * WIDTH * HEIGHT);
    zr_team_destroy(team);
    reading_free(lit);
    reading_free(flat);
    reading_free(by_team);
}

RUN_TESTS(NULL, NULL)
