/* Features of parts beside holes (test_holes.c): planes, open loops, bounding cylinders, symmetry; threads, turned and
 * mirrored parts, and cancellation. */
#include <math.h>
#include <string.h>

#include "mesh/features/angles.h"
#include "mesh/features/part_features.h"
#include "property/cancel_check.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/placed_parts.h"
#include "unit/common/plates.h"

TEST_ARENA((size_t)2 << 30)

static const struct drill one_hole[] = {{-12, 7, 2, 0, 24, 0, 0, 0, 0, 0}};

static const struct zr_part_features *find(struct zr_team *team, const zr_mat4 *matrix)
{
    placed_begin(1, 1);
    placed.meshes[0] = plate_mesh();
    if (matrix) placed.instances[0].object_to_world = *matrix;
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 1);
    const struct zr_run run = {.arena = &arena, .scratch = &arena, .team = team};
    struct zr_part_facts *facts = zr_arena_alloc(&arena, 1, sizeof *facts);
    struct zr_part_features *features = zr_arena_alloc(&arena, 1, sizeof *features);
    assert_int_equal(zr_part_facts_find(&run, &placed.test.scene, &list, facts), ZR_OK);
    assert_int_equal(zr_part_features_find(&run, &placed.test.scene, &list, facts, features), ZR_OK);
    assert_false(features->is_omitted);
    return features;
}

static void assert_about(double value, double want)
{
    if (!(fabs(value - want) <= 1e-5 * (1.0 + fabs(want)))) fail_msg("%.9g, not %.9g", value, want);
}

TEST(angles_are_those_of_libm)
{
    struct random random = random_seeded(3);
    for (int i = 0; i < 100000; i++) {
        const double x = random_range(&random, -1, 1), y = random_range(&random, -1, 1);
        double want = atan2(y, x) * 57.295779513082320877;
        if (want < 0.0) want += 360.0;
        if (!(fabs(zr_angle_of(x, y) - want) <= 1e-9)) fail_msg("(%.17g, %.17g)", x, y);
    }
    struct zr_angle_set set = {{0}};
    zr_angle_set_add(&set, 350.0, 10.0);
    zr_angle_set_add(&set, 90.0, 100.0);
    assert_about(zr_angle_set_degrees(&set), 30.0);
    assert_int_equal(zr_angle_set_arcs(&set), 2);
    zr_angle_set_add(&set, 10.0, 350.0);
    assert_about(zr_angle_set_degrees(&set), 360.0);
    assert_int_equal(zr_angle_set_arcs(&set), 1);
}

TEST_AROUND(parts_that_share_too_few_steps_name_them, open_arena, close_arena)
{
    enum { PARTS = 1000 };
    static struct zr_instance instances[PARTS];
    plate_begin();
    plate_drilled(40, 26, 6, one_hole, 1);
    placed_begin(1, 1);
    placed.meshes[0] = plate_mesh();
    for (int i = 0; i < PARTS; i++)
        instances[i] = placed.instances[0];
    placed.test.scene.instances = instances;
    placed.test.scene.instance_count = PARTS;
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, PARTS);
    const struct zr_run run = {.arena = &arena, .scratch = &arena};
    struct zr_part_facts *facts = zr_arena_alloc(&arena, PARTS, sizeof *facts);
    struct zr_part_features *features = zr_arena_alloc(&arena, PARTS, sizeof *features);
    assert_int_equal(zr_part_facts_find(&run, &placed.test.scene, &list, facts), ZR_OK);
    assert_int_equal(zr_part_features_find(&run, &placed.test.scene, &list, facts, features), ZR_OK);
    for (int i = 0; i < PARTS; i++) {
        assert_true(features[i].is_omitted);
        assert_int_equal(features[i].limit, ZR_FEATURE_LIMIT_STEPS);
        assert_int_equal(features[i].steps_most, ZR_FEATURE_STEPS_MIN / PARTS + ZR_FEATURE_STEPS * facts[i].triangles);
        assert_int_equal(features[i].holes.hole_count, 0);
    }
}

TEST_AROUND(a_box_has_six_planes_and_three_mirrors, open_arena, close_arena)
{
    plate_begin();
    plate_drilled(40, 26, 6, NULL, 0);
    const struct zr_part_features *found = find(NULL, NULL);
    const double areas[] = {1040, 1040, 240, 240, 156, 156};
    assert_int_equal(found->planes.count, 6);
    for (uint32_t i = 0; i < 6; i++) {
        const struct zr_plane *plane = &found->planes.at[i];
        const zr_dvec3 n = plane->normal;
        assert_about(plane->area, areas[i]);
        assert_about(plane->offset, fabs(20 * n.x) + fabs(13 * n.y) + (n.z > 0.5 ? 6 : 0));
    }
    assert_int_equal(found->symmetry.mirror_count, 3);
    assert_int_equal(found->symmetry.turn_count, 3);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(found->symmetry.turns[i].order, 2);
    assert_true(found->cylinder.is_found);
    assert_about(found->cylinder.diameter, sqrt(40 * 40 + 26 * 26));
    assert_about(found->cylinder.height, 6);
    assert_about(found->cylinder.axis.z, 1);
    assert_int_equal(found->borders.count, 0);
    assert_true(found->tunnels.is_known && found->tunnels.count == 0);
}

TEST_AROUND(holes_break_a_symmetry, open_arena, close_arena)
{
    struct drill drills[4];
    for (int i = 0; i < 4; i++) {
        double s, c;
        zr_sine_cosine(90.0 * i + 20.0, &s, &c);
        drills[i] = (struct drill){.x = 8 * c, .y = 8 * s, .radius = 1, .segments = 24};
    }
    plate_begin();
    plate_drilled(30, 30, 4, drills, 4);
    const struct zr_part_features *found = find(NULL, NULL);
    assert_int_equal(found->symmetry.mirror_count, 1); /* across z */
    assert_int_equal(found->symmetry.turn_count, 1);
    assert_int_equal(found->symmetry.turns[0].order, 4);
    const struct zr_pattern *grid = &found->holes.holes[0].pattern;
    assert_int_equal(grid->kind, ZR_PATTERN_GRID);
    assert_int_equal(grid->counts[0], 2);
    assert_int_equal(grid->counts[1], 2);
    assert_about(grid->pitch[0], 8 * sqrt(2));
    assert_about(grid->pitch[1], 8 * sqrt(2));
    plate_begin();
    plate_drilled(40, 26, 4, one_hole, 1);
    found = find(NULL, NULL);
    assert_int_equal(found->symmetry.mirror_count, 1);
    assert_int_equal(found->symmetry.turn_count, 0);
}

TEST_AROUND(equal_holes_have_patterns, open_arena, close_arena)
{
    struct drill drills[12];
    plate_begin();
    for (int i = 0; i < 5; i++) {
        double s, c;
        zr_sine_cosine(72.0 * i, &s, &c);
        drills[i] = (struct drill){.x = 9 * c - 15, .y = 9 * s + 1, .radius = 1, .segments = 24};
    }
    for (int i = 0; i < 6; i++)
        drills[5 + i] = (struct drill){.x = 5.0 * (i % 3) + 6, .y = 7.0 * (i / 3), .radius = 1.5, .segments = 24};
    plate_drilled(60, 40, 4, drills, 11);
    const struct zr_holes *holes = &find(NULL, NULL)->holes;
    int circles = 0, grids = 0;
    assert_int_equal(holes->hole_count, 11);
    for (uint32_t i = 0; i < holes->hole_count; i++) {
        const struct zr_pattern *pattern = &holes->holes[i].pattern;
        if (holes->holes[i].group != i) continue;
        circles += pattern->kind == ZR_PATTERN_CIRCLE;
        grids += pattern->kind == ZR_PATTERN_GRID;
        if (pattern->kind == ZR_PATTERN_CIRCLE) {
            assert_about(pattern->diameter, 18);
            assert_about(pattern->center.x, -15);
            assert_about(pattern->center.y, 1);
        } else {
            assert_int_equal(pattern->counts[0], 3);
            assert_int_equal(pattern->counts[1], 2);
            assert_about(pattern->pitch[0], 5);
            assert_about(pattern->pitch[1], 7);
        }
    }
    assert_int_equal(circles, 1);
    assert_int_equal(grids, 1);
    drills[3].x += 0.1;
    plate_begin();
    plate_drilled(60, 40, 4, drills, 5);
    assert_int_equal(find(NULL, NULL)->holes.holes[0].pattern.kind, ZR_PATTERN_NONE);
}

TEST_AROUND(a_tube_is_round, open_arena, close_arena)
{
    static const double profile[4][2] = {{3, 0}, {5, 0}, {5, 12}, {3, 12}};
    plate_begin();
    plate_turned(profile, 4, 96, true);
    const struct zr_part_features *found = find(NULL, NULL);
    assert_int_equal(found->symmetry.mirror_count, 3);
    assert_int_equal(found->symmetry.turn_count, 3);
    for (uint32_t i = 0; i < 3; i++)
        assert_int_equal(found->symmetry.turns[i].order, found->symmetry.turns[i].axis.z > 0.5 ? 0 : 2);
    assert_about(found->cylinder.diameter, 10);
    assert_about(found->cylinder.height, 12);
    assert_about(found->cylinder.at.z, 0);
    assert_true(found->tunnels.is_known && found->tunnels.count == 1);
}

TEST_AROUND(tunnels_are_counted_of_all_surfaces_that_do_not_overlap, open_arena, close_arena)
{
    const struct drill drills[] = {{-12, 7, 2, 0, 24, 0, 0, 0, 0, 0},
                                   {12, 7, 2, 0, 4, 0, 0, 0, 0, 0}, /* square */
                                   {0, -7, 2, 3, 24, 0, 0, 0, 0, 0} /* blind */};
    plate_begin();
    plate_drilled(40, 26, 6, drills, 3);
    const struct zr_part_features *found = find(NULL, NULL);
    assert_true(found->tunnels.is_known && found->tunnels.count == 2);
    plate_begin();
    plate_drilled(40, 26, 6, drills, 3);
    plate_drilled(40, 26, 4, drills, 1); /* within the first one */
    assert_false(find(NULL, NULL)->tunnels.is_known);
}

TEST_AROUND(open_parts_have_loops_with_places, open_arena, close_arena)
{
    plate_begin();
    plate_drilled(40, 26, 6, one_hole, 1);
    plate.faces--; /* the bottom */
    plate.rings -= 2;
    plate.corners -= 4 + one_hole[0].segments;
    const struct zr_part_features *found = find(NULL, NULL);
    assert_int_equal(found->borders.count, 2);
    assert_int_equal(found->borders.at[0].edges, 4);
    assert_about(found->borders.at[0].length, 132);
    assert_int_equal(found->borders.at[1].edges, 24);
    assert_about(found->borders.at[1].center.x, -12);
    assert_about(found->borders.at[1].center.y, 7);
    assert_about(found->borders.at[1].center.z, 0);
    assert_true(found->borders.at[0].is_closed && found->borders.at[1].is_closed);
    assert_int_equal(found->holes.hole_count, 1);
    assert_false(found->tunnels.is_known);
}

TEST_AROUND(holes_stay_holes_in_mirrored_and_inverted_parts, open_arena, close_arena)
{
    const zr_mat4 mirror = {{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}};
    for (int k = 0; k < 4; k++) {
        plate_begin();
        plate_drilled(40, 26, 6, one_hole, 1);
        for (uint32_t r = 0; k / 2 == 1 && r < plate.rings; r++) { /* inside out */
            const uint32_t begin = plate.ring_offsets[r],
                           end = r + 1 < plate.rings ? plate.ring_offsets[r + 1] : plate.corners;
            for (uint32_t i = begin, j = end - 1; i < j; i++, j--) {
                const uint32_t held = plate.index[i];
                plate.index[i] = plate.index[j];
                plate.index[j] = held;
            }
        }
        const struct zr_holes *holes = &find(NULL, k % 2 ? &mirror : NULL)->holes;
        assert_int_equal(holes->hole_count, 1);
        assert_int_equal(holes->boss_count, 0);
        assert_int_equal(holes->holes[0].reach, ZR_REACH_THROUGH);
        assert_about(holes->holes[0].at.x, k % 2 ? 17 : -12);
        assert_about(holes->holes[0].at.z, k % 2 ? 13 : 6);
    }
}

TEST_AROUND(threads_change_nothing, open_arena, close_arena)
{
    struct zr_team *team = zr_team_create(3);
    assert_non_null(team);
    plate_begin();
    plate_turn(37.3, 21.1, 5, 60, -30);
    plate_drilled(40, 26, 6, one_hole, 1);
    const struct zr_part_features *a = find(NULL, NULL), *b = find(team, NULL);
    assert_int_equal(a->holes.hole_count, b->holes.hole_count);
    assert_memory_equal(a->holes.holes, b->holes.holes, a->holes.hole_count * sizeof *a->holes.holes);
    assert_int_equal(a->planes.count, b->planes.count);
    assert_memory_equal(a->planes.at, b->planes.at, a->planes.count * sizeof *a->planes.at);
    assert_memory_equal(&a->symmetry, &b->symmetry, sizeof a->symmetry);
    zr_team_destroy(team);
}

/* ---- any triangles ---- */

TEST_AROUND(triangles_of_any_kind_are_looked_at, open_arena, close_arena)
{
    enum { PLACES = 60, TRIANGLES = 200 };
    static zr_vec4 positions[PLACES];
    static uint32_t indices[3 * TRIANGLES], offsets[TRIANGLES + 1];
    struct random random = random_seeded(11);
    for (int i = 0; i < 400; i++) {
        const uint32_t places = 3 + (uint32_t)(random_next(&random) % (PLACES - 3)),
                       triangles = 1 + (uint32_t)(random_next(&random) % TRIANGLES);
        const int kind = (int)(random_next(&random) % 4);
        for (uint32_t k = 0; k < places; k++) {
            double s, c;
            zr_sine_cosine(random_range(&random, 0, 360), &s, &c);
            positions[k] = kind == 0   ? (zr_vec4){(float)(random_next(&random) % 3), (float)(random_next(&random) % 3),
                                                   (float)(random_next(&random) % 3), 1}
                           : kind == 1 ? (zr_vec4){(float)c, (float)s, (float)(random_next(&random) % 3), 1}
                           : kind == 2 ? (zr_vec4){(float)c, (float)s, 0, 1}
                                       : (zr_vec4){(float)random_range(&random, -1e30, 1e30), (float)s, (float)c, 1};
        }
        for (uint32_t k = 0; k < 3 * triangles; k++)
            indices[k] = (uint32_t)(random_next(&random) % places);
        for (uint32_t k = 0; k <= triangles; k++)
            offsets[k] = 3 * k;
        placed_begin(1, 1);
        placed.meshes[0] = (struct zr_mesh){.name = "any",
                                            .position_count = places,
                                            .positions = positions,
                                            .face_count = triangles,
                                            .face_offsets = offsets,
                                            .indices = indices};
        const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 1);
        const struct zr_run run = {.arena = &arena, .scratch = &arena};
        const struct zr_part_facts facts = {.triangles = triangles};
        struct zr_part_features features;
        assert_int_equal(zr_part_features_find(&run, &placed.test.scene, &list, &facts, &features), ZR_OK);
        for (uint32_t k = 0; k < features.holes.hole_count; k++)
            assert_true(isfinite(features.holes.holes[k].diameter) && isfinite(features.holes.holes[k].at.x));
        for (uint32_t k = 0; k < features.planes.count; k++)
            assert_true(isfinite(features.planes.at[k].offset));
        assert_true(!features.cylinder.is_found || isfinite(features.cylinder.diameter));
        zr_arena_reset(&arena, SIZE_MAX);
    }
}

/* Makes a sphere with a rough surface, of 2 side^2 triangles. */
static struct zr_mesh rough_sphere(uint32_t side)
{
    struct random random = random_seeded(7);
    zr_vec4 *positions = zr_arena_alloc(&arena, (size_t)side * side, sizeof *positions);
    uint32_t *indices = zr_arena_alloc(&arena, 6 * (size_t)side * side, sizeof *indices);
    uint32_t *offsets = zr_arena_alloc(&arena, 2 * (size_t)side * side + 1, sizeof *offsets), corners = 0;
    assert_true(positions && indices && offsets);
    for (uint32_t i = 0; i < side; i++)
        for (uint32_t k = 0; k < side; k++) {
            double s, c, sk, ck;
            const double radius = random_range(&random, 1.0, 1.0005);
            zr_sine_cosine(178.0 * i / side + 1.0, &s, &c);
            zr_sine_cosine(360.0 * k / side, &sk, &ck);
            positions[i * side + k] =
                (zr_vec4){(float)(radius * s * ck), (float)(radius * s * sk), (float)(radius * c), 1};
            const uint32_t a = i * side + k, b = i * side + (k + 1) % side;
            const uint32_t quad[6] = {a, a + side, b, b, a + side, b + side};
            if (i + 1 == side) continue;
            memcpy(indices + corners, quad, sizeof quad);
            corners += 6;
        }
    for (uint32_t f = 0; f <= corners / 3; f++)
        offsets[f] = 3 * f;
    return (struct zr_mesh){.name = "sphere",
                            .position_count = side * side,
                            .positions = positions,
                            .face_count = corners / 3,
                            .face_offsets = offsets,
                            .indices = indices};
}

TEST_AROUND(work_stops_soon_when_cancelled, open_arena, close_arena)
{
    static const double after_ms[] = {5, 20, 60, 120, 250, 500, 1000};
    const struct zr_mesh mesh = rough_sphere(500);
    placed_begin(1, 1);
    placed.meshes[0] = mesh;
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 1);
    const struct zr_part_facts facts = {.triangles = 0};
    struct zr_part_features features;
    for (size_t i = 0; i < sizeof after_ms / sizeof *after_ms; i++) {
        struct later later;
        begin(&later, after_ms[i]);
        const struct zr_run run = {.arena = &arena, .scratch = &arena, .cancel = &later.cancel};
        const enum zr_status status = zr_part_features_find(&run, &placed.test.scene, &list, &facts, &features);
        if (status == ZR_OK) {
            end(&later);
            assert_true(i > 2); /* the work of a fast machine is done before */
            return;
        }
        assert_ended_soon(&later, status);
    }
}

RUN_TESTS(NULL, NULL)
