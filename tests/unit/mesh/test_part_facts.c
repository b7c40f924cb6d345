/* The parts of a scene: their names, which are closed, and areas and volumes compared with formulas. */
#include <math.h>
#include <string.h>

#include "mesh/facts/closed_parts.h"
#include "render/frame_parts.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/placed_parts.h"

TEST_ARENA(1 << 27)

static void assert_near(double value, double want)
{
    if (!(fabs(value - want) <= 1e-12 + 1e-9 * fabs(want))) fail_msg("%.17g, not %.17g", value, want);
}

/* ---- names ---- */

TEST_AROUND(names_of_parts_are_unique_and_found, open_arena, close_arena)
{
    static const uint32_t face_parts[6] = {0, 1, 2, 3, 3, 3};
    static const char *const names[] = {"wheel", "", "wheel.2", "wheel"};
    static const struct {
        const char *name;
        uint32_t instance, number;
    } want[] = {{"wheel", 0, 0},     {"wheel.2", 1, 0}, {"wheel.3", 2, 0}, {"body", 2, 1},
                {"wheel.2.2", 2, 2}, {"wheel.4", 2, 3}, {"part", 3, 0},    {"part.2", 4, 0}};
    enum { WANTED = sizeof want / sizeof *want };
    placed_begin(3, 5);
    placed.meshes[0] = placed.meshes[1] = placed.meshes[2] = cube();
    placed.meshes[1].name = "";
    placed.meshes[2].face_parts = face_parts;
    placed.meshes[2].part_count = 4;
    placed.meshes[2].part_names = names;
    placed.instances[0].node = "wheel";
    placed.instances[1] = (struct zr_instance){.mesh = 0, .node = "wheel"};
    placed.instances[2].node = "body";
    placed.instances[3] = placed.instances[4] = (struct zr_instance){.mesh = 1, .node = ""};
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 100);
    assert_int_equal(list.count, WANTED);
    assert_int_equal(list.total, WANTED);
    for (uint32_t i = 0; i < WANTED; i++) {
        assert_string_equal(list.at[i].name, want[i].name);
        assert_int_equal(list.at[i].instance, want[i].instance);
        assert_int_equal(list.at[i].number, want[i].number);
    }
    const struct zr_part_list first = zr_part_list_make(&arena, &placed.test.scene, 2);
    assert_int_equal(first.count, 2);
    assert_int_equal(first.total, WANTED);
    assert_string_equal(first.at[1].name, "wheel.2");
}

/* ---- measures ---- */

TEST_AROUND(a_cube_has_its_area_and_volume_in_world_space, open_arena, close_arena)
{
    static const struct {
        zr_mat4 matrix;
        double area, volume;
        zr_vec3 min, max;
        double wall; /* 0: none, such as of a cube sheared until no faces of it overlap */
    } cases[] = {{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 6, 1, {0, 0, 0}, {1, 1, 1}, 1},
                 {{{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}, 22, 6, {5, 6, 7}, {7, 9, 8}, 1},
                 {{{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, 6, 1, {-1, 0, 0}, {0, 1, 1}, 1}, /* mirrored */
                 {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}}, 2, 0, {0, 0, 0}, {1, 1, 0}, 0},   /* flattened */
                 {{{1, 0, 0, 0, 0, 1, 0, 0, 1e6f, 0, 1, 0, 1e6f, 0, 0, 1}},
                  2000004.000001,
                  1,
                  {1e6f, 0, 0},
                  {2000001, 1, 1},
                  0}};
    placed_begin(1, sizeof cases / sizeof *cases);
    placed.meshes[0] = cube();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        placed.instances[i].object_to_world = cases[i].matrix;
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(facts[i].triangles, 12);
        assert_true(facts[i].is_closed && facts[i].has_box);
        assert_true(facts[i].shells.outward == 1 && facts[i].shells.inward == 0 && facts[i].shells.open == 0);
        assert_near(facts[i].area, cases[i].area);
        assert_near(facts[i].volume, cases[i].volume);
        assert_int_equal(facts[i].has_center, cases[i].volume > 0);
        assert_int_equal(facts[i].least_wall.is_found, cases[i].wall > 0);
        assert_near(facts[i].least_wall.thickness, cases[i].wall);
        for (int k = 0; k < 3 && facts[i].has_center; k++)
            assert_near(facts[i].center[k], ((double)(&cases[i].min.x)[k] + (double)(&cases[i].max.x)[k]) / 2);
        assert_memory_equal(&facts[i].min, &cases[i].min, sizeof facts[i].min);
        assert_memory_equal(&facts[i].max, &cases[i].max, sizeof facts[i].max);
    }
}

/* Faces by their corners, 0 between them, of the positions below. Corners count from 1. */
enum { CORNERS_MOST = 64 };
static const zr_vec4 places[] = {
    {0, 0, 0, 1}, {1, 0, 0, 1},     {1, 1, 0, 1}, {0, 1, 0, 1},
    {0, 0, 1, 1}, {1, 0, 1, 1},     {1, 1, 1, 1}, {0, 1, 1, 1}, /* 1 to 8: the cube */
    {0, 0, 0, 1}, {1e-7f, 0, 0, 1},                             /* 9, 10: the same as 1 */
    {2, 0, 0, 1}, {2, 1, 0, 1},     {2, 0, 1, 1}, {2, 1, 1, 1}, /* 11 to 14: a cube beside */
    {4, 0, 0, 2},                                               /* 15: the same as 11 */
    {1, 0, 0, 0}};                                              /* 16: at infinity */
#define CUBE 1, 4, 3, 2, 0, 5, 6, 7, 8, 0, 1, 2, 6, 5, 0, 3, 4, 8, 7, 0, 1, 5, 8, 4, 0

static void make_faces(struct zr_mesh *mesh, const uint32_t *faces, size_t count)
{
    static uint32_t offsets[CORNERS_MOST], indices[CORNERS_MOST];
    uint32_t corner = 0;
    *mesh = (struct zr_mesh){.name = "mesh",
                             .positions = places,
                             .position_count = sizeof places / sizeof *places,
                             .face_offsets = offsets,
                             .indices = indices};
    while (count > 0 && faces[count - 1] == 0) /* unused end of the row */
        count--;
    for (size_t i = 0; i < count; i++) {
        if (faces[i] != 0) indices[corner++] = faces[i] - 1;
        if (faces[i] == 0 || i + 1 == count) offsets[++mesh->face_count] = corner;
    }
}

TEST_AROUND(edges_used_equally_in_both_directions_close_a_part, open_arena, close_arena)
{
    static const struct {
        const char *what;
        bool is_closed;
        double area, volume;
        uint32_t faces[CORNERS_MOST];
    } cases[] = {{"a cube", true, 6, 1, {CUBE, 2, 3, 7, 6}},
                 {"inside out", true, 6, -1, {1, 2, 3, 4, 0, 8, 7, 6, 5, 0, 5, 6, 2, 1, 0,
                                              7, 8, 4, 3, 0, 4, 8, 5, 1, 0, 6, 7, 3, 2}},
                 {"without a face", false, 5, 0, {CUBE}},
                 {"with a turned face", false, 6, 0, {CUBE, 6, 7, 3, 2}},
                 {"with a doubled face", false, 7, 0, {CUBE, 2, 3, 7, 6, 0, 2, 3, 7, 6}},
                 {"with a triangle that needs welding", true, 6, 1, {1, 4, 3, 0, 9, 3, 2, 0, 5, 6, 7, 8, 0, 10, 2, 6,
                                                                     5, 0, 3, 4, 8, 7, 0, 1, 5, 8, 4, 0, 2, 3,  7, 6}},
                 {"with a triangle of two places", true, 6, 1, {CUBE, 2, 3, 7, 6, 0, 2, 3, 2}},
                 {"with a triangle of two welded places", true, 6, 1, {CUBE, 2, 3, 7, 6, 0, 1, 9, 3}},
                 {"with a corner twice in a face", true, 6, 1, {CUBE, 2, 2, 3, 7, 6}},
                 {"two triangles, back to back", true, 1, 0, {1, 2, 3, 0, 1, 3, 2}},
                 {"two tetrahedra that touch along an edge", true, 4.7320508, 1.0 / 3, {1, 4, 2, 0, 1, 2, 5, 0, 1, 5, 4,
                                                                                        0, 2, 4, 5, 0, 8, 4, 5, 0, 8, 5,
                                                                                        7, 0, 8, 7, 4, 0, 5, 4, 7}},
                 {"one triangle", false, 0.5, 0, {1, 2, 3}},
                 {"no area at all", false, 0, 0, {1, 2, 1, 0, 3, 3, 3}},
                 {"a box of two cubes without the face between them", true, 10, 2, {CUBE, 2, 11, 13, 6,  0,  3, 7, 14,
                                                                                    12,   0, 2,  3,  12, 11, 0, 6, 13,
                                                                                    14,   7, 0,  15, 12, 14, 13}},
                 {"a corner at infinity", false, 5, 0, {CUBE, 2, 3, 7, 16}},
                 {"a concave face", false, 0.75, 0, {1, 2, 3, 4, 17}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        placed_begin(1, 1);
        make_faces(&placed.meshes[0], cases[i].faces, CORNERS_MOST);
        zr_vec4 moved[17];
        memcpy(moved, places, sizeof places);
        moved[16] = (zr_vec4){0.5f, 0.5f, 0, 1};
        placed.meshes[0].positions = moved;
        placed.meshes[0].position_count = 17;
        const struct zr_part_facts *facts = placed_facts(&arena, NULL);
        if (facts->is_closed != cases[i].is_closed || !(fabs(facts->area - cases[i].area) < 1e-6) ||
            !(fabs(facts->volume - cases[i].volume) < 1e-6))
            fail_msg("%s: closed %d, area %.9g, volume %.9g", cases[i].what, facts->is_closed, facts->area,
                     facts->volume);
    }
}

/* A square frame: both caps have a hole, in either direction, and eight faces join them. */
TEST_AROUND(holes_are_left_out_whatever_their_direction, open_arena, close_arena)
{
    static const zr_vec4 frame[] = {{0, 0, 0, 1}, {3, 0, 0, 1}, {3, 3, 0, 1}, {0, 3, 0, 1}, {1, 1, 0, 1}, {2, 1, 0, 1},
                                    {2, 2, 0, 1}, {1, 2, 0, 1}, {0, 0, 2, 1}, {3, 0, 2, 1}, {3, 3, 2, 1}, {0, 3, 2, 1},
                                    {1, 1, 2, 1}, {2, 1, 2, 1}, {2, 2, 2, 1}, {1, 2, 2, 1}};
    static const uint32_t rings[] = {0, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    uint32_t ring_offsets[13], face_offsets[11];
    for (int turned = 0; turned < 2; turned++) {
        uint32_t indices[48] = {0, 3, 2, 1, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 14, 13};
        for (uint32_t r = 0; r <= 12; r++)
            ring_offsets[r] = 4 * r;
        for (uint32_t f = 0; f <= 10; f++)
            face_offsets[f] = ring_offsets[rings[f]];
        for (uint32_t k = 0; turned && k < 2; k++) { /* the holes */
            const uint32_t swapped = indices[8 * k + 5];
            indices[8 * k + 5] = indices[8 * k + 7];
            indices[8 * k + 7] = swapped;
        }
        for (uint32_t side = 0; side < 4; side++) {
            const uint32_t next = (side + 1) % 4;
            const uint32_t outer[4] = {side, next, 8 + next, 8 + side},
                           inner[4] = {4 + side, 12 + side, 12 + next, 4 + next};
            memcpy(indices + 16 + 8 * side, outer, sizeof outer);
            memcpy(indices + 20 + 8 * side, inner, sizeof inner);
        }
        placed_begin(1, 1);
        placed.meshes[0] = (struct zr_mesh){.name = "frame",
                                            .position_count = 16,
                                            .positions = frame,
                                            .face_count = 10,
                                            .face_offsets = face_offsets,
                                            .indices = indices,
                                            .face_rings = rings,
                                            .ring_offsets = ring_offsets};
        const struct zr_part_facts *facts = placed_facts(&arena, NULL);
        assert_true(facts->is_closed);
        assert_near(facts->area, 2 * 8 + 4 * 6 + 4 * 2);
        assert_near(facts->volume, 16);
        assert_int_equal(facts->triangles, 2 * 8 + 8 * 2);
    }
}

/* ---- large meshes, parts, threads ---- */

enum { STACKS = 100, SLICES = 200, SPHERE_FACES = 2 * SLICES * (STACKS - 1) };

/* Triangles that share no corners, on a ball of radius 1. */
static struct zr_mesh sphere(void)
{
    static zr_vec4 positions[3 * SPHERE_FACES];
    static uint32_t offsets[SPHERE_FACES + 1], indices[3 * SPHERE_FACES];
    uint32_t corner = 0;
    for (int i = 0; i < STACKS; i++)
        for (int j = 0; j < SLICES; j++) {
            zr_vec4 quad[4];
            for (int k = 0; k < 4; k++) {
                const int stack = i + (k == 1 || k == 2), slice = (j + (k >= 2)) % SLICES;
                const double t = M_PI * stack / STACKS, p = 2 * M_PI * slice / SLICES;
                quad[k] = (zr_vec4){(float)(sin(t) * cos(p)), (float)(sin(t) * sin(p)), (float)cos(t), 1};
                if (stack == 0 || stack == STACKS) quad[k] = (zr_vec4){0, 0, stack ? -1.0f : 1.0f, 1};
            }
            for (int half = 0; half < 2; half++) {
                if (i == (half ? 0 : STACKS - 1)) continue;
                positions[corner++] = quad[0];
                positions[corner++] = quad[1 + half];
                positions[corner++] = quad[2 + half];
            }
        }
    assert_int_equal(corner, 3 * SPHERE_FACES);
    for (uint32_t i = 0; i < corner; i++)
        indices[i] = i;
    for (uint32_t f = 0; f <= SPHERE_FACES; f++)
        offsets[f] = 3 * f;
    return (struct zr_mesh){.name = "sphere",
                            .position_count = corner,
                            .positions = positions,
                            .face_count = SPHERE_FACES,
                            .face_offsets = offsets,
                            .indices = indices};
}

TEST_AROUND(a_sphere_has_nearly_the_area_and_volume_of_the_formula, open_arena, close_arena)
{
    placed_begin(1, 1);
    placed.meshes[0] = sphere();
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    assert_true(facts->is_closed);
    assert_true(fabs(facts->area / (4 * M_PI) - 1) < 1e-3);
    assert_true(fabs(facts->volume / (4 * M_PI / 3) - 1) < 1e-3);
}

/* Three parts: the upper and the lower half, which are open, and a part without faces. */
TEST_AROUND(parts_are_measured_alone_and_alike_by_all_teams, open_arena, close_arena)
{
    static uint32_t parts[SPHERE_FACES];
    static const char *const names[] = {"lower", "nothing", "upper"};
    placed_begin(2, 3);
    placed.meshes[0] = placed.meshes[1] = sphere();
    for (uint32_t f = 0; f < SPHERE_FACES; f++)
        parts[f] = f < SPHERE_FACES / 2 ? 2 : 0;
    placed.meshes[0].face_parts = parts;
    placed.meshes[0].part_count = 3;
    placed.meshes[0].part_names = names;
    placed.instances[2] =
        (struct zr_instance){.mesh = 1, .object_to_world = {{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}}};
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    assert_true(facts[0].min.z == -1 && facts[0].max.z < 1e-6f && facts[2].min.z > -1e-6f && facts[2].max.z == 1);
    assert_near(facts[0].area, facts[2].area);
    assert_near(facts[0].area + facts[2].area, facts[3].area);
    assert_near(4 * facts[3].area, facts[4].area);
    assert_near(8 * facts[3].volume, facts[4].volume);
    assert_true(!facts[0].is_closed && !facts[2].is_closed && facts[3].is_closed && facts[4].is_closed);
    assert_true(!facts[1].has_box && !facts[1].is_closed && facts[1].triangles == 0 && facts[1].area == 0);
    assert_int_equal(facts[0].triangles + facts[2].triangles, SPHERE_FACES);
    for (int threads = 2; threads <= 7; threads += 5) {
        struct zr_team *team = zr_team_create(threads);
        const struct zr_part_facts *others = placed_facts(&arena, team);
        zr_team_destroy(team);
        for (int i = 0; i < 5; i++) {
            assert_memory_equal(&others[i].area, &facts[i].area, sizeof facts[i].area);
            assert_memory_equal(&others[i].volume, &facts[i].volume, sizeof facts[i].volume);
            assert_memory_equal(&others[i].color, &facts[i].color, sizeof facts[i].color);
            assert_int_equal(others[i].is_closed, facts[i].is_closed);
        }
    }
}

/* One vertex has all edges of a fan, too many to compare each with each. */
TEST_AROUND(a_closed_cone_of_many_faces_takes_no_time, open_arena, close_arena)
{
    enum { SIDES = 100000 };
    zr_vec4 *positions = zr_arena_alloc(&arena, SIDES + 2, sizeof *positions);
    uint32_t *indices = zr_arena_alloc(&arena, 6 * SIDES, sizeof *indices),
             *offsets = zr_arena_alloc(&arena, 2 * SIDES + 1, sizeof *offsets);
    positions[0] = (zr_vec4){0, 0, 1, 1};
    positions[1] = (zr_vec4){0, 0, 0, 1};
    for (uint32_t i = 0; i < SIDES; i++) {
        const double angle = 2 * M_PI * i / SIDES;
        const uint32_t next = 2 + (i + 1) % SIDES, of[6] = {0, 2 + i, next, 1, next, 2 + i};
        positions[2 + i] = (zr_vec4){(float)cos(angle), (float)sin(angle), 0, 1};
        memcpy(indices + 6 * (size_t)i, of, sizeof of);
    }
    for (uint32_t f = 0; f <= 2 * SIDES; f++)
        offsets[f] = 3 * f;
    placed_begin(1, 1);
    placed.meshes[0] = (struct zr_mesh){.name = "cone",
                                        .position_count = SIDES + 2,
                                        .positions = positions,
                                        .face_count = 2 * SIDES,
                                        .face_offsets = offsets,
                                        .indices = indices};
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    assert_true(facts->is_closed);
    assert_true(fabs(facts->volume - M_PI / 3) < 1e-6);
}

/* ---- random meshes ---- */

enum { RANDOM_FACES = 12, RANDOM_PARTS = 3, RANDOM_PLACES = 5 };

/* Counts the occurrences of each edge in a table of all pairs of positions. */
static void find_closed_plainly(const struct zr_mesh *mesh, bool closed[RANDOM_PARTS])
{
    static int uses[RANDOM_PARTS][RANDOM_PLACES][RANDOM_PLACES];
    bool any[RANDOM_PARTS] = {false};
    memset(uses, 0, sizeof uses);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *a = mesh->indices + mesh->face_offsets[f], part = mesh->face_parts[f];
        if (a[0] == a[1] || a[1] == a[2] || a[0] == a[2]) continue;
        any[part] = true;
        for (int k = 0; k < 3; k++)
            uses[part][a[k]][a[(k + 1) % 3]]++;
    }
    for (int p = 0; p < RANDOM_PARTS; p++) {
        closed[p] = any[p];
        for (int i = 0; i < RANDOM_PLACES; i++)
            for (int k = 0; k < RANDOM_PLACES; k++)
                closed[p] = closed[p] && uses[p][i][k] == uses[p][k][i];
    }
}

/* Few positions, so that many parts are closed. */
TEST_AROUND(closed_parts_are_those_of_a_plain_count, open_arena, close_arena)
{
    static const zr_vec4 at[RANDOM_PLACES] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    static const char *const names[RANDOM_PARTS] = {"a", "b", "c"};
    uint32_t offsets[RANDOM_FACES + 1], indices[3 * RANDOM_FACES], parts[RANDOM_FACES], closed_count = 0;
    struct random random = random_seeded(1);
    for (int round = 0; round < 20000; round++) {
        uint8_t found[RANDOM_PARTS];
        bool want[RANDOM_PARTS];
        const uint32_t faces = 1 + random_below(&random, RANDOM_FACES);
        for (uint32_t f = 0; f <= faces; f++)
            offsets[f] = 3 * f;
        for (uint32_t i = 0; i < 3 * faces; i++)
            indices[i] = random_below(&random, RANDOM_PLACES);
        for (uint32_t f = 0; f < faces; f++) {
            parts[f] = random_below(&random, RANDOM_PARTS);
            if (f == 0 || random_below(&random, 3) != 0) continue;
            const uint32_t of = 3 * random_below(&random, f), to[3] = {indices[of], indices[of + 2], indices[of + 1]};
            memcpy(indices + 3 * f, to, sizeof to); /* the same face with rotated corners */
            parts[f] = parts[of / 3];
        }
        const struct zr_mesh mesh = {.name = "random",
                                     .position_count = RANDOM_PLACES,
                                     .positions = at,
                                     .face_count = faces,
                                     .face_offsets = offsets,
                                     .indices = indices,
                                     .face_parts = parts,
                                     .part_count = RANDOM_PARTS,
                                     .part_names = names};
        find_closed_plainly(&mesh, want);
        assert_true(zr_closed_parts_find(&(struct zr_run){.arena = &arena}, &mesh, found, NULL));
        for (int p = 0; p < RANDOM_PARTS; p++) {
            if (found[p] != want[p]) fail_msg("round %d, part %d", round, p);
            closed_count += found[p];
        }
    }
    assert_true(closed_count > 1000);
    assert_true(arena.used < 1 << 16); /* the scratch was given back */
}

/* ---- colours, lines and points ---- */

TEST_AROUND(colours_are_means_by_area, open_arena, close_arena)
{
    static const zr_vec4 face_colors[6] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1},
                                           {0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 1, 1}};
    zr_vec4 colors[8];
    placed_begin(3, 4);
    for (int i = 0; i < 8; i++)
        colors[i] = (zr_vec4){0, cube_positions[i].z, 1, 1};
    placed.meshes[0] = placed.meshes[1] = placed.meshes[2] = cube();
    placed.meshes[0].face_colors = face_colors;
    placed.meshes[1].colors = colors;
    placed.test.material.base_color = (zr_vec4){0.5f, 1, 1, 1};
    placed.instances[3] =
        (struct zr_instance){.mesh = 0, .object_to_world = {{3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    const zr_vec3 want[4] = {{1.0f / 6, 0, 2.0f / 3}, {0, 0.5f, 1}, {0.5f, 1, 1}, {0.5f * 6 / 14, 0, 8.0f / 14}};
    for (int i = 0; i < 4; i++)
        if (!(fabsf(facts[i].color.x - want[i].x) < 1e-6f && fabsf(facts[i].color.y - want[i].y) < 1e-6f &&
              fabsf(facts[i].color.z - want[i].z) < 1e-6f))
            fail_msg("%d: %g %g %g", i, (double)facts[i].color.x, (double)facts[i].color.y, (double)facts[i].color.z);
}

TEST_AROUND(lines_and_points_have_a_box_and_a_colour, open_arena, close_arena)
{
    static const uint32_t line[2] = {0, 6}, point = 2, no_faces[1] = {0};
    static const zr_vec4 colors[8] = {[0] = {1, 0, 0, 1}, [2] = {0, 1, 0, 1}, [6] = {0, 0, 1, 1}};
    placed_begin(1, 1);
    placed.meshes[0] = cube();
    placed.meshes[0].face_count = 0;
    placed.meshes[0].face_offsets = no_faces;
    placed.meshes[0].lines = line;
    placed.meshes[0].line_count = 1;
    placed.meshes[0].points = &point;
    placed.meshes[0].point_count = 1;
    placed.meshes[0].colors = colors;
    placed.test.material.base_color = (zr_vec4){1, 1, 1, 1};
    const struct zr_part_facts *facts = placed_facts(&arena, NULL);
    assert_true(facts->has_box && facts->max.z == 1 && facts->min.x == 0);
    assert_true(!facts->is_closed && facts->area == 0 && facts->triangles == 0);
    assert_true(fabsf(facts->color.x - 1.0f / 3) < 1e-6f && fabsf(facts->color.z - 1.0f / 3) < 1e-6f);
}

/* ---- edges ---- */

TEST_AROUND(odd_edges_are_counted_with_a_place, open_arena, close_arena)
{
    static const struct {
        uint32_t faces; /* of the cube; the last one ends at z = 1 */
        bool is_flipped;
        uint32_t open, flipped;
        double at[3];
    } cases[] = {{6, false, 0, 0, {0}}, {5, false, 4, 0, {12, 0.5, 0}}, {6, true, 0, 4, {11, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t indices[24];
        placed_begin(1, 1);
        placed.meshes[0] = cube();
        placed.meshes[0].face_count = cases[i].faces;
        memcpy(indices, cube_indices, sizeof indices);
        for (int k = 0; cases[i].is_flipped && k < 4; k++)
            indices[k] = cube_indices[3 - k];
        placed.meshes[0].indices = indices;
        placed.instances[0].object_to_world = (zr_mat4){{2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}};
        const struct zr_part_facts *facts = placed_facts(&arena, NULL);
        assert_int_equal(facts->is_closed, i == 0);
        const struct zr_edge_facts *edges = cases[i].open > 0 ? &facts->open_edges : &facts->flipped_edges;
        if (facts->open_edges.count != cases[i].open || facts->flipped_edges.count != cases[i].flipped ||
            memcmp(edges->at, cases[i].at, sizeof edges->at) != 0)
            fail_msg("case %zu: %u open, %u flipped, %g %g %g", i, facts->open_edges.count, facts->flipped_edges.count,
                     edges->at[0], edges->at[1], edges->at[2]);
    }
}

/* ---- limits ---- */

TEST_AROUND(a_full_arena_and_a_cancelled_request_are_told, open_arena, close_arena)
{
    struct zr_part_facts facts;
    struct zr_cancel cancel = {0};
    placed_begin(1, 1);
    placed.meshes[0] = sphere();
    const struct zr_part_list list = zr_part_list_make(&arena, &placed.test.scene, 100);
    cancel.raised = true;
    assert_int_equal(
        zr_part_facts_find(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &placed.test.scene, &list, &facts),
        ZR_CANCELLED);
    struct zr_arena small;
    zr_arena_init(&small, 1 << 20);
    assert_int_equal(zr_part_facts_find(&(struct zr_run){.arena = &small}, &placed.test.scene, &list, &facts),
                     ZR_NO_MEMORY);
    zr_arena_free(&small);
}

RUN_TESTS(NULL, NULL)
