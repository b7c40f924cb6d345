/* Face styles, lines and holes: what a scene says of how its faces are drawn. */
#include "unit/common/json_check.h"

#include "base/run.h"
#include "shade/frame.h"
#include "support/tests.h"

#define QUAD "\"vertices\": [[0,0,0],[9,0,0],[9,9,0],[0,9,0]]"
#define HOLE "[[1,1,0],[2,1,0],[2,2,0]]"

static const struct zr_material *material_of_first_face(const struct reading *reading)
{
    return &reading->scene->materials[reading->scene->meshes[0].face_materials[0]];
}

TEST(outline_alone_is_black_on_faces_and_their_own_colour_without)
{
    struct reading *reading = read_scene("{\"polygons\": [{" TRIANGLE ", \"outline\": true}]}");
    const struct zr_material *material = material_of_first_face(reading);
    assert_int_equal(material->outline, ZR_OUTLINE_COLORED);
    assert_true(material->outline_color.x == 0 && material->outline_color.w == 1 && !material->unfilled);
    reading_free(reading);
    reading = read_scene("{\"polygons\": [{" TRIANGLE ", \"outline\": true, \"fill\": false}]}");
    material = material_of_first_face(reading);
    assert_int_equal(material->outline, ZR_OUTLINE_OWN);
    assert_true(material->unfilled);
    reading_free(reading);
}

TEST(outline_may_be_a_colour)
{
    struct reading *reading = read_scene("{\"polygons\": [{" TRIANGLE ", \"outline\": \"#ff0000\"},"
                                         "{" TRIANGLE ", \"outline\": [0, 1, 0], \"fill\": false},"
                                         "{" TRIANGLE ", \"outline\": [0, 1, 0], \"fill\": false}]}");
    assert_read(reading);
    const uint32_t *numbers = reading->scene->meshes[0].face_materials;
    const struct zr_material *materials = reading->scene->materials;
    assert_true(materials[numbers[0]].outline_color.x == 1 && !materials[numbers[0]].unfilled);
    assert_true(materials[numbers[1]].outline_color.y == 1 && materials[numbers[1]].unfilled);
    assert_int_equal(materials[numbers[1]].outline, ZR_OUTLINE_COLORED);
    assert_int_equal(numbers[1], numbers[2]);
    reading_free(reading);
}

TEST(nearest_word_on_faces_counts)
{
    struct reading *reading =
        read_scene("{\"outline\": \"#0000ff\", \"fill\": false, \"shading\": \"unlit\","
                   "\"materials\": [{\"name\": \"m\", \"outline\": false, \"doubleSided\": true}],"
                   "\"polygons\": [{" TRIANGLE "}, {" TRIANGLE ", \"material\": \"m\"},"
                   "{" TRIANGLE ", \"material\": \"m\", \"outline\": true, \"fill\": true, \"doubleSided\": false}]}");
    assert_read(reading);
    const uint32_t *numbers = reading->scene->meshes[0].face_materials;
    const struct zr_material *scene_wide = &reading->scene->materials[numbers[0]],
                             *by_material = &reading->scene->materials[numbers[1]],
                             *by_polygon = &reading->scene->materials[numbers[2]];
    assert_true(scene_wide->outline == ZR_OUTLINE_COLORED && scene_wide->outline_color.z == 1 && scene_wide->unfilled);
    assert_true(by_material->outline == ZR_OUTLINE_NONE && by_material->unfilled && by_material->double_sided);
    assert_true(by_polygon->outline == ZR_OUTLINE_COLORED && by_polygon->outline_color.z == 0);
    assert_true(!by_polygon->unfilled && !by_polygon->double_sided && by_polygon->shading == ZR_SHADING_UNLIT);
    reading_free(reading);
}

TEST(lines_are_pairs_of_positions)
{
    struct reading *reading = read_scene("{\"meshes\": [{" POSITIONS ", \"lines\": [[0,1],[3,2]]}]}");
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t lines[4] = {0, 1, 3, 2};
    assert_int_equal(mesh->face_count, 0);
    assert_int_equal(mesh->face_offsets[0], 0);
    assert_int_equal(mesh->line_count, 2);
    assert_memory_equal(mesh->lines, lines, sizeof lines);
    reading_free(reading);
}

TEST(holes_become_rings_of_the_face)
{
    struct reading *reading = read_scene("{\"polygons\": [{" TRIANGLE "}, {" QUAD ", \"holes\": [" HOLE ", " HOLE "]},"
                                         "{" TRIANGLE "}]}");
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t faces[4] = {0, 3, 13, 16}, face_rings[4] = {0, 1, 4, 5}, rings[6] = {0, 3, 7, 10, 13, 16};
    assert_memory_equal(mesh->face_offsets, faces, sizeof faces);
    assert_memory_equal(mesh->face_rings, face_rings, sizeof face_rings);
    assert_memory_equal(mesh->ring_offsets, rings, sizeof rings);
    assert_true(mesh->positions[8].x == 2 && mesh->positions[8].y == 1);
    reading_free(reading);
}

TEST(colours_of_a_polygon_with_holes_count_all_its_vertices)
{
    struct reading *reading = read_scene("{\"polygons\": [{" TRIANGLE ", \"holes\": [" HOLE "], \"colors\":"
                                         "[[1,0,0],[1,0,0],[1,0,0],[0,1,0],[0,1,0],[0,0,1]]}]}");
    assert_read(reading);
    assert_true(reading->scene->meshes[0].colors[5].z == 1);
    reading_free(reading);
}

TEST(bad_holes_are_refused_with_pointer_to_them)
{
    struct zr_limits limits = zr_limits_default();
    limits.polygon_vertices_max = 6;
    static const char text[] = "{\"polygons\": [{" QUAD ", \"holes\": [" HOLE "]}]}";
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text, sizeof text - 1, limits, (size_t)1 << 20);
    assert_complaint(reading, ZR_BAD_SCENE, "/polygons/0/holes/0", "a polygon of 7 vertices; 3 to 6 are allowed");
    reading_free(reading);
}

/* A grey face, and far from it one with colours: its pixels must be what they are without the other. */
TEST(colours_of_one_polygon_do_not_change_another)
{
    static const char one[] =
        "{\"shading\": \"unlit\", \"window\": {\"width\": 96, \"height\": 70}, \"view\": {\"eye\": "
        "[-0.375,-1,3], \"znear\": 0.1, \"zfar\": 10, \"perspective\": {\"yfovDegrees\": 50}},"
        "\"polygons\": [{\"vertices\": [[0.44804,0.625,0.75],[0.125,1.26,0.75],[-0.23071,0.625,0.75],"
        "[0.125,-0.01,0.75]], \"doubleSided\": true}%s]}";
    static const char *const others[] = {
        "", ", {\"vertices\": [[5,5,-5],[6,5,-5],[5,6,-5]], \"colors\": [\"#ff0000\",\"#ff0000\",\"#ff0000\"]}"};
    uint8_t bytes[2][96 * 70 * 4];
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof text, one, others[i]);
        struct reading *reading = read_scene(text);
        struct zr_error error = {.count = 0};
        const struct zr_frame *frame;
        assert_int_equal(
            zr_render(&(struct zr_run){.arena = &reading->arena, .error = &error}, reading->scene, NULL, &frame),
            ZR_OK);
        memcpy(bytes[i], frame->color, sizeof bytes[i]);
        reading_free(reading);
    }
    assert_memory_equal(bytes[0], bytes[1], sizeof bytes[0]);
}

RUN_TESTS(NULL, NULL)
