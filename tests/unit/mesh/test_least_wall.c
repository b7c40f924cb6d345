/* The least wall of parts: solids whose walls are known, and unions of boxes compared with runs of cells. */
#include <math.h>
#include <string.h>

#include "mesh/facts/least_wall.h"
#include "render/frame_parts.h"
#include "support/random.h"
#include "support/solids.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA((size_t)1 << 29)

enum { FACES_MOST = 250000 };

/* A mesh of triangles and quads that grows. */
static struct growing {
    zr_vec4 *positions;
    uint32_t *offsets, *indices, position_count, face_count;
} growing;

static void begin(void)
{
    growing = (struct growing){.positions = zr_arena_alloc(&arena, 4 * (size_t)FACES_MOST, sizeof(zr_vec4)),
                               .offsets = zr_arena_zero(&arena, FACES_MOST + 1, sizeof(uint32_t)),
                               .indices = zr_arena_alloc(&arena, 4 * (size_t)FACES_MOST, sizeof(uint32_t))};
}

static void add_face(const zr_vec4 *corners, uint32_t count, bool turn)
{
    struct growing *g = &growing;
    const uint32_t at = g->offsets[g->face_count];
    for (uint32_t i = 0; i < count; i++) {
        g->positions[g->position_count] = corners[turn ? count - 1 - i : i];
        g->indices[at + i] = g->position_count++;
    }
    g->offsets[++g->face_count] = at + count;
}

/* The solid between two polygons of the same number of corners, the upper one seen turning left from above. */
static void add_prism(const zr_vec4 *low, const zr_vec4 *high, uint32_t count, bool turn)
{
    add_face(low, count, !turn);
    add_face(high, count, turn);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = (i + 1) % count;
        add_face((const zr_vec4[4]){low[i], low[k], high[k], high[i]}, 4, turn);
    }
}

static void add_box(float x0, float y0, float z0, float x1, float y1, float z1, bool turn)
{
    const zr_vec4 low[4] = {{x0, y0, z0, 1}, {x1, y0, z0, 1}, {x1, y1, z0, 1}, {x0, y1, z0, 1}},
                  high[4] = {{x0, y0, z1, 1}, {x1, y0, z1, 1}, {x1, y1, z1, 1}, {x0, y1, z1, 1}};
    add_prism(low, high, 4, turn);
}

static struct zr_mesh mesh_of_growing(void)
{
    return (struct zr_mesh){.name = "grown",
                            .position_count = growing.position_count,
                            .positions = growing.positions,
                            .face_count = growing.face_count,
                            .face_offsets = growing.offsets,
                            .indices = growing.indices};
}

static const zr_mat4 straight = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
static const zr_mat4 turned = {/* by the quaternion 1, 2, 3, 4, and moved */
                               {2.0f / 15, 14.0f / 15, -1.0f / 3, 0, -2.0f / 3, 1.0f / 3, 2.0f / 3, 0, 11.0f / 15,
                                2.0f / 15, 2.0f / 3, 0, 5, -7, 3, 1}};

static struct zr_least_wall find_in(const struct zr_mesh *mesh, const zr_mat4 *matrix, uint64_t steps)
{
    const struct zr_wall_faces faces = {.mesh = mesh, .object_to_world = matrix, .end = mesh->face_count};
    const size_t used = arena.used;
    const struct zr_least_wall wall = zr_least_wall_find(&arena, NULL, &faces, &steps);
    assert_true(arena.used <= used + ZR_ARENA_ALIGN);
    return wall;
}

/* `want` < 0: there is none. Both straight and turned. */
static void check(const char *what, double want)
{
    const struct zr_mesh mesh = mesh_of_growing();
    for (int turn = 0; turn < 2; turn++) {
        const struct zr_least_wall wall = find_in(&mesh, turn ? &turned : &straight, 1 << 24);
        if (wall.is_omitted || wall.is_found != (want >= 0) ||
            (wall.is_found && !(fabs(wall.thickness - want) < 4e-6 * (want + 1))))
            fail_msg("%s%s: %d %d %.9g, not %g", what, turn ? ", turned" : "", wall.is_found, wall.is_omitted,
                     wall.thickness, want);
    }
}

/* ---- solids of known walls ---- */

TEST_AROUND(boxes_have_the_wall_of_their_nearest_faces, open_arena, close_arena)
{
    begin();
    add_box(0, 0, 0, 3, 4, 5, false);
    check("a box", 3);
    begin();
    add_box(0, 0, 0, 20, 30, 40, false);
    add_box(2, 2, 2, 18, 28, 38, true);
    check("a hollow box", 2);
    begin();
    add_box(0, 0, 0, 20, 30, 40, false);
    add_box(3, 2, 1.5f, 18, 28, 36, true);
    check("a hollow box with a thinner floor", 1.5);
    begin();
    add_box(0, 0, 0, 10, 10, 3, false);
    add_box(20, 0, 0, 30, 10, 4, false);
    check("two boxes apart", 3);
}

TEST_AROUND(a_step_has_the_wall_of_its_lower_side, open_arena, close_arena)
{
    const zr_vec4 low[6] = {{0, 0, 0, 1},     {10, 0, 0, 1}, {10, 0.75f, 0, 1},
                            {4, 0.75f, 0, 1}, {4, 2, 0, 1},  {0, 2, 0, 1}};
    zr_vec4 high[6];
    memcpy(high, low, sizeof high);
    for (int i = 0; i < 6; i++)
        high[i].z = 8;
    begin();
    add_prism(low, high, 6, false);
    check("a step", 0.75);
}

/* Faces of shells that overlap, touch or lie within one another are no walls. */
TEST_AROUND(only_the_outside_of_several_shells_counts, open_arena, close_arena)
{
    begin();
    add_box(0, 0, 0, 10, 20, 20, false);
    add_box(8, 0, 0, 15, 20, 20, false);
    check("shells that overlap by 2", 15);
    begin();
    add_box(0, 0, 0, 10, 20, 20, false);
    add_box(10, 0, 0, 15, 20, 20, false);
    check("shells that touch", 15);
    begin();
    add_box(0, 0, 0, 10, 20, 30, false);
    add_box(2, 2, 2, 3, 3, 3, false);
    check("a shell within", 10);
    begin();
    add_box(0, 0, 0, 10, 10, 10, false);
    add_box(4, 4, 4, 6, 6, 6, true);
    add_box(4, 4, 4, 6, 6, 6, false);
    check("a filled cavity", 10);
}

TEST_AROUND(faces_that_are_not_parallel_have_no_wall, open_arena, close_arena)
{
    const zr_vec4 corners[4] = {{0, 0, 0, 1}, {3, 0, 0, 1}, {0, 4, 0, 1}, {1, 1, 5, 1}};
    begin();
    add_face((const zr_vec4[3]){corners[0], corners[2], corners[1]}, 3, false);
    add_face((const zr_vec4[3]){corners[0], corners[1], corners[3]}, 3, false);
    add_face((const zr_vec4[3]){corners[1], corners[2], corners[3]}, 3, false);
    add_face((const zr_vec4[3]){corners[2], corners[0], corners[3]}, 3, false);
    check("a tetrahedron", -1);
}

/* Walls of 2 over a length of 10 with a slope: a twentieth of a degree is parallel, a quarter is not. */
TEST_AROUND(slopes_up_to_a_tenth_of_a_degree_are_parallel, open_arena, close_arena)
{
    static const double degrees[4] = {0.05, 0.09, 0.11, 0.25};
    for (int i = 0; i < 4; i++) {
        const float y = (float)(2 - 10 * tan(degrees[i] * 0.017453292519943295));
        const zr_vec4 low[4] = {{0, 0, 0, 1}, {10, 0, 0, 1}, {10, y, 0, 1}, {0, 2, 0, 1}},
                      high[4] = {{0, 0, 7, 1}, {10, 0, 7, 1}, {10, y, 7, 1}, {0, 2, 7, 1}};
        begin();
        add_prism(low, high, 4, false);
        check("a slope", i < 2 ? (double)y : 7);
    }
}

/* Facets of both sides have the same angles. The wall is that between them, less than that of the circles. */
TEST_AROUND(a_tube_has_the_wall_between_its_facets, open_arena, close_arena)
{
    enum { SIDES = 48 };
    begin();
    for (int i = 0; i < SIDES; i++) {
        zr_vec4 low[4], high[4];
        for (int k = 0; k < 4; k++) {
            const double angle = 2 * M_PI * (i + (k == 1 || k == 2)) / SIDES, radius = k < 2 ? 10 : 9;
            low[k] = high[k] = (zr_vec4){(float)(radius * cos(angle)), (float)(radius * sin(angle)), 0, 1};
            high[k].z = 30;
        }
        add_face(low, 4, true);
        add_face(high, 4, false);
        add_face((const zr_vec4[4]){low[0], low[1], high[1], high[0]}, 4, false);
        add_face((const zr_vec4[4]){low[2], low[3], high[3], high[2]}, 4, false);
    }
    check("a tube", cos(M_PI / SIDES));
}

TEST_AROUND(solids_have_their_walls, open_arena, close_arena)
{
    static const struct {
        enum solid solid;
        double want; /* of the spheres: between opposite quads at the equator */
    } cases[] = {{SOLID_SPHERE, 1.966202}, {SOLID_INSIDE_OUT, 1.925274}, {SOLID_HOLLOW, 0.4}, {SOLID_PLATE, 0.1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_mesh mesh = solid_make(&arena, cases[i].solid);
        const struct zr_wall_faces faces = {.mesh = &mesh,
                                            .object_to_world = &straight,
                                            .end = mesh.face_count,
                                            .is_turned = cases[i].solid == SOLID_INSIDE_OUT};
        uint64_t steps = 1 << 24;
        const struct zr_least_wall wall = zr_least_wall_find(&arena, NULL, &faces, &steps);
        if (!wall.is_found || !(fabs(wall.thickness - cases[i].want) < 2e-5))
            fail_msg("%s: %d %.9g", solid_names[cases[i].solid], wall.is_found, wall.thickness);
    }
}

/* ---- random unions ---- */

enum { CELLS = 7 };

/* Returns the least length of the runs of inner cells along the three axes. */
static int least_run(bool inner[CELLS][CELLS][CELLS])
{
    int least = CELLS + 1;
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < CELLS * CELLS; i++) {
            int run = 0;
            for (int k = 0; k <= CELLS; k++) {
                const int at[3] = {i / CELLS, i % CELLS, k};
                if (k < CELLS && inner[at[axis]][at[(axis + 1) % 3]][at[(axis + 2) % 3]]) {
                    run++;
                    continue;
                }
                if (run > 0 && run < least) least = run;
                run = 0;
            }
        }
    return least;
}

TEST_AROUND(unions_of_boxes_have_the_least_run_of_cells, open_arena, close_arena)
{
    struct random random = random_seeded(1);
    int seen[CELLS + 1] = {0};
    for (int round = 0; round < 6000; round++) {
        static bool inner[CELLS][CELLS][CELLS];
        memset(inner, 0, sizeof inner);
        zr_arena_reset(&arena, (size_t)1 << 29);
        begin();
        for (uint32_t i = 0, count = 1 + random_below(&random, round % 3 ? 3 : 9); i < count; i++) {
            int low[3], high[3];
            for (int k = 0; k < 3; k++) {
                const int least = round % 2 ? 1 : 3;
                low[k] = (int)random_below(&random, (uint32_t)(CELLS + 1 - least));
                high[k] = low[k] + least + (int)random_below(&random, (uint32_t)(CELLS + 1 - least - low[k]));
            }
            add_box((float)low[0], (float)low[1], (float)low[2], (float)high[0], (float)high[1], (float)high[2], false);
            for (int x = low[0]; x < high[0]; x++)
                for (int y = low[1]; y < high[1]; y++)
                    for (int z = low[2]; z < high[2]; z++)
                        inner[x][y][z] = true;
        }
        const int want = least_run(inner);
        const struct zr_mesh mesh = mesh_of_growing();
        const struct zr_least_wall wall = find_in(&mesh, round % 4 < 2 ? &straight : &turned, 1 << 24);
        seen[want]++;
        if (!wall.is_found || !(fabs(wall.thickness - want) < 1e-4))
            fail_msg("round %d: %d %.9g, not %d", round, wall.is_found, wall.thickness, want);
    }
    assert_true(seen[1] > 1000 && seen[2] > 100 && seen[3] > 1000 && seen[4] > 100);
}

/* ---- limits ---- */

TEST_AROUND(faces_at_the_same_place_end_in_bounded_work, open_arena, close_arena)
{
    begin();
    for (int i = 0; i < 8000; i++)
        add_box(0, 0, 0, 1, 2, 3, false);
    const struct zr_mesh mesh = mesh_of_growing();
    const struct zr_least_wall wall = find_in(&mesh, &straight, 1 << 24);
    assert_true(wall.is_found && fabs(wall.thickness - 1) < 1e-9);
    const struct zr_least_wall few = find_in(&mesh, &straight, 1000);
    assert_true(few.is_omitted && !few.is_found);
    begin(); /* sheets without a volume: faces at the same place face each other */
    for (int i = 0; i < 50000; i++) {
        const zr_vec4 sheet[3] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
        add_face(sheet, 3, false);
        add_face(sheet, 3, true);
    }
    const struct zr_mesh sheets = mesh_of_growing();
    const struct zr_least_wall none = find_in(&sheets, &straight, 1 << 24);
    assert_true(!none.is_found);
}

/* Boxes that overlap: of each pair of opposite faces, most have a face within another box, on all lines. */
TEST_AROUND(faces_within_other_shells_are_passed_over_in_few_steps, open_arena, close_arena)
{
    begin();
    for (int i = 0; i < 20; i++)
        add_box(0.05f * (float)i, 0, 0, 0.05f * (float)i + 1, 2, 2, false);
    const struct zr_mesh mesh = mesh_of_growing();
    const struct zr_least_wall wall = find_in(&mesh, &straight, 1 << 21);
    if (!wall.is_found || fabs(wall.thickness - 1.95) > 1e-6)
        fail_msg("%d %d %.9g", wall.is_found, wall.is_omitted, wall.thickness);
}

TEST_AROUND(triangles_without_area_change_nothing, open_arena, close_arena)
{
    begin();
    add_box(0, 0, 0, 3, 4, 5, false);
    add_face((const zr_vec4[3]){{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, 3, false);
    add_face((const zr_vec4[3]){{0, 0, 0, 1}, {1, 1, 1, 1}, {2, 2, 2, 1}}, 3, false);
    add_face((const zr_vec4[3]){{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, 3, false);
    check("a box with degenerate triangles", 3);
    begin();
    add_face((const zr_vec4[3]){{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, 3, false);
    check("no area", -1);
}

TEST_AROUND(a_full_arena_and_a_cancelled_search_have_no_wall, open_arena, close_arena)
{
    const struct zr_mesh mesh = solid_make(&arena, SOLID_SPHERE);
    const struct zr_wall_faces faces = {.mesh = &mesh, .object_to_world = &straight, .end = mesh.face_count};
    struct zr_cancel cancel = {0};
    uint64_t steps = 1 << 24;
    int found = 0, omitted = 0;
    cancel.raised = true;
    assert_false(zr_least_wall_find(&arena, &cancel, &faces, &steps).is_found);
    for (size_t ceiling = 1 << 12; ceiling <= (size_t)1 << 23; ceiling += ceiling / 4) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        const struct zr_least_wall wall = zr_least_wall_find(&small, NULL, &faces, &steps);
        assert_true(wall.is_omitted != wall.is_found && zr_arena_ok(&small));
        found += wall.is_found;
        omitted += wall.is_omitted;
        zr_arena_free(&small);
    }
    assert_true(found > 2 && omitted > 2);
}

RUN_TESTS(NULL, NULL)
