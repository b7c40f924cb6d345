/* Regions that only one of two solids has. */
#include "measure/regions.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static struct zr_regions regions_of(const struct zr_mesh *a, const struct zr_mesh *b, uint32_t rays, double thin)
{
    const struct zr_run run = {.arena = &arena};
    const struct zr_world_place zero = {0, 0, 0};
    const struct zr_solid first = model_solid(&run, a, &zero), second = model_solid(&run, b, &zero);
    static struct zr_regions out;
    struct zr_ray_lists lists;
    assert_int_equal(zr_ray_lists_make(&run, &first, &second, 0, rays, &lists), ZR_OK);
    assert_int_equal(zr_regions_find(&run, &lists, thin, &out), ZR_OK);
    return out;
}

/* A plate with boxes on it. */
static struct model plate_with(const double (*boxes)[2][3], uint32_t count)
{
    struct model m = model_begin(&arena, 8 * (count + 1), 6 * (count + 1));
    model_add_box(&m, (const double[3]){0, 0, 0}, (const double[3]){4, 3, 1});
    for (uint32_t i = 0; i < count; i++)
        model_add_box(&m, boxes[i][0], boxes[i][1]);
    return m;
}

TEST_AROUND(a_moved_boss_is_removed_and_added, open_arena, close_arena)
{
    static const double before[2][2][3] = {{{0.5, 0.5, 0.5}, {0.5, 0.5, 1}}, {{3, 2, 0.5}, {0.5, 0.5, 0.8}}},
                        after[2][2][3] = {{{0.5, 0.5, 0.5}, {0.5, 0.5, 1}}, {{2, 2, 0.5}, {0.5, 0.5, 0.9}}};
    const struct model a = plate_with(before, 2), b = plate_with(after, 2);
    for (uint32_t rays = 128; rays <= 512; rays *= 2) {
        const struct zr_regions found = regions_of(&a.mesh, &b.mesh, rays, 1e-5);
        assert_int_equal(found.count, 2);
        assert_true(found.omitted == 0 && found.at[0].is_b && !found.at[1].is_b);
        assert_near(found.at[0].volume, 0.1, 2e-3);
        assert_near(found.at[1].volume, 0.075, 2e-3);
        assert_near(found.at[0].center[0], 2.25, 0.01);
        assert_near(found.at[0].center[2], 1.2, 0.01);
        assert_near(found.at[0].min[0], 2, 2 * found.cell);
        assert_near(found.at[0].max[2], 1.4, 2 * found.cell);
        assert_near(found.at[1].min[1], 2, 2 * found.cell);
        assert_true(found.at[0].thickness > 0.2 && found.at[0].thickness <= 0.5);
    }
}

/* Faces that coincide but are cut into other triangles: no shards. */
TEST_AROUND(equal_faces_of_other_triangles_give_no_region, open_arena, close_arena)
{
    const double middle[3] = {0, 0, 0};
    const struct model a = model_sphere(&arena, 1, 96, middle);
    struct model b = model_begin(&arena, a.mesh.position_count, 2 * a.mesh.face_count);
    for (uint32_t i = 0; i < a.mesh.position_count; i++)
        b.positions[b.mesh.position_count++] = a.positions[i];
    for (uint32_t f = 0; f < a.mesh.face_count; f++) {
        const uint32_t *at = a.indices + a.offsets[f];
        model_face(&b, 3, (const uint32_t[3]){at[1], at[2], at[0]});
        if (a.offsets[f + 1] - a.offsets[f] == 4) model_face(&b, 3, (const uint32_t[3]){at[2], at[3], at[0]});
    }
    assert_int_equal(regions_of(&a.mesh, &b.mesh, 256, 1e-5).count, 0);
}

/* Two crescents, whose rims are thinner than the cells and grazed by rays. */
TEST_AROUND(a_moved_sphere_has_two_regions, open_arena, close_arena)
{
    const struct model a = model_sphere(&arena, 1, 256, (const double[3]){0, 0, 0}),
                       b = model_sphere(&arena, 1, 252, (const double[3]){0.1, 0, 0});
    for (uint32_t rays = 128; rays <= 512; rays *= 2)
        assert_int_equal(regions_of(&a.mesh, &b.mesh, rays, 1e-4).count, 2);
}

TEST_AROUND(thin_regions_are_left_out, open_arena, close_arena)
{
    const struct model a = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1}),
                       b = model_box(&arena, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1.01});
    const struct zr_regions all = regions_of(&a.mesh, &b.mesh, 256, 1e-5);
    assert_int_equal(all.count, 1);
    assert_near(all.at[0].volume, 0.01, 1e-4);
    assert_near(all.at[0].thickness, 0.01, 1e-5);
    assert_int_equal(regions_of(&a.mesh, &b.mesh, 256, 0.011).count, 0);
}

TEST_AROUND(the_smallest_of_many_are_omitted, open_arena, close_arena)
{
    enum { SIDE = 10, BOXES = SIDE * SIDE };
    static double boxes[BOXES][2][3];
    for (int i = 0; i < BOXES; i++)
        for (int k = 0; k < 3; k++) {
            boxes[i][0][k] = k == 2 ? 0.5 : 0.1 + 0.35 * (k == 0 ? i % SIDE : i / SIDE) * (k == 0 ? 1 : 0.8);
            boxes[i][1][k] = k == 2 ? 0.6 + 0.002 * i : 0.15;
        }
    const struct model a = plate_with(NULL, 0), b = plate_with((const double(*)[2][3])boxes, BOXES);
    const struct zr_regions found = regions_of(&a.mesh, &b.mesh, 512, 1e-5);
    assert_true(found.count == ZR_REGIONS_MAX && found.omitted == BOXES - ZR_REGIONS_MAX);
    for (uint32_t i = 1; i < found.count; i++)
        assert_true(found.at[i - 1].volume >= found.at[i].volume);
}

RUN_TESTS(NULL, NULL)
