/* Whole comparisons: memory, threads, and the answer as text. */
#include "base/team.h"
#include "output/json/comparison_json.h"
#include "support/test_arena.h"
#include "unit/measure/models.h"

TEST_ARENA(1 << 28)

static struct zr_comparison_options wanted = {.tolerance = -1, .is_quick = true};

/* Compares two tori and prints the answer. */
static enum zr_status compare(struct zr_arena *in, struct zr_team *team, const struct zr_scene *a,
                              const struct zr_scene *b, struct zr_buffer *out)
{
    struct zr_error error = {0};
    const struct zr_run run = {.arena = in, .team = team, .error = &error};
    struct zr_comparison comparison;
    *out = (struct zr_buffer){.arena = in};
    const enum zr_status status = zr_comparison_make(&run, a, b, &wanted, &comparison);
    return status == ZR_OK ? zr_comparison_json_write(&comparison, a, b, out) : status;
}

static const struct zr_scene *torus(int slot, double radius)
{
    const struct model m = model_torus(&arena, radius, 0.4, 40, 24);
    return model_scene(&m.mesh, slot);
}

TEST_AROUND(each_amount_of_memory_gives_the_answer_or_a_status, open_arena, close_arena)
{
    const struct zr_scene *a = torus(0, 1), *b = torus(1, 1.1);
    int refused = 0, made = 0;
    for (size_t ceiling = 1 << 14; made < 2; ceiling += ceiling / 3) {
        struct zr_arena own;
        struct zr_buffer out;
        zr_arena_init(&own, ceiling);
        const enum zr_status status = compare(&own, NULL, a, b, &out);
        if (status != ZR_OK) assert_int_equal(status, ZR_NO_MEMORY);
        refused += status != ZR_OK;
        made += status == ZR_OK;
        zr_arena_free(&own);
    }
    assert_true(refused > 8);
}

TEST_AROUND(the_answer_is_the_same_for_all_numbers_of_threads, open_arena, close_arena)
{
    const struct zr_scene *a = torus(0, 1), *b = torus(1, 1.1);
    struct zr_team *team = zr_team_create(4);
    struct zr_buffer one, four;
    wanted.align = ZR_ALIGN_PRINCIPAL;
    assert_int_equal(compare(&arena, NULL, a, b, &one), ZR_OK);
    assert_int_equal(compare(&arena, team, a, b, &four), ZR_OK);
    assert_int_equal(one.size, four.size);
    assert_memory_equal(one.bytes, four.bytes, one.size);
    zr_team_destroy(team);
}

TEST_AROUND(faces_without_an_area_and_lost_corners_are_left_out, open_arena, close_arena)
{
    struct model m = model_begin(&arena, 12, 9);
    model_add_box(&m, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    model_place(&m, 0, 0, 0);
    m.positions[m.mesh.position_count++] = (zr_vec4){1, 0, 0, 0}; /* at infinity */
    model_face(&m, 3, (const uint32_t[3]){0, 8, 0});
    const struct zr_run run = {.arena = &arena};
    const struct zr_solid closed = model_solid(&run, &m.mesh, NULL);
    assert_true(closed.is_closed && closed.count == 12 && closed.volume == 1 && closed.area == 6);
    model_face(&m, 3, (const uint32_t[3]){0, 1, 9});
    const struct zr_solid lost = model_solid(&run, &m.mesh, NULL);
    assert_true(!lost.is_closed && lost.count == 12 && lost.max[0] - lost.min[0] == 1);
}

TEST_AROUND(handles_and_cavities_are_counted, open_arena, close_arena)
{
    const struct zr_run run = {.arena = &arena};
    const struct model ring = model_torus(&arena, 1, 0.4, 20, 12);
    const struct zr_solid solid = model_solid(&run, &ring.mesh, NULL);
    assert_true(solid.has_handles && solid.handles == 1 && solid.outward == 1 && solid.inward == 0);
    struct model hollow = model_begin(&arena, 16, 12);
    model_add_box(&hollow, (const double[3]){0, 0, 0}, (const double[3]){4, 4, 4});
    model_add_box(&hollow, (const double[3]){3, 1, 1}, (const double[3]){-2, 2, 2});
    const struct zr_solid shell = model_solid(&run, &hollow.mesh, NULL);
    assert_true(shell.outward == 1 && shell.inward == 1 && shell.handles == 0);
    assert_near(shell.volume, 56, 1e-12);
}

RUN_TESTS(NULL, NULL)
