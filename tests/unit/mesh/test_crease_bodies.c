/* Normals of corners of bodies that are known: sharp where they should be, and smooth elsewhere. */
#include "base/run.h"
#include "support/tests.h"
#include "unit/common/crease_check.h"

static struct zr_mesh soup_of(const zr_vec4 *positions, uint32_t triangles)
{
    static uint32_t offsets[200001], indices[600000];
    for (uint32_t i = 0; i < 3 * triangles; i++)
        indices[i] = i;
    for (uint32_t i = 0; i <= triangles; i++)
        offsets[i] = 3 * i;
    return (struct zr_mesh){.position_count = 3 * triangles,
                            .positions = positions,
                            .face_count = triangles,
                            .face_offsets = offsets,
                            .indices = indices};
}

/* Corners by the bits of x, y, z: 1 is +1. */
static const int cube_faces[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                     {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
static const float cube_normals[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

static zr_vec4 cube_corner(int bits)
{
    return (zr_vec4){bits & 1 ? 1.0f : -1.0f, bits & 2 ? 1.0f : -1.0f, bits & 4 ? 1.0f : -1.0f, 1.0f};
}

static struct zr_mesh soup_of_cube(zr_vec4 positions[36])
{
    for (int f = 0; f < 6; f++)
        for (int i = 0; i < 6; i++) {
            static const int order[6] = {0, 1, 2, 0, 2, 3};
            positions[6 * f + i] = cube_corner(cube_faces[f][order[i]]);
        }
    return soup_of(positions, 12);
}

TEST_AROUND(cubes_are_sharp_up_to_90_degrees, empty_arena, NULL)
{
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    static const float angles[] = {0, 35, 89.9f, 90, 180};
    const double even = 1.0 / sqrt(3.0);
    for (int a = 0; a < 5; a++) {
        const zr_vec4 *n = make(NULL, &mesh, angles[a]);
        for (int i = 0; i < 36; i++) {
            const float *flat = cube_normals[i / 6];
            const zr_vec4 p = positions[i];
            if (a < 3)
                assert_near(n[i], (double)flat[0], (double)flat[1], (double)flat[2], 1e-7);
            else
                assert_near(n[i], even * (double)p.x, even * (double)p.y, even * (double)p.z, 1e-6);
        }
    }
}

/* Whatever borders of cells are between them: a point far away, on which the cells depend, is everywhere. */
TEST_AROUND(positions_that_nearly_agree_are_one_vertex, empty_arena, NULL)
{
    for (int round = 0; round < 2000; round++) {
        zr_vec4 positions[39];
        const zr_vec4 far = {-3.0f + any(), -3.0f + any(), -3.0f + any(), 1};
        soup_of_cube(positions);
        for (int i = 0; i < 36; i++) {
            positions[i].x += 9e-7f * any();
            positions[i].y += 9e-7f * any();
            positions[i].z += 9e-7f * any();
        }
        positions[36] = positions[37] = positions[38] = far;
        const struct zr_mesh mesh = soup_of(positions, 13);
        const zr_vec4 *n = make(NULL, &mesh, 180);
        for (int i = 0; i < 36; i++) {
            const double even = 1.0 / sqrt(3.0);
            assert_near(n[i], positions[i].x > 0 ? even : -even, positions[i].y > 0 ? even : -even,
                        positions[i].z > 0 ? even : -even, 1e-4);
        }
        zr_arena_reset(&arena, ARENA_BYTES);
    }
}

TEST_AROUND(positions_farther_apart_are_not, empty_arena, NULL)
{
    for (int round = 0; round < 200; round++) {
        zr_vec4 positions[36];
        const struct zr_mesh mesh = soup_of_cube(positions);
        const float x = any();
        for (int i = 0; i < 36; i++)
            positions[i].x += x + (i < 6 ? 5e-6f : 0.0f);
        const zr_vec4 *n = make(NULL, &mesh, 180);
        for (int i = 0; i < 6; i++)
            assert_near(n[i], 1.0, 0.0, 0.0, 1e-6);
        zr_arena_reset(&arena, ARENA_BYTES);
    }
}

TEST_AROUND(faces_without_area_take_what_is_around, empty_arena, NULL)
{
    const zr_vec4 positions[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1},
                                 {1, 0, 0, 1}, {5, 5, 5, 1}, {5, 5, 5, 1}, {5, 5, 5, 1}};
    const struct zr_mesh mesh = soup_of(positions, 3);
    const zr_vec4 *n = make(NULL, &mesh, 10);
    for (int i = 0; i < 6; i++)
        assert_near(n[i], 0.0, 0.0, 1.0, 1e-7);
    for (int i = 6; i < 9; i++)
        assert_near(n[i], 0.0, 0.0, 0.0, 0.0);
}

/* ---- crowds ---- */

enum { ROUND_MOST = 100000 };

/* A cone of so many faces, its tip at the origin and half as high as wide. */
static struct zr_mesh cone_of(uint32_t faces)
{
    static zr_vec4 positions[3 * ROUND_MOST];
    for (uint32_t i = 0; i < faces; i++) {
        const double a = 6.283185307179586 * i / faces, b = 6.283185307179586 * (i + 1) / faces;
        positions[3 * i] = (zr_vec4){0, 0, 0, 1};
        positions[3 * i + 1] = (zr_vec4){(float)cos(a), (float)sin(a), -0.5f, 1};
        positions[3 * i + 2] = (zr_vec4){(float)cos(b), (float)sin(b), -0.5f, 1};
    }
    return soup_of(positions, faces);
}

/* ---- ends ---- */

static const struct zr_crease_normals *make_shared(struct zr_team *team, const struct zr_mesh *mesh, float degrees)
{
    const struct zr_crease_normals *made =
        zr_crease_normals_make(&(struct zr_run){.arena = &arena, .team = team}, mesh, degrees);
    assert_non_null(made);
    return made;
}

TEST_AROUND(room_is_given_back, empty_arena, NULL)
{
    const struct zr_mesh mesh = cone_of(ROUND_MOST);
    const size_t corners = 3 * ROUND_MOST, bytes = corners * (sizeof(zr_vec4) + sizeof(uint32_t));
    const struct zr_crease_normals *made = make_shared(NULL, &mesh, 180);
    assert_non_null(made->numbers);
    assert_true(arena.used < bytes / 2);
    assert_true(arena.peak < corners * 31);
}

TEST_AROUND(equal_normals_are_stored_once, empty_arena, NULL)
{
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    const struct zr_crease_normals *round = make_shared(NULL, &mesh, 180);
    assert_int_equal(round->count, 8);
    uint32_t seen = 0;
    for (uint32_t i = 0; i < 36; i++) { /* numbered in the order of their first corners */
        assert_true(round->numbers[i] <= seen);
        seen += round->numbers[i] == seen;
    }
    assert_int_equal(make_shared(NULL, &mesh, 35)->count, 24);
}

TEST_AROUND(normals_that_differ_have_no_numbers, empty_arena, NULL)
{
    zr_vec4 positions[3 * 12];
    for (int i = 0; i < 36; i++)
        positions[i] = (zr_vec4){any(), any(), any(), 1};
    const struct zr_mesh mesh = soup_of(positions, 12);
    const struct zr_crease_normals *made = make_shared(NULL, &mesh, 35);
    assert_null(made->numbers);
    assert_int_equal(made->count, 36);
}

TEST_AROUND(without_memory_there_are_none, empty_arena, NULL)
{
    zr_vec4 positions[36];
    const struct zr_mesh mesh = soup_of_cube(positions);
    struct zr_arena small;
    for (size_t bytes = 0; bytes <= 1024; bytes += 512) {
        zr_arena_init(&small, bytes);
        assert_null(zr_crease_normals_make(&(struct zr_run){.arena = &small}, &mesh, 35));
        zr_arena_free(&small);
    }
}

TEST_AROUND(what_was_cancelled_ends_early, empty_arena, NULL)
{
    const struct zr_mesh mesh = cone_of(ROUND_MOST);
    const struct zr_cancel cancel = {.raised = true};
    struct zr_team *team = zr_team_create(3);
    assert_non_null(
        zr_crease_normals_make(&(struct zr_run){.arena = &arena, .team = team, .cancel = &cancel}, &mesh, 35));
    assert_true(arena.used <= 3 * ROUND_MOST * 2 * sizeof(zr_vec4));
    zr_team_destroy(team);
}

RUN_TESTS(open_arena, close_arena)
