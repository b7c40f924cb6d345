/* Features of parts: holes, bosses and fillets of plates that are made here, and bodies that have none. */
#include <math.h>
#include <stdio.h>
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
    const struct zr_hole *sunk = hole_at(holes, -8, 0, 8);
    assert_hole(sunk, 4, 6, ZR_REACH_THROUGH, 32);
    assert_int_equal(sunk->step_count, 1);
    assert_about(sunk->steps[0].diameter, 8, 1e-4);
    assert_about(sunk->steps[0].depth, 2, 1e-4);
    assert_about(sunk->steps[0].angle, 90, 1e-4);
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

TEST_AROUND(half_channels_and_slots_have_no_holes, open_arena, close_arena)
{
    enum { STEPS = 16 };
    plate_begin();
    uint32_t rings[2];
    for (int k = 0; k < 2; k++) { /* a block with half a channel on top, and a slot with round ends beside it */
        rings[k] = plate_place(10, k ? 20 : 0, -8);
        plate_place(10, k ? 20 : 0, 0);
        for (int i = 0; i <= STEPS; i++) {
            double s, c;
            zr_sine_cosine(180.0 * i / STEPS, &s, &c);
            plate_place(5 * c, k ? 20 : 0, 0.0 - 5 * s);
        }
        plate_place(-10, k ? 20 : 0, 0);
        plate_place(-10, k ? 20 : 0, -8);
    }
    for (uint32_t i = 0; i < STEPS + 5; i++) {
        const uint32_t next = (i + 1) % (STEPS + 5);
        plate_quad(rings[0] + i, rings[0] + next, rings[1] + next, rings[1] + i);
    }
    plate_face();
    plate_ring(rings[0], STEPS + 5, true);
    plate_face();
    plate_ring(rings[1], STEPS + 5, false);
    const struct zr_holes *holes = find();
    assert_int_equal(holes->hole_count, 0);
    assert_int_equal(holes->boss_count, 0);
    assert_int_equal(holes->fillet_count, 1);
    assert_about(holes->fillets[0].radius, 5, 1e-4);
}

/* ---- random plates ---- */

static double uniform(struct random *random, double low, double high)
{
    return low + (high - low) * (double)(random_next(random) >> 11) * 0x1p-53;
}

/* Makes a drill that keeps clear of the others. False if there is no place for it. */
static bool make_drill(struct random *random, double width, double length, double height, const struct drill *others,
                       uint32_t count, struct drill *out)
{
    const int kind = (int)(random_next(random) % 6);
    *out = (struct drill){.radius = uniform(random, 0.01, 0.08) * width,
                          .segments = 12 + (uint32_t)(random_next(random) % 85)};
    if (kind == 1 || kind == 2) out->depth = uniform(random, 0.2, 0.6) * height;
    if (kind == 2) out->tip = 0.6 * out->radius < 0.3 * height ? 0.6 * out->radius : 0.3 * height;
    if (kind == 3) {
        out->bore = uniform(random, 1.2, 2.0) * out->radius;
        out->bore_depth = uniform(random, 0.2, 0.7) * height;
    }
    if (kind == 4) out->cone = uniform(random, 0.1, 0.5) * zr_least_of(out->radius, height);
    if (kind == 5) out->height = uniform(random, 0.1, 2.0) * height;
    const double reach = zr_most_of(out->radius + out->cone, out->bore);
    for (int try = 0; try < 50; try++) {
        bool is_free = true;
        out->x = uniform(random, -0.5, 0.5) * (width - 2.1 * reach);
        out->y = uniform(random, -0.5, 0.5) * (length - 2.1 * reach);
        for (uint32_t i = 0; i < count && is_free; i++) {
            const double x = out->x - others[i].x, y = out->y - others[i].y,
                         other = zr_most_of(others[i].radius + others[i].cone, others[i].bore);
            is_free = x * x + y * y > 1.05 * (reach + other) * 1.05 * (reach + other);
        }
        if (is_free) return true;
    }
    return false;
}

struct score {
    int wanted, found, right;
};

static void add_score(const struct zr_holes *holes, const struct drill *drills, uint32_t count, double height,
                      struct score *score)
{
    score->found += (int)holes->hole_count;
    for (uint32_t i = 0; i < count; i++) {
        const struct drill *d = &drills[i];
        if (d->height > 0.0) continue;
        const double bore = d->bore > 0.0 ? d->bore_depth : 0.0;
        const double depth = d->depth > 0.0 ? d->depth : height - bore - d->cone;
        const struct plate_point p = plate_direction(plate.turn, (struct plate_point){d->x, d->y, height});
        score->wanted++;
        for (uint32_t k = 0; k < holes->hole_count; k++) {
            const struct zr_hole *hole = &holes->holes[k];
            const zr_dvec3 place = {p.x + plate.move[0], p.y + plate.move[1], p.z + plate.move[2]};
            const zr_dvec3 from = zr_dvec3_sub(place, hole->at),
                           to = zr_dvec3_add_scaled(from, hole->axis, 0.0 - depth);
            const bool has_two = hole->reach == ZR_REACH_THROUGH && hole->step_count == 0; /* ends alike */
            const double off = sqrt(zr_least_of(zr_dvec3_dot(from, from), has_two ? zr_dvec3_dot(to, to) : HUGE_VAL));
            if (off < 0.05 * d->radius && fabs(hole->diameter - 2.0 * d->radius) < 0.002 * d->radius &&
                fabs(hole->depth - depth) < 1e-3 * depth &&
                hole->reach == (d->depth > 0.0 ? ZR_REACH_BLIND : ZR_REACH_THROUGH) &&
                hole->step_count == (d->bore > 0.0 || d->cone > 0.0) && hole->segments == d->segments)
                score->right++;
        }
    }
}

TEST_AROUND(holes_of_random_plates_are_found, open_arena, close_arena)
{
    const char *rounds = getenv("PLATES");
    const int plates = rounds ? atoi(rounds) : 60;
    struct random random = random_seeded(58);
    struct score score = {0, 0, 0};
    for (int i = 0; i < plates; i++) {
        struct drill drills[24];
        const uint32_t most = 1 + (uint32_t)(random_next(&random) % 24);
        const double width = uniform(&random, 1, 200), length = uniform(&random, 0.5, 1) * width,
                     height = uniform(&random, 0.01, 0.3) * width;
        uint32_t count = 0;
        while (count < most && make_drill(&random, width, length, height, drills, count, &drills[count]))
            count++;
        plate_begin();
        if (i % 3 > 0)
            plate_turn(uniform(&random, 0, 360), uniform(&random, 0, 360), uniform(&random, -1, 1) * width,
                       uniform(&random, -1, 1) * width, uniform(&random, -1, 1) * width);
        plate_drilled(width, length, height, drills, count);
        add_score(find(), drills, count, height, &score);
        zr_arena_reset(&arena, SIZE_MAX);
    }
    if (rounds)
        printf("%d holes, %d found, %d right: precision %.4f, recall %.4f\n", score.wanted, score.found, score.right,
               (double)score.right / score.found, (double)score.right / score.wanted);
    assert_true(score.right >= 0.99 * score.found && score.right >= 0.99 * score.wanted);
}

RUN_TESTS(NULL, NULL)
