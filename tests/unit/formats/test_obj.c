#include "unit/common/input_check.h"

#include "input/formats/input.h"
#include "support/tests.h"

static const char triangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/* The three vertices above, and then `rest`. */
static struct reading *read_rest(const char *rest)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s", triangle, rest);
    return read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .look = "textbook"}, text, strlen(text),
                        zr_limits_default(), (size_t)1 << 28);
}

TEST(triangle_becomes_a_scene_of_the_textbook)
{
    struct reading *reading = read_rest("f 1 2 3");
    assert_read(reading);
    const struct zr_scene *scene = reading->scene;
    const struct zr_mesh *mesh = &scene->meshes[0];
    assert_int_equal(scene->views[0].width, 640);
    assert_int_equal(scene->views[0].height, 480);
    assert_int_equal(scene->instance_count, 1);
    assert_int_equal(scene->light_count, 2);
    assert_true(scene->lights[0].camera_frame && scene->lights[1].camera_frame);
    assert_int_equal(scene->views[0].output_count, 1);
    assert_int_equal(scene->views[0].preset, ZR_PRESET_FRONT); /* it is flat */
    assert_int_equal(scene->views[0].projection, ZR_PROJECTION_ORTHOGRAPHIC);
    assert_true(scene->materials[0].double_sided);
    assert_int_equal(scene->materials[0].shading, ZR_SHADING_FLAT);
    assert_true(scene->materials[0].base_color.x == 0.7f);
    assert_int_equal(mesh->position_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->face_offsets[1], 3);
    assert_int_equal(mesh->indices[2], 2);
    assert_true(mesh->positions[1].x == 1.0f && mesh->positions[1].w == 1.0f);
    assert_int_equal(mesh->normal_count, 0);
    assert_null(mesh->colors);
    reading_free(reading);
}

TEST(every_corner_form_is_read)
{
    struct reading *reading = read_rest("vt 0 0\nvt .5\nvt 1 1 0\nvn 0 0 1\nvn 0 1 0\n"
                                        "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//1 3//2\nf 1/1/2 2/2/2 3/3/1\n");
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    static const uint32_t normals[12] = {2, 2, 2, 2, 2, 2, 0, 0, 1, 1, 1, 0};
    assert_int_equal(mesh->face_count, 4);
    assert_int_equal(mesh->normal_count, 3);
    assert_true(mesh->normals[2].x == 0 && mesh->normals[2].y == 0 && mesh->normals[2].z == 0);
    for (size_t i = 0; i < 12; i++) {
        assert_int_equal(mesh->indices[i], i % 3);
        assert_int_equal(mesh->normal_indices[i], normals[i]);
    }
    assert_int_equal(reading->scene->materials[0].shading, ZR_SHADING_GOURAUD);
    reading_free(reading);
}

TEST(normals_at_all_corners_need_no_zero_normal)
{
    struct reading *reading = read_rest("vn 0 0 1\nf 1//1 2//1 3//-1");
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].normal_count, 1);
    assert_int_equal(reading->scene->meshes[0].normal_indices[2], 0);
    reading_free(reading);
}

TEST(negative_indices_count_back_from_here)
{
    struct reading *reading = read_rest("f -3 -2 -1\nv 5 5 5\nf -1 -2 -3\nf 4 1 2\n");
    assert_read(reading);
    static const uint32_t indices[9] = {0, 1, 2, 3, 2, 1, 3, 0, 1};
    assert_memory_equal(reading->scene->meshes[0].indices, indices, sizeof indices);
    reading_free(reading);
}

TEST(absolute_index_may_come_before_its_vertex)
{
    struct reading *reading = read_text(ZR_FORMAT_OBJ, "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0");
    assert_read(reading);
    reading_free(reading);
}

TEST(several_bad_faces_are_all_reported)
{
    struct reading *reading = read_rest("f 1 2 4\nf 1 2 -9\nf 1 2 3\nf 5 5 5\n");
    assert_int_equal(reading->status, ZR_BAD_SCENE);
    assert_int_equal(reading->error.count, 3);
    assert_non_null(strstr(reading->error.items[1].detail, "line 5: relative index -9"));
    reading_free(reading);
}

TEST(limits_are_kept)
{
    char text[8192] = "v 0 0 0\nf";
    for (int i = 0; i < 1024; i++)
        strcat(text, " 1");
    struct reading *reading = read_text(ZR_FORMAT_OBJ, text);
    assert_read(reading);
    reading_free(reading);
    strcat(text, " 1");
}

TEST(layout_of_the_text_does_not_matter)
{
    static const char *const texts[] = {
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "\t v\t0  0\t0  \n\n \nv 1 0 0 # comment\nv 0 1 0\n  f 1\t2   3",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 \\\n3",
        "# a path C:\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf\\\n1 2 3 #1",
        "g a#b \nv 0 0 0 # C:\\\nv 1 0 0 #\\\r\nv 0 1 0\nf \\\n1 2 \\\n3\\\n# and \\\n#",
        "v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1\nf 1 2 3",
        "v +0 0. .0e1\nv 1 0 0\nv 0 1 0\nf 1 2 3",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_text(ZR_FORMAT_OBJ, texts[i]);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->position_count, 3);
        assert_true(mesh->positions[1].x == 1 && mesh->positions[1].w == 1 && mesh->positions[2].y == 1);
        assert_int_equal(mesh->indices[0] * 100 + mesh->indices[1] * 10 + mesh->indices[2], 12);
        reading_free(reading);
    }
}

/* One corner after the other is put into a face, in every form and with blanks of all kinds between: so lines have
 * every length, as whatever looks at many bytes at once must be tried. The face ends the file, or a line, or has a
 * comment. */
TEST(faces_have_every_corner_that_they_are_written_with)
{
    static const char *const corners[] = {"1", "2/7", "3//1", "-1/2/1", "1/12345678/1", "3", "000000000000002"};
    static const char *const blanks[] = {" ", "\t", "  ", " \f", " \\\n"},
                             *const ends[] = {"", "\n", " \r\n", " # 1 2\n",
                                              "\n# and so on, word by word, to the end\n"};
    static const uint32_t indices[] = {0, 1, 2, 2, 0, 2, 1};
    enum {
        FORMS = sizeof corners / sizeof corners[0],
        KINDS = sizeof blanks / sizeof blanks[0],
        ENDS = sizeof ends / sizeof ends[0]
    };
    for (size_t kind = 0; kind < KINDS * ENDS; kind++) {
        char text[8192];
        size_t used = (size_t)sprintf(text, "%svn 0 0 1\nf", triangle);
        for (size_t count = 1; count <= 300; count++) {
            used += (size_t)sprintf(text + used, "%s%s", blanks[kind % KINDS], corners[count % FORMS]);
            if (count < 3 || (count > 20 && count < 290)) continue;
            sprintf(text + used, "%s", ends[kind / KINDS]);
            struct reading *reading = read_text(ZR_FORMAT_OBJ, text);
            assert_read(reading);
            const struct zr_mesh *mesh = &reading->scene->meshes[0];
            assert_int_equal(mesh->face_offsets[1], count);
            for (size_t i = 0; i < count; i++)
                assert_int_equal(mesh->indices[i], indices[(i + 1) % FORMS]);
            reading_free(reading);
        }
    }
}

/* Where their count no longer fits what counts them. */
TEST(face_of_many_short_corners_is_counted)
{
    struct zr_limits limits = zr_limits_default();
    limits.polygon_vertices_max = 100000;
    char *text = malloc(3 * (size_t)limits.polygon_vertices_max);
    assert_non_null(text);
    static const uint32_t counts[] = {1000, 2039, 2040, 2041, 2047, 2048, 2049, 2300, 64000};
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        const uint32_t count = counts[k];
        size_t used = (size_t)sprintf(text, "%sf", triangle);
        for (size_t i = 0; i < count; i++)
            used += (size_t)sprintf(text + used, " %d", (int)(i % 3) + 1);
        used += (size_t)sprintf(text + used, "\n# the end of the file is not near\n");
        struct reading *reading =
            read_request((struct zr_request){.format = ZR_FORMAT_OBJ}, text, used, limits, (size_t)1 << 28);
        assert_read(reading);
        assert_int_equal(reading->scene->meshes[0].face_offsets[1], count);
        assert_int_equal(reading->scene->meshes[0].indices[count - 1], (count - 1) % 3);
        reading_free(reading);
    }
    free(text);
}

TEST(other_statements_are_passed_over)
{
    static const char *const words[] = {
        "bevel",      "bmat",   "bsp",   "bzp",    "c_interp", "call",      "cdc",  "cdp",    "con",    "csh",
        "cstype",     "ctech",  "curv",  "curv2",  "d_interp", "deg",       "end",  "g",      "hole",   "l",
        "lod",        "maplib", "mg",    "mtllib", "o",        "p",         "parm", "res",    "s",      "scrv",
        "shadow_obj", "sp",     "stech", "step",   "surf",     "trace_obj", "trim", "usemap", "usemtl", "vp"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char rest[64];
        snprintf(rest, sizeof rest, "%s any thing\nf 1 2 3\n", words[i]);
        struct reading *reading = read_rest(rest);
        assert_read(reading);
        reading_free(reading);
    }
}

TEST(what_is_not_drawn_is_warned_of)
{
    static const struct {
        const char *rest, *warnings[2];
    } cases[] = {
        {"mtllib a.mtl\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n",
         {"OBJ: 1 material library (mtllib) is no part of the request; it is line 4: 'mtllib a.mtl'"}},
        {"usemtl red\nusemtl oak\nf 1 2 3\nusemtl blue\nf 3 2 1\n",
         {"OBJ: 2 materials (usemtl) are in no material library; their faces have the look's; the first is line 5: "
          "'oak'"}},
        {"f 1 2 3\ncurv 0 1 1 2 3\nsurf 0 1 0 1 1 2 3\n",
         {"OBJ: 2 statements of curves and surfaces are not drawn; the first is line 5: 'curv 0 1 1 2 3'"}},
        {"o a\ng b\ns 1\nvt 0 0\nf 1 2 3\n# usemtl red\n", {NULL}}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_rest(cases[i].rest);
        assert_read(reading);
        uint32_t count = 0;
        for (; count < 2 && cases[i].warnings[count]; count++)
            assert_true(count < reading->scene->warning_count &&
                        strcmp(reading->scene->warnings[count], cases[i].warnings[count]) == 0);
        assert_int_equal(reading->scene->warning_count, count);
        reading_free(reading);
    }
}

TEST(byte_order_mark_is_passed_over)
{
    struct reading *reading = read_text(ZR_FORMAT_OBJ, "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].position_count, 3);
    reading_free(reading);
}

TEST(vertex_colors_are_read_and_white_elsewhere)
{
    struct reading *reading = read_rest("v 1 1 1 0.25 0.5 1\nf 1 2 3 4");
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_true(mesh->colors[0].x == 1 && mesh->colors[0].w == 1);
    assert_true(mesh->colors[3].x == 0.25f && mesh->colors[3].y == 0.5f && mesh->colors[3].z == 1);
    assert_true(reading->scene->materials[0].base_color.x == 1);
    assert_int_equal(reading->scene->materials[0].shading, ZR_SHADING_GOURAUD);
    reading_free(reading);
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1";
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_OBJ}, text, strlen(text), 16384) > 512);
}

RUN_TESTS(NULL, NULL)
