/* Holes that differ between two plates. */
#include <string.h>

#include "measure/hole_changes.h"
#include "support/test_arena.h"
#include "unit/common/plates.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static struct zr_solid solid_of(const struct drill *drills, uint32_t count)
{
    const struct zr_run run = {.arena = &arena};
    const struct zr_world_place zero = {0, 0, 0};
    plate_begin();
    plate_drilled(200, 100, 5, drills, count);
    const struct zr_mesh mesh = plate_mesh();
    return model_solid(&run, &mesh, &zero);
}

static struct zr_hole_changes changes_of(const struct drill *a, uint32_t count_a, const struct drill *b,
                                         uint32_t count_b)
{
    const struct zr_run run = {.arena = &arena};
    const struct zr_solid first = solid_of(a, count_a), second = solid_of(b, count_b);
    struct zr_hole_changes out;
    assert_int_equal(zr_hole_changes_find(&run, &first, &second, 0, &out), ZR_OK);
    assert_false(out.is_omitted);
    return out;
}

static struct drill drill_of(double x, double y, double radius, double depth)
{
    return (struct drill){.x = x, .y = y, .radius = radius, .depth = depth, .segments = 32};
}

TEST_AROUND(a_small_hole_that_moved_is_found_with_its_box, open_arena, close_arena)
{
    const struct drill a[2] = {drill_of(40, 10, 1, 0), drill_of(-60, 20, 4, 0)};
    const struct drill b[2] = {drill_of(41, 10, 1, 0), drill_of(-60, 20, 4, 0)};
    const struct zr_hole_changes all = changes_of(a, 2, b, 2);
    assert_int_equal(all.count, 1);
    const struct zr_hole_change *moved = &all.at[0];
    assert_int_equal(moved->kind, ZR_HOLE_MOVED);
    assert_near(moved->a.diameter, 2, 1e-5);
    assert_near(moved->b.at.x - moved->a.at.x, 1, 1e-4);
    assert_near(moved->b.at.y - moved->a.at.y, 0, 1e-4);
    const double min[3] = {39, 9, 0}, max[3] = {42, 11, 5};
    for (int k = 0; k < 3; k++) {
        assert_near(moved->min[k], min[k], 1e-3);
        assert_near(moved->max[k], max[k], 1e-3);
    }
}

TEST_AROUND(equal_plates_have_no_changes, open_arena, close_arena)
{
    const struct drill a[3] = {drill_of(40, 10, 1, 0), drill_of(-60, 20, 4, 0), drill_of(0, -30, 3, 2)};
    const struct drill b[3] = {a[2], a[0], a[1]};
    assert_int_equal(changes_of(a, 3, b, 3).count, 0);
}

TEST_AROUND(holes_are_removed_added_and_changed, open_arena, close_arena)
{
    const struct drill a[3] = {drill_of(40, 10, 1, 0), drill_of(-60, 20, 4, 0), drill_of(0, -30, 3, 2)};
    const struct drill b[3] = {drill_of(-60, 20, 4, 0), drill_of(0, -30, 3.5, 2), drill_of(70, 0, 2, 3)};
    const struct zr_hole_changes all = changes_of(a, 3, b, 3);
    uint32_t counts[ZR_HOLE_CHANGE_KINDS] = {0};
    assert_int_equal(all.count, 3);
    for (uint32_t i = 0; i < all.count; i++) {
        const struct zr_hole_change *change = &all.at[i];
        counts[change->kind]++;
        if (change->kind == ZR_HOLE_REMOVED) assert_near(change->a.diameter, 2, 1e-5);
        if (change->kind == ZR_HOLE_ADDED) assert_near(change->b.diameter, 4, 1e-5);
        if (change->kind == ZR_HOLE_CHANGED) assert_near(change->b.diameter - change->a.diameter, 1, 1e-5);
    }
    assert_int_equal(counts[ZR_HOLE_MOVED], 0);
}

TEST_AROUND(holes_without_work_are_omitted, open_arena, close_arena)
{
    const struct drill drill = drill_of(40, 10, 1, 0);
    const struct zr_solid solid = solid_of(&drill, 1);
    static char room[1 << 16];
    struct zr_arena small;
    struct zr_hole_changes out;
    zr_arena_init_within(&small, room, sizeof room);
    const struct zr_run run = {.arena = &small};
    assert_int_equal(zr_hole_changes_find(&run, &solid, &solid, 0, &out), ZR_OK);
    assert_true(out.is_omitted);
}

RUN_TESTS(NULL, NULL)
