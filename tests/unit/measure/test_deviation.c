/* Distances between surfaces, against formulas. */
#include "base/team.h"
#include "measure/deviation.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static struct zr_surface_tree tree_of(const struct zr_mesh *mesh, const struct zr_world_place *middle)
{
    const struct zr_run run = {.arena = &arena};
    struct zr_solid *solid = zr_arena_alloc(&arena, 1, sizeof *solid);
    struct zr_surface_tree tree;
    *solid = model_solid(&run, mesh, middle);
    assert_int_equal(zr_surface_tree_make(&run, solid, &tree), ZR_OK);
    return tree;
}

static struct zr_deviation deviation_of(const struct zr_mesh *a, const struct zr_mesh *b, struct zr_team *team)
{
    const struct zr_run run = {.arena = &arena, .team = team};
    const struct zr_world_place zero = {0, 0, 0};
    const struct zr_surface_tree first = tree_of(a, &zero), second = tree_of(b, &zero);
    const struct zr_deviation_side from = {.tree = &first}, to = {.tree = &second};
    struct zr_deviation out;
    assert_int_equal(zr_deviation_find(&run, &from, &to, 20000, 0.01, &out), ZR_OK);
    assert_false(out.is_omitted);
    return out;
}

/* The signed distance of a place from a box around the origin. */
static double distance_of_box(const double at[3], const double half[3])
{
    double outside = 0, inside = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        const double gap = fabs(at[k]) - half[k];
        if (gap > 0) outside += gap * gap;
        inside = fmax(inside, gap);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

TEST_AROUND(distances_from_a_box_are_those_of_the_formula, open_arena, close_arena)
{
    const double half[3] = {1, 0.5, 0.25};
    const struct model box = model_box(&arena, (const double[3]){-1, -0.5, -0.25}, (const double[3]){2, 1, 0.5});
    const struct zr_surface_tree tree = tree_of(&box.mesh, NULL);
    struct random random = random_seeded(7);
    struct zr_surface_hit hit = {0};
    uint64_t steps = 0;
    for (int i = 0; i < 2000; i++) {
        double at[3];
        for (int k = 0; k < 3; k++)
            at[k] = random_below(&random, 4001) / 1000.0 - 2;
        const struct zr_world_place place = {at[0], at[1], at[2]};
        const double truth = distance_of_box(at, half);
        zr_surface_tree_nearest(&tree, place, -1, &hit, &steps);
        assert_near(sqrt(hit.square), fabs(truth), 1e-15);
        if (truth != 0) assert_int_equal(zr_surface_tree_winding(&tree, place, &steps), truth < 0);
    }
}

/* A walk whose steps are short and long, near the surface and far from it. */
TEST_AROUND(winding_numbers_beside_a_place_are_those_of_whole_rays, open_arena, close_arena)
{
    const struct model torus = model_torus(&arena, 1, 0.4, 60, 30);
    const struct zr_surface_tree tree = tree_of(&torus.mesh, NULL);
    struct random random = random_seeded(3);
    struct zr_surface_hit hit = {0};
    struct zr_surface_ball ball = {.is_known = false};
    uint64_t steps = 0;
    double at[3] = {1, 0, 0};
    int inside = 0;
    for (int i = 0; i < 5000; i++) {
        for (int k = 0; k < 3; k++) {
            const double step = (random_below(&random, 2001) / 1000.0 - 1) * (i % 7 == 0 ? 1 : 0.05);
            if (fabs(at[k] + step) < (k == 2 ? 0.6 : 1.6) && (i % 5 > 0 || k == i % 3)) at[k] += step;
        }
        const struct zr_world_place place = {at[0], at[1], at[2]};
        zr_surface_tree_nearest(&tree, place, -1, &hit, &steps);
        const int winding = zr_surface_tree_winding(&tree, place, &steps);
        assert_int_equal(zr_surface_tree_winding_beside(&tree, place, sqrt(hit.square), &ball, &steps), winding);
        assert_int_equal(zr_surface_tree_within(&tree, place, 0.1, &hit, &steps), hit.square < 0.01);
        inside += winding;
    }
    assert_in_range(inside, 500, 4500);
}

TEST_AROUND(a_fine_mesh_gives_the_same_as_a_walk_over_all_triangles, open_arena, close_arena)
{
    const struct model torus = model_torus(&arena, 1, 0.4, 61, 37);
    const struct zr_surface_tree tree = tree_of(&torus.mesh, NULL);
    struct random random = random_seeded(8);
    uint64_t steps = 0;
    for (int i = 0; i < 500; i++) {
        const struct zr_world_place at = {random_below(&random, 4001) / 1000.0 - 2,
                                          random_below(&random, 4001) / 1000.0 - 2,
                                          random_below(&random, 2001) / 1000.0 - 1};
        struct zr_surface_hit hit = {.triangle = random_below(&random, tree.solid->count)};
        double least = HUGE_VAL;
        zr_surface_tree_nearest(&tree, at, -1, &hit, &steps);
        for (uint32_t t = 0; t < tree.solid->count; t++) {
            struct zr_surface_tree one = tree;
            struct zr_surface_hit own = {.triangle = t};
            zr_surface_tree_nearest(&one, at, HUGE_VAL, &own, &steps); /* the guess alone */
            least = fmin(least, own.square);
        }
        assert_true(hit.square == least);
        const double ring = sqrt(at.x * at.x + at.y * at.y) - 1, tube = sqrt(ring * ring + at.z * at.z);
        if (fabs(tube - 0.4) > 0.01) assert_int_equal(zr_surface_tree_winding(&tree, at, &steps), tube < 0.4);
    }
    assert_true(steps / 1000 < 20 * tree.solid->count);
}

TEST_AROUND(a_larger_sphere_is_outside_by_the_difference, open_arena, close_arena)
{
    const double zero[3] = {0, 0, 0};
    const struct model a = model_sphere(&arena, 1, 200, zero), b = model_sphere(&arena, 1.1, 200, zero);
    const struct zr_deviation out = deviation_of(&b.mesh, &a.mesh, NULL), in = deviation_of(&a.mesh, &b.mesh, NULL);
    assert_true(out.is_signed && out.points == 20000);
    assert_near(out.mean, 0.1, 1e-3);
    assert_near(out.rms, 0.1, 1e-3);
    assert_near(out.p95, 0.1, 1e-3);
    assert_near(out.max, 0.1, 1e-3);
    assert_near(in.mean, -0.1, 1e-3);
    assert_near(in.max, -0.1, 1e-3);
    assert_near(in.abs, 0.1, 1e-3);
    assert_true(out.within == 0 && out.alignment > 0.999);
}

TEST_AROUND(the_same_surface_of_other_triangles_has_no_distance, open_arena, close_arena)
{
    const double low[3] = {0, 0, 0}, size[3] = {1, 2, 3};
    const struct model a = model_box(&arena, low, size);
    struct model b = model_box(&arena, low, size);
    for (uint32_t f = 0; f < 6; f++) { /* the other diagonal */
        const uint32_t first = b.indices[4 * f];
        memmove(b.indices + 4 * f, b.indices + 4 * f + 1, 3 * sizeof first);
        b.indices[4 * f + 3] = first;
    }
    const struct zr_deviation out = deviation_of(&a.mesh, &b.mesh, NULL);
    assert_near(out.max, 0, 1e-15);
    assert_true(out.within == 1);
    assert_near(out.alignment, 1, 1e-12);
}

/* A spike whose corner no point meets. */
TEST_AROUND(the_largest_distance_is_found_at_a_corner, open_arena, close_arena)
{
    const double low[3] = {0, 0, 0}, size[3] = {1, 1, 1};
    const struct model a = model_box(&arena, low, size);
    struct model b = model_begin(&arena, 9, 9);
    model_add_box(&b, low, size);
    model_place(&b, 0.5, 0.5, 1.75);
    b.mesh.face_count = 0;
    const uint32_t faces[6][4] = {{0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}, {4, 5, 8, 8}};
    for (int f = 0; f < 5; f++)
        model_face(&b, 4, faces[f]);
    const uint32_t top[5] = {4, 5, 7, 6, 4};
    for (int k = 0; k < 4; k++)
        model_face(&b, 3, (const uint32_t[3]){top[k], top[k + 1], 8});
    const struct zr_deviation out = deviation_of(&b.mesh, &a.mesh, NULL);
    assert_near(out.max, 0.75, 1e-15);
    assert_true(out.at.x == 0.5 && out.at.y == 0.5 && out.at.z == 1.75);
}

TEST_AROUND(an_open_surface_has_no_sign, open_arena, close_arena)
{
    struct model a = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1}),
                 b = model_box(&arena, (const double[3]){-1, -1, -1}, (const double[3]){3, 3, 3});
    b.mesh.face_count = 5;
    const struct zr_deviation out = deviation_of(&a.mesh, &b.mesh, NULL);
    assert_true(!out.is_signed && out.max >= 1 && out.mean == out.abs);
}

TEST_AROUND(inner_walls_are_left_out, open_arena, close_arena)
{
    const struct zr_run run = {.arena = &arena};
    struct model a = model_begin(&arena, 16, 12);
    model_add_box(&a, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    model_add_box(&a, (const double[3]){0.5, 0, 0}, (const double[3]){1, 1, 1});
    const struct model b = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1.5, 1, 1});
    const struct zr_surface_tree first = tree_of(&a.mesh, &(struct zr_world_place){0, 0, 0}),
                                 second = tree_of(&b.mesh, &(struct zr_world_place){0, 0, 0});
    const struct zr_deviation_side from = {.tree = &first, .has_overlap = true}, to = {.tree = &second};
    struct zr_deviation out;
    assert_int_equal(zr_deviation_find(&run, &from, &to, 5000, 0.01, &out), ZR_OK);
    assert_true(out.points < 5000 && out.points > 4000);
    assert_near(out.max, 0, 1e-15);
}

TEST_AROUND(distances_are_the_same_for_all_numbers_of_threads, open_arena, close_arena)
{
    const struct model a = model_torus(&arena, 1, 0.4, 100, 60),
                       b = model_sphere(&arena, 1.2, 90, (double[3]){0, 0, 0});
    const struct zr_deviation one = deviation_of(&a.mesh, &b.mesh, NULL);
    struct zr_team *team = zr_team_create(4);
    const struct zr_deviation four = deviation_of(&a.mesh, &b.mesh, team);
    zr_team_destroy(team);
    assert_true(one.mean == four.mean && one.max == four.max && one.p95 == four.p95 && one.at.x == four.at.x);
}

/* Long triangles through one place: each query would visit all of them. */
TEST_AROUND(hostile_triangles_end_without_a_result, open_arena, close_arena)
{
    enum { NEEDLES = 100000 };
    struct model a = model_begin(&arena, 3 * NEEDLES, NEEDLES);
    for (uint32_t i = 0; i < NEEDLES; i++) {
        const double angle = model_pi * i / NEEDLES, x = cos(angle), y = sin(angle);
        model_place(&a, x, y, 1e-3 * i / NEEDLES);
        model_place(&a, -x, -y, 1e-3 * i / NEEDLES);
        model_place(&a, 0, 0, -1);
        model_face(&a, 3, (const uint32_t[3]){3 * i, 3 * i + 1, 3 * i + 2});
    }
    const struct model b = model_box(&arena, (const double[3]){-1, -1, 5}, (const double[3]){2, 2, 1});
    const struct zr_run run = {.arena = &arena};
    const struct zr_world_place zero = {0, 0, 0};
    const struct zr_surface_tree first = tree_of(&b.mesh, &zero), second = tree_of(&a.mesh, &zero);
    const struct zr_deviation_side from = {.tree = &first}, to = {.tree = &second};
    struct zr_deviation out;
    assert_int_equal(zr_deviation_find(&run, &from, &to, 2000, 0.01, &out), ZR_OK);
    assert_true(out.is_omitted);
}

RUN_TESTS(NULL, NULL)
