/* Laying a model on another one. */
#include "base/trig.h"
#include "measure/align.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

/* Turns by degrees around (1, 2, 3) and (3, -1, 1), and moves. */
static struct zr_rigid motion_of(double degrees)
{
    static const double axes[2][3] = {{1, 2, 3}, {3, -1, 1}};
    struct zr_rigid all = zr_rigid_none();
    for (int i = 0; i < 2; i++) {
        double s, c;
        zr_sine_cosine(i == 0 ? degrees : 0.5 * degrees, &s, &c);
        const double *a = axes[i], length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), x = a[0] / length,
                     y = a[1] / length, z = a[2] / length, r = 1 - c;
        const struct zr_rigid turn = {{{c + x * x * r, x * y * r - z * s, x * z * r + y * s},
                                       {x * y * r + z * s, c + y * y * r, y * z * r - x * s},
                                       {x * z * r - y * s, y * z * r + x * s, c + z * z * r}},
                                      {0.25, -0.5, 0.75}};
        all = zr_rigid_after(&all, &turn);
    }
    return all;
}

/* A bracket: boxes of one mesh, that overlap. */
static struct model bracket(double boss)
{
    struct model m = model_begin(&arena, 24, 18);
    model_add_box(&m, (const double[3]){0, 0, 0}, (const double[3]){4, 3, 0.5});
    model_add_box(&m, (const double[3]){0, 0, 0.25}, (const double[3]){0.5, 3, 2});
    model_add_box(&m, (const double[3]){2, 1, 0.25}, (const double[3]){1, boss, 1});
    return m;
}

/* Lays a moved copy of b on a. */
static struct zr_alignment align(const struct zr_mesh *a, const struct zr_mesh *b, double degrees, enum zr_align kind,
                                 double *distance)
{
    const struct zr_run run = {.arena = &arena};
    const struct zr_world_place zero = {0, 0, 0};
    const struct zr_solid first = model_solid(&run, a, &zero);
    struct zr_solid second = model_solid(&run, b, &zero), again = second;
    const struct zr_rigid motion = motion_of(degrees);
    struct zr_world_place *places = zr_arena_copy(&arena, second.places, second.place_count * sizeof *second.places);
    struct zr_surface_tree tree;
    struct zr_alignment out;
    if (degrees != 0) zr_align_move(&second, &motion, NULL);
    assert_int_equal(zr_surface_tree_make(&run, &first, &tree), ZR_OK);
    assert_int_equal(zr_align_find(&run, &tree, &second, kind, false, &out), ZR_OK);
    assert_false(out.is_omitted);
    zr_align_move(&second, &out.motion, NULL);
    *distance = 0;
    for (uint32_t i = 0; i < again.place_count; i++) {
        const struct zr_world_place way = zr_world_place_minus(second.places[i], places[i]);
        *distance = fmax(*distance, sqrt(zr_world_place_dot(way, way)));
    }
    return out;
}

TEST_AROUND(a_turned_and_moved_part_is_found, open_arena, close_arena)
{
    const struct model part = bracket(0.75);
    double distance;
    const struct zr_alignment out = align(&part.mesh, &part.mesh, 77, ZR_ALIGN_PRINCIPAL, &distance);
    assert_true(out.before > 0.1);
    assert_near(out.after, 0, 1e-13);
    assert_near(distance, 0, 1e-13);
    assert_true(out.ambiguous_count == 0 && !out.is_mirrored);
}

TEST_AROUND(a_scaled_part_is_found, open_arena, close_arena)
{
    const struct model part = bracket(0.75), changed = bracket(0.8);
    for (int i = 0; i < 4; i++) {
        const struct zr_run run = {.arena = &arena};
        const struct zr_world_place zero = {0, 0, 0};
        const enum zr_align kind = i == 0 ? ZR_ALIGN_ICP : ZR_ALIGN_PRINCIPAL;
        const struct zr_solid first = model_solid(&run, &part.mesh, &zero);
        struct zr_solid second = model_solid(&run, i < 3 ? &part.mesh : &changed.mesh, &zero);
        const double area = second.area;
        const struct zr_rigid motion = motion_of(i == 0 ? 0 : 77), size = zr_rigid_scaling(zero, 25.4);
        struct zr_surface_tree tree;
        struct zr_alignment out;
        if (i > 0) zr_align_move(&second, &motion, NULL);
        zr_align_move(&second, &size, NULL);
        assert_near(second.area, 25.4 * 25.4 * area, 1e-9 * second.area);
        const struct zr_rigid before = zr_align_size(&first, &second, kind, NULL);
        assert_near(zr_rigid_scale(&before) * 25.4, 1, i < 3 ? 1e-12 : 0.02);
        zr_align_move(&second, &before, NULL);
        assert_int_equal(zr_surface_tree_make(&run, &first, &tree), ZR_OK);
        assert_int_equal(zr_align_find(&run, &tree, &second, kind, true, &out), ZR_OK);
        if (i > 0) assert_near(zr_rigid_scale(&before) * zr_rigid_scale(&out.motion) * 25.4, 1, i < 3 ? 1e-12 : 1e-3);
        if (i == 1 || i == 2) assert_near(out.after, 0, 1e-12);
    }
}

TEST_AROUND(a_changed_feature_moves_nothing, open_arena, close_arena)
{
    const struct model a = bracket(0.75), b = bracket(1.25);
    double distance;
    align(&a.mesh, &b.mesh, 50, ZR_ALIGN_PRINCIPAL, &distance);
    assert_near(distance, 0, 1e-9);
}

TEST_AROUND(icp_finds_a_part_that_is_nearly_in_place, open_arena, close_arena)
{
    const struct model part = bracket(0.75);
    const struct zr_run run = {.arena = &arena};
    const struct zr_world_place zero = {0, 0, 0};
    const struct zr_solid first = model_solid(&run, &part.mesh, &zero);
    struct zr_solid second = model_solid(&run, &part.mesh, &zero);
    const struct zr_rigid motion =
        zr_rigid_of_step(zero, (const double[3]){0.02, -0.03, 0.05}, (const double[3]){0.03, 0.02, -0.05});
    struct zr_surface_tree tree;
    struct zr_alignment out;
    zr_align_move(&second, &motion, NULL);
    assert_int_equal(zr_surface_tree_make(&run, &first, &tree), ZR_OK);
    assert_int_equal(zr_align_find(&run, &tree, &second, ZR_ALIGN_ICP, false, &out), ZR_OK);
    assert_near(out.after, 0, 1e-13);
}

TEST_AROUND(boxes_are_laid_on_each_other_by_their_middles, open_arena, close_arena)
{
    const struct model a = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1}),
                       b = model_box(&arena, (const double[3]){5, 6, 7}, (const double[3]){1, 1, 1});
    double distance;
    const struct zr_alignment out = align(&a.mesh, &b.mesh, 0, ZR_ALIGN_BOUNDS, &distance);
    assert_near(out.motion.shift[0], -5, 1e-12);
    assert_near(out.motion.shift[2], -7, 1e-12);
    assert_near(out.after, 0, 1e-12);
}

/* A plate can be laid on itself in four ways; the given place wins. */
TEST_AROUND(a_symmetric_part_is_ambiguous_and_stays, open_arena, close_arena)
{
    const struct model plate = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){4, 3, 1});
    double distance;
    const struct zr_alignment out = align(&plate.mesh, &plate.mesh, 0, ZR_ALIGN_PRINCIPAL, &distance);
    assert_true(distance < 1e-12);
    assert_int_equal(out.ambiguous_count, 3);
}

TEST_AROUND(a_mirrored_part_is_told_and_not_taken, open_arena, close_arena)
{
    const struct model part = bracket(0.75);
    struct model other = bracket(0.75);
    for (uint32_t i = 0; i < other.mesh.position_count; i++)
        other.positions[i].y = -other.positions[i].y;
    for (uint32_t f = 0; f < other.mesh.face_count; f++)
        for (uint32_t k = 0; k < 2; k++) {
            const uint32_t at = other.indices[4 * f + k];
            other.indices[4 * f + k] = other.indices[4 * f + 3 - k];
            other.indices[4 * f + 3 - k] = at;
        }
    double distance;
    const struct zr_alignment out = align(&part.mesh, &other.mesh, 30, ZR_ALIGN_PRINCIPAL, &distance);
    const double(*t)[3] = out.motion.turn;
    assert_true(out.is_mirrored);
    assert_near(t[0][0] * (t[1][1] * t[2][2] - t[1][2] * t[2][1]) - t[0][1] * (t[1][0] * t[2][2] - t[1][2] * t[2][0]) +
                    t[0][2] * (t[1][0] * t[2][1] - t[1][1] * t[2][0]),
                1, 1e-9);
}

TEST_AROUND(turned_bodies_with_equal_moments_are_found, open_arena, close_arena)
{
    /* a square plate with a small box on a corner: two moments are nearly equal */
    struct model m = model_begin(&arena, 16, 12);
    model_add_box(&m, (const double[3]){0, 0, 0}, (const double[3]){3, 3, 1});
    model_add_box(&m, (const double[3]){0.1, 0.2, 0.5}, (const double[3]){0.3, 0.4, 0.7});
    double distance;
    const struct zr_alignment out = align(&m.mesh, &m.mesh, 77, ZR_ALIGN_PRINCIPAL, &distance);
    assert_near(out.after, 0, 1e-12);
    assert_near(distance, 0, 1e-12);
}

RUN_TESTS(NULL, NULL)
