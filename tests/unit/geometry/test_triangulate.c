/* Faces of every shape, cut into triangles: corners lie on a grid of integers, so that areas are exact. */
#include <string.h>

#include "geometry/triangulate.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/face_shapes.h"

enum { TRIANGLES_MAX = CORNERS_MAX + 2 * RINGS_MAX };

struct result {
    uint32_t triangles[TRIANGLES_MAX][3], count;
};

TEST_ARENA(1 << 24)
static struct zr_triangulator scratch;

/* ---- what always holds ---- */

static uint8_t edges[CORNERS_MAX][CORNERS_MAX];

static void toggle(uint32_t a, uint32_t b)
{
    edges[a < b ? a : b][a < b ? b : a] ^= 1;
}

static void assert_edges_cancel(const struct face *face, const struct result *result)
{
    for (uint32_t r = 0; r < face->rings; r++) {
        uint32_t begin = face->ring_offsets[r], end = face->ring_offsets[r + 1];
        for (uint32_t i = begin; i < end && end - begin > 1; i++)
            toggle(i, i + 1 < end ? i + 1 : begin);
    }
    for (uint32_t i = 0; i < result->count; i++)
        for (int k = 0; k < 3; k++)
            toggle(result->triangles[i][k], result->triangles[i][(k + 1) % 3]);
    uint32_t corners = corners_of(face), odd = 0;
    for (uint32_t a = 0; a < corners; a++)
        for (uint32_t b = a; b < corners; b++)
            odd += edges[a][b];
    assert_int_equal(odd, 0);
}

static void assert_sane(const struct face *face, const struct result *result)
{
    uint32_t corners = corners_of(face);
    uint64_t nodes = zr_triangulate_nodes_max(corners, face->rings);
    assert_true(result->count <= zr_triangulate_count_max(corners, face->rings));
    assert_true(scratch.loops.visits <= ZR_TRIANGULATE_VISITS * nodes * nodes);
    bool clockwise = ring_area(face, 0) < 0;
    for (uint32_t i = 0; i < result->count; i++) {
        const uint32_t *t = result->triangles[i];
        assert_true(t[0] < corners && t[1] < corners && t[2] < corners);
        assert_true(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        int64_t area = turn(face->at[t[0]], face->at[t[1]], face->at[t[2]]);
        assert_true(clockwise ? area <= 0 : area >= 0);
    }
    assert_edges_cancel(face, result);
}

static int64_t area_of_triangles(const struct face *face, const struct result *result)
{
    int64_t sum = 0;
    for (uint32_t i = 0; i < result->count; i++) {
        const uint32_t *t = result->triangles[i];
        sum += llabs(turn(face->at[t[0]], face->at[t[1]], face->at[t[2]]));
    }
    return sum;
}

/* As it is, and with other w across another axis: the triangles must be the same. */
static void triangulate(const struct face *face, struct result *result)
{
    static zr_vec4 points[CORNERS_MAX];
    static struct result again;
    uint32_t corners = corners_of(face);
    assert_true(zr_triangulator_reserve(&arena, &scratch, corners, face->rings));
    for (uint32_t i = 0; i < corners; i++)
        points[i] = (zr_vec4){(float)face->at[i].x, (float)face->at[i].y, 7.0f, 1.0f};
    result->count = zr_triangulate(&scratch, points, face->ring_offsets, face->rings, result->triangles);
    for (uint32_t i = 0; i < corners; i++) {
        float x = (float)face->at[i].x, y = (float)face->at[i].y, w = i % 3 == 0 ? 4.0f : 0.5f;
        points[i] = corners % 2 ? (zr_vec4){y * w, -3.0f * w, x * w, w} : (zr_vec4){0.0f, x * w, y * w, w};
    }
    assert_sane(face, result);
    again.count = zr_triangulate(&scratch, points, face->ring_offsets, face->rings, again.triangles);
    assert_sane(face, &again);
    assert_int_equal(again.count, result->count);
    assert_memory_equal(again.triangles, result->triangles, result->count * sizeof result->triangles[0]);
}

/* ---- tests: proper faces ---- */

static struct face face;
static struct result result;

static uint32_t triangulate_points(const zr_vec4 *points, const uint32_t *offsets, uint32_t rings, uint32_t (*out)[3])
{
    assert_true(zr_triangulator_reserve(&arena, &scratch, offsets[rings] - offsets[0], rings));
    return zr_triangulate(&scratch, points, offsets, rings, out);
}

TEST(triangulate_dart_gives_its_two_triangles_on_its_side)
{
    const zr_vec4 dart[4] = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0.5f, 0.5f, 0, 1}, {0, 2, 0, 1}};
    const uint32_t offsets[2] = {0, 4}, want[2][3] = {{0, 1, 2}, {2, 3, 0}};
    uint32_t out[2][3];
    assert_int_equal(zr_triangulate_count_max(4, 1), 2);
    assert_int_equal(triangulate_points(dart, offsets, 1, out), 2);
    assert_memory_equal(out, want, sizeof want);
    const zr_vec4 from_behind[4] = {{0, 2, 0, 1}, {0.5f, 0.5f, 0, 1}, {2, 0, 0, 1}, {0, 0, 0, 1}};
    const uint32_t want_behind[2][3] = {{3, 0, 1}, {1, 2, 3}};
    assert_int_equal(triangulate_points(from_behind, offsets, 1, out), 2);
    assert_memory_equal(out, want_behind, sizeof want_behind);
}

TEST(triangulate_numbers_corners_as_offsets_do)
{
    const zr_vec4 points[8] = {{NAN, 0, 0, 1}, {NAN, 0, 0, 1}, {0, 0, 0, 1}, {9, 0, 0, 1},
                               {9, 9, 0, 1},   {1, 1, 0, 1},   {2, 1, 0, 1}, {2, 2, 0, 1}};
    const uint32_t offsets[3] = {2, 5, 8};
    uint32_t out[6][3];
    assert_int_equal(zr_triangulate_count_max(6, 2), 6);
    assert_int_equal(triangulate_points(points, offsets, 2, out), 6);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            assert_in_range(out[i][k], 2, 7);
}

TEST(triangulate_rings_of_fewer_than_three_corners_are_left_out)
{
    const zr_vec4 points[6] = {{5, 5, 0, 1}, {6, 7, 0, 1}, {0, 0, 0, 1}, {9, 0, 0, 1}, {0, 9, 0, 1}, {1, 1, 0, 1}};
    const uint32_t offsets[5] = {0, 2, 2, 5, 6};
    uint32_t out[10][3];
    assert_int_equal(triangulate_points(points, offsets, 4, out), 1);
    assert_int_equal(out[0][0] + out[0][1] + out[0][2], 2 + 3 + 4);
    assert_int_equal(triangulate_points(points, offsets, 1, out), 0);
    assert_int_equal(zr_triangulate_count_max(2, 1), 0);
}

TEST(triangulate_scratch_that_grows_one_by_one_stays_small)
{
    struct zr_arena own;
    struct zr_triangulator growing = {.node_capacity = 0};
    zr_arena_init(&own, 1 << 20);
    for (uint32_t corners = 3; corners <= CORNERS_MAX; corners++)
        assert_true(zr_triangulator_reserve(&own, &growing, corners, corners / 3));
    assert_true(own.used <= 4 * zr_triangulate_nodes_max(CORNERS_MAX, RINGS_MAX) * sizeof(struct zr_loop_corner));
    zr_arena_free(&own);
}

TEST(triangulate_without_memory_is_refused)
{
    struct zr_arena small;
    struct zr_triangulator none = {.node_capacity = 0};
    zr_arena_init(&small, 4096);
    assert_true(zr_triangulator_reserve(&small, &none, 10, 2));
    assert_false(zr_triangulator_reserve(&small, &none, 1000, 1));
    assert_int_equal(none.node_capacity, 0);
    assert_int_equal(zr_triangulate_nodes_max(UINT32_MAX, 7), UINT32_MAX);
    zr_arena_free(&small);
}

/* ---- tests: anything else ---- */

TEST(triangulate_self_crossing_rings_keeps_their_edges_modulo_two)
{
    struct random random = random_seeded(4);
    for (uint32_t i = 0; i < 400; i++) {
        uint32_t corner = 0, rings = 1 + random_below(&random, 5), size = i % 2 ? 5 : 100000;
        start(&face);
        for (uint32_t r = 0; r < rings; r++) {
            for (uint32_t k = random_below(&random, 30); k-- > 0;)
                add(&face, &corner, random_below(&random, size), random_below(&random, size));
            end_ring(&face, corner);
        }
        triangulate(&face, &result);
    }
}

TEST(triangulate_corners_on_one_line_or_in_one_place_keeps_their_edges)
{
    struct random random = random_seeded(5);
    for (uint32_t i = 0; i < 200; i++) {
        uint32_t corner = 0, count = 3 + random_below(&random, 40), size = 1 + random_below(&random, 12);
        int64_t x = random_below(&random, 3), y = random_below(&random, 3);
        start(&face);
        for (uint32_t k = 0; k < count; k++) {
            int64_t along = random_below(&random, size);
            add(&face, &corner, along * x, along * y);
            if (k == count / 2 && count > 7) end_ring(&face, corner);
        }
        end_ring(&face, corner);
        triangulate(&face, &result);
        assert_int_equal(area_of_triangles(&face, &result), 0);
    }
}

TEST(triangulate_repeated_corners_and_spikes_keeps_the_area)
{
    struct random random = random_seeded(6);
    for (uint32_t i = 0; i < 300; i++) {
        static struct face plain;
        start(&plain);
        add_star(&plain, &random, 0, 0, i % 2 ? 8 : 10000, 4 + random_below(&random, 30));
        uint32_t corner = 0;
        start(&face);
        for (uint32_t k = 0; k < corners_of(&plain); k++) {
            struct grid_point p = plain.at[k];
            add(&face, &corner, p.x, p.y);
            for (uint32_t more = random_below(&random, 8); more > 5; more--)
                add(&face, &corner, p.x, p.y);
            if (random_below(&random, 4) > 0) continue;
            /* Straight away from the centre, where nothing is met, and back. */
            add(&face, &corner, p.x * 2, p.y * 2);
            add(&face, &corner, p.x, p.y);
        }
        end_ring(&face, corner);
        triangulate(&face, &result);
        assert_int_equal(area_of_triangles(&face, &result), llabs(ring_area(&plain, 0)));
    }
}

TEST(triangulate_point_at_infinity_or_behind_gives_fans)
{
    zr_vec4 points[7] = {{0, 0, 0, 1}, {9, 0, 0, 1}, {1, 1, 0, 0}, {0, 9, 0, 1},
                         {1, 1, 0, 1}, {2, 1, 0, 1}, {1, 2, 0, 1}};
    const uint32_t offsets[3] = {0, 4, 7};
    const uint32_t want[3][3] = {{1, 2, 0}, {2, 3, 0}, {5, 6, 4}};
    uint32_t out[8][3];
    assert_int_equal(triangulate_points(points, offsets, 2, out), 3);
    assert_memory_equal(out, want, sizeof want);
    points[2] = (zr_vec4){-1, -1, 0, -1};
    assert_int_equal(triangulate_points(points, offsets, 2, out), 3);
    assert_memory_equal(out, want, sizeof want);
}

/* assert_sane looks at the bound. */
TEST(triangulate_most_corners_stays_within_its_bound)
{
    struct random random = random_seeded(8);
    for (int64_t size = 3; size < 1000000; size *= 40) {
        uint32_t corner = 0;
        start(&face);
        while (corner < CORNERS_MAX)
            add(&face, &corner, random_below(&random, (uint32_t)size), random_below(&random, (uint32_t)size));
        end_ring(&face, corner);
        triangulate(&face, &result);
        assert_int_equal(result.count, CORNERS_MAX - 2);
        face.rings = 0;
        while (face.rings < RINGS_MAX)
            end_ring(&face, 3 * face.rings + 3);
        triangulate(&face, &result);
    }
}

RUN_TESTS(open_arena, close_arena)
