/* OFF, PCD and XYZ: positions, colours, normals and faces. Refusals: tests/refusals/off.txt, pcd.txt, xyz.txt. */
#include <math.h>

#include "input/formats/formats.h"
#include "input/points/lzf.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

static struct reading *read_file_bytes(const void *bytes, size_t size)
{
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_UNKNOWN, .look = "textbook"}, bytes,
                                           size, zr_limits_default(), (size_t)1 << 26);
    assert_read(reading);
    return reading;
}

static struct reading *read_file_text(const char *text)
{
    return read_file_bytes(text, strlen(text));
}

static bool is_color(const zr_vec4 *c, float r, float g, float b)
{
    return fabsf(c->x - r) < 1e-6f && fabsf(c->y - g) < 1e-6f && fabsf(c->z - b) < 1e-6f && c->w == 1.0f;
}

/* ---- OFF ---- */

TEST(off_has_polygons_and_colours_of_faces)
{
    struct reading *reading = read_file_text("OFF # a comment\n\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n"
                                             "4 0 1 2 3 255 0 51\n3  0 1 2  # no colour\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->face_count, 2);
    assert_int_equal(mesh->face_offsets[2], 7);
    assert_int_equal(mesh->indices[3], 3);
    assert_true(mesh->positions[3].z == 0.5f);
    assert_true(is_color(&mesh->face_colors[0], 1, 0, 0.2f) && is_color(&mesh->face_colors[1], 1, 1, 1));
    reading_free(reading);
}

/* Programs that read white space alike write one number per line. */
TEST(off_continues_on_the_next_lines)
{
    struct reading *reading = read_file_text("OFF\n4 2 0\n0 0 0\n1\n0\n0\n1 1\n0.25\n0 1 0\n4 0\n1\n2 \n3\n3 0\n1 2\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t indices[] = {0, 1, 2, 3, 0, 1, 2};
    assert_int_equal(mesh->face_count, 2);
    assert_memory_equal(mesh->indices, indices, sizeof indices);
    assert_true(mesh->positions[2].y == 1 && mesh->positions[2].z == 0.25f && mesh->positions[3].y == 1);
    reading_free(reading);
}

TEST(off_has_colours_and_normals_of_vertices)
{
    static const char *const texts[] = {
        "CNOFF3 1\n0 0 0 0 0 2 1 0 0 1\n1 0 0 0 0 1 0 1 0 1\n0 1 0 nan 0 1 0 0 1 1\n3 0 1 2\n",
        ("\xEF\xBB\xBF"
         "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n"),
        "OFF\n3 1 0\n0 0 0 1.0 0 0\n1 0 0 0 1.0 0\n0 1 0 0 0 1.0\n3 0 1 2\n"};
    for (size_t i = 0; i < 3; i++) {
        struct reading *reading = read_file_text(texts[i]);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_true(is_color(&mesh->colors[0], 1, 0, 0) && is_color(&mesh->colors[2], 0, 0, 1));
        assert_int_equal(mesh->normal_count, i == 0 ? 3 : 0);
        reading_free(reading);
    }
}

TEST(off_without_faces_is_a_cloud)
{
    struct reading *reading = read_file_text("OFF\n2 0 0\n0 0 0\n5 0 0\n");
    assert_int_equal(reading->scene->meshes[0].point_count, 2);
    reading_free(reading);
}

/* ---- XYZ ---- */

TEST(xyz_has_colours_or_normals)
{
    static const struct {
        const char *text;
        bool has_colors;
    } cases[] = {{"0 0 0 255 0 0\n1 0 0 0 0 255\n", true},
                 {"0 0 0 1 0 0\n1 0 0 0 1 0\n", false},
                 {"0,0,0,0,0,1,255,0,0\n1,0,0,0,1,0,0,0,255\n", true},
                 {"2\n0 0 0 -1200 255 0 0\n1 0 0 -900 0 0 255\n", true},
                 {"//X Y Z R G B Nx Ny Nz\n0 0 0 255 0 0 0 0 1\n1 0 0 0 0 255 0 0 1\n", true},
                 {"x;y;z;scan;red;green;blue\n0;0;0;7;255;0;0\n1;0;0;7;0;0;255\n", true},
                 {"b g r z y x\n0 0 255 0 0 0\n255 0 0 0 0 1\n", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_file_text(cases[i].text);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->point_count, 2);
        assert_true(mesh->positions[1].x == 1.0f);
        if ((mesh->colors != NULL) != cases[i].has_colors) fail_msg("case %zu", i);
        if (mesh->colors) assert_true(is_color(&mesh->colors[0], 1, 0, 0) && is_color(&mesh->colors[1], 0, 0, 1));
        reading_free(reading);
    }
}

TEST(far_points_lose_their_origin)
{
    struct reading *reading = read_file_text("5000000.25 100 0\n5000001 100 0\n5000001.75 102 0\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_true(reading->scene->origin && reading->scene->origin[0] == 5000001.0);
    assert_true(mesh->positions[0].x == -0.75f && mesh->positions[2].x == 0.75f);
    reading_free(reading);
}

TEST(lines_of_numbers_are_xyz_and_other_texts_are_not)
{
    static const char *const others[] = {"C 0 0 0\n", "1 2\n3 4\n", "hello\n", "v 0 0 0\n", "12\nwater\nO 0 0 0\n", ""};
    assert_int_equal(zr_format_of_bytes("0 0 0\n1 1 1", 11), ZR_FORMAT_XYZ);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_int_not_equal(zr_format_of_bytes(others[i], strlen(others[i])), ZR_FORMAT_XYZ);
}

/* ---- PCD ---- */

TEST(pcd_ascii_has_packed_colours)
{
    struct reading *reading =
        read_file_text("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\n"
                       "COUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n0 0 0 2.3418052e-38\n"
                       "nan nan nan 0\n1 0 0 9.147676e-41\n");
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_int_equal(mesh->point_count, 2);
    assert_int_equal(mesh->points[1], 2);
    assert_true(is_color(&mesh->colors[0], 1, 0, 0));
    assert_true(is_color(&mesh->colors[2], 0, 1, 0));
    reading_free(reading);
}

TEST(pcd_binary_has_fields_of_any_type)
{
    unsigned char file[200];
    static const char head[] = "FIELDS r g b x y z n\nSIZE 1 1 1 8 4 2 4\nTYPE U U U F F I U\nCOUNT 1 1 1 1 1 1 2\n"
                               "POINTS 1\nDATA binary\n";
    const size_t size = sizeof head - 1 + 3 + 8 + 4 + 2 + 8;
    memset(file, 0, sizeof file);
    memcpy(file, head, sizeof head - 1);
    unsigned char *at = file + sizeof head - 1;
    at[2] = 255;
    at[3 + 6] = 0xF0; /* 1.0 */
    at[3 + 7] = 0x3F;
    at[11 + 3] = 0x40; /* 2.0f */
    at[15] = 0xFE;     /* -2 */
    at[16] = 0xFF;
    struct reading *reading = read_file_bytes(file, size);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_true(is_color(&mesh->colors[0], 0, 0, 1));
    assert_true(mesh->positions[0].x == 1.0f && mesh->positions[0].y == 2.0f && mesh->positions[0].z == -2.0f);
    reading_free(reading);
}

TEST(pcd_compressed_has_field_after_field)
{
    static const char file[] = "FIELDS x y z\nSIZE 2 2 2\nTYPE U U U\nPOINTS 2\nDATA binary_compressed\n"
                               "\x0A\0\0\0\x0C\0\0\0\3\1\0\2\0\x80\3\1\7\0";
    struct reading *reading = read_file_bytes(file, sizeof file - 1);
    const zr_vec4 *p = reading->scene->meshes[0].positions;
    assert_true(p[0].x == 1.0f && p[1].x == 2.0f && p[0].y == 1.0f && p[1].y == 2.0f);
    reading_free(reading);
}

TEST(lines_end_in_three_ways)
{
    struct reading *reading = read_text(ZR_FORMAT_XYZ, "0 0 0\r\n1 0 0\r2 0 0\n\r\n0 bad 0\r\n");
    assert_complaint(reading, ZR_BAD_SYNTAX, "", "line 5: 'bad' is no number");
    reading_free(reading);
}

TEST(empty_lines_look_at_the_cancellation)
{
    static const char *const heads[] = {"OFF\n3 1 0\n0 0 0\n", "FIELDS x y z\nPOINTS 2\nDATA ascii\n", "0 0 0\n"};
    static const enum zr_format formats[] = {ZR_FORMAT_OFF, ZR_FORMAT_PCD, ZR_FORMAT_XYZ};
    static char text[1 << 20];
    struct zr_cancel cancel = {.parent = NULL};
    atomic_store(&cancel.raised, true);
    for (size_t i = 0; i < 3; i++) {
        memset(text, '\n', sizeof text);
        memcpy(text, heads[i], strlen(heads[i]));
        struct reading *reading = read_request((struct zr_request){.format = formats[i], .cancel = &cancel}, text,
                                               sizeof text, zr_limits_default(), (size_t)1 << 26);
        assert_int_equal(reading->status, ZR_CANCELLED);
        reading_free(reading);
    }
}

TEST(lzf_copies_overlap)
{
    unsigned char out[12];
    static const unsigned char packed[] = {1, 'a', 'b', 0xE0, 1, 1};
    assert_true(zr_lzf_decode(packed, sizeof packed, out, 12, NULL));
    assert_memory_equal(out, "abababababab", 12);
    assert_false(zr_lzf_decode(packed, sizeof packed, out, 11, NULL));
    assert_false(zr_lzf_decode(packed, sizeof packed - 1, out, 12, NULL));
}

RUN_TESTS(NULL, NULL)
