/* Volumes that two solids share, against formulas. */
#include "base/run.h"
#include "base/team.h"
#include "measure/volumes.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static struct zr_volumes volumes_of(const struct zr_mesh *a, const struct zr_mesh *b, uint32_t rays,
                                    struct zr_team *team)
{
    const struct zr_run run = {.arena = &arena, .team = team};
    const struct zr_solid first = model_solid(&run, a, NULL), second = model_solid(&run, b, &first.middle);
    struct zr_volumes out;
    assert_true(first.is_closed && second.is_closed);
    assert_int_equal(zr_volumes_find(&run, &first, &second, rays, 0, &out, NULL), ZR_OK);
    return out;
}

static struct model cube_at(double x)
{
    return model_box(&arena, (const double[3]){x, 0, 0}, (const double[3]){1, 1, 1});
}

TEST_AROUND(a_cube_moved_by_an_eighth_shares_seven_ninths, open_arena, close_arena)
{
    const struct model a = cube_at(0), b = cube_at(0.125);
    const struct zr_volumes v = volumes_of(&a.mesh, &b.mesh, 256, NULL);
    assert_near(v.iou, 7.0 / 9.0, 1e-7);
    assert_near(v.both, 0.875, 1e-6);
    assert_near(v.only_a, 0.125, 1e-6);
    assert_near(v.only_b, 0.125, 1e-6);
    assert_near(v.a.volume, 1, 1e-15);
    assert_true(v.a.error == 0 && !v.a.has_overlap && !v.a.is_inside_out);
}

TEST_AROUND(lens_cylinders_and_torus_are_right_within_half_a_thousandth, open_arena, close_arena)
{
    const double left[3] = {0, 0, 0}, right[3] = {1, 0, 0};
    const struct model sphere = model_sphere(&arena, 1, 512, left), other = model_sphere(&arena, 1, 512, right),
                       along_x = model_cylinder(&arena, 1, 2, 512, 0), along_y = model_cylinder(&arena, 1, 2, 512, 1),
                       torus = model_torus(&arena, 2, 0.5, 512, 256),
                       half = model_box(&arena, (const double[3]){-4, -4, 0}, (const double[3]){8, 8, 4});
    const struct {
        const struct model *a, *b;
        double both;
    } cases[] = {{&sphere, &other, model_pi * 5 / 12},
                 {&along_x, &along_y, 16.0 / 3},
                 {&torus, &half, model_pi * model_pi * 2 * 0.25}};
    for (size_t i = 0; i < 3; i++) {
        const struct zr_volumes v = volumes_of(&cases[i].a->mesh, &cases[i].b->mesh, 256, NULL);
        if (fabs(v.both - cases[i].both) > 5e-4 * cases[i].both)
            fail_msg("case %zu: %.9g for %.9g", i, v.both, cases[i].both);
    }
}

/* A subdivided mesh: each face of a box as triangles around its middle; corners in another order. */
TEST_AROUND(the_same_solid_of_other_triangles_shares_all, open_arena, close_arena)
{
    const struct model sphere = model_sphere(&arena, 1, 128, (const double[3]){0.1, 0.2, 0.3});
    struct model turned = model_begin(&arena, sphere.mesh.position_count, 2 * sphere.mesh.face_count);
    for (uint32_t i = 0; i < sphere.mesh.position_count; i++)
        turned.positions[turned.mesh.position_count++] = sphere.positions[i];
    for (uint32_t f = sphere.mesh.face_count; f-- > 0;) {
        const uint32_t *at = sphere.indices + sphere.offsets[f], corners = sphere.offsets[f + 1] - sphere.offsets[f];
        model_face(&turned, 3, (const uint32_t[3]){at[1], at[2], at[0]});
        if (corners == 4) model_face(&turned, 3, (const uint32_t[3]){at[2], at[3], at[0]});
    }
    const struct zr_volumes same = volumes_of(&sphere.mesh, &sphere.mesh, 256, NULL),
                            v = volumes_of(&sphere.mesh, &turned.mesh, 256, NULL);
    assert_true(same.iou == 1 && same.error == 0);
    assert_true(v.iou == 1 && v.only_a == 0 && v.only_b == 0 && v.error < 1e-9);
}

TEST_AROUND(thin_plates_are_not_lost_between_few_rays, open_arena, close_arena)
{
    const struct model a = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){4, 3, 0.005}),
                       b = model_box(&arena, (const double[3]){1, 0, 0}, (const double[3]){4, 3, 0.005});
    const struct zr_volumes v = volumes_of(&a.mesh, &b.mesh, 64, NULL);
    assert_near(v.iou, 0.6, 1e-2);
    assert_true(fabs(v.iou - 0.6) < v.error + 1e-12);
}

TEST_AROUND(random_boxes_are_within_the_stated_error, open_arena, close_arena)
{
    enum { PAIRS = 48 };
    struct random random = random_seeded(58);
    for (int i = 0; i < PAIRS; i++) {
        double low[2][3], size[2][3], common = 1, volumes[2] = {1, 1};
        for (int k = 0; k < 3; k++) {
            for (int s = 0; s < 2; s++) {
                low[s][k] = random_below(&random, 500) / 1024.0;
                size[s][k] = (random_below(&random, 1000) + 50) / 1024.0;
                volumes[s] *= size[s][k];
            }
            common *= fmax(0, fmin(low[0][k] + size[0][k], low[1][k] + size[1][k]) - fmax(low[0][k], low[1][k]));
        }
        const struct model a = model_box(&arena, low[0], size[0]), b = model_box(&arena, low[1], size[1]);
        const struct zr_volumes v = volumes_of(&a.mesh, &b.mesh, 128, NULL);
        const double iou = common / (volumes[0] + volumes[1] - common);
        if (fabs(v.iou - iou) > v.error + 1e-6 || fabs(v.both - common) > v.volume_error + 1e-6)
            fail_msg("pair %d: %.9g for %.9g, stated error %g", i, v.iou, iou, v.error);
    }
}

TEST_AROUND(overlapping_shells_count_once, open_arena, close_arena)
{
    struct model a = model_begin(&arena, 16, 12);
    model_add_box(&a, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    model_add_box(&a, (const double[3]){0.5, 0, 0}, (const double[3]){1, 1, 1});
    const struct model b = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1.5, 1, 1});
    const struct zr_volumes v = volumes_of(&a.mesh, &b.mesh, 256, NULL);
    assert_true(v.iou == 1 && v.a.has_overlap && !v.b.has_overlap);
    assert_near(v.a.volume, 1.5, 1e-5);
    assert_true(fabs(v.a.volume - 1.5) <= v.a.error);
}

TEST_AROUND(solids_far_from_one_another_share_nothing, open_arena, close_arena)
{
    const struct model a = cube_at(0), b = cube_at(100);
    const struct zr_volumes v = volumes_of(&a.mesh, &b.mesh, 256, NULL);
    assert_true(v.iou == 0 && v.both == 0 && v.a.volume == 1);
}

TEST_AROUND(results_are_the_same_for_all_numbers_of_threads, open_arena, close_arena)
{
    const struct model a = model_torus(&arena, 2, 0.5, 200, 100),
                       b = model_sphere(&arena, 2, 200, (double[3]){1, 0, 0});
    const struct zr_volumes one = volumes_of(&a.mesh, &b.mesh, 256, NULL);
    struct zr_team *team = zr_team_create(4);
    const struct zr_volumes four = volumes_of(&a.mesh, &b.mesh, 256, team);
    zr_team_destroy(team);
    assert_memory_equal(&one, &four, sizeof one);
}

TEST_AROUND(a_raised_cancel_and_a_full_arena_end_it, open_arena, close_arena)
{
    const struct model a = cube_at(0);
    struct zr_cancel cancel = {.raised = true};
    const struct zr_run run = {.arena = &arena}, cancelled = {.arena = &arena, .cancel = &cancel};
    const struct zr_solid solid = model_solid(&run, &a.mesh, NULL);
    struct zr_volumes out;
    struct zr_solid again;
    assert_int_equal(zr_solid_make(&cancelled, model_scene(&a.mesh, 0), NULL, &again), ZR_CANCELLED);
    assert_int_equal(zr_volumes_find(&cancelled, &solid, &solid, 256, 0, &out, NULL), ZR_CANCELLED);
    arena.ceiling = arena.held;
    assert_int_equal(zr_volumes_find(&run, &solid, &solid, 256, 0, &out, NULL), ZR_NO_MEMORY);
}

RUN_TESTS(NULL, NULL)
