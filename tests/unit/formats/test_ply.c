/* Reads PLY of every form, type and order of properties; bounds. */
#include "input/ply/ply_file.h"
#include "support/tests.h"
#include "unit/common/texts.h"

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

static struct reading *read_and_drop(struct text *text)
{
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_PLY, .look = "textbook"},
                                           text->bytes, text->size, zr_limits_default(), (size_t)1 << 28);
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
            assert_origin(reading, 408205.25, 4080925.5, 2);
            assert_memory_equal(reading->scene->meshes[0].positions, want, sizeof want);
            assert_int_equal(reading->scene->warning_count, 0);
            reading_free(reading);
            free(text.bytes);
        }
}

TEST(headers_are_bounded)
{
    struct text text = head_of(ZR_PLY_ASCII);
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

RUN_TESTS(NULL, NULL)
