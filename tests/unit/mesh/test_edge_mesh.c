/* Edges of a mesh: which triangles meet at which welded edge, compared with a count by brute force. */
#include "base/run.h"
#include "mesh/edge_mesh.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1u << 30)

static struct zr_edge_mesh make(const struct zr_mesh *mesh, struct zr_team *team)
{
    struct zr_edge_mesh out;
    assert_int_equal(zr_edge_mesh_make(&(struct zr_run){.arena = &arena, .team = team}, mesh, &out), ZR_OK);
    return out;
}

static struct zr_edge_mesh make_text(const char *text)
{
    return make(&model_of_text(&arena, text, NULL)->meshes[0], NULL);
}

/* Edges by the number of their triangles, without diagonals: one, two, more. */
struct tally {
    uint32_t borders, inner, more, diagonals;
};

static struct tally tally_of(const struct zr_edge_mesh *mesh)
{
    struct tally tally = {0};
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        const uint32_t count = zr_edge_side_count(mesh, e);
        if (zr_edge_is_diagonal(mesh, e)) {
            tally.diagonals++;
            continue;
        }
        tally.borders += count == 1;
        tally.inner += count == 2;
        tally.more += count > 2;
    }
    return tally;
}

static void assert_tally(const struct zr_edge_mesh *mesh, struct tally want)
{
    const struct tally tally = tally_of(mesh);
    assert_int_equal(tally.borders, want.borders);
    assert_int_equal(tally.inner, want.inner);
    assert_int_equal(tally.more, want.more);
    assert_int_equal(tally.diagonals, want.diagonals);
}

TEST(a_cube_has_twelve_edges_and_six_diagonals)
{
    const struct zr_edge_mesh mesh = make_text(CUBE_CORNERS CUBE_SIDES CUBE_TOP);
    assert_int_equal(mesh.vertex_count, 8);
    assert_int_equal(mesh.triangle_count, 12);
    assert_int_equal(mesh.piece_count, 1);
    assert_tally(&mesh, (struct tally){.inner = 12, .diagonals = 6});
}

TEST(an_open_box_has_four_borders)
{
    const struct zr_edge_mesh mesh = make_text(CUBE_CORNERS CUBE_SIDES);
    assert_tally(&mesh, (struct tally){.borders = 4, .inner = 8, .diagonals = 5});
}

TEST(corners_that_repeat_are_welded)
{
    const struct zr_edge_mesh mesh =
        make_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.piece_count, 1);
    assert_tally(&mesh, (struct tally){.borders = 4, .inner = 1});
}

TEST(three_faces_may_meet_in_an_edge)
{
    const struct zr_edge_mesh mesh =
        make_text("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    assert_tally(&mesh, (struct tally){.borders = 6, .more = 1});
}

TEST(concave_faces_are_cut_within)
{
    const struct zr_edge_mesh mesh = make_text("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n");
    assert_int_equal(mesh.triangle_count, 3);
    assert_tally(&mesh, (struct tally){.borders = 5, .diagonals = 2});
}

TEST(faces_without_area_are_left_out)
{
    const struct zr_edge_mesh mesh = make_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n");
    assert_int_equal(mesh.triangle_count, 1);
    assert_tally(&mesh, (struct tally){.borders = 3});
}

TEST(pieces_are_numbered_by_their_first_triangle)
{
    const struct zr_edge_mesh mesh =
        make_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 1 1 0\nf 4 5 6\nf 1 2 3\nf 2 7 3\n");
    assert_int_equal(mesh.piece_count, 2);
    assert_int_equal(mesh.pieces[0], 0);
    assert_int_equal(mesh.pieces[1], 1);
    assert_int_equal(mesh.pieces[2], 1);
}

TEST(pieces_are_not_connected_where_three_faces_meet)
{
    const struct zr_edge_mesh mesh = make_text("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 1 0 1\nf 1 2 3\n"
                                               "f 1 2 4\nf 1 2 5\nf 2 6 3\n");
    assert_int_equal(mesh.piece_count, 3);
    assert_int_equal(mesh.pieces[3], 0);
}

/* ---- the table itself, of random triangles between few corners ---- */

enum { TRIANGLES = 400, CORNERS = 60 };

static void assert_edge(const struct zr_edge_mesh *mesh, uint32_t edge)
{
    const struct zr_mesh_edge *own = &mesh->edges[edge];
    uint32_t found = 0;
    assert_true(own->low < own->high);
    if (edge > 0) assert_true(own[-1].low < own->low || (own[-1].low == own->low && own[-1].high < own->high));
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t from = mesh->corners[3 * t + k], to = mesh->corners[3 * t + (k + 1) % 3];
            if ((from != own->low || to != own->high) && (from != own->high || to != own->low)) continue;
            assert_int_equal(mesh->sides[own->first_side + found++], 3 * t + k);
            assert_int_equal(mesh->side_edges[3 * t + k], edge);
            assert_int_equal(zr_side_is_upward(mesh, 3 * t + k), from == own->low);
        }
    assert_int_equal(zr_edge_side_count(mesh, edge), found);
    assert_true(found > 0);
}

static struct zr_mesh soup(void)
{
    static zr_vec4 positions[CORNERS];
    static uint32_t offsets[TRIANGLES + 1], indices[3 * TRIANGLES];
    struct random numbers = random_seeded(7);
    for (uint32_t p = 0; p < CORNERS; p++)
        positions[p] = (zr_vec4){(float)(p % 4), (float)(p / 4 % 4), (float)(p / 16), 1.0f};
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        offsets[t + 1] = 3 * (t + 1);
        for (uint32_t k = 0; k < 3; k++)
            indices[3 * t + k] = random_below(&numbers, CORNERS);
    }
    return (struct zr_mesh){.name = "",
                            .position_count = CORNERS,
                            .positions = positions,
                            .face_count = TRIANGLES,
                            .face_offsets = offsets,
                            .indices = indices};
}

TEST(each_side_is_listed_once_at_its_edge)
{
    const struct zr_mesh mesh = soup();
    const struct zr_edge_mesh made = make(&mesh, NULL);
    assert_int_equal(made.edges[made.edge_count].first_side, 3 * made.triangle_count);
    for (uint32_t e = 0; e < made.edge_count; e++)
        assert_edge(&made, e);
}

TEST(threads_make_the_same_table)
{
    const struct zr_scene *scene = model_of_file(&arena, "stanford-bunny.obj", NULL);
    const struct zr_mesh few = soup(), *mesh = scene ? &scene->meshes[0] : &few;
    struct zr_team *team = zr_team_create(4);
    const struct zr_edge_mesh one = make(mesh, NULL), four = make(mesh, team);
    assert_int_equal(one.edge_count, four.edge_count);
    assert_memory_equal(one.edges, four.edges, (one.edge_count + 1) * sizeof *one.edges);
    assert_memory_equal(one.sides, four.sides, 3 * one.triangle_count * sizeof *one.sides);
    assert_memory_equal(one.side_edges, four.side_edges, 3 * one.triangle_count * sizeof *one.side_edges);
    assert_memory_equal(one.pieces, four.pieces, one.triangle_count * sizeof *one.pieces);
    zr_team_destroy(team);
}

RUN_TESTS(open_arena, close_arena)
