/* Whole comparisons: memory, threads, and the answer as text. */
#include <string.h>

#include "base/team.h"
#include "output/json/comparison_json.h"
#include "support/test_arena.h"
#include "unit/common/plates.h"
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

static bool holds(const struct zr_buffer *out, const char *text)
{
    return memmem(out->bytes, out->size, text, strlen(text)) != NULL;
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
        if (status == ZR_OK) assert_true(holds(&out, "\"features\":") != holds(&out, "holes are left out"));
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

/* Compares two plates of one hole each and returns the answer as text, in the arena. */
static const char *compare_holes(const struct drill *a, double width, const struct drill *b, enum zr_align align)
{
    const struct zr_scene *scenes[2];
    struct zr_buffer out;
    for (int i = 0; i < 2; i++) {
        plate_begin();
        plate_drilled(i == 0 ? 200 : width, i == 0 ? 100 : 20000 / width, 5, i == 0 ? a : b, 1);
        const struct zr_mesh mesh = plate_mesh();
        struct zr_mesh *kept = zr_arena_copy(&arena, &mesh, sizeof mesh);
        kept->positions = zr_arena_copy(&arena, mesh.positions, mesh.position_count * sizeof *mesh.positions);
        kept->indices = zr_arena_copy(&arena, mesh.indices, sizeof plate.index);
        kept->face_offsets = zr_arena_copy(&arena, mesh.face_offsets, sizeof plate.face_offsets);
        kept->face_rings = zr_arena_copy(&arena, mesh.face_rings, sizeof plate.face_rings);
        kept->ring_offsets = zr_arena_copy(&arena, mesh.ring_offsets, sizeof plate.ring_offsets);
        scenes[i] = model_scene(kept, i);
    }
    wanted.align = align;
    assert_int_equal(compare(&arena, NULL, scenes[0], scenes[1], &out), ZR_OK);
    assert_true(zr_buffer_add(&out, "", 1));
    return (const char *)out.bytes;
}

TEST_AROUND(a_blind_hole_that_becomes_through_is_told, open_arena, close_arena)
{
    const struct drill blind = {.x = 40, .y = 10, .radius = 3, .depth = 2, .segments = 32},
                       through = {.x = 40, .y = 10, .radius = 3, .segments = 32},
                       wide = {.x = 40, .y = 10, .radius = 4, .segments = 32};
    const char *text = compare_holes(&blind, 200, &through, ZR_ALIGN_NONE);
    assert_non_null(strstr(text, "; 1 hole changed (1 now through);"));
    assert_non_null(strstr(text, "\"through\":false,\"newThrough\":true"));
    text = compare_holes(&through, 200, &blind, ZR_ALIGN_NONE);
    assert_non_null(strstr(text, "; 1 hole changed (1 now blind);"));
    text = compare_holes(&through, 200, &wide, ZR_ALIGN_NONE);
    assert_non_null(strstr(text, "; 1 hole changed;"));
    assert_non_null(strstr(text, "\"through\":true,\"newThrough\":true"));
}

TEST_AROUND(steps_of_changed_holes_are_told, open_arena, close_arena)
{
    const struct drill plain = {.x = 40, .y = 10, .radius = 3, .segments = 32},
                       bored = {.x = 40, .y = 10, .radius = 3, .segments = 32, .bore = 5, .bore_depth = 2},
                       wide = {.x = 40, .y = 10, .radius = 3, .segments = 32, .bore = 6, .bore_depth = 2},
                       sunk = {.x = 40, .y = 10, .radius = 3, .segments = 32, .cone = 2};
    const char *text = compare_holes(&bored, 200, &wide, ZR_ALIGN_NONE);
    assert_non_null(strstr(text, "\"steps\":[{\"diameter\":10,\"depth\":2,\"segments\":32}],"
                                 "\"newSteps\":[{\"diameter\":12,\"depth\":2,\"segments\":32}]"));
    text = compare_holes(&bored, 200, &sunk, ZR_ALIGN_NONE);
    assert_non_null(strstr(text, "; 1 hole changed;"));
    assert_non_null(strstr(text, "\"newSteps\":[{\"diameter\":10,\"depth\":2,\"angleDegrees\":90,"));
    assert_non_null(strstr(compare_holes(&bored, 200, &plain, ZR_ALIGN_NONE), "\"newSteps\":[]"));
    assert_null(strstr(compare_holes(&bored, 200, &bored, ZR_ALIGN_NONE), "teps\""));
}

TEST_AROUND(an_alignment_is_advised_if_no_hole_fits, open_arena, close_arena)
{
    const struct drill one = {.x = 40, .y = 10, .radius = 3, .segments = 32},
                       other = {.x = -10, .y = 40, .radius = 2, .segments = 32},
                       moved = {.x = -10, .y = 40, .radius = 3, .segments = 32};
    assert_non_null(strstr(compare_holes(&one, 100, &other, ZR_ALIGN_NONE), "align=principal"));
    assert_non_null(strstr(compare_holes(&one, 100, &moved, ZR_ALIGN_NONE), "align=principal moves it"));
    assert_null(strstr(compare_holes(&one, 200, &moved, ZR_ALIGN_NONE), "align=principal"));
    assert_null(strstr(compare_holes(&one, 100, &other, ZR_ALIGN_BOUNDS), "align=principal"));
    assert_null(strstr(compare_holes(&one, 200, &one, ZR_ALIGN_NONE), "align=principal"));
    assert_null(strstr(compare_holes(&one, 400, &other, ZR_ALIGN_NONE), "align=principal"));
}

TEST_AROUND(combined_solids_are_refused, open_arena, close_arena)
{
    const struct zr_scene *plain = torus(0, 1);
    struct zr_scene combined = *torus(1, 1);
    static const struct zr_csg csg;
    combined.csg = &csg;
    struct zr_error error = {0};
    const struct zr_run run = {.arena = &arena, .error = &error};
    struct zr_comparison out;
    assert_int_equal(zr_comparison_make(&run, plain, &combined, &wanted, &out), ZR_BAD_SCENE);
    assert_int_equal(zr_comparison_make(&run, &combined, plain, &wanted, &out), ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/csg");
    assert_non_null(strstr(error.items[0].detail, "leave out csg of b"));
    assert_non_null(strstr(error.items[1].detail, "leave out csg of a"));
}

RUN_TESTS(NULL, NULL)
