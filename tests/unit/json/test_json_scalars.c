/* Meshes whose numbers become colours. */
#include "unit/common/json_check.h"

#include "scene/colormap.h"
#include "support/tests.h"

#define SQUARE "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], \"faces\": [[0,1,2],[0,2,3]]"

static const char *with_mesh(const char *mesh)
{
    static char text[8192];
    snprintf(text, sizeof text, "{\"meshes\": [{%s}]}", mesh);
    return text;
}

static struct reading *read_mesh(const char *mesh)
{
    return read_scene(with_mesh(mesh));
}

static void assert_colors(const zr_vec4 *colors, enum zr_colormap map, const float *at, size_t count)
{
    assert_non_null(colors);
    for (size_t i = 0; i < count; i++) {
        const zr_vec4 want = zr_colormap_color(map, at[i]);
        if (!zr_vec4_equal(colors[i], want))
            fail_msg("colour %zu is %g %g %g", i, (double)colors[i].x, (double)colors[i].y, (double)colors[i].z);
    }
}

TEST(numbers_of_positions_become_colors_of_vertices)
{
    struct reading *reading = read_mesh(SQUARE ", \"scalars\": [-10, 0, 30, 10]");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_colors(mesh->colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.25f, 1, 0.5f}, 4);
    assert_null(mesh->face_colors);
    const struct zr_material *material = &reading->scene->materials[mesh->material];
    assert_int_equal(material->shading, ZR_SHADING_GOURAUD); /* as with all colours of vertices */
    assert_true(material->base_color.x == 1 && material->base_color.y == 1 && material->base_color.z == 1);
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
}

TEST(numbers_of_faces_become_colors_of_faces)
{
    struct reading *reading = read_mesh(SQUARE ", \"scalars\": [1e30, -1e30], \"colormap\": \"turbo\"");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_colors(mesh->face_colors, ZR_COLORMAP_TURBO, (float[]){1, 0}, 2);
    assert_null(mesh->colors);
    assert_int_equal(reading->scene->materials[mesh->material].shading, ZR_SHADING_FLAT);
    reading_free(reading);
}

TEST(default_range_is_that_of_what_is_drawn)
{
    static const char *const meshes[] = {
        "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[9,9,9]], \"faces\": [[0,1,2]], \"scalars\": [1, 2, 3, 900]",
        "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[9,9,9]], \"faces\": [[0,1,2],[0,3,3]], \"scalars\": [1, 2, 3, -9]",
        "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[9,9,9]], \"lines\": [[0,1],[3,3]], \"points\": [2], \"scalars\": "
        "[1, 2, 3, -9]",
        SQUARE ", \"scalars\": [1, 3, 2, 2], \"colormap\": \"viridis\"",
        "\"positions\": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,1,0]], \"faces\": [[0,1,2],[0,2,3],[3,4,0]], \"scalars\": "
        "[1, 3, 900]",
        /* The last column is beside a hole, so none of its cells is drawn. */
        "\"heights\": {\"values\": [[1, 2, null, 900], [3, 2, null, -9]]}, \"colormap\": \"viridis\"",
        "\"heights\": {\"values\": [[7, 7, null, 7], [7, 7, null, 7]]}, \"scalars\": [1, 2, 5, 900, 3, 2, 5, -9]",
        "\"heights\": {\"values\": [[7, 7, 7, null], [7, 7, 7, 7]]}, \"scalars\": [1, 3, 900]",
    };
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        struct reading *reading = read_mesh(meshes[i]);
        assert_read(reading);
        const struct zr_color_scale *scale = reading->scene->meshes[0].scale;
        assert_non_null(scale);
        if (scale->low != 1.0f || scale->high != 3.0f)
            fail_msg("case %zu: %g to %g", i, (double)scale->low, (double)scale->high);
        reading_free(reading);
    }
}

TEST(where_there_are_as_many_they_are_of_positions)
{
    struct reading *reading = read_mesh("\"positions\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], \"faces\": "
                                        "[[0,1,2],[0,1,3],[0,2,3],[1,2,3]], \"scalars\": [0,1,2,4]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.25f, 0.5f, 1}, 4);
    assert_null(reading->scene->meshes[0].face_colors);
    reading_free(reading);
}

TEST(each_map_has_its_name)
{
    static const char *const names[] = {"viridis", "turbo", "gray", "coolwarm"};
    for (int map = 0; map < ZR_COLORMAP_COUNT; map++) {
        char text[512];
        snprintf(text, sizeof text, SQUARE ", \"colormap\": \"%s\", \"scalars\": [0,1,2,4]", names[map]);
        struct reading *reading = read_mesh(text);
        assert_colors(reading->scene->meshes[0].colors, (enum zr_colormap)map, (float[]){0, 0.25f, 0.5f, 1}, 4);
        reading_free(reading);
    }
}

TEST(what_is_outside_of_the_range_is_counted)
{
    struct reading *reading = read_mesh(SQUARE ", \"scalars\": [-1, 0, 1.5, 3], \"range\": [0, 2]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0, 0.75f, 1}, 4);
    assert_int_equal(reading->scene->warning_count, 1);
    assert_string_equal(reading->scene->warnings[0], "mesh 0: 2 of 4 scalars are outside of the range from 0 to 2 and "
                                                     "have the colours of its ends");
    reading_free(reading);
    reading = read_mesh(SQUARE ", \"scalars\": [0, 0, 1.5, 2], \"range\": [0, 2]");
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
}

/* Neither below nor above: the middle. */
TEST(ranges_of_no_length_have_a_middle)
{
    struct reading *reading = read_mesh(SQUARE ", \"scalars\": [7, 7, 7, 7]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0.5f, 0.5f, 0.5f, 0.5f}, 4);
    assert_int_equal(reading->scene->warning_count, 0);
    reading_free(reading);
    reading = read_mesh(SQUARE ", \"scalars\": [6, 7, 8, 7], \"range\": [7, 7]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.5f, 1, 0.5f}, 4);
    assert_int_equal(reading->scene->warning_count, 1);
    reading_free(reading);
}

TEST(ranges_may_be_as_long_as_floats_are)
{
    struct reading *reading = read_mesh(SQUARE ", \"scalars\": [-3.4e38, 0, 3.4e38, 1]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.5f, 1, 0.5f}, 4);
    reading_free(reading);
}

TEST(heights_have_the_colors_of_their_z_where_a_map_is_named)
{
    struct reading *reading = read_mesh("\"heights\": [[0,1],[2,4]], \"colormap\": \"coolwarm\"");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_COOLWARM, (float[]){0, 0.25f, 0.5f, 1}, 4);
    reading_free(reading);
    reading = read_mesh("\"heights\": [[0,1],[2,4]]");
    assert_null(reading->scene->meshes[0].colors);
    reading_free(reading);
    reading = read_mesh("\"heights\": [[0,1],[2,4]], \"scalars\": [0,0,0,9]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0, 0, 1}, 4);
    reading_free(reading);
    reading = read_mesh("\"heights\": [[0,1,0],[2,4,0]], \"scalars\": [5,6]");
    assert_colors(reading->scene->meshes[0].face_colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 1}, 2);
    reading_free(reading);
    reading = read_mesh("\"heights\": [[0,1],[2,4]], \"colormap\": \"gray\", \"range\": [0, 8]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_GRAY, (float[]){0, 0.125f, 0.25f, 0.5f}, 4);
    reading_free(reading);
}

/* Holes have no z, and go with their cells. */
TEST(holes_have_no_share_in_the_range)
{
    struct reading *reading = read_mesh("\"heights\": [[null,1,2],[3,5,2]], \"colormap\": \"turbo\"");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->position_count, 4);
    assert_colors(mesh->colors, ZR_COLORMAP_TURBO, (float[]){0, 0.25f, 1, 0.25f}, 4);
    reading_free(reading);
    reading = read_mesh("\"heights\": [[0,1,null],[1,3,5],[1,1,1]], \"scalars\": [1,2,99,3,4,5,6,7,9]");
    mesh = &reading->scene->meshes[0];
    assert_true(mesh->scale->low == 1 && mesh->scale->high == 9);
    assert_colors(mesh->colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.125f}, 2);
    reading_free(reading);
}

/* Numbers in forms that the quick reader does not take, and blanks. */
TEST(numbers_may_have_any_form)
{
    struct reading *reading = read_mesh(
        SQUARE ", \"scalars\": [ 0.0000000000000000000000000000000000000000000000 ,\n1.00000000000000000000000000000,"
               "\t2e+0 , 0.4E1 ]");
    assert_colors(reading->scene->meshes[0].colors, ZR_COLORMAP_VIRIDIS, (float[]){0, 0.25f, 0.5f, 1}, 4);
    reading_free(reading);
}

TEST(every_ceiling_is_enough_or_fails_cleanly)
{
    const char *text = with_mesh(SQUARE ", \"scalars\": [1,2,3,4], \"range\": [2,3]");
    const size_t enough =
        smallest_ceiling((struct zr_request){.format = ZR_FORMAT_JSON}, text, strlen(text), (size_t)1 << 20);
    assert_true(enough > 0);
}

RUN_TESTS(NULL, NULL)
