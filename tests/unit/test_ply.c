/* Reads PLY of every form, type and order of properties; warnings and bounds. */
#include <math.h>

#include "input/ply_values.h"
#include "same_scene.h"
#include "support/tests.h"
#include "texts.h"

enum { PROPERTIES_MAX = 16, VERTICES = 4 };

static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
static const char *const types[ZR_PLY_TYPES][2] = {
#define NAMES(ID, name, newer, type) {name, newer},
    ZR_PLY_TYPE_ROWS(NAMES)
#undef NAMES
};

/* ---- writing ---- */

/* Appends a value in this form and type. */
static void put_value(struct text *text, int form, int type, double value)
{
    char bytes[8];
    size_t size = 0;
    if (form == ZR_PLY_ASCII) {
        add(text, "%.9g ", value);
        return;
    }
#define PUT(ID, name, newer, ctype)                                                                                    \
    if (type == ZR_PLY_##ID) {                                                                                         \
        const ctype number = (ctype)value;                                                                             \
        memcpy(bytes, &number, size = sizeof number);                                                                  \
    }
    ZR_PLY_TYPE_ROWS(PUT)
#undef PUT
    for (size_t i = 0; i < size; i++)
        put(text, &bytes[zr_ply_is_swapped((enum zr_ply_form)form) ? size - 1 - i : i], 1);
}

static void end_line(struct text *text, int form)
{
    if (form == ZR_PLY_ASCII) put(text, "\n", 1);
}

static const char *any_name(int type)
{
    return types[type][below(2)];
}

/* Appends a list of `count` corners, with a length of type count_type. */
static void put_list(struct text *text, int form, int count_type, int type, const double *values, size_t count)
{
    put_value(text, form, count_type, (double)count);
    for (size_t i = 0; i < count; i++)
        put_value(text, form, type, values[i]);
}

static struct text head_of(int form)
{
    struct text text = {0};
    add(&text, "ply\nformat %s 1.0\ncomment any\nobj_info any\n", forms[form]);
    return text;
}

static struct reading *read_ply(const struct text *text)
{
    return read_request((struct zr_request){.format = ZR_FORMAT_PLY, .look = "textbook"}, text->bytes, text->size,
                        zr_limits_default(), (size_t)1 << 28);
}

static struct reading *read_and_drop(struct text *text)
{
    struct reading *reading = read_ply(text);
    drop(text);
    return reading;
}

/* Small whole numbers, which every type can represent. */
static const double corners[VERTICES][3] = {{0, 0, 0}, {9, 0, 1}, {9, 8, 2}, {0, 8, 3}};
static const double quad[VERTICES] = {0, 1, 2, 3}, triangle[3] = {2, 1, 0};

/* ---- types, forms and orders ---- */

/* Appends vertices with x, y and z in an unusual order, between unknown properties and lists. */
static void put_vertices(struct text *header, struct text *body, int form, int type, int list_type, bool with_list)
{
    const int odd = (type + 3) % ZR_PLY_TYPES;
    add(header, "element vertex %d\nproperty %s z\nproperty %s confidence\n", VERTICES, any_name(type), any_name(odd));
    if (with_list) add(header, "property list %s %s neighbours\n", any_name(list_type), any_name(odd));
    add(header, "property %s x\nproperty %s y\n", any_name(type), any_name(type));
    for (size_t i = 0; i < VERTICES; i++) {
        put_value(body, form, type, corners[i][2]);
        put_value(body, form, odd, 7);
        if (with_list) put_list(body, form, list_type, odd, quad, i);
        put_value(body, form, type, corners[i][0]);
        put_value(body, form, type, corners[i][1]);
        end_line(body, form);
    }
}

static void put_faces(struct text *header, struct text *body, int form, int type, int list_type, bool triangles)
{
    add(header, "element face 2\nproperty %s flags\nproperty list %s %s %s\nproperty list uchar float texcoord\n",
        any_name(type), any_name(list_type), any_name(type), below(2) ? "vertex_indices" : "vertex_index");
    for (size_t i = 0; i < 2; i++) {
        put_value(body, form, type, 5);
        if (i)
            put_list(body, form, list_type, type, triangle, 3);
        else
            put_list(body, form, list_type, type, quad + triangles, triangles ? 3 : 4);
        put_list(body, form, ZR_PLY_U8, ZR_PLY_F32, quad, i);
        end_line(body, form);
    }
}

static void put_unknown(struct text *header, struct text *body, int form, int type)
{
    add(header, "element material 2\nproperty %s a\nproperty %s b\n", any_name(type), any_name(type));
    for (int i = 0; i < 4; i++)
        put_value(body, form, type, i);
    end_line(body, form);
}

static void assert_corners(const struct zr_mesh *mesh)
{
    assert_int_equal(mesh->position_count, VERTICES);
    for (size_t i = 0; i < VERTICES; i++)
        assert_true(mesh->positions[i].x == (float)corners[i][0] && mesh->positions[i].y == (float)corners[i][1] &&
                    mesh->positions[i].z == (float)corners[i][2] && mesh->positions[i].w == 1.0f);
}

static void check(int form, int type, int list_type, int order)
{
    struct text header = head_of(form), body = {0};
    const bool faces_first = order & 1, with_list = order & 2, triangles = order & 4;
    if (faces_first) put_faces(&header, &body, form, type, list_type, triangles);
    if (order & 8) put_unknown(&header, &body, form, type);
    put_vertices(&header, &body, form, type, list_type, with_list);
    if (!faces_first) put_faces(&header, &body, form, type, list_type, triangles);
    add(&header, "end_header\n");
    put(&header, body.bytes, body.size);
    drop(&body);
    struct reading *reading = read_and_drop(&header);
    assert_read(reading);
    const struct zr_mesh *mesh = &reading->scene->meshes[0];
    assert_corners(mesh);
    assert_int_equal(mesh->face_count, 2);
    for (uint32_t i = 0; i < mesh->face_offsets[1]; i++)
        assert_int_equal(mesh->indices[i], i + triangles);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(mesh->indices[mesh->face_offsets[1] + i], 2 - i);
    assert_int_equal(mesh->face_offsets[1], triangles ? 3 : 4);
    assert_int_equal(mesh->face_offsets[2], mesh->face_offsets[1] + 3);
    reading_free(reading);
}

TEST(every_type_in_every_form_and_order_is_the_same_mesh)
{
    for (int form = 0; form < 3; form++)
        for (int type = 0; type < ZR_PLY_TYPES; type++)
            for (int list_type = 0; list_type < ZR_PLY_TYPES; list_type++)
                for (int order = 0; order < 16; order++)
                    check(form, type, list_type, order);
}

/* ---- texts ---- */

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

/* The body begins with a line feed, so the first line decides the line end of the header. */
TEST(binary_begins_right_behind_the_header)
{
    static const char *const ends[] = {"\r", "\r\n", "\n"};
    for (size_t e = 0; e < 3; e++) {
        struct text text = {0};
        static const char lines[] = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\n"
                                    "property char y\nproperty char z\nend_header\n";
        for (const char *at = lines; *at; at++)
            put(&text, *at == '\n' ? ends[e] : at, *at == '\n' ? strlen(ends[e]) : 1);
        put(&text, "\n\r\n", 3);
        struct reading *reading = read_and_drop(&text);
        assert_read(reading);
        const zr_vec4 *v = reading->scene->meshes[0].positions;
        assert_true(v->x == 10 && v->y == 13 && v->z == 10);
        reading_free(reading);
    }
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
        struct reading *reading = read_and_drop(&text);
        assert_read(reading);
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
        struct reading *reading = read_and_drop(&text);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->normal_count, 3);
        assert_true(mesh->normals[1].y == 2.0f && zr_normal_is_zero(mesh->normals[2]));
        assert_true(mesh->texcoords[0].x == 0.5f && mesh->texcoords[0].y == 0.25f && mesh->texcoords[2].y == 1.0f);
        reading_free(reading);
    }
}

/* ---- faces, strips, edges, points ---- */

TEST(faces_have_colours)
{
    for (int form = 0; form < 3; form++)
        for (int is_mixed = 0; is_mixed < 2; is_mixed++) {
            struct text header = head_of(form), body = {0};
            const double colors[2][3] = {{255, 0, 51}, {0, 102, 255}};
            put_vertices(&header, &body, form, ZR_PLY_F32, ZR_PLY_U8, false);
            add(&header, "element face 2\nproperty uchar red\nproperty list uchar int vertex_indices\n"
                         "property uchar green\nproperty uchar blue\nend_header\n");
            for (size_t i = 0; i < 2; i++) {
                put_value(&body, form, ZR_PLY_U8, colors[i][0]);
                put_list(&body, form, ZR_PLY_U8, ZR_PLY_I32, is_mixed ? quad : triangle, is_mixed && i ? 4 : 3);
                put_value(&body, form, ZR_PLY_U8, colors[i][1]);
                put_value(&body, form, ZR_PLY_U8, colors[i][2]);
            }
            put(&header, body.bytes, body.size);
            drop(&body);
            struct reading *reading = read_and_drop(&header);
            assert_read(reading);
            const struct zr_mesh *mesh = &reading->scene->meshes[0];
            assert_non_null(mesh->face_colors);
            assert_true(mesh->face_colors[0].x == 1.0f && mesh->face_colors[0].z == 0.2f);
            assert_true(mesh->face_colors[1].y == 0.4f && mesh->face_colors[1].w == 1.0f);
            assert_int_equal(mesh->face_offsets[2], is_mixed ? 7 : 6);
            assert_true(reading->scene->materials[0].base_color.x == 1.0f);
            reading_free(reading);
        }
}

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

TEST(vertices_without_faces_are_points_but_for_those_that_are_not_finite)
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

/* ---- warnings ---- */

TEST(what_is_not_drawn_or_odd_is_warned_of)
{
    static const struct {
        const char *text, *warning;
    } cases[] = {
        {ASCII "comment TextureFile a b.png \ncomment TextureFile c.png\n" VERTEX "end_header\n" POSITIONS,
         "2 textures are not read in this version; the first is 'a b.png'"},
        {ASCII "made by hand\n" VERTEX "end_header\n" POSITIONS, "1 line of the header is not known; it is line 3"},
        {ASCII VERTEX "element face 3\nproperty list uchar int vertex_indices\nend_header\n" POSITIONS
                      "3 0 1 2\n2 0 1\n0\n",
         "2 faces have fewer than 3 corners and are left out; the first is face 1"},
        {ASCII VERTEX "end_header\n0 0 0 9 0 1\n9 8 2 0 8 3\n",
         "2 lines have another number of values than the header says; the first is line 8"},
        {MESH "5 6\n", "4 bytes behind the last element are not read"},
        {ASCII VERTEX
         "element camera 1\nproperty float a\nelement b 0\nelement c 2\nproperty float a\nend_header\n" POSITIONS
         "1\n1\n2\n",
         "2 kinds of elements are not drawn; the first is 'camera' (1 of them)"},
        {ASCII VERTEX "property float f_dc_0\nend_header\n0 0 0 1\n1 0 0 1\n1 1 0 1\n2 2 2 2\n", "splats (f_dc_0)"},
        {ASCII "element vertex 3\n" XYZ "property uchar red\nproperty uchar green\nproperty uchar blue\n" FACE
               "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n"
               "0 1 0 7 8 9\n3 0 1 2 1 2 3\n",
         "colours of faces are not drawn beside those of vertices"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_good(cases[i].text);
        if (reading->scene->warning_count != 1 || !strstr(reading->scene->warnings[0], cases[i].warning))
            fail_msg("case %zu: %u warnings, %s", i, reading->scene->warning_count,
                     reading->scene->warning_count ? reading->scene->warnings[0] : "");
        reading_free(reading);
        const struct zr_request strict = {.format = ZR_FORMAT_PLY, .strict = "1"};
        reading = read_request(strict, cases[i].text, strlen(cases[i].text), zr_limits_default(), 1 << 28);
        assert_complaint(reading, ZR_BAD_SCENE, "", cases[i].warning);
        reading_free(reading);
    }
}

/* ---- bounds ---- */

/* The middle of far meshes is subtracted in double precision. Vertices that no face uses are ignored. */
TEST(middle_of_far_meshes_is_their_origin)
{
    static const double v[][3] = {{408200.25, 4080920.5, 0}, {408210.25, 4080920.5, 0}, {408200.25, 4080930.5, 4}};
    static const zr_vec4 want[] = {{-5, -5, -2, 1}, {5, -5, -2, 1}, {-5, 5, 2, 1}};
    const double all_three[] = {0, 1, 2};
    for (int form = 0; form < 3; form++)
        for (int kind = 0; kind < 4; kind++) { /* a face, a face beside an unused vertex, points, a list before x */
            const bool has_list = kind == 3, has_face = kind != 2;
            struct text text = {0};
            add(&text, "ply\nformat %s 1.0\nelement vertex %d\n", forms[form], kind == 1 ? 4 : 3);
            if (has_list) add(&text, "property list uchar int some\n");
            add(&text, "property double x\nproperty double y\nproperty double z\nelement face %d\n", has_face);
            add(&text, "property list uchar int vertex_indices\nend_header\n");
            for (int i = 0; i < (kind == 1 ? 4 : 3); i++) {
                if (has_list) put_list(&text, form, ZR_PLY_U8, ZR_PLY_I32, all_three, 2);
                for (int k = 0; k < 3; k++) {
                    if (form == ZR_PLY_ASCII)
                        add(&text, "%.17g ", i < 3 ? v[i][k] : -1e15);
                    else
                        put_value(&text, form, ZR_PLY_F64, i < 3 ? v[i][k] : -1e15);
                }
                end_line(&text, form);
            }
            if (has_face) put_list(&text, form, ZR_PLY_U8, ZR_PLY_I32, all_three, 3);
            if (has_face) end_line(&text, form);
            struct reading *reading = read_bytes(ZR_FORMAT_PLY, text.bytes, text.size);
            assert_read(reading);
            const double *origin = reading->scene->origin;
            assert_true(origin && origin[0] == 408205.25 && origin[1] == 4080925.5 && origin[2] == 2);
            assert_memory_equal(reading->scene->meshes[0].positions, want, sizeof want);
            assert_int_equal(reading->scene->warning_count, 0);
            reading_free(reading);
            free(text.bytes);
        }
}

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

TEST(headers_are_bounded)
{
    struct text text = {0};
    add(&text, ASCII);
    while (text.size < ZR_PLY_HEADER_MAX)
        add(&text, "comment a long story\n");
    struct reading *reading = read_and_drop(&text);
    assert_complaint(reading, ZR_BAD_SYNTAX, "", "no end_header within the first 262144 bytes");
    reading_free(reading);
}

TEST(any_bytes_cut_short_are_refused)
{
    for (int form = 0; form < 3; form++) {
        struct text header = head_of(form), body = {0};
        put_vertices(&header, &body, form, ZR_PLY_F32, ZR_PLY_U8, false);
        put_faces(&header, &body, form, ZR_PLY_I32, ZR_PLY_U8, false);
        add(&header, "end_header\n");
        const size_t least = header.size;
        put(&header, body.bytes, body.size - (form == ZR_PLY_ASCII ? 3 : 0));
        drop(&body);
        for (size_t size = 0; size < header.size; size++) {
            struct reading *reading = read_bytes(ZR_FORMAT_PLY, header.bytes, size);
            assert_int_equal(reading->status, ZR_BAD_SYNTAX);
            if (size >= least) assert_true(strstr(reading->error.items[0].detail, "the file "));
            reading_free(reading);
        }
        drop(&header);
    }
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_PLY}, MESH, strlen(MESH), 1 << 16) > 512);
}

RUN_TESTS(NULL, NULL)
