/* Colours by x, y or z: in the world, of bare meshes in their file. */
#include <math.h>

#include "scene/colormap.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

#define VIEW                                                                                                           \
    "\"view\": {\"azimuthDegrees\": 0}, \"outputs\": [{\"channel\": \"color\"}], \"window\": {\"width\": 64, "         \
    "\"height\": 64}"
#define MESH                                                                                                           \
    "\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,2,0],[0,0,3]], \"faces\": [[0,2,1],[0,1,3]], \"colors\": "       \
    "[[1,0,0],[1,0,0],[1,0,0],[1,0,0]]"

static struct reading *read_scene(const char *text)
{
    struct reading *reading = read_text(ZR_FORMAT_JSON, text);
    assert_read(reading);
    return reading;
}

static bool is_at(const struct reading *reading, uint32_t instance, uint32_t position, float share)
{
    const struct zr_scene *scene = reading->scene;
    const zr_vec4 wanted = zr_colormap_color(ZR_COLORMAP_VIRIDIS, share),
                  found = scene->meshes[scene->instances[instance].mesh].colors[position];
    return fabsf(wanted.x - found.x) < 1e-5f && fabsf(wanted.y - found.y) < 1e-5f && fabsf(wanted.z - found.z) < 1e-5f;
}

TEST(a_mesh_is_coloured_from_its_least_to_its_greatest_coordinate)
{
    struct reading *reading = read_scene("{\"colors\": \"z\", " VIEW ", " MESH "}]}");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_true(is_at(reading, 0, 0, 0) && is_at(reading, 0, 2, 0) && is_at(reading, 0, 3, 1));
    assert_true(mesh->scale && mesh->scale->low == 0.0f && mesh->scale->high == 3.0f);
    assert_true(reading->scene->materials[mesh->material].base_color.y == 1.0f);
    reading_free(reading);
}

TEST(instances_have_the_colours_of_their_places)
{
    struct reading *reading = read_scene("{\"colors\": \"y\", " VIEW ", " MESH "}], \"nodes\": [{\"mesh\": 0}, "
                                         "{\"mesh\": 0, \"translation\": [9,0,0]}, "
                                         "{\"mesh\": 0, \"translation\": [0,2,0]}]}");
    const struct zr_scene *scene = reading->scene;
    assert_int_equal(scene->instance_count, 3);
    assert_int_equal(scene->instances[1].mesh, scene->instances[0].mesh);
    assert_int_not_equal(scene->instances[2].mesh, scene->instances[0].mesh);
    assert_true(is_at(reading, 0, 0, 0) && is_at(reading, 0, 2, 0.5f));
    assert_true(is_at(reading, 2, 0, 0.5f) && is_at(reading, 2, 2, 1));
    reading_free(reading);
}

TEST(a_flat_coordinate_has_the_middle_of_the_map)
{
    struct reading *reading = read_scene("{\"colors\": \"z\", \"colorBar\": true, " VIEW
                                         ", \"meshes\": [{\"positions\": [[0,0,5],[1,0,5]], \"points\": [0, 1]}]}");
    assert_true(is_at(reading, 0, 0, 0.5f));
    reading_free(reading);
}

TEST(far_clouds_have_the_numbers_of_their_file)
{
    const struct zr_request request = {.format = ZR_FORMAT_XYZ, .look = "textbook", .colors = "x"};
    static const char text[] = "5000000 0 0\n5000001 0 0\n5000002 0 0\n";
    struct reading *reading = read_request(request, text, sizeof text - 1, zr_limits_default(), (size_t)1 << 26);
    assert_read(reading);
    assert_true(is_at(reading, 0, 0, 0) && is_at(reading, 0, 1, 0.5f) && is_at(reading, 0, 2, 1));
    assert_true(reading->scene->meshes[0].scale->low == 5000000.0f);
    assert_true(reading->scene->meshes[0].scale->high == 5000002.0f);
    reading_free(reading);
}

TEST(bare_meshes_are_coloured_by_the_axes_of_their_file)
{
    static const char text[] = "0 5000000 7\n0 5000001 8\n3 5000002 9\n";
    static const struct {
        const char *up, *colors;
        float low, high;
    } cases[] = {{"z", "z", 7, 9},
                 {"z", "y", 5000000, 5000002},
                 {"x", "z", 7, 9},
                 {"y", "z", 7, 9},
                 {"-y", "y", 5000000, 5000002}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_request request = {
            .format = ZR_FORMAT_XYZ, .look = "textbook", .colors = cases[i].colors, .up = cases[i].up};
        struct reading *reading = read_request(request, text, sizeof text - 1, zr_limits_default(), (size_t)1 << 26);
        assert_read(reading);
        assert_true(is_at(reading, 0, 0, 0) && is_at(reading, 0, 1, 0.5f) && is_at(reading, 0, 2, 1));
        assert_true(reading->scene->meshes[0].scale->low == cases[i].low);
        assert_true(reading->scene->meshes[0].scale->high == cases[i].high);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
