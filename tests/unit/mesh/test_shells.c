/* Shells of the parts of a mesh: which surfaces are one, which are closed, and which are turned inwards. */
#include <string.h>

#include "base/run.h"
#include "mesh/facts/closed_parts.h"
#include "mesh/facts/shells.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 26)

enum { FACES_MOST = 4096 };

/* Quads and triangles that do not share positions. */
static struct soup {
    zr_vec4 positions[4 * FACES_MOST];
    uint32_t offsets[FACES_MOST + 1], indices[4 * FACES_MOST], parts[FACES_MOST];
    uint32_t faces, corners, part;
} soup;

static void begin(void)
{
    soup.faces = soup.corners = soup.part = 0;
}

static void put_face(const zr_vec3 *corners, uint32_t count, bool is_turned)
{
    for (uint32_t i = 0; i < count; i++, soup.corners++) {
        const zr_vec3 at = corners[is_turned ? count - 1 - i : i];
        soup.positions[soup.corners] = (zr_vec4){at.x, at.y, at.z, 1};
        soup.indices[soup.corners] = soup.corners;
    }
    soup.parts[soup.faces] = soup.part;
    soup.offsets[++soup.faces] = soup.corners;
}

/* A box without the first `missing` faces. */
static void put_box(zr_vec3 low, zr_vec3 high, bool is_inward, int missing)
{
    const zr_vec3 c[8] = {low,
                          {high.x, low.y, low.z},
                          {high.x, high.y, low.z},
                          {low.x, high.y, low.z},
                          {low.x, low.y, high.z},
                          {high.x, low.y, high.z},
                          high,
                          {low.x, high.y, high.z}};
    static const int sides[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}};
    for (int side = missing; side < 6; side++) {
        const zr_vec3 corners[4] = {c[sides[side][0]], c[sides[side][1]], c[sides[side][2]], c[sides[side][3]]};
        put_face(corners, 4, is_inward);
    }
}

static void put_cube(float x, float y, float z, float side)
{
    put_box((zr_vec3){x, y, z}, (zr_vec3){x + side, y + side, z + side}, false, 0);
}

static zr_vec3 on_sphere(int row, int column, float radius)
{
    const double polar = M_PI * row / 8, turn = 2 * M_PI * column / 12;
    return (zr_vec3){radius * (float)(sin(polar) * cos(turn)), radius * (float)(sin(polar) * sin(turn)),
                     radius * (float)cos(polar)};
}

static void put_sphere(float radius, bool is_inward)
{
    for (int row = 0; row < 8; row++)
        for (int column = 0; column < 12; column++) {
            const zr_vec3 corners[4] = {on_sphere(row, column, radius), on_sphere(row + 1, column, radius),
                                        on_sphere(row + 1, (column + 1) % 12, radius),
                                        on_sphere(row, (column + 1) % 12, radius)};
            put_face(corners, 4, is_inward);
        }
}

static struct zr_mesh mesh_of_soup(uint32_t parts)
{
    static const char *const names[] = {"a", "b", "c"};
    return (struct zr_mesh){.name = "soup",
                            .position_count = soup.corners,
                            .positions = soup.positions,
                            .face_count = soup.faces,
                            .face_offsets = soup.offsets,
                            .indices = soup.indices,
                            .face_parts = parts > 1 ? soup.parts : NULL,
                            .part_count = parts > 1 ? parts : 0,
                            .part_names = parts > 1 ? names : NULL};
}

static void check(const char *what, uint32_t outward, uint32_t inward, uint32_t flat, uint32_t open)
{
    struct zr_team *team = zr_team_create(4);
    const struct zr_mesh mesh = mesh_of_soup(1);
    for (int i = 0; i < 2; i++) {
        struct zr_shells found;
        uint8_t is_closed;
        assert_true(zr_closed_parts_find(&(struct zr_run){.arena = &arena, .team = i ? team : NULL}, &mesh, &is_closed,
                                         &found));
        if (found.outward != outward || found.inward != inward || found.flat != flat || found.open != open)
            fail_msg("%s: outward %u, inward %u, flat %u, open %u", what, found.outward, found.inward, found.flat,
                     found.open);
        assert_int_equal(is_closed, open == 0);
    }
    zr_team_destroy(team);
}

TEST_AROUND(faces_that_share_an_edge_are_one_shell, open_arena, close_arena)
{
    begin();
    put_cube(0, 0, 0, 1);
    check("a cube", 1, 0, 0, 0);
    put_cube(5, 0, 0, 1);
    put_cube(0.5f, 0.5f, 0.5f, 1);
    check("two cubes that overlap, and one apart", 3, 0, 0, 0);
    begin();
    put_cube(0, 0, 0, 1);
    put_cube(1, 1, 1, 1);
    check("cubes that touch at a corner", 2, 0, 0, 0);
    begin();
    put_cube(0, 0, 0, 1);
    put_cube(1, 1, 0, 1);
    check("cubes that touch along an edge", 1, 0, 0, 0);
    begin();
    put_cube(0, 0, 0, 1);
    put_cube(1, 0.25f, 0.25f, 0.5f);
    check("cubes that touch within a face", 2, 0, 0, 0);
}

TEST_AROUND(a_void_is_a_shell, open_arena, close_arena)
{
    begin();
    put_sphere(2, false);
    put_sphere(1, true);
    check("a hollow sphere", 1, 1, 0, 0);
    put_sphere(0.5f, false);
    check("with a ball in it", 2, 1, 0, 0);
    begin();
    put_box((zr_vec3){1000, 1000, 1000}, (zr_vec3){1001, 1001, 1001}, true, 0);
    check("a cube inside out", 0, 1, 0, 0);
}

TEST_AROUND(open_and_flat_shells_enclose_nothing, open_arena, close_arena)
{
    const zr_vec3 sheet[4] = {{7, 7, 7}, {8, 7.1f, 7.2f}, {8.3f, 8.3f, 7.5f}, {7.3f, 8.2f, 7.3f}};
    begin();
    put_box((zr_vec3){0, 0, 0}, (zr_vec3){1, 1, 1}, false, 1);
    check("a box without a lid", 0, 0, 0, 1);
    put_cube(3, 0, 0, 1);
    put_face(sheet, 4, false);
    check("with a cube and a sheet", 1, 0, 0, 2);
    put_face(sheet, 4, true);
    check("the sheet has two sides", 1, 0, 1, 1);
    begin();
    put_cube(0, 0, 0, 1);
    put_face((const zr_vec3[]){{0, 0, 0}, {1, 0, 0}, {0.5f, -1, 0}}, 3, false);
    check("a cube with a fin, whose edge has three faces", 0, 0, 0, 1);
    begin();
    put_face((const zr_vec3[]){{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 3, false);
    struct zr_shells found;
    uint8_t is_closed;
    const struct zr_mesh mesh = mesh_of_soup(1);
    assert_true(zr_closed_parts_find(&(struct zr_run){.arena = &arena}, &mesh, &is_closed, &found));
    assert_int_equal(found.open + found.outward + found.flat, 0); /* a face without area */
}

/* ---- random meshes ---- */

enum { PLACES = 7, PARTS = 3, ROUND_FACES = 14 };

/* Joins faces until nothing changes. Returns the numbers of closed and open shells of each part. */
static void count_plainly(uint32_t corners[][3], uint32_t faces, uint32_t counts[PARTS][2])
{
    uint32_t shells[ROUND_FACES];
    int uses[ROUND_FACES][PLACES][PLACES];
    memset(counts, 0, PARTS * sizeof *counts);
    for (uint32_t f = 0; f < faces; f++)
        shells[f] = f;
    for (bool changes = true; changes;) {
        changes = false;
        for (uint32_t f = 0; f < faces; f++)
            for (uint32_t g = 0; g < faces; g++)
                for (int i = 0; i < 9; i++) {
                    const uint32_t a = corners[f][i / 3], b = corners[f][(i / 3 + 1) % 3], c = corners[g][i % 3],
                                   d = corners[g][(i % 3 + 1) % 3];
                    const bool is_shared = soup.parts[f] == soup.parts[g] && ((a == c && b == d) || (a == d && b == c));
                    if (!is_shared || shells[f] <= shells[g]) continue;
                    shells[f] = shells[g];
                    changes = true;
                }
    }
    memset(uses, 0, sizeof uses);
    for (uint32_t f = 0; f < faces; f++)
        for (int k = 0; k < 3; k++)
            uses[shells[f]][corners[f][k]][corners[f][(k + 1) % 3]]++;
    for (uint32_t f = 0; f < faces; f++) {
        bool is_open = false;
        for (int i = 0; i < PLACES * PLACES; i++)
            is_open = is_open || uses[f][i / PLACES][i % PLACES] != uses[f][i % PLACES][i / PLACES];
        if (shells[f] == f) counts[soup.parts[f]][is_open]++;
    }
}

static zr_vec3 place(uint32_t number)
{
    return (zr_vec3){(float)(number * number), (float)number, (float)(number % 3)};
}

TEST_AROUND(shells_are_those_of_a_plain_search, open_arena, close_arena)
{
    struct random random = random_seeded(7);
    uint32_t closed_count = 0, several = 0;
    for (int round = 0; round < 5000; round++) {
        uint32_t corners[ROUND_FACES][3], wanted[PARTS][2];
        const uint32_t faces = 1 + random_below(&random, ROUND_FACES);
        begin();
        for (uint32_t f = 0; f < faces; f++) {
            const bool is_twin = f > 0 && random_below(&random, 2) == 0;
            const uint32_t of = is_twin ? random_below(&random, f) : 0, a = random_below(&random, PLACES);
            const uint32_t b = (a + 1 + random_below(&random, 2)) % PLACES,
                           c = (b + 1 + random_below(&random, 2)) % PLACES;
            soup.part = is_twin ? soup.parts[of] : random_below(&random, PARTS);
            for (int k = 0; k < 3; k++)
                corners[f][k] = is_twin ? corners[of][2 - k] : (const uint32_t[]){a, b, c}[k];
            put_face((const zr_vec3[]){place(corners[f][0]), place(corners[f][1]), place(corners[f][2])}, 3, false);
        }
        count_plainly(corners, faces, wanted);
        struct zr_shells found[PARTS];
        uint8_t is_closed[PARTS];
        const struct zr_mesh mesh = mesh_of_soup(PARTS);
        assert_true(zr_closed_parts_find(&(struct zr_run){.arena = &arena}, &mesh, is_closed, found));
        for (int p = 0; p < PARTS; p++) {
            const uint32_t closed = found[p].outward + found[p].inward + found[p].flat;
            if (closed != wanted[p][0] || found[p].open != wanted[p][1])
                fail_msg("round %d, part %d: %u closed, %u open; not %u, %u", round, p, closed, found[p].open,
                         wanted[p][0], wanted[p][1]);
            assert_int_equal(is_closed[p], closed > 0 && found[p].open == 0);
            assert_int_equal(found[p].open > 0, found[p].open_edges.count + found[p].flipped_edges.count > 0);
            closed_count += closed;
            several += closed + found[p].open > 1;
        }
    }
    assert_true(closed_count > 1000 && several > 1000);
}

RUN_TESTS(NULL, NULL)
