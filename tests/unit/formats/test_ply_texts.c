/* Reads PLY as text: lines, colours and normals, strips, edges and points; bounds. Warnings: tests/refusals/ply-texts.txt. */
#include "support/tests.h"
#include "unit/common/same_scene.h"
#include "unit/common/texts.h"

#define XYZ       "property float x\nproperty float y\nproperty float z\n"
#define VERTEX    "element vertex 4\n" XYZ
#define FACE      "element face 1\nproperty list uchar int vertex_indices\n"
#define ASCII     "ply\nformat ascii 1.0\n"
#define POSITIONS "0 0 0\n9 0 1\n9 8 2\n0 8 3\n"
#define MESH      ASCII VERTEX FACE "end_header\n" POSITIONS "4 0 1 2 3\n"

static struct reading *read_good(const char *text)
{
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_PLY}, text, strlen(text), zr_limits_default(), 1 << 28);
    assert_read(reading);
    return reading;
}

TEST(line_ends_of_every_kind_are_the_same_file)
{
    static const char *const ends[] = {"\r", "\r\n", " \t\r\n", "\n"};
    struct reading *wanted = read_good(MESH);
    assert_int_equal(wanted->scene->warning_count, 0);
    for (size_t e = 0; e < 4; e++) {
        struct text text = {0};
        for (const char *at = MESH; *at; at++)
            put(&text, *at == '\n' ? ends[e] : at, *at == '\n' ? strlen(ends[e]) : 1);
        struct reading *reading = read_good(text.bytes);
        assert_same_scene(reading->scene, wanted->scene);
        reading_free(reading);
        drop(&text);
    }
    reading_free(wanted);
}

TEST(mesh_equals_that_of_obj)
{
    static const char obj[] = "v 0 0 0 1 0 0.2\nv 9 0 1 0 1 0\nv 9 8 2 0 0 1\nv 0 8 3 1 1 1\nf 1 2 3 4\nf 1 2 3\n";
    struct reading *wanted = read_text(ZR_FORMAT_OBJ, obj);
    struct reading *reading =
        read_good(ASCII VERTEX "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
                               "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 51\n9 0 1 0 255 0\n"
                               "9 8 2 0 0 255\n0 8 3 255 255 255\n4 0 1 2 3\n3 0 1 2\n");
    assert_same_scene(reading->scene, wanted->scene);
    assert_int_equal(reading->scene->materials[0].alpha_mode, ZR_ALPHA_OPAQUE);
    reading_free(reading);
    reading_free(wanted);
}

/* ---- properties of vertices ---- */

TEST(colours_of_every_kind_are_0_to_1)
{
    static const struct {
        const char *type, *names, *values;
        float red, alpha;
        size_t warnings;
    } cases[] = {
        {"uchar", "red green blue alpha", "51 0 255 102", 0.2f, 0.4f, 0},
        {"uchar", "diffuse_red diffuse_green diffuse_blue alpha", "51 0 255 102", 0.2f, 0.4f, 0},
        {"uchar", "r g b a", "51 0 255 102", 0.2f, 0.4f, 0},
        {"uchar", "blue green red", "0 0 51", 0.2f, 1, 0},
        {"ushort", "red green blue alpha", "13107 0 65535 26214", 0.2f, 0.4f, 0},
        {"int", "red green blue", "51 0 255", 0.2f, 1, 0},
        {"float", "red green blue alpha", "0.2 0 1 0.4", 0.2f, 0.4f, 0},
        {"double", "red green blue", "0.2 0 1.00001", 0.2f, 1, 1},
        {"float", "red green blue", "51 0 255", 0.2f, 1, 1},
        {"float", "red green blue", "-1 0 nan", 0, 1, 1},
        {"short", "red green blue", "300 0 0", 1, 1, 1},
        {"uchar", "red green blue alpha", "51 0 0 0", 0.2f, 1, 1},
        {"uchar", "red green alpha", "51 0 102", 1, 1, 0}, /* no colour */
        {"uchar", "r", "51", 1, 1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct text text = {0};
        char names[64], *rest = names, *name;
        snprintf(names, sizeof names, "%s", cases[i].names);
        add(&text, ASCII "element vertex 1\n" XYZ);
        while ((name = strsep(&rest, " ")))
            add(&text, "property %s %s\n", cases[i].type, name);
        add(&text, "end_header\n1 2 3 %s\n", cases[i].values);
        struct reading *reading = read_good(text.bytes);
        drop(&text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        const zr_vec4 color = mesh->colors ? mesh->colors[0] : (zr_vec4){1, 1, 1, 1};
        if (color.x != cases[i].red || color.w != cases[i].alpha)
            fail_msg("case %zu: red %g, alpha %g", i, (double)color.x, (double)color.w);
        assert_int_equal(reading->scene->warning_count, cases[i].warnings);
        assert_int_equal(reading->scene->materials[0].alpha_mode,
                         cases[i].alpha < 1.0f ? ZR_ALPHA_BLEND : ZR_ALPHA_OPAQUE);
        reading_free(reading);
    }
}

TEST(normals_and_texture_coordinates_are_read)
{
    static const char *const names[][2] = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}};
    for (size_t i = 0; i < 3; i++) {
        struct text text = {0};
        add(&text,
            ASCII "element vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n" XYZ
                  "property float %s\nproperty float %s\n" FACE "end_header\n",
            names[i][0], names[i][1]);
        add(&text, "0 0 1 0 0 0 0.5 0.25\n0 2 0 1 0 0 1 0\nnan 0 0 0 1 0 0 1\n3 0 1 2\n");
        struct reading *reading = read_good(text.bytes);
        drop(&text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->normal_count, 3);
        assert_true(mesh->normals[1].y == 2.0f && zr_normal_is_zero(mesh->normals[2]));
        assert_true(mesh->texcoords[0].x == 0.5f && mesh->texcoords[0].y == 0.25f && mesh->texcoords[2].y == 1.0f);
        reading_free(reading);
    }
}

/* ---- strips, edges, points ---- */

TEST(strips_are_triangles_of_alternating_order)
{
    static const uint32_t wanted[] = {0, 1, 2, 2, 1, 3, 3, 2, 1, 0, 1, 3};
    struct reading *reading = read_good(ASCII VERTEX "element tristrips 2\nproperty list int int vertex_indices\n"
                                                     "end_header\n" POSITIONS "9 0 1 2 3 -1 3 2 1 1\n5 -1 0 1 3 -1\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->face_count, 4);
    assert_memory_equal(mesh->indices, wanted, sizeof wanted);
    assert_int_equal(mesh->face_offsets[4], 12);
    reading_free(reading);
}

TEST(edges_are_lines)
{
    struct reading *reading = read_good(ASCII VERTEX "element edge 2\nproperty uchar red\nproperty int vertex2\n"
                                                     "property int vertex1\nend_header\n" POSITIONS "1 3 0\n1 2 1\n");
    static const uint32_t wanted[] = {0, 3, 1, 2};
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->line_count, 2);
    assert_memory_equal(mesh->lines, wanted, sizeof wanted);
    assert_int_equal(mesh->point_count + mesh->face_count, 0);
    reading_free(reading);
}

TEST(finite_vertices_without_faces_are_points)
{
    struct reading *reading =
        read_good(ASCII VERTEX "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0\nnan 0 1\n9 -inf 2\n0 8 3\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->point_count, 2);
    assert_int_equal(mesh->points[1], 3);
    assert_int_equal(reading->scene->warning_count, 1);
    assert_non_null(
        strstr(reading->scene->warnings[0], "2 vertices are not finite and are left out; the first is vertex 1"));
    reading_free(reading);
}

/* ---- bounds ---- */

TEST(counts_beyond_the_bytes_are_refused_before_allocating)
{
    static const char *const texts[] = {
        ASCII "element vertex 1000000000\n" XYZ "end_header\n1 2 3\n",
        "ply\nformat binary_big_endian 1.0\nelement face 999999999\nproperty list uchar int vertex_indices\n"
        "element vertex 18446744073709551616\n" XYZ "end_header\n123",
        ASCII "element other 18446744073709551615\nproperty list uchar uchar a\nelement vertex 1\n" XYZ
              "end_header\n1 2 3\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct reading *reading = read_text(ZR_FORMAT_PLY, texts[i]);
        assert_true(reading->status == ZR_BAD_SYNTAX || reading->status == ZR_BAD_SCENE);
        assert_true(reading->arena.used < 8192);
        reading_free(reading);
    }
}

TEST(elements_without_properties_take_no_time)
{
    struct reading *reading = read_good(ASCII "element nothing 18446744073709551615\n" VERTEX "end_header\n" POSITIONS);
    assert_int_equal(reading->scene->meshes[0].point_count, 4);
    reading_free(reading);
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_PLY}, MESH, strlen(MESH), 1 << 16) > 512);
}

RUN_TESTS(NULL, NULL)
