/* Reads binary PLY in parts by several threads; compares with the same meshes in ASCII. */
#include <math.h>

#include "input/formats/formats.h"
#include "input/ply/ply_file.h"
#include "support/tests.h"
#include "unit/common/by_teams.h"

enum { FAULTS_MAX = 30, VERTEX_BYTES = 15, FACE_BYTES = 13 };

static void put_swapped(struct text *text, int form, const void *value, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        const size_t at = zr_ply_is_swapped((enum zr_ply_form)form) ? size - 1 - i : i;
        put(text, (const char *)value + at, 1);
    }
}

static void put_header(struct text *text, int form, size_t vertices, size_t faces)
{
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    add(text, "ply\nformat %s 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n",
        forms[form], vertices);
    add(text, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    add(text, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", faces);
}

/* Makes a mesh of triangles; face `quad` has four corners, face `line` has two. */
static struct text make_mesh(int form, size_t vertices, size_t faces, size_t quad, size_t line)
{
    struct text text = {0};
    struct random numbers_of_mesh = {{1, 2, 3, 4}};
    put_header(&text, form, vertices, faces);
    for (size_t i = 0; i < vertices; i++) {
        const float v[3] = {(float)i / 64, (float)(i % 100) / 4, (float)(i % 7)};
        const unsigned char colors[3] = {(unsigned char)i, (unsigned char)(i / 7), 9};
        for (size_t k = 0; k < 3; k++)
            if (form == ZR_PLY_ASCII)
                add(&text, "%.9g ", (double)v[k]);
            else
                put_swapped(&text, form, &v[k], 4);
        if (form == ZR_PLY_ASCII)
            add(&text, "%u %u %u\n", colors[0], colors[1], colors[2]);
        else
            put(&text, (const char *)colors, 3);
    }
    for (size_t i = 0; i < faces; i++) {
        const size_t corners = i == quad ? 4 : i == line ? 2 : 3;
        if (form == ZR_PLY_ASCII)
            add(&text, "%zu", corners);
        else
            put(&text, &(char){(char)corners}, 1);
        for (size_t k = 0; k < corners; k++) {
            const uint32_t index = random_below(&numbers_of_mesh, (uint32_t)vertices);
            if (form == ZR_PLY_ASCII)
                add(&text, " %u", index);
            else
                put_swapped(&text, form, &index, 4);
        }
        if (form == ZR_PLY_ASCII) add(&text, "\n");
    }
    return text;
}

TEST(meshes_of_any_size_and_form_are_the_same_for_every_team)
{
    static const size_t sizes[] = {1, 255, 256, 257, 8192, 8193, 16384, 40001};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (size_t odd = 0; odd < 4; odd++) {
            const size_t count = sizes[i], quad = odd & 1 ? count / 2 : count, line = odd & 2 ? count * 3 / 4 : count;
            struct text ascii = make_mesh(ZR_PLY_ASCII, count, count, quad, line);
            struct reading *wanted = read_by_all(ZR_FORMAT_PLY, &ascii);
            if (count > 1) assert_read(wanted);
            for (int form = ZR_PLY_LITTLE; form <= ZR_PLY_BIG; form++) {
                struct text text = make_mesh(form, count, count, quad, line);
                struct reading *reading = read_by_all(ZR_FORMAT_PLY, &text);
                assert_same_reading(reading, wanted);
                reading_free(reading);
                drop(&text);
            }
            reading_free(wanted);
            drop(&ascii);
        }
}

TEST(faults_are_told_in_their_order)
{
    enum { COUNT = 40000 };
    const float nowhere = 1e30f;
    const uint32_t index = COUNT + 5;
    for (int of_faces = 0; of_faces < 2; of_faces++) {
        struct text text = make_mesh(ZR_PLY_LITTLE, COUNT, COUNT, COUNT, COUNT), header = {0};
        char faults[FAULTS_MAX][FAULT_SIZE];
        put_header(&header, ZR_PLY_LITTLE, COUNT, COUNT);
        for (size_t i = 0; i < FAULTS_MAX; i++) {
            const size_t bad = COUNT / 2 + 619 * i;
            char *vertices = text.bytes + header.size, *faces = vertices + (size_t)COUNT * VERTEX_BYTES;
            if (of_faces) {
                memcpy(faces + bad * FACE_BYTES + 5, &index, sizeof index);
                snprintf(faults[i], FAULT_SIZE, "face %zu names vertex 40005, but there are 40000, from 0 on", bad);
            } else {
                memcpy(vertices + bad * VERTEX_BYTES + 4, &nowhere, sizeof nowhere);
                snprintf(faults[i], FAULT_SIZE, "vertex %zu: (", bad);
            }
        }
        struct reading *reading = read_by_all(ZR_FORMAT_PLY, &text);
        assert_faults(reading, faults, FAULTS_MAX);
        reading_free(reading);
        drop(&header);
        drop(&text);
    }
}

TEST(triangles_take_little_more_memory_than_their_arrays)
{
    enum { COUNT = 40000 };
    struct text text = make_mesh(ZR_PLY_LITTLE, COUNT, COUNT, COUNT, COUNT);
    struct reading *reading = read_by(NULL, ZR_FORMAT_PLY, &text);
    assert_read(reading);
    const size_t arrays = COUNT * (2 * sizeof(zr_vec4) + 4 * sizeof(uint32_t));
    assert_in_range(reading->arena.peak, arrays, arrays + COUNT + arrays / 50 + 4096);
    reading_free(reading);
    drop(&text);
}

/* Calls the reader itself: zr_scene_read reports a cancel in any case. */
TEST(cancelled_reader_says_so)
{
    struct zr_cancel cancel = {.raised = true};
    const struct zr_limits limits = zr_limits_default();
    for (int form = ZR_PLY_ASCII; form <= ZR_PLY_BIG; form++)
        for (int i = 0; i < 2; i++) {
            struct text text = make_mesh(form, 20000, 20000, 20000, 20000);
            const struct zr_request request = {
                .format = ZR_FORMAT_PLY, .bytes = text.bytes, .size = text.size, .cancel = &cancel};
            struct zr_arena arena;
            struct zr_scene scene = {.mesh_count = 0};
            struct zr_error error = {.count = 0};
            zr_arena_init(&arena, CEILING);
            struct zr_scene_builder builder = zr_scene_builder_open(&arena, i ? teams[1] : NULL, &scene);
            assert_int_equal(zr_format_rows[ZR_FORMAT_PLY].read(&builder, &request, &limits, &error), ZR_CANCELLED);
            zr_arena_free(&arena);
            drop(&text);
        }
}

RUN_TESTS(start_teams, end_teams)
