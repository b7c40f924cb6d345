/* Features of parts: holes, bosses and fillets of plates that are made here, and bodies that have none. */
#include <math.h>
#include <string.h>

#include "mesh/features/part_features.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/placed_parts.h"
#include "unit/common/plates.h"

TEST_ARENA(1 << 28)

static struct zr_part_features found;

static const struct zr_holes *find(void)
{
    placed_begin(1, 1);
    placed.meshes[0] = plate_mesh();
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 1);
    const struct zr_run run = {.arena = &arena, .scratch = &arena};
    struct zr_part_facts *facts = zr_arena_alloc(&arena, 1, sizeof *facts);
    assert_int_equal(zr_part_facts_find(&run, &placed.test.scene, &list, facts), ZR_OK);
    assert_true(facts->is_closed);
    assert_int_equal(zr_part_features_find(&run, &placed.test.scene, &list, facts, &found), ZR_OK);
    assert_false(found.is_omitted);
    return &found.holes;
}

static void assert_about(double value, double want, double tolerance)
{
    if (!(fabs(value - want) <= tolerance * fabs(want))) fail_msg("%.9g, not %.9g", value, want);
}

/* Returns the hole of this diameter and depth at a place of the plate; NULL: none. */
static const struct zr_hole *hole_at(const struct zr_holes *holes, double x, double y, double z)
{
    const struct plate_point p = plate_direction(plate.turn, (struct plate_point){x, y, z});
    for (uint32_t i = 0; i < holes->hole_count; i++) {
        const zr_dvec3 at = holes->holes[i].at;
        if (fabs(at.x - p.x - plate.move[0]) + fabs(at.y - p.y - plate.move[1]) + fabs(at.z - p.z - plate.move[2]) <
            0.02)
            return &holes->holes[i];
    }
    return NULL;
}

static void assert_hole(const struct zr_hole *hole, double diameter, double depth, enum zr_hole_reach reach,
                        uint32_t segments)
{
    const struct plate_point down = plate_direction(plate.turn, (struct plate_point){0, 0, -1});
    assert_non_null(hole);
    assert_about(hole->diameter, diameter, 1e-4);
    assert_about(hole->depth, depth, 1e-4);
    assert_int_equal(hole->reach, reach);
    assert_int_equal(hole->segments, segments);
    assert_true(hole->coverage > 359.0);
    assert_about(hole->axis.x * down.x + hole->axis.y * down.y + hole->axis.z * down.z, 1.0, 1e-6);
}

TEST_AROUND(holes_of_a_plate_are_found_at_all_segments_and_angles, open_arena, close_arena)
{
    static const uint32_t segments[] = {6, 8, 12, 16, 24, 32, 48, 64, 96, 128};
    for (size_t i = 0; i < sizeof segments / sizeof *segments; i++)
        for (int tilt = 0; tilt < 2; tilt++) {
            const uint32_t n = segments[i];
            const struct drill drills[] = {{-15, -8, 1.6, 0, n, 0, 0, 0, 0, 0}, {15, -8, 1.6, 0, n, 0, 0, 0, 0, 0},
                                           {-15, 8, 1.6, 0, n, 0, 0, 0, 0, 0},  {15, 8, 1.6, 0, n, 0, 0, 0, 0, 0},
                                           {0, 0, 6, 0, n, 0, 0, 0, 0, 0},      {-8, 14, 2.5, 0, n, 5, 2, 0, 0, 0},
                                           {8, -14, 4, 3, n, 0, 0, 0, 0, 0},    {8, 14, 3, 0, n, 0, 0, 5, 0, 0}};
            plate_begin();
            if (tilt) plate_turn(37.3, 21.1, 5, 60, -30);
            plate_drilled(40, 42, 6, drills, 8);
            const struct zr_holes *holes = find();
            assert_int_equal(holes->hole_count, 7);
            for (int k = 0; k < 4; k++)
                assert_hole(hole_at(holes, drills[k].x, drills[k].y, 6), 3.2, 6, ZR_REACH_THROUGH, n);
            assert_hole(hole_at(holes, 0, 0, 6), 12, 6, ZR_REACH_THROUGH, n);
            const struct zr_hole *bored = hole_at(holes, -8, 14, 6);
            assert_hole(bored, 5, 4, ZR_REACH_THROUGH, n);
            assert_int_equal(bored->step_count, 1);
            assert_about(bored->steps[0].diameter, 10, 1e-4);
            assert_about(bored->steps[0].depth, 2, 1e-4);
            assert_hole(hole_at(holes, 8, -14, 6), 8, 3, ZR_REACH_BLIND, n);
            assert_about(hole_at(holes, 8, -14, 6)->across_flats, 8 * cos(3.14159265358979 / n), 1e-4);
            assert_int_equal(holes->boss_count, 1);
            assert_about(holes->bosses[0].diameter, 6, 1e-4);
            assert_about(holes->bosses[0].depth, 5, 1e-4);
            assert_int_equal(holes->fillet_count, 0);
        }
}

TEST_AROUND(countersinks_and_tips_of_drills_leave_the_hole, open_arena, close_arena)
{
    static const struct drill drills[] = {{-8, 0, 2, 0, 32, 0, 0, 0, 2, 0}, {8, 0, 2, 4, 32, 0, 0, 0, 0, 1.2}};
    plate_begin();
    plate_drilled(40, 26, 8, drills, 2);
    const struct zr_holes *holes = find();
    assert_int_equal(holes->hole_count, 2);
    assert_hole(hole_at(holes, -8, 0, 6), 4, 6, ZR_REACH_THROUGH, 32);
    assert_hole(hole_at(holes, 8, 0, 8), 4, 4, ZR_REACH_BLIND, 32);
}

TEST_AROUND(free_forms_have_no_holes, open_arena, close_arena)
{
    enum { RINGS = 33, SEGMENTS = 48 };
    double profile[RINGS][2];
    for (int kind = 0; kind < 3; kind++) {
        plate_begin();
        for (int i = 0; i < RINGS; i++) {
            double s, c;
            if (kind == 0) { /* sphere */
                zr_sine_cosine(180.0 * i / (RINGS - 1) - 90.0, &s, &c);
                profile[i][0] = i == 0 || i == RINGS - 1 ? 0.0 : 5.0 * c;
                profile[i][1] = 5.0 * s;
            } else { /* torus, then cone */
                zr_sine_cosine(360.0 * i / RINGS, &s, &c);
                profile[i][0] = kind == 1 ? 6.0 + 2.0 * c : i == 0 ? 0.0 : i == 1 ? 5.0 : 0.0;
                profile[i][1] = kind == 1 ? 2.0 * s : i == 2 ? 4.0 : 0.0;
            }
        }
        plate_turned((const double(*)[2])profile, kind == 2 ? 3 : RINGS, SEGMENTS, kind == 1);
        const struct zr_holes *holes = find();
        assert_int_equal(holes->hole_count, 0);
        assert_int_equal(holes->boss_count, 0);
        assert_int_equal(holes->fillet_count, 0);
    }
}

TEST_AROUND(a_tube_is_a_boss_and_a_hole, open_arena, close_arena)
{
    static const double profile[4][2] = {{3, 0}, {5, 0}, {5, 12}, {3, 12}};
    plate_begin();
    plate_turned(profile, 4, 36, true);
    const struct zr_holes *holes = find();
    assert_int_equal(holes->hole_count, 1);
    assert_int_equal(holes->boss_count, 1);
    assert_hole(&holes->holes[0], 6, 12, ZR_REACH_THROUGH, 36);
    assert_about(holes->bosses[0].diameter, 10, 1e-4);
}

RUN_TESTS(NULL, NULL)
