/* Surfaces that are cut for colours by their distance from another solid. */
#include "base/team.h"
#include "measure/refined.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static double area_of(const struct zr_refined_triangle *t)
{
    const struct zr_world_place n =
        zr_world_place_cross(zr_world_place_minus(t->at[1], t->at[0]), zr_world_place_minus(t->at[2], t->at[0]));
    return 0.5 * sqrt(zr_world_place_dot(n, n));
}

static struct zr_refined refined_of(const struct zr_mesh *a, const struct zr_mesh *b, const struct zr_refining *how,
                                    struct zr_team *team)
{
    const struct zr_run run = {.arena = &arena, .team = team};
    const struct zr_world_place zero = {0, 0, 0};
    struct zr_solid *solids = zr_arena_alloc(&arena, 2, sizeof *solids);
    struct zr_surface_tree tree;
    struct zr_refined out;
    solids[0] = model_solid(&run, a, &zero);
    solids[1] = model_solid(&run, b, &zero);
    assert_int_equal(zr_surface_tree_make(&run, &solids[1], &tree), ZR_OK);
    assert_int_equal(zr_refined_make(&run, &solids[0], &tree, how, &out), ZR_OK);
    assert_false(out.is_omitted);
    return out;
}

/* Two unit cubes, one moved by (0.3, 0, 0): areas of each class by formula. */
TEST_AROUND(classes_have_the_areas_of_the_formulas, open_arena, close_arena)
{
    const struct model a = model_box(&arena, (const double[3]){0.3, 0, 0}, (const double[3]){1, 1, 1}),
                       b = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    const struct zr_refining how = {0.1, 0.005, 1e-6, HUGE_VAL};
    const struct zr_refined all = refined_of(&a.mesh, &b.mesh, &how, NULL);
    double areas[ZR_SURFACE_CLASSES] = {0}, longest = 0;
    for (uint32_t i = 0; i < all.count; i++) {
        areas[all.at[i].own] += area_of(&all.at[i]);
        for (int k = 0; k < 3; k++) {
            const struct zr_world_place way = zr_world_place_minus(all.at[i].at[k], all.at[i].at[(k + 1) % 3]);
            longest = fmax(longest, sqrt(zr_world_place_dot(way, way)));
        }
    }
    assert_near(areas[ZR_SURFACE_NEAR], 4 * 0.7, 0.03);
    assert_near(areas[ZR_SURFACE_OUTSIDE], 4 * 0.3 + 1, 0.03);
    assert_near(areas[ZR_SURFACE_INSIDE], 1, 0.03);
    assert_near(areas[0] + areas[1] + areas[2], 6, 1e-6);
    assert_true(longest <= 0.1);
}

/* Each inner edge is used once in each direction: there are no gaps. */
TEST_AROUND(pieces_meet_along_whole_edges, open_arena, close_arena)
{
    const struct model a = model_sphere(&arena, 1, 24, (const double[3]){0.4, 0, 0}),
                       b = model_sphere(&arena, 1, 24, (const double[3]){0, 0, 0});
    const struct zr_refining how = {0.3, 0.03, 1e-6, HUGE_VAL};
    const struct zr_refined all = refined_of(&a.mesh, &b.mesh, &how, NULL);
    struct zr_run run = {.arena = &arena};
    struct model again = model_begin(&arena, 3 * all.count, all.count);
    for (uint32_t i = 0; i < all.count; i++) {
        for (int k = 0; k < 3; k++)
            model_place(&again, all.at[i].at[k].x, all.at[i].at[k].y, all.at[i].at[k].z);
        model_face(&again, 3, (const uint32_t[3]){3 * i, 3 * i + 1, 3 * i + 2});
    }
    const struct zr_solid solid = model_solid(&run, &again.mesh, NULL);
    assert_true(all.count > a.mesh.face_count && solid.is_closed);
}

TEST_AROUND(pieces_are_the_same_for_all_numbers_of_threads, open_arena, close_arena)
{
    const struct model a = model_torus(&arena, 1, 0.4, 40, 20),
                       b = model_sphere(&arena, 1, 40, (const double[3]){0, 0, 0});
    const struct zr_refining how = {0.3, 0.03, 1e-6, HUGE_VAL};
    const struct zr_refined one = refined_of(&a.mesh, &b.mesh, &how, NULL);
    struct zr_team *team = zr_team_create(4);
    const struct zr_refined four = refined_of(&a.mesh, &b.mesh, &how, team);
    zr_team_destroy(team);
    assert_int_equal(one.count, four.count);
    for (uint32_t i = 0; i < one.count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(one.at[i].at[k].x == four.at[i].at[k].x && one.at[i].distance[k] == four.at[i].distance[k]);
}

RUN_TESTS(NULL, NULL)
